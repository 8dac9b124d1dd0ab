//! Directional light with a map for each slice of the view: every point finds its map, no seam shows, each map is asked for
//! what its own slice needs.

mod common;

use common::casters::{cuboid, quad};
use common::gpu;
use common::rig::{Point, Rig, camera_above, fixed, sun_above};
use glam::{DVec3, Vec3};
use scumble::scumble_core::half_plane_under_disc;
use scumble::{Camera, Error, Filter, Light, Options, Settings, SizeChoice, Splits, Statistic, View};

fn settings(cap: u32) -> Settings {
    Settings { cap, ..Settings::default() }
}

fn cascaded(options: Options, count: u32) -> Options {
    Options { maps: 4, cascades: Splits { count, ..Splits::default() }, ..options }
}

/// Ground of 120 m by 16 m and what stands on it.
fn street_with(mut casters: Vec<Vec3>) -> Vec<Vec3> {
    casters.extend(quad([[-8.0, 0.0, 6.0], [8.0, 0.0, 6.0], [8.0, 0.0, -114.0], [-8.0, 0.0, -114.0]].map(Vec3::from)));
    casters
}

/// A level half plane 2 m above the street, x <= 0, whose edge runs along the view.
fn awning() -> Vec<Vec3> {
    street_with(quad([[-8.0, 2.0, 6.0], [0.0, 2.0, 6.0], [0.0, 2.0, -114.0], [-8.0, 2.0, -114.0]].map(Vec3::from)))
}

/// Looks down the street.
fn walker() -> Camera {
    Camera {
        eye: DVec3::new(1.0, 3.0, 8.0),
        target: DVec3::new(1.0, 0.0, -30.0),
        up: DVec3::Y,
        vertical_fov: 0.8,
        aspect: 1.0,
        near: 0.1,
        far: f64::INFINITY,
    }
}

fn rig(settings: Settings, options: Options, vertices: &[Vec3]) -> Rig {
    let mut rig = Rig::new(settings, options, vertices);
    rig.camera = walker();
    rig
}

/// The point of the street at `x` with this view depth.
fn on_street(x: f64, view_depth: f64, pixel: u32) -> Point {
    let (eye, forward) = (walker().eye, walker().forward());
    let z = eye.z + (view_depth - forward.x * (x - eye.x) + forward.y * eye.y) / forward.z;
    Point { position: DVec3::new(x, 0.0, z).as_vec3(), normal: Vec3::Y, pixel: [pixel, pixel / 3] }
}

/// Visibility at one place, averaged over the turns of the kernel.
fn means(rig: &Rig, places: &[(f64, f64)]) -> Vec<f64> {
    let turns = 64;
    let points: Vec<Point> =
        places.iter().flat_map(|&(x, depth)| (0..turns).map(move |k| on_street(x, depth, k * 13))).collect();
    let found = rig.visibility(&points);
    found.chunks(turns as usize).map(|all| all.iter().map(|&v| f64::from(v)).sum::<f64>() / f64::from(turns)).collect()
}

#[test]
fn every_point_on_screen_is_looked_up_in_the_map_of_its_slice_with_room_for_its_taps() {
    let radius_world = 0.3;
    for count in 1..=4 {
        let options = cascaded(Options { filter: Filter::Pcf { radius_world }, ..Options::default() }, count);
        let mut rig = rig(settings(1024), options, &awning());
        let tilted = Light::Directional { direction: DVec3::new(0.3, -1.0, 0.2), half_angle: 0.1 };
        let plan = rig.draw(&[tilted]);
        let views = plan.views();
        assert_eq!(views.len(), count as usize);
        let points: Vec<Point> = (0..2000_u32)
            .map(|i| {
                let t = f64::from(i);
                on_street(1.0 + 0.8 * ((t * 0.618).fract() - 0.5), 6.5 + 110.0 * (t * 0.7548).fract().powi(3), i)
            })
            .collect();
        let body = "let map = shadow_map_of(0u, row.a.xyz);
             result = vec4f(f32(map), shadow_receiver(map, row.a.xyz, row.b.xyz).texel, shadow_lights.view_depth.w);";
        for (point, [map, x, y, _]) in points.iter().zip(rig.evaluate(body, &points)) {
            let depth = (point.position.as_dvec3() - rig.camera.eye).dot(rig.camera.forward());
            let is_at_end = views.iter().any(|view| (view.depth_end / depth - 1.0).abs() < 1e-5);
            let expected = views.iter().find(|view| depth <= view.depth_end).expect("the last slice has no end");
            assert!(is_at_end || map == expected.layer as f32, "{depth} {map}");
            assert!(is_at_end || plan.view_at(0, point.position.as_dvec3()) == Some(expected));
            let view: &View = &views[map as usize];
            let reach = radius_world / view.texel_world();
            for (at, side, reach) in [(x, view.size_texels[0], reach.x), (y, view.size_texels[1], reach.y)] {
                let (at, reach) = (f64::from(at), reach - 0.05);
                assert!(at >= reach && at <= f64::from(side) - reach, "{point:?} {at} of {side}");
            }
        }
    }
}

#[test]
fn no_seam_shows_where_slices_meet() {
    let pcf = Filter::Pcf { radius_world: 0.5 };
    let adaptive = Options { filter: pcf, ..Options::default() };
    for (options, radius) in [(adaptive, 0.5), (fixed(pcf, 700), 0.5), (fixed(Filter::Pcss, 1024), 2.0 * 0.1_f64.tan())]
    {
        let mut rig = rig(settings(2048), cascaded(options.clone(), 4), &awning());
        let plan = rig.draw(&[sun_above(0.1)]);
        let ends: Vec<f64> = plan.views().iter().map(|view| view.depth_end).filter(|end| end.is_finite()).collect();
        assert_eq!(ends.len(), 3);
        for end in ends {
            let places: Vec<f64> = (0..21).map(|i| (f64::from(i) / 10.0 - 1.0) * 1.2 * radius).collect();
            let [before, behind] = [1.0 - 1e-4, 1.0 + 1e-4]
                .map(|side| means(&rig, &places.iter().map(|&x| (x, end * side)).collect::<Vec<_>>()));
            for ((x, before), behind) in places.iter().zip(before).zip(behind) {
                let truth = half_plane_under_disc(x / radius);
                // The truth does not change along the edge; two maps differ by the residual of their texels.
                assert!((before - behind).abs() < 0.05, "{:?} at {end}, {x}: {before} {behind}", options.filter);
                assert!((before - truth).abs() < 0.06 && (behind - truth).abs() < 0.06, "{before} {behind} {truth}");
            }
        }
    }
}

#[test]
fn each_map_is_asked_for_what_its_own_slice_needs() {
    // A plate 1 m up near the eye, one 3 m up far away, nothing between.
    let mut plates = cuboid(Vec3::new(-1.0, 0.95, -11.0), Vec3::new(1.0, 1.0, -9.0));
    plates.extend(cuboid(Vec3::new(-3.0, 2.95, -72.0), Vec3::new(3.0, 3.0, -64.0)));
    let geometry_alone = Settings { footprint_kappa: 0.0, ..settings(1024) };
    let mut rig = rig(geometry_alone, cascaded(fixed(Filter::Pcss, 1024), 4), &street_with(plates));
    rig.camera.eye.y = 12.0;
    let plan = rig.draw_and_measure(&[sun_above(0.1)], 512);
    let measured: Vec<Option<f64>> =
        plan.views().iter().map(|view| rig.shadows.measured_radius_world(view).expect("it was measured")).collect();
    let slice_of = |z: f64| {
        let depth = (DVec3::new(0.0, 0.0, z) - rig.camera.eye).dot(rig.camera.forward());
        plan.views().iter().position(|view| depth <= view.depth_end).expect("the last slice has no end")
    };
    let (near, far) = (slice_of(-10.0), slice_of(-68.0));
    assert!(near + 1 < far, "{measured:?}");
    for (slice, height) in [(near, 1.0), (far, 3.0)] {
        let radius = measured[slice].unwrap_or_default();
        assert!((radius / (height * 0.1_f64.tan()) - 1.0).abs() < 0.02, "{measured:?}");
    }
    assert_eq!(measured[near + 1], None, "there is nothing between");
}

#[test]
fn the_loop_comes_to_the_same_rest_from_the_smallest_and_the_largest_size() {
    let sun = [sun_above(0.1)];
    let still = Settings { shrink_after_frames: 1, shrink_rungs: 1000, ..settings(1024) };
    let run = |first: Options| {
        let mut rig = rig(still.clone(), cascaded(first, 4), &awning());
        rig.draw_and_measure(&sun, 128);
        rig.shadows.set_options(cascaded(Options::default(), 4)).unwrap();
        let sizes: Vec<Vec<[u32; 2]>> = (0..14)
            .map(|_| rig.draw_and_measure(&sun, 128).views().iter().map(|view| view.size_texels).collect())
            .collect();
        assert!(sizes[10..].iter().all(|now| *now == sizes[13]), "{sizes:?}");
        sizes[13].clone()
    };
    let from_largest = run(fixed(Filter::Pcss, 1024));
    assert_eq!(from_largest, run(fixed(Filter::Pcss, 8)));
    assert!(from_largest.iter().flatten().all(|&side| side < 1024), "{from_largest:?}");
}

#[test]
fn what_the_demand_pass_found_of_blocks_holds_across_slices() {
    let side = 96;
    let options = Options { measure_stride: 4, ..cascaded(fixed(Filter::Pcss, 1024), 4) };
    let mut rig = rig(settings(1024), options, &awning());
    let sun = [sun_above(0.1)];
    let height = rig.camera.height_at_unit_distance();
    let forward = rig.camera.forward();
    let right = forward.cross(DVec3::Y).normalize();
    let up = right.cross(forward);
    let points: Vec<Point> = (0..side * side)
        .filter_map(|i| {
            let pixel = [i % side, i / side];
            let [across, down] = pixel.map(|at| (f64::from(at) + 0.5) / f64::from(side) - 0.5);
            let ray = forward + height * (across * right - down * up);
            let position = rig.camera.eye - ray * (rig.camera.eye.y / ray.y);
            // The lit side of the street, as the prepass sees it.
            let is_seen = ray.y < -0.03 && (0.3..8.0).contains(&position.x) && position.z > -110.0;
            is_seen.then_some(Point { position: position.as_vec3(), normal: Vec3::Y, pixel })
        })
        .collect();
    rig.draw(&sun);
    let without = rig.visibility(&points);
    rig.draw_and_measure(&sun, side);
    let with = rig.visibility(&points);
    assert!(points.len() > 1000);
    let kinds = rig.evaluate("result.x = f32(shadow_block(0u, vec2u(row.c.xy)));", &points);
    assert!(kinds.iter().filter(|kind| kind[0] == 1.0).count() > points.len() / 2, "most blocks are lit");
    let off = without.iter().zip(&with).filter(|(a, b)| (**a - **b).abs() > 0.05).count();
    assert!(off == 0, "{off} of {}", points.len());
}

#[test]
fn maps_and_passes_are_counted_and_nothing_is_allocated_when_the_cascades_change() {
    let mut rig = rig(settings(64), cascaded(fixed(Filter::Hard, 64), 4), &awning());
    let first = rig.shadows.counters();
    assert_eq!(first.map_bytes, 4 * 64 * 64 * 4);
    for (count, passes) in [(4, 4), (1, 5), (3, 8), (2, 10)] {
        rig.shadows.set_options(cascaded(fixed(Filter::Hard, 64), count)).unwrap();
        rig.draw(&[sun_above(0.1)]);
        let counters = rig.shadows.counters();
        assert_eq!((counters.map_passes, counters.texels), (passes, u64::from(count) * 64 * 64));
        assert_eq!(counters.allocations, first.allocations);
    }
}

#[test]
fn two_lights_have_maps_beside_each_other() {
    let lamp = Light::Spot {
        position: DVec3::new(1.0, 5.0, 0.0),
        direction: DVec3::NEG_Y,
        cone_half_angle: 0.6,
        radius_world: 0.1,
    };
    let mut rig = rig(settings(256), cascaded(fixed(Filter::Hard, 256), 3), &awning());
    let plan = rig.draw(&[sun_above(0.1), lamp]);
    let places: Vec<[u32; 3]> = plan.views().iter().map(|view| [view.light, view.slice, view.layer]).collect();
    assert_eq!(places, [[0, 0, 0], [0, 1, 1], [0, 2, 2], [1, 0, 3]]);
    assert_eq!((plan.views_of(0).count(), plan.views_of(1).count()), (3, 1));
    let body = "result = vec4f(shadow_visibility(0u, row.a.xyz, row.b.xyz, row.c.xy), \
                shadow_visibility(1u, row.a.xyz, row.b.xyz, row.c.xy), 0.0, 0.0);";
    let found = rig.evaluate(body, &[on_street(-1.0, 9.0, 0), on_street(1.5, 9.0, 1), on_street(-1.0, 60.0, 2)]);
    assert_eq!(found.iter().map(|v| [v[0], v[1]]).collect::<Vec<_>>(), [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
}

#[test]
fn cascades_that_do_not_fit_are_refused_in_words() {
    let rig = rig(settings(64), Options { maps: 2, ..cascaded(fixed(Filter::Hard, 64), 4) }, &awning());
    let refused = |rig: &Rig, lights: &[Light]| rig.shadows.plan(&rig.camera, &rig.bounds, lights).unwrap_err();
    let few = refused(&rig, &[sun_above(0.1)]);
    assert!(matches!(few, Error::TooManyMaps { needed: 4, allocated: 2 }), "{few}");
    let many = Options { cascades: Splits { count: 5, ..Splits::default() }, ..Options::default() };
    let refusal = scumble::Shadows::with_options(&gpu().device, settings(64), many).unwrap_err();
    assert!(refusal.to_string().contains("cascades is 5"), "{refusal}");
}

#[test]
fn a_view_straight_down_on_flat_ground_has_usable_maps() {
    let mut rig = rig(settings(128), cascaded(Options::default(), 4), &awning());
    rig.camera = camera_above(DVec3::ZERO);
    let plan = rig.draw(&[sun_above(0.0)]);
    assert!(plan.views().iter().all(|view| view.clip_from_world.is_finite() && view.texels() > 0));
    rig.shadows.set_options(cascaded(Options { size: SizeChoice::Fixed([32; 2]), ..Options::default() }, 2)).unwrap();
    assert!(rig.draw(&[sun_above(0.2)]).texels() > 0);
}

#[test]
fn every_map_of_a_light_has_its_own_histogram() {
    let half_angle = 0.1_f64;
    let settings = Settings { footprint_kappa: 0.0, statistic: Statistic::Quantile(0.05), ..settings(1024) };
    let mut rig = rig(settings, cascaded(Options { measure_stride: 1, ..Options::default() }, 3), &awning());
    let plan = rig.draw_and_measure(&[sun_above(half_angle)], 192);
    let radii: Vec<f64> =
        plan.views().iter().map(|view| rig.shadows.measured_radius_world(view).unwrap().expect("a penumbra")).collect();
    assert_eq!(radii.len(), 3);
    // The awning is 2 m above the street everywhere.
    let expected = 2.0 * half_angle.tan();
    for radius in radii {
        assert!(radius > 0.85 * expected && radius < 1.02 * expected, "{radius} for {expected}");
    }
}
