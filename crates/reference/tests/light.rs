//! The light over rays against shadows whose value is known.
//!
//! Occluders lie in planes parallel to the light, so that their outline, seen from the receiver, is a shape on the
//! light's disc (the module of closed forms derives it). `z` is the distance from the exact value in standard errors.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod common;

use common::sun;
use glam::{DVec2, DVec3, Vec3};
use scumble_core::{Filter, Light, Taps, fit, half_plane_under_disc};
use scumble_reference::{
    Estimate, KernelTruth, LightTruth, Rays, Receiver, disc_under_disc, polygon_under_disc, slit_under_disc,
};
use scumble_scenes::{Mesh, cuboid, ground};

/// Height of the lamp and its radius.
const LAMP: f64 = 4.0;
const RADIUS: f64 = 0.5;
/// Height of the occluders.
const LID: f64 = 1.0;
/// What multiplies an outline seen from the ground: the ratio of the distances, in lamp radii.
const ON_LIGHT: f64 = LAMP / LID / RADIUS;

fn lamp() -> Light {
    Light::Spot {
        position: DVec3::new(0.0, LAMP, 0.0),
        direction: DVec3::NEG_Y,
        cone_half_angle: 1.0,
        radius_world: RADIUS,
    }
}

/// A convex outline at the lids' height, filled by a strip of triangles that zigzags between its two chains.
fn lid(outline: &[DVec2]) -> Mesh {
    let count = outline.len() as u32;
    let zigzag = |i: u32| if i % 2 == 1 { i.div_ceil(2) } else { (count - i / 2) % count };
    Mesh {
        name: "lid".to_owned(),
        positions: outline.iter().map(|p| DVec3::new(p.x, LID, p.y).as_vec3()).collect(),
        normals: vec![Vec3::Y; outline.len()],
        triangles: (0..count - 2).map(|i| [i, i + 1, i + 2].map(zigzag)).collect(),
        linear_color: Vec3::ONE,
        mask: None,
    }
}

fn rectangle(min: DVec2, max: DVec2) -> [DVec2; 4] {
    [min, DVec2::new(max.x, min.y), max, DVec2::new(min.x, max.y)]
}

fn rays_of(light: Light, occluders: Vec<Mesh>) -> Rays {
    let mut meshes = vec![ground("ground", DVec3::ZERO, 40.0, Vec3::ONE)];
    meshes.extend(occluders);
    Rays::new(&common::scene(light, meshes))
}

/// Points of the ground in a grid around the origin, as far as `reach`.
fn receivers(reach: f64, per_side: u32) -> Vec<Receiver> {
    let along = |i: u32| (2.0 * (f64::from(i) + 0.5) / f64::from(per_side) - 1.0) * reach;
    let receiver = |i: u32| {
        let pixel = [i % per_side, i / per_side];
        Receiver { position: DVec3::new(along(pixel[0]), 0.0, along(pixel[1])).as_vec3(), normal: Vec3::Y, pixel }
    };
    (0..per_side * per_side).map(receiver).collect()
}

/// Where a point of the lids' plane is on the lamp's unit disc, seen from the ground.
fn on_lamp(receiver: &Receiver, p: DVec2) -> DVec2 {
    let from = DVec2::new(f64::from(receiver.position.x), f64::from(receiver.position.z));
    // The ray through p meets the lamp's plane at from + (p - from) LAMP / LID; the lamp's middle is the origin.
    (p - from) * ON_LIGHT + from / RADIUS
}

/// Scores of the estimates against `expected`, of the receivers that are neither all lit nor all dark.
fn scores(rays: &Rays, light: &Light, samples: u32, expected: impl Fn(&Receiver) -> f64) -> Vec<f64> {
    let receivers = receivers(0.35, 24);
    let found = LightTruth::new(rays, light, samples).unwrap().visibility(&receivers, |_| ());
    let score = |(receiver, estimate): (&Receiver, &Estimate)| {
        let exact = expected(receiver);
        let z = (f64::from(estimate.visibility) - exact) / f64::from(estimate.standard_error);
        assert!((exact > 0.0 && exact < 1.0) || z == 0.0, "{receiver:?}: {estimate:?} of {exact}");
        (exact > 0.0 && exact < 1.0).then_some(z)
    };
    receivers.iter().zip(&found).filter_map(score).collect()
}

/// Scores of the shapes under the lamp.
fn scores_of_shapes(samples: u32) -> Vec<(&'static str, Vec<f64>)> {
    let edge = rectangle(DVec2::new(-19.0, -19.0), DVec2::new(0.0, 19.0));
    let slit = [
        rectangle(DVec2::new(-19.0, -19.0), DVec2::new(-0.08, 19.0)),
        rectangle(DVec2::new(0.08, -19.0), DVec2::new(19.0, 19.0)),
    ];
    let slanted = [DVec2::new(-0.2, -0.1), DVec2::new(0.25, -0.2), DVec2::new(0.1, 0.22)];
    let many: Vec<DVec2> =
        (0..2000).map(|i| 0.15 * DVec2::from_angle(f64::from(i) * 1e-3 * std::f64::consts::PI)).collect();

    let lit_by = |outline: &[DVec2], receiver: &Receiver| {
        let seen: Vec<DVec2> = outline.iter().map(|&p| on_lamp(receiver, p)).collect();
        1.0 - polygon_under_disc(&seen)
    };
    let of_edge = |receiver: &Receiver| half_plane_under_disc(-on_lamp(receiver, DVec2::ZERO).x);
    let of_slit = |receiver: &Receiver| slit_under_disc(on_lamp(receiver, DVec2::ZERO).x, 0.16 * ON_LIGHT);
    // A polygon of 2000 corners has 1.6e-6 less area than its disc.
    let of_disc = |receiver: &Receiver| 1.0 - disc_under_disc(on_lamp(receiver, DVec2::ZERO).length(), 0.15 * ON_LIGHT);
    let rays = |outlines: &[&[DVec2]]| rays_of(lamp(), outlines.iter().map(|outline| lid(outline)).collect());
    vec![
        ("edge", scores(&rays(&[&edge]), &lamp(), samples, of_edge)),
        ("slit", scores(&rays(&[&slit[0], &slit[1]]), &lamp(), samples, of_slit)),
        ("disc", scores(&rays(&[&many]), &lamp(), samples, of_disc)),
        ("triangle", scores(&rays(&[&slanted]), &lamp(), samples, |receiver| lit_by(&slanted, receiver))),
    ]
}

fn mean_square(scores: &[f64]) -> f64 {
    scores.iter().map(|z| z * z).sum::<f64>() / scores.len() as f64
}

/// As many scores beyond 3 as 3 standard errors let happen: 0.27 % of them and three standard deviations of their count.
fn assert_within_chance(name: &str, scores: &[f64]) {
    let expected = 0.0027 * scores.len() as f64;
    let beyond = scores.iter().filter(|z| z.abs() > 3.0).count() as f64;
    assert!(beyond <= expected + 3.0 * expected.sqrt(), "{name}: {beyond} of {} beyond 3", scores.len());
}

#[test]
fn the_error_against_closed_forms_is_what_the_standard_error_says() {
    for samples in LightTruth::SAMPLES {
        for (shape, scores) in scores_of_shapes(samples) {
            let name = format!("{shape}, {samples} samples");
            assert!(scores.len() > 250, "{name}: {}", scores.len());
            assert_within_chance(&name, &scores);
            let spread = mean_square(&scores).sqrt();
            assert!((0.85..1.1).contains(&spread), "{name}: {spread}");
            let mean = scores.iter().sum::<f64>() / scores.len() as f64;
            assert!(mean.abs() < 3.0 / (scores.len() as f64).sqrt(), "{name}: {mean}");
        }
    }
}

#[test]
fn a_lamp_of_another_radius_is_far_from_the_closed_form() {
    let edge = rectangle(DVec2::new(-19.0, -19.0), DVec2::new(0.0, 19.0));
    let rays = rays_of(lamp(), vec![lid(&edge)]);
    let expected = |receiver: &Receiver| half_plane_under_disc(0.9 * -on_lamp(receiver, DVec2::ZERO).x);
    let found = LightTruth::new(&rays, &lamp(), 256).unwrap().visibility(&receivers(0.1, 24), |_| ());
    let scores: Vec<f64> = found
        .iter()
        .zip(receivers(0.1, 24))
        .map(|(estimate, receiver)| {
            (f64::from(estimate.visibility) - expected(&receiver)) / f64::from(estimate.standard_error)
        })
        .collect();
    assert!(mean_square(&scores) > 2.0, "{}", mean_square(&scores));
}

#[test]
fn more_samples_err_less_than_their_number_says() {
    // An edge cuts the square root of the areas, so stratified errors fall as n^(-3/4), those of chance as n^(-1/2).
    let edge = rectangle(DVec2::new(-19.0, -19.0), DVec2::new(0.0, 19.0));
    let rays = rays_of(lamp(), vec![lid(&edge)]);
    let points = receivers(0.1, 24);
    let rms = |samples: u32| {
        let truth = LightTruth::new(&rays, &lamp(), samples).unwrap();
        let error = |receiver: &Receiver| {
            f64::from(truth.at(receiver).visibility) - half_plane_under_disc(-on_lamp(receiver, DVec2::ZERO).x)
        };
        mean_square(&points.iter().map(error).collect::<Vec<_>>()).sqrt()
    };
    let [few, many] = [64, 1024].map(rms);
    let order = (few / many).ln() / 16_f64.ln();
    assert!((order - 0.75).abs() < 0.1, "{order}");
}

#[test]
fn under_a_slanted_sun_the_disc_of_directions_is_the_light() {
    let half_angle = 0.1_f64;
    let light = sun(DVec3::new(1.0, -1.0, 0.0));
    let edge = rectangle(DVec2::new(-19.0, -19.0), DVec2::new(0.0, 19.0));
    let rays = rays_of(light, vec![lid(&edge)]);
    let truth = LightTruth::new(&rays, &light, 256).unwrap();
    let mut scores = Vec::new();
    for receiver in receivers(0.2, 24) {
        let at = Receiver { position: receiver.position + Vec3::X * LID as f32, ..receiver };
        // Across the edge, which runs along v, the sun's direction w + tan h (u, v) turns from 45 degrees by the angle
        // whose tangent is u tan h; the edge is met where that is the angle at which the receiver sees it.
        let slope = f64::from(at.position.x) / LID;
        let angle = slope.atan() - std::f64::consts::FRAC_PI_4;
        let exact = half_plane_under_disc(angle.tan() / half_angle.tan());
        let estimate = truth.at(&at);
        if exact > 0.0 && exact < 1.0 {
            scores.push((f64::from(estimate.visibility) - exact) / f64::from(estimate.standard_error));
        }
    }
    assert!(scores.len() > 250, "{}", scores.len());
    assert_within_chance("slanted sun", &scores);
    assert!((0.8..1.15).contains(&mean_square(&scores).sqrt()), "{}", mean_square(&scores));
}

#[test]
fn beside_a_box_its_upper_edge_is_the_half_plane() {
    let long_box = cuboid("box", DVec3::new(-3.0, 0.0, -19.0), DVec3::new(-0.2, LID, 19.0), Vec3::ONE);
    let rays = rays_of(lamp(), vec![long_box]);
    let truth = LightTruth::new(&rays, &lamp(), 512).unwrap();
    let mut scores = Vec::new();
    for receiver in receivers(0.199, 24) {
        // The lamp hangs over the origin; from beside the wall its lower left is behind the box's edge.
        let exact = half_plane_under_disc(-on_lamp(&receiver, DVec2::new(-0.2, 0.0)).x);
        let estimate = truth.at(&receiver);
        if exact > 0.0 && exact < 1.0 {
            scores.push((f64::from(estimate.visibility) - exact) / f64::from(estimate.standard_error));
        }
    }
    assert!(scores.len() > 40, "{}", scores.len());
    assert_within_chance("box", &scores);
    assert!((0.7..1.3).contains(&mean_square(&scores).sqrt()), "{}", mean_square(&scores));
}

#[test]
fn under_a_far_light_the_filter_of_the_same_radius_agrees() {
    // A sun straight above and a level lid: PCF with the penumbra's radius is the light itself, but for its 1000 taps.
    let light = sun(DVec3::NEG_Y);
    let slanted = [DVec2::new(-0.6, -0.1), DVec2::new(0.5, -0.5), DVec2::new(0.1, 0.7)];
    let scene = common::scene(light, vec![ground("ground", DVec3::ZERO, 8.0, Vec3::ONE), lid(&slanted)]);
    let rays = Rays::new(&scene);
    let fit = fit(&scene.camera, &scene.bounds(), &light, true).unwrap().unwrap();
    let filter = Filter::Pcf { radius_world: LID * 0.1_f64.tan() };
    let kernel = KernelTruth { taps: Taps::new(16, 1000), ..KernelTruth::new(&rays, &fit, filter) };
    let light = LightTruth::new(&rays, &light, 1024).unwrap();
    let mut partial = 0;
    for receiver in receivers(0.6, 24) {
        let (filtered, estimate) = (kernel.at(&receiver).visibility, light.at(&receiver));
        // Of 1000 taps: three times n^(-3/4), see closed_forms.rs.
        let allowed = 0.017 + 3.0 * f64::from(estimate.standard_error);
        assert!((filtered - f64::from(estimate.visibility)).abs() < allowed, "{receiver:?}: {filtered} {estimate:?}");
        partial += u32::from(filtered > 0.0 && filtered < 1.0);
    }
    assert!(partial > 100, "{partial}");
}

#[test]
fn a_point_that_faces_away_or_is_covered_is_dark_and_an_open_one_is_lit() {
    let whole = rectangle(DVec2::splat(-19.0), DVec2::splat(19.0));
    for light in [lamp(), sun(DVec3::new(0.5, -1.0, 0.3))] {
        let (open, covered) = (rays_of(light, vec![]), rays_of(light, vec![lid(&whole)]));
        for receiver in receivers(0.5, 4) {
            let visibility = |rays, receiver: &Receiver| LightTruth::new(rays, &light, 64).unwrap().at(receiver);
            let one_in_64 = 1.0 / 64.0;
            assert_eq!(visibility(&open, &receiver), Estimate { visibility: 1.0, standard_error: one_in_64 });
            assert_eq!(visibility(&covered, &receiver), Estimate { visibility: 0.0, standard_error: one_in_64 });
            let from_below = Receiver { normal: Vec3::NEG_Y, ..receiver };
            assert_eq!(visibility(&open, &from_below).visibility, 0.0);
        }
    }
}

#[test]
fn a_light_without_a_size_casts_a_hard_shadow() {
    let Light::Spot { position, direction, cone_half_angle, .. } = lamp() else { panic!("a lamp") };
    let point = Light::Spot { position, direction, cone_half_angle, radius_world: 0.0 };
    let edge = rectangle(DVec2::new(-19.0, -19.0), DVec2::new(0.0, 19.0));
    let rays = rays_of(point, vec![lid(&edge)]);
    for receiver in receivers(0.3, 8) {
        let expected = f32::from(u8::from(receiver.position.x > 0.0));
        assert_eq!(LightTruth::new(&rays, &point, 64).unwrap().at(&receiver).visibility, expected, "{receiver:?}");
    }
}

#[test]
fn all_receivers_together_have_the_values_of_each_and_are_counted_once() {
    let edge = rectangle(DVec2::new(-19.0, -19.0), DVec2::new(0.0, 19.0));
    let rays = rays_of(lamp(), vec![lid(&edge)]);
    let truth = LightTruth::new(&rays, &lamp(), 64).unwrap();
    let points = receivers(0.3, 40);
    let done = std::sync::atomic::AtomicUsize::new(0);
    let found = truth.visibility(&points, |count| {
        done.fetch_add(count, std::sync::atomic::Ordering::Relaxed);
    });
    assert_eq!(done.into_inner(), points.len());
    assert_eq!(found, points.iter().map(|receiver| truth.at(receiver)).collect::<Vec<_>>());
}

#[test]
fn numbers_of_samples_and_lights_out_of_range_are_refused_with_what_is_allowed() {
    let rays = rays_of(lamp(), vec![]);
    for samples in [0, 1, 32, 100, 2048, u32::MAX] {
        let refused = LightTruth::new(&rays, &lamp(), samples).err().unwrap().to_string();
        assert!(refused.contains(&samples.to_string()) && refused.contains("256"), "{refused}");
    }
    let none = Light::Directional { direction: DVec3::ZERO, half_angle: 0.1 };
    assert!(LightTruth::new(&rays, &none, 64).err().unwrap().to_string().contains("direction"));
}
