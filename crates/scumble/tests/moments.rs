//! Variance shadow maps: the moments are those of the CPU, and their cost does not depend on the radius.

mod common;

use common::casters::cuboid;
use common::rig::{Point, Rig, fixed, ground_and, slab, sun_above};
use glam::{DVec2, DVec3, Vec3};
use scumble::scumble_core::moments::MomentMap;
use scumble::{Error, Filter, Light, Options, Settings, View};

fn vsm(radius_world: f64) -> Filter {
    Filter::Vsm { radius_world }
}

fn settings(cap: u32) -> Settings {
    Settings { cap, ..Settings::default() }
}

fn on_ground(x: f32, z: f32) -> Point {
    Point { position: Vec3::new(x, 0.0, z), normal: Vec3::Y, pixel: [0, 0] }
}

fn lamp() -> Light {
    Light::Spot {
        position: DVec3::new(1.0, 8.0, -0.5),
        direction: DVec3::new(-0.1, -1.0, 0.05),
        cone_half_angle: 0.6,
        radius_world: 0.4,
    }
}

/// Linear depths of a drawn map, 0 at its near plane and 1 at its far plane.
fn linear_depths(rig: &Rig, view: &View) -> Vec<f64> {
    let depths = rig.gpu.read_depth(rig.shadows.map_texture(), view.layer, view.size_texels);
    depths.into_iter().map(|depth| share_of_range(view, view.fit.depth_from_ndc(f64::from(depth)))).collect()
}

fn share_of_range(view: &View, depth: f64) -> f64 {
    (depth - view.fit.depth_near) / (view.fit.depth_far - view.fit.depth_near)
}

#[test]
fn moments_and_visibility_are_those_of_the_cpu_over_the_same_map() {
    let mut above = cuboid(Vec3::new(0.5, 0.0, -2.0), Vec3::new(1.7, 1.1, -0.6));
    above.extend(cuboid(Vec3::new(-2.0, 1.5, 0.3), Vec3::new(0.2, 1.7, 2.4)));
    let scene = ground_and(above);
    let points: Vec<Point> =
        (0..1600).map(|i| on_ground((i % 40) as f32 * 0.153 - 3.0, (i / 40) as f32 * 0.149 - 2.9)).collect();
    let sun = Light::Directional { direction: DVec3::new(0.35, -1.0, 0.2), half_angle: 0.1 };
    // Less than half a texel, a few texels, blocks of many.
    for (light, radii) in [(sun, [0.01, 0.3, 0.9]), (lamp(), [0.002, 0.02, 0.12])] {
        for radius_world in radii {
            let mut rig = Rig::new(settings(512), fixed(vsm(radius_world), 160), &scene);
            let plan = rig.draw(&[light]);
            let view = &plan.views()[0];
            let texels = radius_world / view.texel_world();
            let map = MomentMap::new(&linear_depths(&rig, view), view.size_texels, texels);
            let bound = rig.shadows.settings().variance;
            let range = view.fit.depth_far - view.fit.depth_near;

            let found = rig.evaluate(
                "let receiver = shadow_receiver(0u, row.a.xyz, row.b.xyz);
                 result = vec4f(shadow_moments_at(0u, receiver.texel), shadow_vsm(0u, receiver), 0.0);",
                &points,
            );
            let (mut of_mean, mut of_deviation, mut off, mut partial) = (0.0f64, 0.0f64, 0, 0);
            for (point, [mean, variance, visibility, _]) in points.iter().zip(found) {
                let (uv, depth) = view.fit.uv_from_world(point.position.as_dvec3());
                let size = DVec2::new(f64::from(view.size_texels[0]), f64::from(view.size_texels[1]));
                let expected = map.at(uv * size);
                of_mean = of_mean.max((f64::from(mean) - expected.mean).abs());
                of_deviation = of_deviation.max((f64::from(variance).sqrt() - expected.variance.sqrt()).abs());
                // The part of the bias that is for rounding: 1e-5 of the range.
                let deviation_min = bound.deviation_min_texels * view.texel_world().max_element()
                    / view.fit.reference_from_depth(depth)
                    / range;
                let depth = share_of_range(view, depth).min(1.0) - 1e-5;
                let expected = expected.visibility(depth, deviation_min, bound.bleeding_cut);
                off += usize::from((f64::from(visibility) - expected).abs() > 0.01);
                partial += usize::from(expected > 0.0 && expected < 1.0);
            }
            println!("{texels:.1} texels: mean off by {of_mean:.1e}, deviation by {of_deviation:.1e} of the range");
            assert!(partial >= 10, "only {partial} of the points are in a penumbra");
            // Depth and place of f32: 6e-8 of the range by up to some tens of texels of slope. Of the deviation, where it is 0.
            assert!(of_mean < 1e-4 && of_deviation < 1e-3, "{of_mean} {of_deviation}");
            assert!(off <= 4, "{light:?}: {off} of {} points differ", points.len());
        }
    }
}

#[test]
fn the_cost_has_a_bound_that_no_radius_passes_and_nothing_is_allocated_later() {
    let mut rig = Rig::new(settings(256), fixed(vsm(0.01), 256), &ground_and(slab(2.0, 0.3)));
    let created = rig.shadows.counters();
    // Depth, and two textures of two f32.
    assert_eq!(created.map_bytes, 256 * 256 * (4 + 8 + 8));
    let mut radius_world = 0.005;
    while radius_world < 4.0 {
        rig.shadows.set_options(fixed(vsm(radius_world), 256)).unwrap();
        let plan = rig.draw(&[sun_above(0.1)]);
        let counters = rig.shadows.counters();
        let taps = counters.moment_taps as f64 / plan.texels() as f64;
        let texels = radius_world / plan.views()[0].texel_world().min_element();
        println!("{texels:6.1} texels: {taps:5.1} reads a texel");
        // A texel once, and 17 blocks along x and along y; blocks of two texels or more are a quarter as many.
        assert!(taps <= if texels < 8.0 { 35.0 } else { 1.0 + 34.0 / 4.0 + 0.2 }, "{texels}: {taps}");
        assert_eq!((counters.taps_per_pixel, counters.allocations), (4, created.allocations));
        radius_world *= 1.17;
    }
    assert!(rig.shadows.counters().moment_passes > 30);
}

#[test]
fn moments_that_were_not_allocated_are_refused_in_words_and_others_can_be_left_and_taken_up() {
    let mut without = Rig::new(settings(64), fixed(Filter::Pcss, 64), &ground_and(slab(2.0, 0.3)));
    let refused = without.shadows.set_options(fixed(vsm(0.3), 64)).unwrap_err();
    assert!(matches!(refused, Error::MomentsAllocated) && refused.to_string().contains("pcf"), "{refused}");

    let mut rig = Rig::new(settings(64), fixed(vsm(0.3), 64), &ground_and(slab(2.0, 0.3)));
    let points: Vec<Point> = (0..64).map(|i| on_ground(i as f32 * 0.05 - 1.6, 0.2)).collect();
    let seen = |rig: &mut Rig, filter| {
        rig.shadows.set_options(fixed(filter, 64)).unwrap();
        rig.draw(&[sun_above(0.1)]);
        rig.visibility(&points)
    };
    let first = seen(&mut rig, vsm(0.3));
    let passes = rig.shadows.counters().moment_passes;
    assert_ne!(seen(&mut rig, Filter::Hard), first);
    let counters = rig.shadows.counters();
    assert_eq!((counters.moment_passes, counters.moment_taps, counters.moment_blocks), (passes, 0, 0));
    assert_eq!(seen(&mut rig, vsm(0.3)), first);
}

#[test]
fn each_light_has_its_own_moments() {
    let options = Options { maps: 2, ..fixed(vsm(0.2), 96) };
    let mut rig = Rig::new(settings(96), options, &ground_and(slab(2.0, 0.0)));
    rig.draw(&[sun_above(0.1), lamp()]);
    let points: Vec<Point> = (0..64).map(|i| on_ground(i as f32 * 0.08 - 2.5, 0.2)).collect();
    let both = rig.evaluate(
        "result = vec4f(shadow_visibility(0u, row.a.xyz, row.b.xyz, row.c.xy),
                        shadow_visibility(1u, row.a.xyz, row.b.xyz, row.c.xy), 0.0, 0.0);",
        &points,
    );
    // The sun's shadow ends at x = 0; the lamp at x = 1, 8 m up, sees the slab's edge 2 m up at x = -1/3.
    for (point, [sun, lamp, ..]) in points.iter().zip(both) {
        for (visibility, edge) in [(sun, 0.0), (lamp, -1.0 / 3.0)] {
            let x = point.position.x;
            let is_near = (x - edge).abs() < 0.5;
            assert!(is_near || visibility == f32::from(u8::from(x > edge)), "{x}: {visibility}");
        }
    }
}
