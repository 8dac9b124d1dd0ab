//! The filter over rays against shadows whose value is known.
//!
//! A half plane covers the share `F(t)` of a disc whose centre is `t` radii inside of its edge
//! (`half_plane_under_disc`); a slit of width w leaves `F(t + w / 2r) - F(t - w / 2r)` lit. Many taps make the sum an
//! integral.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod common;

use common::sun;
use glam::{DVec3, Vec3};
use scumble_core::{Filter, Fit, Light, Taps, fit, half_plane_under_disc};
use scumble_reference::{KernelTruth, Rays, Receiver};
use scumble_scenes::{Mesh, Scene, cuboid, ground};

/// Height of the lids, sheets without thickness, above the ground.
const LID: f64 = 1.0;

/// What 1000 taps leave of the integral's error: three times n^(-3/4), since a disc of taps far from each other errs by
/// the square root of the number of taps (n^(1/2)) that an edge cuts.
const OF_1000_TAPS: f64 = 0.017;

fn scene(light: Light, lids: &[(f64, f64)]) -> Scene {
    let lid = |&(from, to): &(f64, f64)| -> Mesh {
        let sheet = ground("lid", DVec3::ZERO, 2.0, Vec3::ONE);
        let (middle, half) = ((from + to) / 2.0, (to - from) / 2.0);
        Mesh {
            positions: sheet
                .positions
                .iter()
                .map(|p| Vec3::new(middle as f32 + p.x * half as f32, LID as f32, 4.0 * p.z))
                .collect(),
            ..sheet
        }
    };
    let mut meshes = vec![ground("ground", DVec3::ZERO, 16.0, Vec3::ONE)];
    meshes.extend(lids.iter().map(lid));
    common::scene(light, meshes)
}

fn view(scene: &Scene) -> Fit {
    fit(&scene.camera, &scene.bounds(), &scene.light, true).unwrap().unwrap()
}

/// Points on the ground along x.
fn receivers(xs: &[f64]) -> Vec<Receiver> {
    let receiver = |(i, &x): (usize, &f64)| Receiver {
        position: Vec3::new(x as f32, 0.0, 0.05),
        normal: Vec3::Y,
        pixel: [i as u32, 7],
    };
    xs.iter().enumerate().map(receiver).collect()
}

fn steps(from: f64, to: f64) -> Vec<f64> {
    (0..=60).map(|i| from + (to - from) * f64::from(i) / 60.0).collect()
}

/// Largest distance of the filter over rays from `expected(x)`.
fn largest_error(scene: &Scene, filter: Filter, taps: usize, xs: &[f64], expected: impl Fn(f64) -> f64) -> f64 {
    let (rays, fit) = (Rays::new(scene), view(scene));
    let truth = KernelTruth { taps: Taps::new(64, taps), ..KernelTruth::new(&rays, &fit, filter) };
    let visibility = truth.visibility(&receivers(xs), |_| ());
    visibility.iter().zip(xs).map(|(&v, &x)| (f64::from(v) - expected(x)).abs()).fold(0.0, f64::max)
}

#[test]
fn the_edge_of_a_half_plane_is_the_area_of_a_disc_segment() {
    let scene = scene(sun(DVec3::NEG_Y), &[(-8.0, 0.0)]);
    let filter = Filter::Pcf { radius_world: 0.2 };
    let error = largest_error(&scene, filter, 1000, &steps(-0.3, 0.3), |x| half_plane_under_disc(x / 0.2));
    assert!(error < OF_1000_TAPS, "{error}");
}

#[test]
fn under_a_slanted_sun_the_kernel_is_measured_across_the_light() {
    let scene = scene(sun(DVec3::new(1.0, -1.0, 0.0)), &[(-8.0, 0.0)]);
    let filter = Filter::Pcf { radius_world: 0.2 };
    // The edge's shadow lies one height further; a step along the ground is 1 / sqrt 2 of it across the light.
    let expected = |x: f64| half_plane_under_disc((x - LID) * 0.5f64.sqrt() / 0.2);
    let error = largest_error(&scene, filter, 1000, &steps(0.6, 1.4), expected);
    assert!(error < OF_1000_TAPS, "{error}");
}

#[test]
fn a_slit_narrower_than_the_kernel_is_never_fully_lit() {
    let (width, radius) = (0.15, 0.2);
    let scene = scene(sun(DVec3::NEG_Y), &[(-8.0, -width / 2.0), (width / 2.0, 8.0)]);
    let expected =
        |x: f64| half_plane_under_disc((x + width / 2.0) / radius) - half_plane_under_disc((x - width / 2.0) / radius);
    let error = largest_error(&scene, Filter::Pcf { radius_world: radius }, 1000, &steps(-0.35, 0.35), expected);
    assert!(error < OF_1000_TAPS, "{error}");
}

#[test]
fn a_soft_shadow_has_the_radius_of_similar_triangles() {
    // Sun: r = h tan(half angle). Nowhere else is an occluder, so the mean blocker depth is exact wherever one is
    // found.
    let under_sun = scene(sun(DVec3::NEG_Y), &[(-8.0, 0.0)]);
    let radius = LID * 0.1f64.tan();
    let error =
        largest_error(&under_sun, Filter::Pcss, 1000, &steps(-0.15, 0.08), |x| half_plane_under_disc(x / radius));
    assert!(error < OF_1000_TAPS, "{error}");

    // Lamp over the edge at height H: its shadow's radius on the ground is R h / (H - h).
    let (height, lamp_radius) = (3.0, 0.1);
    let lamp = Light::Spot {
        position: DVec3::new(0.0, height, 0.0),
        direction: DVec3::NEG_Y,
        cone_half_angle: 0.7,
        radius_world: lamp_radius,
    };
    let radius = lamp_radius * LID / (height - LID);
    let error = largest_error(&scene(lamp, &[(-8.0, 0.0)]), Filter::Pcss, 1000, &steps(-0.06, 0.04), |x| {
        half_plane_under_disc(x / radius)
    });
    assert!(error < OF_1000_TAPS, "{error}");
}

#[test]
fn more_taps_come_closer_to_the_closed_form() {
    let scene = scene(sun(DVec3::NEG_Y), &[(-8.0, 0.0)]);
    let filter = Filter::Pcf { radius_world: 0.2 };
    let error = |taps| largest_error(&scene, filter, taps, &steps(-0.25, 0.25), |x| half_plane_under_disc(x / 0.2));
    let errors = [16, 64, 256, 1024].map(error);
    // The order is n^(-3/4); half of it is required, since each of these is the maximum of one set of taps.
    assert!(errors.is_sorted_by(|a, b| a > b), "{errors:?}");
    assert!(errors[3] < errors[0] / 64f64.powf(0.375), "{errors:?}");
}

#[test]
fn an_open_ground_is_lit_and_a_covered_one_is_dark_to_the_last_bit() {
    for light in [
        sun(DVec3::new(0.5, -1.0, 0.3)),
        Light::Spot {
            position: DVec3::new(0.5, 4.0, 1.0),
            direction: DVec3::NEG_Y,
            cone_half_angle: 0.9,
            radius_world: 0.2,
        },
    ] {
        let open = scene(light, &[]);
        let covered = scene(light, &[(-8.0, 8.0)]);
        for filter in [Filter::Hard, Filter::Pcf { radius_world: 0.1 }, Filter::Pcss] {
            assert_eq!(largest_error(&open, filter, 25, &steps(-1.5, 1.5), |_| 1.0), 0.0, "{filter:?}");
            assert_eq!(largest_error(&covered, filter, 25, &steps(-0.5, 0.5), |_| 0.0), 0.0, "{filter:?}");
        }
    }
}

#[test]
fn a_box_on_the_ground_is_dark_in_contact() {
    let mut scene = scene(sun(DVec3::new(1.0, -1.0, 0.0)), &[]);
    scene.meshes.push(cuboid("box", DVec3::new(-1.0, 0.0, -1.0), DVec3::new(0.0, 1.0, 1.0), Vec3::ONE));
    let (rays, fit) = (Rays::new(&scene), view(&scene));
    let truth = KernelTruth::new(&rays, &fit, Filter::Hard);
    let points = receivers(&[-1.01, 0.001, 0.5, 0.999, 1.001]);
    assert_eq!(truth.visibility(&points, |_| ()), [1.0, 0.0, 0.0, 0.0, 1.0]);
}

#[test]
fn progress_counts_every_receiver_once() {
    let scene = scene(sun(DVec3::NEG_Y), &[]);
    let (rays, fit) = (Rays::new(&scene), view(&scene));
    let done = std::sync::atomic::AtomicUsize::new(0);
    let points = vec![receivers(&[0.0])[0]; 5000];
    let visibility = KernelTruth::new(&rays, &fit, Filter::Hard).visibility(&points, |count| {
        done.fetch_add(count, std::sync::atomic::Ordering::Relaxed);
    });
    assert_eq!((visibility.len(), done.into_inner()), (5000, 5000));
}
