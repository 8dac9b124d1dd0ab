//! Every scene's camera and light move without a jump and without touching what stands there.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use glam::DVec3;
use scumble_core::{Aabb, Light};
use scumble_scenes::{Scene, catalogue, open};
use std::path::PathBuf;

/// Samples of a path.
const FRAMES: u32 = 128;

fn scenes() -> impl Iterator<Item = Scene> {
    let assets = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../assets");
    catalogue().iter().filter(|entry| entry.model.is_none()).map(move |entry| open(entry.name, &assets).unwrap())
}

fn frames() -> impl Iterator<Item = f64> {
    (0..=FRAMES).map(|i| f64::from(i) / f64::from(FRAMES))
}

#[test]
fn every_scene_can_be_approached_panned_crept_through_and_swept() {
    for scene in scenes() {
        for name in ["approach", "pan", "creep", "sweep"] {
            assert_eq!(scene.path(name).unwrap().name, name);
        }
        assert!(scene.path("fly").is_none());
    }
}

#[test]
fn paths_are_finite_deterministic_and_without_jumps() {
    for scene in scenes() {
        let size = scene.bounds().size().length();
        for path in scene.camera_paths().iter().chain(&scene.light_paths()) {
            let poses: Vec<_> = frames().map(|t| path.at(t).unwrap()).collect();
            for pair in poses.windows(2) {
                let step = pair[0].position.distance(pair[1].position);
                assert!(step <= 0.05 * size, "{} {}: {step}", scene.name, path.name);
                assert!(pair[0].direction.angle_between(pair[1].direction) <= 0.05, "{} {}", scene.name, path.name);
            }
            assert!(poses.iter().all(|pose| pose.position.is_finite() && pose.direction.is_normalized()));
            assert_eq!(poses[7], path.at(7.0 / f64::from(FRAMES)).unwrap());
        }
    }
}

#[test]
fn a_path_begins_at_the_camera_and_the_light_of_the_scene() {
    for scene in scenes() {
        let size = scene.bounds().size().length();
        for path in scene.camera_paths() {
            let (start, _) = scene.moved(&path, 0.0);
            assert!(start.eye.abs_diff_eq(scene.camera.eye, 1e-12 * size), "{} {}", scene.name, path.name);
            assert!(start.target.abs_diff_eq(scene.camera.target, 1e-12 * size), "{} {}", scene.name, path.name);
        }
        let sweep = scene.path("sweep").unwrap();
        let (_, start) = scene.moved(&sweep, 0.0);
        let (position, direction) = parts(&start);
        let (of_scene, aimed) = parts(&scene.light);
        assert!(position.abs_diff_eq(of_scene, 1e-12 * size) && direction.abs_diff_eq(aimed.normalize(), 1e-12));
        for t in frames() {
            let (camera, light) = scene.moved(&sweep, t);
            assert!(light.checked().is_ok() && camera == scene.camera);
        }
    }
}

fn parts(light: &Light) -> (DVec3, DVec3) {
    match *light {
        Light::Directional { direction, .. } => (DVec3::ZERO, direction),
        Light::Spot { position, direction, .. } => (position, direction),
        Light::Point { position, .. } => (position, DVec3::ZERO),
    }
}

/// The corner of the near plane is as far as this from the eye; no triangle's box may come nearer.
#[test]
fn no_camera_path_leads_through_a_surface() {
    for scene in scenes() {
        let camera = &scene.camera;
        let half_height = (camera.vertical_fov / 2.0).tan();
        let corner = camera.near * (1.0 + half_height * half_height * (1.0 + camera.aspect * camera.aspect)).sqrt();
        let boxes: Vec<Aabb> = scene
            .meshes
            .iter()
            .flat_map(|mesh| {
                mesh.triangles.iter().map(|t| Aabb::from_points(t.map(|i| mesh.positions[i as usize].as_dvec3())))
            })
            .collect();
        for path in scene.camera_paths() {
            // Nine samples: the way is straight and the objects are larger than an eighth of it.
            for i in 0..=8 {
                let eye = path.at(f64::from(i) / 8.0).unwrap().position;
                let nearest = boxes.iter().map(|b| eye.distance(eye.clamp(b.min, b.max))).fold(f64::INFINITY, f64::min);
                assert!(nearest > corner, "{} {}: {nearest} at {eye}", scene.name, path.name);
            }
        }
    }
}
