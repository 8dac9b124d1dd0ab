//! The demand pass measures what the geometry says, and the loop of measuring and sizing comes to rest.

mod common;

use common::casters::{cuboid, quad};
use common::rig::{Rig, camera_above, fixed, ground_and, slab, sun_above};
use glam::{DVec3, Vec3};
use scumble::scumble_core::Bias;
use scumble::{Camera, Filter, Light, Options, Settings, SizeChoice, Statistic};

fn settings(cap: u32) -> Settings {
    Settings { cap, ..Settings::default() }
}

/// Pixels do not bound the demand: what is measured is the geometry's.
fn without_footprint(cap: u32) -> Settings {
    Settings { footprint_kappa: 0.0, ..settings(cap) }
}

fn measured(rig: &mut Rig, lights: &[Light], side: u32) -> Option<Option<f64>> {
    let plan = rig.draw_and_measure(lights, side);
    rig.shadows.measured_radius_world(&plan.views()[0])
}

#[test]
fn the_smallest_radius_under_a_slab_is_its_height_times_the_tangent_of_the_sun() {
    for (height, half_angle) in [(2.0, 0.1), (2.0, 0.2), (1.0, 0.2)] {
        let mut rig = Rig::new(without_footprint(512), fixed(Filter::Pcss, 512), &ground_and(slab(height, 0.3)));
        let expected = f64::from(height) * f64::tan(half_angle);
        let radius = measured(&mut rig, &[sun_above(half_angle)], 128).unwrap().expect("there is a penumbra");
        assert!((radius / expected - 1.0).abs() < 2e-3, "{radius} for {expected}");
    }
}

#[test]
fn the_smallest_radius_under_a_wedge_is_that_of_its_low_edge() {
    // A wedge over x <= 0, 1 m high at z = -3 and 3 m at z = 3: along its edge r runs from tan to 3 tan.
    let half_angle: f64 = 0.1;
    let wedge = quad([[-9.0, 1.0, -3.0], [0.0, 1.0, -3.0], [0.0, 3.0, 3.0], [-9.0, 3.0, 3.0]].map(Vec3::from));
    let mut rig = Rig::new(without_footprint(1024), fixed(Filter::Pcss, 1024), &ground_and(wedge));
    let radius = measured(&mut rig, &[sun_above(half_angle)], 192).unwrap().expect("there is a penumbra");
    // A search disc of 0.3 m averages the wedge's slope of 1/3: the mean is off by at most 0.1 m of height.
    let (least, most) = (half_angle.tan() * 0.97, half_angle.tan() * 1.1);
    assert!(radius > least && radius < most, "{radius} outside of {least}..{most}");
}

#[test]
fn the_lower_of_two_slabs_decides() {
    let mut casters = cuboid(Vec3::new(-2.5, 0.9, -2.5), Vec3::new(-1.0, 1.0, -1.0));
    casters.extend(cuboid(Vec3::new(1.0, 1.9, 1.0), Vec3::new(2.5, 2.0, 2.5)));
    let mut rig = Rig::new(without_footprint(512), fixed(Filter::Pcss, 512), &ground_and(casters));
    // The eye high above sees both shadows around their boxes; seen by the light, a box is its top.
    rig.camera = Camera { eye: DVec3::new(0.0, 9.0, 9.0), ..camera_above(DVec3::ZERO) };
    let expected = 1.0 * f64::tan(0.2);
    let radius = measured(&mut rig, &[sun_above(0.2)], 192).unwrap().expect("there is a penumbra");
    assert!((radius / expected - 1.0).abs() < 5e-3, "{radius} for {expected}");
}

#[test]
fn a_quantile_passes_over_the_share_of_the_penumbra_that_may_show_texels() {
    // A small slab near the ground, and a large one twice as high, whose penumbra is longer and wider.
    let mut casters = cuboid(Vec3::new(-2.5, 0.9, -2.5), Vec3::new(-2.2, 1.0, -2.2));
    casters.extend(cuboid(Vec3::new(0.0, 1.9, 0.0), Vec3::new(2.5, 2.0, 2.5)));
    let (low, high) = (f64::tan(0.2), 2.0 * f64::tan(0.2));
    for (statistic, expected) in [
        (Statistic::Minimum, low),
        (Statistic::Quantile(0.0), low),
        (Statistic::Quantile(0.2), high),
        (Statistic::Quantile(0.8), high),
    ] {
        let settings = Settings { statistic, ..without_footprint(512) };
        let mut rig = Rig::new(settings, fixed(Filter::Pcss, 512), &ground_and(casters.clone()));
        rig.camera = Camera { eye: DVec3::new(0.0, 9.0, 9.0), ..camera_above(DVec3::ZERO) };
        let radius = measured(&mut rig, &[sun_above(0.2)], 192).unwrap().expect("there is a penumbra");
        // The edge of a bin is at most a ninth below.
        assert!(radius > expected * 8.0 / 9.0 * 0.995 && radius < expected * 1.005, "{statistic:?}: {radius}");
    }
}

#[test]
fn the_radius_under_a_lamp_is_that_of_similar_triangles() {
    let (lamp_height, slab_height, radius_world) = (6.0, 2.0f32, 0.2);
    let lamp = Light::Spot {
        position: DVec3::new(0.0, lamp_height, 0.0),
        direction: DVec3::NEG_Y,
        cone_half_angle: 0.6,
        radius_world,
    };
    let mut rig = Rig::new(without_footprint(1024), fixed(Filter::Pcss, 1024), &ground_and(slab(slab_height, 0.2)));
    let plan = rig.draw_and_measure(&[lamp], 128);
    let view = &plan.views()[0];
    let radius = rig.shadows.measured_radius_world(view).unwrap().expect("there is a penumbra");
    let (receiver, blocker) = (lamp_height, lamp_height - f64::from(slab_height));
    let expected = radius_world * (receiver - blocker) / blocker * view.fit.depth_near / receiver;
    assert!((radius / expected - 1.0).abs() < 5e-3, "{radius} for {expected}");
}

#[test]
fn a_fixed_kernel_is_measured_as_itself_where_pixels_are_small() {
    let mut rig =
        Rig::new(without_footprint(512), fixed(Filter::Pcf { radius_world: 0.4 }, 256), &ground_and(slab(2.0, 0.0)));
    let radius = measured(&mut rig, &[sun_above(0.1)], 256).unwrap().expect("there is a penumbra");
    assert!((radius - 0.4).abs() < 1e-6, "{radius}");
}

#[test]
fn pixels_texel_floor_and_least_radius_bound_the_demand_from_below() {
    let slab = ground_and(slab(0.3, 0.3));
    let sun = [sun_above(0.1)];
    let with = |settings: Settings, side| {
        let mut rig = Rig::new(settings, fixed(Filter::Pcss, 1024), &slab);
        measured(&mut rig, &sun, side).unwrap().expect("there is a penumbra")
    };
    // The camera is 12 m above and sees 8 m in `side` pixels.
    for side in [64, 128] {
        let expected = 3.47 * 8.0 / f64::from(side);
        let radius = with(settings(1024), side);
        assert!((radius / expected - 1.0).abs() < 1e-3, "{radius} for {expected}");
    }
    let floored = with(Settings { texel_floor_world: 0.2, ..settings(1024) }, 128);
    assert!((floored / (3.47 * 0.2) - 1.0).abs() < 1e-6, "{floored}");
    let least = with(Settings { radius_min_world: 0.9, ..settings(1024) }, 128);
    assert!((least - 0.9).abs() < 1e-6, "{least}");
}

#[test]
fn a_screen_without_a_penumbra_measures_nothing() {
    let mut rig = Rig::new(settings(256), fixed(Filter::Pcss, 256), &ground_and(Vec::new()));
    assert_eq!(measured(&mut rig, &[sun_above(0.2)], 128), Some(None));
    let roof = slab(3.0, 0.0).into_iter().chain(slab(3.0, std::f32::consts::PI)).collect();
    let mut dark = Rig::new(settings(256), fixed(Filter::Pcss, 256), &ground_and(roof));
    dark.camera.eye.y = 2.5;
    assert_eq!(measured(&mut dark, &[sun_above(0.2)], 128), Some(None));
}

#[test]
fn self_shadowing_of_slopes_does_not_raise_the_demand() {
    // A roof of 50 degrees under a slanted sun, small map: acne, if there were any, would ask for tiny radii.
    let roof = quad([[-3.0, 0.0, -3.0], [3.0, 3.5, -3.0], [3.0, 3.5, 3.0], [-3.0, 0.0, 3.0]].map(Vec3::from));
    let mut rig = Rig::new(settings(64), fixed(Filter::Pcss, 48), &roof);
    let sun = Light::Directional { direction: DVec3::new(0.5, -1.0, 0.3), half_angle: 0.1 };
    assert_eq!(measured(&mut rig, &[sun], 128), Some(None));
    // The same without slope bias does show acne, so the check can fail.
    let unbiased = Bias { slope_texels: 0.0, constant_texels: 0.0, slope_angle_max: 1.48 };
    let mut acne = Rig::new(Settings { bias: unbiased, ..settings(64) }, fixed(Filter::Pcss, 48), &roof);
    assert!(measured(&mut acne, &[sun], 128).unwrap().is_some());
}

#[test]
fn a_stride_of_four_measures_the_same_within_what_it_skips() {
    let mut rig = Rig::new(without_footprint(512), fixed(Filter::Pcss, 512), &ground_and(slab(2.0, 0.3)));
    let sun = [sun_above(0.15)];
    let full = measured(&mut rig, &sun, 256).unwrap().unwrap();
    rig.shadows.set_options(Options { measure_stride: 4, ..fixed(Filter::Pcss, 512) }).unwrap();
    let strided = measured(&mut rig, &sun, 256).unwrap().unwrap();
    assert!(strided >= full && strided / full < 1.01, "{strided} {full}");
}

/// Frames of measuring and sizing; returns the sizes of the last `frames` frames.
fn run(rig: &mut Rig, sun: &[Light], frames: usize) -> Vec<[u32; 2]> {
    (0..frames).map(|_| rig.draw_and_measure(sun, 96).views()[0].size_texels).collect()
}

#[test]
fn the_loop_comes_to_the_same_rest_from_the_smallest_and_the_largest_size() {
    let sun = [sun_above(0.15)];
    let adaptive = Options::default();
    let scene = || ground_and(slab(2.0, 0.3));

    let mut from_largest = Rig::new(settings(1024), adaptive.clone(), &scene());
    let first = run(&mut from_largest, &sun, 1)[0]; // Without a measurement.
    assert!(
        first.iter().all(|n| (860..=1024).contains(n)),
        "soft shadows start a quarter octave below the cap or at it"
    );
    let shrinking = run(&mut from_largest, &sun, 200);

    let mut from_smallest = Rig::new(settings(1024), fixed(Filter::Pcss, 8), &scene());
    run(&mut from_smallest, &sun, 3);
    from_smallest.shadows.set_options(Options { size: SizeChoice::Adaptive, ..adaptive }).unwrap();
    let growing = run(&mut from_smallest, &sun, 120);

    let rest = shrinking[199];
    println!("largest {first:?} -> {rest:?}; smallest {:?} -> {:?}", growing[0], growing[119]);
    assert!(shrinking[140..].iter().all(|&size| size == rest), "it rests: {shrinking:?}");
    assert!(growing[60..].iter().all(|&size| size == growing[119]), "it rests: {growing:?}");
    assert_eq!(rest, growing[119]);
    // By hand: about 8 m of ground seen, r = 2 tan 0.15 = 0.302 m: the relation asks for 92 and more.
    assert!(rest[0] >= 92 && rest[0] <= 256, "{rest:?}");
}

#[test]
fn the_loop_rests_where_a_box_touches_the_ground() {
    let sun = [Light::Directional { direction: DVec3::new(0.4, -1.0, 0.3), half_angle: 0.1 }];
    let scene = ground_and(cuboid(Vec3::new(-1.0, 0.0, -1.0), Vec3::new(1.0, 2.0, 1.0)));
    let mut rig = Rig::new(settings(1024), Options::default(), &scene);
    let sizes = run(&mut rig, &sun, 160);
    assert!(sizes[120..].iter().all(|&size| size == sizes[159]), "{sizes:?}");
    // The pixel decides: 8 m in 96 pixels need no more than about 96 texels for what is seen, a little more for the
    // box.
    assert!(sizes[159][0] < 512, "{:?}", sizes[159]);
}
