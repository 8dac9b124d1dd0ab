//! Lit surfaces that rise above the receiver's tangent plane are no occluders, and what lies above a surface still is
//! one.
//!
//! In each scene it is known which points light reaches. A kernel over a surface that is lit all over is lit; one that
//! looked at tangent planes would find it dark in every concave fold.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod common;

use common::{scene, sun};
use glam::{DVec3, Vec3};
use scumble_core::{Filter, Light, fit};
use scumble_reference::{KernelTruth, Rays, Receiver};
use scumble_scenes::{Mesh, Scene, cuboid, ground};

fn lamp(position: DVec3) -> Light {
    Light::Spot { position, direction: -position.normalize(), cone_half_angle: 0.9, radius_world: 0.3 }
}

/// A strip of two metres along z through the points (x, y), normals to the left of the way.
fn strip(profile: &[(f64, f64)]) -> Mesh {
    let mut mesh = Mesh {
        positions: Vec::new(),
        normals: Vec::new(),
        triangles: Vec::new(),
        ..ground("strip", DVec3::ZERO, 1.0, Vec3::ONE)
    };
    for ends in profile.windows(2) {
        let [a, b] = [ends[0], ends[1]].map(|(x, y)| DVec3::new(x, y, 0.0));
        let normal = DVec3::Z.cross(b - a).normalize().as_vec3();
        let first = mesh.positions.len() as u32;
        mesh.positions.extend([a + DVec3::Z, b + DVec3::Z, b - DVec3::Z, a - DVec3::Z].map(|p| p.as_vec3()));
        mesh.normals.extend([normal; 4]);
        mesh.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|triangle| triangle.map(|corner| first + corner)));
    }
    mesh
}

/// The same strip seen from its other side.
fn turned(strip: &Mesh) -> Mesh {
    let mut mesh = strip.clone();
    mesh.normals.iter_mut().for_each(|normal| *normal = -*normal);
    mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    mesh
}

/// Folds of 6 cm, 4 cm high.
fn zig_zag() -> Mesh {
    let profile: Vec<(f64, f64)> = (0..=40).map(|i| (-1.2 + 0.06 * f64::from(i), 0.04 * f64::from(i % 2))).collect();
    strip(&profile)
}

/// Points along a strip's profile, near z = 0.
fn on_strip(strip: &Mesh) -> Vec<Receiver> {
    let quads = strip.positions.chunks(4).zip(strip.normals.chunks(4));
    let points = quads.flat_map(|(corners, normals)| {
        let (left, right, normal) = (corners[3], corners[2], normals[0]);
        (1..20).map(move |i| (left.lerp(right, i as f32 / 20.0), normal))
    });
    points.enumerate().map(|(i, (p, normal))| receiver(p.x, p.y, normal, i)).collect()
}

fn receiver(x: f32, y: f32, normal: Vec3, i: usize) -> Receiver {
    Receiver { position: Vec3::new(x, y, 0.013), normal, pixel: [i as u32, 5] }
}

fn on_ground(xs: &[f32]) -> Vec<Receiver> {
    xs.iter().enumerate().map(|(i, &x)| receiver(x, 0.0, Vec3::Y, i)).collect()
}

fn visibility(scene: &Scene, filter: Filter, receivers: &[Receiver]) -> Vec<f32> {
    let fit = fit(&scene.camera, &scene.bounds(), &scene.light, true).unwrap().unwrap();
    KernelTruth::new(&Rays::new(scene), &fit, filter).visibility(receivers, |_| ())
}

fn filters() -> impl Iterator<Item = Filter> {
    let fixed = [0.01, 0.05, 0.2, 0.6].map(|radius_world| Filter::Pcf { radius_world });
    fixed.into_iter().chain([Filter::Hard, Filter::Pcss])
}

#[track_caller]
fn assert_lit(scene: &Scene, receivers: &[Receiver]) {
    for filter in filters() {
        let found = visibility(scene, filter, receivers);
        assert!(found.iter().all(|&v| v == 1.0), "{:?} {filter:?} {found:?}", scene.light);
    }
}

#[test]
fn a_concave_corner_of_two_lit_walls_is_lit_at_any_radius() {
    let corner = strip(&[(-1.5, 0.0), (0.0, 0.0), (0.0, 1.0)]);
    let receivers = on_strip(&corner);
    for light in [
        sun(DVec3::new(1.0, -1.0, 0.0)),
        sun(DVec3::new(1.0, -0.4, 0.2)),
        sun(DVec3::new(0.3, -1.0, -0.1)),
        lamp(DVec3::new(-1.0, 1.5, 0.0)),
    ] {
        assert_lit(&scene(light, vec![corner.clone()]), &receivers);
    }
}

#[test]
fn ground_that_goes_on_under_a_body_does_not_darken_the_foot_of_its_lit_side() {
    let receivers = on_ground(&[-0.5, -0.1, -0.05, -0.02, -0.004]);
    let light = sun(DVec3::new(1.0, -1.0, 0.0));
    // The body stands on the ground, and is sunk into it.
    for bottom in [0.0, -0.3] {
        let body = cuboid("body", DVec3::new(0.0, bottom, -1.0), DVec3::new(2.0, 1.0, 1.0), Vec3::ONE);
        let scene = scene(light, vec![ground("ground", DVec3::ZERO, 6.0, Vec3::ONE), body]);
        assert_lit(&scene, &receivers);
    }
}

#[test]
fn a_folded_sheet_that_faces_the_light_is_lit() {
    let sheet = zig_zag();
    let receivers = on_strip(&sheet);
    for light in [sun(DVec3::NEG_Y), sun(DVec3::new(0.4, -1.0, 0.2)), lamp(DVec3::new(0.2, 2.0, 0.0))] {
        assert_lit(&scene(light, vec![sheet.clone()]), &receivers);
    }
}

#[test]
fn doubled_cloth_is_lit_on_the_side_of_the_light() {
    let sheet = zig_zag();
    let receivers = on_strip(&sheet);
    let floor = ground("floor", DVec3::new(0.0, -2.0, 0.0), 4.0, Vec3::ONE);
    assert_lit(&scene(sun(DVec3::new(0.4, -1.0, 0.0)), vec![turned(&sheet), sheet, floor]), &receivers);
}

#[test]
fn a_sheet_that_turns_its_back_to_the_light_is_an_occluder() {
    let back = turned(&strip(&[(-1.0, 0.03), (1.0, 0.03)]));
    let scene = scene(sun(DVec3::NEG_Y), vec![back, ground("ground", DVec3::ZERO, 4.0, Vec3::ONE)]);
    for filter in [Filter::Hard, Filter::Pcf { radius_world: 0.1 }, Filter::Pcss] {
        assert_eq!(visibility(&scene, filter, &on_ground(&[0.0, 0.5])), [0.0; 2], "{filter:?}");
    }
}

#[test]
fn a_box_on_the_ground_shades_the_ground_at_its_foot() {
    let body = cuboid("box", DVec3::new(-1.0, 0.0, -1.0), DVec3::new(0.0, 0.5, 1.0), Vec3::ONE);
    let scene = scene(sun(DVec3::new(1.0, -1.0, 0.0)), vec![ground("ground", DVec3::ZERO, 4.0, Vec3::ONE), body]);
    for filter in [Filter::Hard, Filter::Pcf { radius_world: 0.1 }, Filter::Pcss] {
        let found = visibility(&scene, filter, &on_ground(&[0.002, 0.01, 0.1, 0.3]));
        assert_eq!(found, [0.0; 4], "{filter:?}");
        assert_eq!(visibility(&scene, filter, &on_ground(&[0.7])), [1.0], "{filter:?}");
    }
}

#[test]
fn a_thin_slab_above_the_ground_shades_it_though_the_kernel_is_wider_than_its_height() {
    let slab = cuboid("slab", DVec3::new(-0.5, 0.01, -1.0), DVec3::new(0.5, 0.015, 1.0), Vec3::ONE);
    let scene = scene(sun(DVec3::NEG_Y), vec![ground("ground", DVec3::ZERO, 4.0, Vec3::ONE), slab]);
    let filter = Filter::Pcf { radius_world: 0.05 };
    let found = visibility(&scene, filter, &on_ground(&[-0.4, 0.0, 0.44, 0.5, 0.56]));
    assert_eq!([found[0], found[1], found[2], found[4]], [0.0, 0.0, 0.0, 1.0], "{found:?}");
    assert!((found[3] - 0.5).abs() < 0.1, "{found:?}");
}
