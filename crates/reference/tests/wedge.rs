//! The catalogue's wedge against its closed form: both truths on the ground that its camera sees.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use glam::{DMat3, DVec3, Vec3};
use scumble_core::{Filter, Taps, fit, half_plane_under_disc};
use scumble_reference::{KernelTruth, LightTruth, Rays, Receiver};
use scumble_scenes::{Scene, open};
use std::path::Path;

/// Of the scene: the plate's height and the turn of its edge out of the z axis, by which it begins at the origin.
const HEIGHT: f64 = 1.0;
const SLANT: f64 = 0.1;
/// Points across and down the picture.
const GRID: [u32; 2] = [64, 36];

fn wedge() -> Scene {
    open("wedge", Path::new("")).unwrap()
}

/// Ground points behind a grid of pixels, within two penumbrae of the edge.
fn seen(scene: &Scene, reach: f64) -> Vec<Receiver> {
    let world_from_clip = scene.camera.clip_from_world().inverse();
    let of_pixel = |pixel: [u32; 2]| {
        let ndc = DVec3::new(
            2.0 * (f64::from(pixel[0]) + 0.5) / f64::from(GRID[0]) - 1.0,
            1.0 - 2.0 * (f64::from(pixel[1]) + 0.5) / f64::from(GRID[1]),
            0.5,
        );
        let way = world_from_clip.project_point3(ndc) - scene.camera.eye;
        let position = scene.camera.eye - way * (scene.camera.eye.y / way.y);
        (way.y < 0.0 && distance(position).abs() < reach && position.length() < 2.5).then(|| Receiver {
            position: position.as_vec3(),
            normal: Vec3::Y,
            pixel,
        })
    };
    (0..GRID[1]).flat_map(|y| (0..GRID[0]).map(move |x| [x, y])).filter_map(of_pixel).collect()
}

/// Signed distance of a point of the ground from the edge's foot, positive on the lit side.
fn distance(position: DVec3) -> f64 {
    position.dot(DMat3::from_rotation_y(SLANT) * DVec3::X)
}

/// The visibility at a signed distance, as the scene's documentation has it.
fn closed_form(distance: f64, radius: f64) -> f64 {
    let x = (distance / radius).clamp(-1.0, 1.0);
    0.5 + (x * (1.0 - x * x).sqrt() + x.asin()) / std::f64::consts::PI
}

#[test]
fn the_closed_form_is_that_of_a_half_plane_under_a_disc() {
    for x in [-1.5, -1.0, -0.4, 0.0, 0.7, 1.0, 2.0] {
        assert!((closed_form(x, 1.0) - half_plane_under_disc(x)).abs() < 1e-12, "{x}");
    }
}

#[test]
fn the_light_is_within_three_standard_errors_of_its_closed_form() {
    let scene = wedge();
    let scumble_core::Light::Directional { half_angle, .. } = scene.light else { panic!("the wedge has a sun") };
    let radius = HEIGHT * half_angle.tan();
    let rays = Rays::new(&scene);
    let receivers = seen(&scene, 2.0 * radius);
    let estimates = LightTruth::new(&rays, &scene.light, 256).unwrap().visibility(&receivers, |_| ());
    let z: Vec<f64> = receivers
        .iter()
        .zip(&estimates)
        .map(|(receiver, estimate)| {
            let exact = closed_form(distance(receiver.position.as_dvec3()), radius);
            (f64::from(estimate.visibility) - exact) / f64::from(estimate.standard_error)
        })
        .collect();
    let beyond = z.iter().filter(|z| z.abs() > 3.0).count();
    let spread = (z.iter().map(|z| z * z).sum::<f64>() / z.len() as f64).sqrt();
    assert!(z.len() > 300, "{}", z.len());
    assert!(beyond as f64 <= 0.01 * z.len() as f64 && spread < 1.1, "{beyond} of {}, {spread}", z.len());
}

#[test]
fn a_filter_of_many_taps_is_its_closed_form() {
    let scene = wedge();
    let radius_world = scene.pcf_radius_world;
    let rays = Rays::new(&scene);
    let fit = fit(&scene.camera, &scene.bounds(), &scene.light, true).unwrap().unwrap();
    let taps = Taps::new(Taps::BLOCKER, 400);
    let truth = KernelTruth { taps, ..KernelTruth::new(&rays, &fit, Filter::Pcf { radius_world }) };
    let receivers = seen(&scene, 2.0 * radius_world);
    let found = truth.visibility(&receivers, |_| ());
    let errors = receivers.iter().zip(&found).map(|(receiver, visibility)| {
        f64::from(*visibility) - closed_form(distance(receiver.position.as_dvec3()), radius_world)
    });
    // A chord through a disc of n relaxed darts leaves an error of about n^(-3/4): 0.011.
    let worst = errors.map(f64::abs).fold(0.0, f64::max);
    assert!(receivers.len() > 300 && worst < 0.03, "{worst} of {}", receivers.len());
}
