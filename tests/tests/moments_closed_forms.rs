//! Variance shadow maps where the answer is known: occluders over a parallel receiver, whose light the bound has exactly,
//! and two occluders above each other, where it says how much bleeds.
//!
//! The kernel is a square of half side r. Lengths are in r below; the sun shines straight down, and the square lies along
//! x and z of the world.

#[path = "../../crates/scumble/tests/common/mod.rs"]
mod common;

use std::f64::consts::PI;

use common::rig::{Point, Rig, fixed, ground_and, slab, sun_above};
use glam::{DVec2, Vec3};
use scumble::scumble_core::moments::VarianceBound;
use scumble::{Filter, Options, Settings, SizeChoice};
use scumble_reference::{Rectangle, half_plane_under_rectangle, polygon_under_disc};

const RADIUS_WORLD: f64 = 0.5;
/// The kernel, in its half sides.
const SQUARE: Rectangle = Rectangle { min: DVec2::NEG_ONE, max: DVec2::ONE };
const HEIGHT: f32 = 2.0;

/// Largest and RMS error of visibility over points of the ground within three radii, against what is expected at a place
/// in radii; on a map whose texels are `ratio` to the radius.
fn errors(casters: Vec<Vec3>, ratio: f64, expected: impl Fn(DVec2) -> f64) -> [f64; 2] {
    let settings = Settings {
        cap: 2048,
        variance: VarianceBound { deviation_min_texels: 0.01, bleeding_cut: 0.0 },
        ..Settings::default()
    };
    let filter = Filter::Vsm { radius_world: RADIUS_WORLD };
    let mut rig = Rig::new(settings, Options { filter, ..Options::default() }, &ground_and(casters));
    let sun = [sun_above(0.1)];
    let plan = rig.draw(&sun);
    let sides = (plan.views()[0].fit.extent_world * ratio / RADIUS_WORLD).ceil().as_uvec2().to_array();
    let exact = Options { size: SizeChoice::Fixed(sides), ..rig.shadows.options().clone() };
    rig.shadows.set_options(exact).expect("the filter and the number of maps stay");
    rig.draw(&sun);

    // Anywhere (R2 sequence).
    let place = |i: u32| DVec2::new(f64::from(i) * 0.754_877_666, f64::from(i) * 0.569_840_291).fract() * 6.0 - 3.0;
    let places: Vec<DVec2> = (0..4000).map(place).collect();
    let points: Vec<Point> = places
        .iter()
        .map(|place| {
            let at = (place * RADIUS_WORLD).as_vec2();
            Point { position: Vec3::new(at.x, 0.0, at.y), normal: Vec3::Y, pixel: [0, 0] }
        })
        .collect();
    let (mut largest, mut squares) = (0.0f64, 0.0);
    for (&place, found) in places.iter().zip(rig.visibility(&points)) {
        let error = f64::from(found) - expected(place);
        largest = largest.max(error.abs());
        squares += error * error;
    }
    [largest, (squares / places.len() as f64).sqrt()]
}

/// Share of the square about `place` that lies beside a slab's edge, turned by `angle`.
fn beside_slab(place: DVec2, angle: f64) -> f64 {
    // As `glam::Quat::from_rotation_y` turns x towards -z.
    let normal = DVec2::new(angle.cos(), -angle.sin());
    half_plane_under_rectangle(&SQUARE, normal, place.dot(normal))
}

/// Ratios to try with the largest and the RMS error allowed. At the relation's own, the texel errs: an edge along it may be
/// half a texel off, 1 / (4 c) = 0.07 of the light. Where texels are small, the kernel is filtered on blocks, and the ends of
/// a penumbra are bent as far as a bilinear value bends them: an eighth of a block's share, 1 / (2 * 4), twice where an edge
/// meets blocks at the worst place.
const ALLOWED: [(f64, [f64; 2]); 3] = [(3.47, [0.06, 0.02]), (14.0, [0.035, 0.006]), (50.0, [0.04, 0.008])];

#[test]
fn a_half_plane_fades_as_the_square_covers_it() {
    for (ratio, [largest_allowed, rms_allowed]) in ALLOWED {
        for degrees in [0.0, 4.0, 9.0, 15.0, 22.0, 27.0, 33.0, 38.0, 44.0, 71.0f64] {
            let angle = degrees.to_radians();
            let [largest, rms] = errors(slab(HEIGHT, angle as f32), ratio, |place| beside_slab(place, angle));
            println!("c = {ratio}, {degrees} degrees: largest {largest:.4}, rms {rms:.4}");
            assert!(largest < largest_allowed && rms < rms_allowed, "{largest} {rms}");
        }
    }
}

#[test]
fn a_slit_is_two_half_planes() {
    let (angle, half_width) = (0.35f64, 0.7);
    let turn = glam::Quat::from_rotation_y(angle as f32);
    // Slabs on both sides of a slit, which is 1.4 radii wide.
    let away = turn * Vec3::X * (half_width * RADIUS_WORLD) as f32;
    let left = slab(HEIGHT, angle as f32).into_iter().map(|corner| corner - away);
    let right = slab(HEIGHT, (angle + PI) as f32).into_iter().map(|corner| corner + away);
    let normal = DVec2::new(angle.cos(), -angle.sin());
    for (ratio, [largest_allowed, rms_allowed]) in ALLOWED {
        let casters = left.clone().chain(right.clone()).collect();
        let [largest, rms] = errors(casters, ratio, |place| {
            let shift = half_width * normal;
            beside_slab(place + shift, angle) - beside_slab(place - shift, angle)
        });
        println!("c = {ratio}: largest {largest:.4}, rms {rms:.4}");
        assert!(largest < 2.0 * largest_allowed && rms < 2.0 * rms_allowed);
    }
}

#[test]
fn a_disc_shades_what_the_square_has_of_it() {
    let radius = 1.3;
    let corner = |i: u32| {
        let (sin, cos) = (f64::from(i) / 128.0 * 2.0 * PI).sin_cos();
        Vec3::new((radius * RADIUS_WORLD * cos) as f32, HEIGHT, (radius * RADIUS_WORLD * sin) as f32)
    };
    let disc: Vec<Vec3> = (0..128).flat_map(|i| [Vec3::Y * HEIGHT, corner(i), corner(i + 1)]).collect();
    for (ratio, [largest_allowed, rms_allowed]) in ALLOWED {
        let [largest, rms] = errors(disc.clone(), ratio, |place| {
            let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
            let in_disc = corners.map(|corner| (place + DVec2::from_array(corner)) / radius);
            // The polygon's share of the disc, as a share of the square's area of 4.
            1.0 - polygon_under_disc(&in_disc) * PI * radius * radius / 4.0
        });
        println!("c = {ratio}: largest {largest:.4}, rms {rms:.4}");
        assert!(largest < largest_allowed && rms < rms_allowed, "{largest} {rms}");
    }
}

#[test]
fn under_a_roof_and_a_higher_edge_light_bleeds_as_the_bound_says() {
    let (lower, upper, ratio) = (2.0, 6.0, 7.0);
    let roof = slab(lower as f32, 0.0).into_iter().chain(slab(lower as f32, PI as f32));
    let casters: Vec<Vec3> = roof.chain(slab(upper as f32, 0.0)).collect();
    let bleeding = |place: DVec2| {
        let share = 1.0 - beside_slab(place, 0.0);
        let spread = share * (1.0 - share) * (upper - lower) * (upper - lower);
        spread / (spread + (lower + share * (upper - lower)).powi(2))
    };
    let [largest, rms] = errors(casters, ratio, bleeding);
    // Greatest at the share h_2 / (h_1 + h_2) = 1/4: (h_1 - h_2)^2 / (h_1 + h_2)^2.
    let most = ((upper - lower) / (upper + lower)).powi(2);
    let found = (-100..=100).map(|i| bleeding(DVec2::new(f64::from(i) / 100.0, 0.0))).fold(0.0, f64::max);
    println!("bleeds up to {found:.3}, by the bound {most:.3}; largest {largest:.4}, rms {rms:.4}");
    assert!((found - most).abs() < 1e-3, "{found} {most}");
    // Half a texel is 1 / (4 c) of the share, which counts up to (h_1 - h_2)^2 / h_2^2 = 4 times, where the higher edge begins.
    assert!(largest < 1.0 / ratio && rms < 0.2 / ratio, "{largest} {rms}");
}

#[test]
fn a_cut_darkens_a_penumbra_by_no_more_than_itself() {
    let cut = 0.2;
    let variance = VarianceBound { bleeding_cut: cut, ..VarianceBound::default() };
    let settings = Settings { cap: 1024, variance, ..Settings::default() };
    let mut rig = Rig::new(settings, fixed(Filter::Vsm { radius_world: 0.5 }, 800), &ground_and(slab(HEIGHT, 0.0)));
    rig.draw(&[sun_above(0.1)]);
    let points: Vec<Point> = (-100..=100)
        .map(|i| Point { position: Vec3::new(i as f32 * 0.006, 0.0, 0.3), normal: Vec3::Y, pixel: [0, 0] })
        .collect();
    let mut darkest = 0.0f64;
    for (point, found) in points.iter().zip(rig.visibility(&points)) {
        let lit = beside_slab(DVec2::new(f64::from(point.position.x) / 0.5, 0.0), 0.0);
        let error = f64::from(found) - lit;
        assert!(error < 0.02 && error > -cut - 0.02, "{point:?}: {found} for {lit}");
        darkest = darkest.min(error);
    }
    assert!(darkest < -0.8 * cut, "{darkest}");
}
