//! Every scene of the catalogue keeps what `Scene` and `Mesh` promise.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use glam::DVec3;
use scumble_core::Light;
use scumble_scenes::{Entry, MODELS_VARIABLE, Scene, catalogue, open};
use std::path::PathBuf;

fn assets() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../assets")
}

/// The scenes whose models are in the repository.
fn shipped() -> impl Iterator<Item = &'static Entry> {
    catalogue().iter().filter(|entry| entry.model.is_none())
}

fn scenes() -> impl Iterator<Item = Scene> {
    shipped().map(|entry| open(entry.name, &assets()).unwrap())
}

#[test]
fn names_are_unique_and_described_in_one_line() {
    for (i, entry) in catalogue().iter().enumerate() {
        assert!(!entry.description.is_empty() && !entry.description.contains('\n'));
        assert!(catalogue()[i + 1..].iter().all(|other| other.name != entry.name));
    }
    for entry in shipped() {
        assert_eq!(open(entry.name, &assets()).unwrap().name, entry.name);
    }
}

#[test]
fn a_scene_whose_model_is_not_there_says_which_file_it_needs_and_where_that_comes_from() {
    let folder = tempfile::tempdir().unwrap();
    let assets = folder.path().join("assets");
    for entry in catalogue().iter().filter(|entry| entry.model.is_some()) {
        if std::env::var_os(MODELS_VARIABLE).is_none() {
            let file = entry.missing(&assets).unwrap();
            let refused = open(entry.name, &assets).unwrap_err().to_string();
            for part in [entry.name, &file.display().to_string(), "CC", MODELS_VARIABLE] {
                assert!(refused.contains(part) && !refused.contains('\n'), "{refused}");
            }
        }
    }
}

#[test]
fn meshes_have_unit_normals_finite_positions_and_triangles_with_area() {
    for scene in scenes() {
        for mesh in &scene.meshes {
            let place = format!("{} {}", scene.name, mesh.name);
            assert_eq!(mesh.positions.len(), mesh.normals.len(), "{place}");
            assert!(mesh.positions.iter().all(|p| p.is_finite()), "{place}");
            assert!(mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-5), "{place}");
            assert!(mesh.linear_color.cmpge(glam::Vec3::ZERO).all() && mesh.linear_color.cmple(glam::Vec3::ONE).all());
            for triangle in &mesh.triangles {
                let [a, b, c] = triangle.map(|i| mesh.positions[i as usize].as_dvec3());
                assert!((b - a).cross(c - a).length() > 0.0, "{place}");
            }
        }
    }
}

#[test]
fn cameras_and_lights_are_in_range_and_the_camera_sees_the_middle() {
    for scene in scenes() {
        assert!(scene.camera.checked().is_ok() && scene.light.checked().is_ok(), "{}", scene.name);
        assert!(scene.pcf_radius_world > 0.0);
        let ndc = scene.camera.clip_from_world().project_point3(scene.camera.target);
        assert!(ndc.abs_diff_eq(DVec3::new(0.0, 0.0, ndc.z), 1e-9) && (0.0..1.0).contains(&ndc.z));
        if let Light::Spot { position, .. } = scene.light {
            let bounds = scene.bounds();
            assert!(position.cmpgt(bounds.min).all(), "{} has its lamp inside", scene.name);
        }
    }
}

#[test]
fn models_stand_on_the_ground_and_have_the_size_of_things() {
    for scene in scenes().filter(|scene| !["giant", "speck", "wedge"].contains(&scene.name.as_str())) {
        let is_stage =
            |name: &str| ["ground", "terrace", "floor", "stage", "wall"].iter().any(|part| name.contains(part));
        let mut models = scene.clone();
        models.meshes.retain(|mesh| !is_stage(&mesh.name));
        let bounds = models.bounds();
        assert!(bounds.min.y.abs() < 1e-4, "{}: {bounds:?}", scene.name);
        assert!((1.0..4.0).contains(&bounds.max.y), "{}: {bounds:?}", scene.name);
    }
}

#[test]
fn the_light_reaches_what_the_camera_looks_at() {
    for scene in scenes() {
        assert!(scumble_core::fit(&scene.camera, &scene.bounds(), &scene.light, true).is_ok(), "{}", scene.name);
        if let Light::Spot { position, direction, cone_half_angle, .. } = scene.light {
            let angle = direction.angle_between(scene.camera.target - position);
            assert!(angle < cone_half_angle, "{}: {angle}", scene.name);
        }
    }
}

#[test]
fn the_giant_and_the_speck_are_exact_copies_of_the_contact() {
    let contact = open("contact", &assets()).unwrap();
    for (name, factor) in [("giant", 2f64.powi(20)), ("speck", 2f64.powi(-20))] {
        let copy = open(name, &assets()).unwrap();
        assert_eq!(copy.meshes.len(), contact.meshes.len());
        for (copied, original) in copy.meshes.iter().zip(&contact.meshes) {
            let enlarged: Vec<_> = original.positions.iter().map(|&p| p * factor as f32).collect();
            assert_eq!(copied.positions, enlarged, "{name}");
            assert_eq!((&copied.triangles, &copied.normals), (&original.triangles, &original.normals), "{name}");
        }
        assert_eq!(copy.light, contact.light);
        assert_eq!(copy.camera.eye / factor, contact.camera.eye);
        assert_eq!(copy.camera.target / factor, contact.camera.target);
        assert_eq!([copy.camera.near, copy.camera.far], [contact.camera.near, contact.camera.far].map(|x| x * factor));
        assert_eq!(copy.pcf_radius_world / factor, contact.pcf_radius_world);
    }
}

#[test]
fn the_yard_is_as_rich_as_a_hundred_thousand_triangles() {
    let yard = open("yard", &assets()).unwrap();
    assert!((80_000..110_000).contains(&yard.triangle_count()), "{}", yard.triangle_count());
}
