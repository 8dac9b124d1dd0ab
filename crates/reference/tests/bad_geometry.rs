//! Scenes that no loader would return: what is no surface is left out and named, the rest is met as before.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod common;

use common::sun;
use glam::{DVec3, Vec3};
use scumble_core::{Filter, fit};
use scumble_reference::{Estimate, KernelTruth, LightTruth, Rays, Receiver};
use scumble_scenes::{Mesh, Scene, cuboid, ground};

fn good() -> Vec<Mesh> {
    let lid = cuboid("box", DVec3::new(-1.0, 1.0, -1.0), DVec3::new(0.0, 2.0, 1.0), Vec3::ONE);
    vec![ground("ground", DVec3::ZERO, 8.0, Vec3::ONE), lid]
}

fn scene(meshes: Vec<Mesh>) -> Scene {
    common::scene(sun(DVec3::new(0.2, -1.0, 0.1)), meshes)
}

/// Kernel and light truth along the ground, as far as the good meshes reach.
fn truths(scene: &Scene) -> (Vec<f32>, Vec<Estimate>) {
    let rays = Rays::new(scene);
    let good = self::scene(good());
    let fit = fit(&good.camera, &good.bounds(), &good.light, true).unwrap().unwrap();
    let receiver =
        |i: u32| Receiver { position: Vec3::new(-2.0 + 0.04 * i as f32, 0.0, 0.03), normal: Vec3::Y, pixel: [i, 0] };
    let receivers: Vec<Receiver> = (0..100).map(receiver).collect();
    let filter = Filter::Pcf { radius_world: 0.2 };
    let light = LightTruth::new(&rays, &scene.light, 64).unwrap();
    (KernelTruth::new(&rays, &fit, filter).visibility(&receivers, |_| ()), light.visibility(&receivers, |_| ()))
}

#[test]
fn a_good_scene_has_nothing_to_tell() {
    assert!(Rays::new(&scene(good())).skipped().is_empty());
}

#[test]
fn corners_that_are_no_points_are_named_with_their_mesh_and_the_rest_stays_as_it_is() {
    let expected = truths(&scene(good()));
    for wrong in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut meshes = good();
        // A mesh between light and ground, of which one corner in four is no point: both its triangles use it.
        let mut torn = ground("torn", DVec3::new(0.0, 3.0, 0.0), 4.0, Vec3::ONE);
        torn.positions[0].y = wrong;
        meshes.insert(1, torn);
        let found = scene(meshes);
        assert_eq!(truths(&found), expected, "{wrong}");
        let rays = Rays::new(&found);
        let [skipped] = rays.skipped() else { panic!("{:?}", rays.skipped()) };
        assert_eq!((&skipped.mesh[..], skipped.triangles, skipped.broken, skipped.flat), ("torn", 2, 2, 0));
        let words = skipped.to_string();
        assert!(words.contains("torn") && words.contains("of 2 triangles 2 "), "{words}");
    }
}

#[test]
fn corners_and_normals_that_are_missing_are_no_surface_and_no_panic() {
    let mut meshes = good();
    meshes[1].triangles.push([0, 1, 4_000_000]);
    meshes[1].normals.clear();
    let found = scene(meshes);
    let rays = Rays::new(&found);
    assert_eq!((rays.skipped()[0].broken, rays.skipped()[0].triangles), (1, 13));
    let hit = rays.first_hit(DVec3::new(-0.5, 5.0, 0.3), DVec3::NEG_Y).unwrap();
    assert_eq!((hit.shading_normal, hit.position.y), (DVec3::Y, 2.0));
}

#[test]
fn triangles_without_an_area_are_named_and_no_ray_stops_at_them() {
    let expected = truths(&scene(good()));
    let mut meshes = good();
    let line = [Vec3::new(-2.0, 3.0, 0.03), Vec3::new(0.1, 3.0, 0.03), Vec3::new(2.0, 3.0, 0.03)];
    meshes.push(Mesh {
        name: "lines".to_owned(),
        positions: line.to_vec(),
        normals: vec![Vec3::Y; 3],
        triangles: vec![[0, 1, 2], [0, 0, 0], [1, 2, 1]],
        linear_color: Vec3::ONE,
        mask: None,
    });
    let found = scene(meshes);
    assert_eq!(truths(&found), expected);
    assert_eq!((Rays::new(&found).skipped()[0].flat, Rays::new(&found).skipped().len()), (3, 1));
}

#[test]
fn triangles_that_are_there_many_times_are_met_as_one() {
    let expected = truths(&scene(good()));
    let mut meshes = good();
    for mesh in &mut meshes {
        let once = mesh.triangles.clone();
        // So often that the boxes of the hierarchy coincide too.
        mesh.triangles = once.iter().copied().cycle().take(100 * once.len()).collect();
    }
    let found = scene(meshes);
    assert_eq!(truths(&found), expected);
    let rays = Rays::new(&found);
    assert!(rays.skipped().is_empty());
    assert_eq!(rays.all_hits(DVec3::new(-0.5, 5.0, 0.3), DVec3::NEG_Y).len(), 3);
}

#[test]
fn no_triangle_of_a_fan_of_slender_ones_is_lost() {
    // Their boxes all overlap, which makes the deepest of trees.
    let count = 2000;
    let rim = |i: u32| {
        let (sin, cos) = (f64::from(i) / f64::from(count) * std::f64::consts::TAU).sin_cos();
        DVec3::new(cos, 1.0, sin)
    };
    let mut positions: Vec<Vec3> = (0..count).map(|i| rim(i).as_vec3()).collect();
    positions.push(Vec3::new(1.0, 1.0, 0.0));
    let triangles: Vec<[u32; 3]> = (0..count - 1).map(|i| [count, i, i + 1]).collect();
    let normals = vec![Vec3::Y; positions.len()];
    let fan = Mesh { name: "fan".to_owned(), positions, normals, triangles, linear_color: Vec3::ONE, mask: None };
    let rays = Rays::new(&scene(vec![fan]));
    for i in 0..20_000_u32 {
        let (turn, radius) = (f64::from(i) * 2.399_963, (f64::from(i) / 20_000.0).sqrt() * 0.999);
        let from = DVec3::new(radius * turn.cos(), 2.0, radius * turn.sin());
        assert!(rays.first_hit(from, DVec3::NEG_Y).is_some(), "{from}");
        assert!(!rays.free(from, from - DVec3::Y * 2.0), "{from}");
    }
}

#[test]
fn a_scene_without_a_surface_is_all_lit() {
    for meshes in [
        vec![],
        vec![Mesh { triangles: vec![], ..good().remove(0) }],
        vec![Mesh { positions: vec![], ..good().remove(0) }],
    ] {
        let (kernel, light) = truths(&scene(meshes));
        assert!(kernel.iter().all(|&visibility| visibility == 1.0));
        assert!(light.iter().all(|estimate| estimate.visibility == 1.0));
    }
}
