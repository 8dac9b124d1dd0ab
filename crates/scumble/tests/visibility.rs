//! Known answers: what is lit, what is dark, and how soft an edge is.

mod common;

use common::casters::{cuboid, quad};
use common::rig::{Point, Rig, camera_above, fixed, ground_and, slab, sun_above};
use glam::{DVec2, DVec3, Vec2, Vec3};
use scumble::scumble_core::half_plane_under_disc;
use scumble::{Camera, Filter, Light, Options, Settings, SizeChoice};

fn settings(cap: u32) -> Settings {
    Settings { cap, ..Settings::default() }
}

fn on_ground(x: f32, z: f32, pixel: u32) -> Point {
    Point { position: Vec3::new(x, 0.0, z), normal: Vec3::Y, pixel: [pixel, pixel / 3] }
}

/// A grid of the middle of the ground, 6 m wide.
fn grid(side: u32) -> Vec<Point> {
    let at = |i: u32| 6.0 * (i as f32 + 0.5) / side as f32 - 3.0;
    (0..side * side).map(|i| on_ground(at(i % side), at(i / side), i)).collect()
}

#[test]
fn one_tap_tells_dark_from_lit_beside_an_edge() {
    let mut rig = Rig::new(settings(256), fixed(Filter::Hard, 256), &ground_and(slab(2.0, 0.4)));
    rig.draw(&[sun_above(0.1)]);
    let across = glam::Quat::from_rotation_y(0.4) * Vec3::X;
    for (point, visibility) in grid(40).iter().zip(rig.visibility(&grid(40))) {
        let distance = point.position.dot(across);
        if distance.abs() > 0.1 {
            assert_eq!(visibility, f32::from(u8::from(distance > 0.0)), "{point:?}");
        }
    }
}

#[test]
fn a_surface_under_nothing_is_fully_lit_however_it_is_tilted() {
    for tilt in [0.0f32, 0.5, 1.0, 1.3] {
        let turn = glam::Quat::from_euler(glam::EulerRot::YXZ, 0.3, 0.0, tilt);
        let plane =
            quad([[-4.0, -4.0], [4.0, -4.0], [4.0, 4.0], [-4.0, 4.0]].map(|[x, z]| turn * Vec3::new(x, 0.0, z)));
        let radius_world = 0.2;
        for filter in [Filter::Hard, Filter::Pcf { radius_world }, Filter::Pcss, Filter::Vsm { radius_world }] {
            let mut rig = Rig::new(settings(128), fixed(filter, 96), &plane);
            rig.camera = camera_above(DVec3::ZERO);
            rig.draw(&[Light::Directional { direction: DVec3::new(0.1, -1.0, -0.2), half_angle: 0.1 }]);
            let points: Vec<Point> = grid(30)
                .into_iter()
                .map(|p| Point { position: turn * (0.9 * p.position), normal: turn * Vec3::Y, ..p })
                .collect();
            let darkest = rig.visibility(&points).into_iter().fold(1.0, f32::min);
            assert_eq!(darkest, 1.0, "{filter:?} at a tilt of {tilt}");
        }
    }
}

#[test]
fn a_half_plane_fades_as_the_closed_form_of_a_disc_within_the_residual_of_the_ratio() {
    let radius_world = 0.5;
    let (mut largest, mut squares, mut count) = (0.0f64, 0.0f64, 0.0f64);
    for degrees in [4.0f32, 9.0, 15.0, 22.0, 27.0, 33.0, 38.0, 44.0] {
        let options = Options { filter: Filter::Pcf { radius_world }, ..Options::default() };
        let angle = degrees.to_radians();
        let mut rig = Rig::new(settings(1024), options, &ground_and(slab(2.0, angle)));
        let plan = rig.draw(&[sun_above(0.1)]);
        // The ladder may give more texels than the ratio asks for; compare at exactly the ratio.
        let sides = (plan.views()[0].fit.extent_world * 3.47 / radius_world).ceil().as_uvec2().to_array();
        let exact = Options { size: SizeChoice::Fixed(sides), ..rig.shadows.options().clone() };
        rig.shadows.set_options(exact).unwrap();
        rig.draw(&[sun_above(0.1)]);

        // Points anywhere along the edge, up to two radii from it.
        let turn = glam::Quat::from_rotation_y(angle);
        let places: Vec<Vec2> = (0..2000u32)
            .map(|i| {
                Vec2::new((i as f32 * 0.569_840_3).fract() * 2.0 - 1.0, (i as f32 * 0.754_877_7).fract() * 4.0 - 2.0)
            })
            .collect();
        let points: Vec<Point> = (0u32..)
            .zip(&places)
            .map(|(i, at)| Point {
                position: turn * Vec3::new(at.x, 0.0, at.y),
                normal: Vec3::Y,
                pixel: [i, degrees as u32],
            })
            .collect();
        for (at, found) in places.iter().zip(rig.visibility(&points)) {
            let error = f64::from(found) - half_plane_under_disc(f64::from(at.x) / radius_world);
            largest = largest.max(error.abs());
            squares += error * error;
            count += 1.0;
        }
    }
    let rms = (squares / count).sqrt();
    println!("largest {largest:.4}, rms {rms:.4}");
    // The residual of 25 bilinear taps at c = 3.47: 0.095 and 0.015 for a Vogel disc, a little more for a Poisson disc,
    // whose taps on the CPU stay below these (a test of `scumble_core`).
    assert!(largest < 0.115, "{largest}");
    assert!(rms < 0.017, "{rms}");
}

#[test]
fn the_error_of_an_edge_shrinks_as_the_map_grows() {
    let radius_world = 0.5;
    let rms = |side: u32| {
        let filter = Filter::Pcf { radius_world };
        let mut rig = Rig::new(settings(1024), fixed(filter, side), &ground_and(slab(2.0, 0.3)));
        rig.draw(&[sun_above(0.1)]);
        let turn = glam::Quat::from_rotation_y(0.3);
        let places: Vec<f32> = (0..40u32).map(|i| i as f32 / 40.0 - 0.5).collect();
        let points: Vec<Point> = places
            .iter()
            .flat_map(|&x| {
                (0..64u32).map(move |k| {
                    let position = turn * Vec3::new(x, 0.0, k as f32 * 0.043 - 1.4);
                    Point { position, normal: Vec3::Y, pixel: [k * 31 + 7, k * 17] }
                })
            })
            .collect();
        let errors: Vec<f64> = places
            .iter()
            .zip(rig.visibility(&points).chunks(64))
            .map(|(&x, found)| {
                let mean = found.iter().map(|&v| f64::from(v)).sum::<f64>() / 64.0;
                (mean - half_plane_under_disc(f64::from(x) / radius_world)).powi(2)
            })
            .collect();
        (errors.iter().sum::<f64>() / errors.len() as f64).sqrt()
    };
    let [coarse, fine] = [rms(24), rms(768)];
    assert!(fine < 0.02 && coarse > 1.5 * fine, "{coarse} {fine}");
}

#[test]
fn the_penumbra_of_a_soft_shadow_is_as_wide_as_the_sun_and_the_height_make_it() {
    let (half_angle, height) = (0.15f64, 2.0f32);
    let mut rig = Rig::new(settings(1024), fixed(Filter::Pcss, 1024), &ground_and(slab(height, 0.0)));
    rig.draw(&[sun_above(half_angle)]);
    let radius = f64::from(height) * half_angle.tan();
    let places: Vec<f32> = (0..80u32).map(|i| (i as f32 / 40.0 - 1.0) * 1.5 * radius as f32).collect();
    let points: Vec<Point> =
        places.iter().flat_map(|&x| (0..64u32).map(move |k| on_ground(x, k as f32 * 0.03 - 1.0, k * 13))).collect();
    for (&x, found) in places.iter().zip(rig.visibility(&points).chunks(64)) {
        let mean = found.iter().map(|&v| f64::from(v)).sum::<f64>() / 64.0;
        let expected = half_plane_under_disc(f64::from(x) / radius);
        assert!((mean - expected).abs() < 0.05, "at {x}: {mean} for {expected}");
    }
}

#[test]
fn a_lamp_under_a_ceiling_casts_the_same_soft_shadow_as_one_in_the_open() {
    let lamp = Light::Spot {
        position: DVec3::new(0.0, 2.5, 0.0),
        direction: DVec3::NEG_Y,
        cone_half_angle: 0.7,
        radius_world: 0.15,
    };
    // Similar triangles: the slab is 1.5 m below the lamp, the ground 2.5 m.
    let radius = 0.15 * 1.0 / 1.5;
    for ceiling in [None, Some(cuboid(Vec3::new(-5.0, 3.0, -5.0), Vec3::new(5.0, 3.1, 5.0)))] {
        let casters = slab(1.0, 0.0).into_iter().chain(ceiling.into_iter().flatten()).collect();
        let mut rig = Rig::new(settings(1024), fixed(Filter::Pcss, 1024), &ground_and(casters));
        rig.camera = Camera { vertical_fov: 1.2, ..camera_above(DVec3::ZERO) };
        rig.camera.eye.y = 2.9;
        rig.draw(&[lamp]);
        let places: Vec<f32> = (0..40u32).map(|i| i as f32 * 0.01 - 0.2).collect();
        let points: Vec<Point> =
            places.iter().flat_map(|&x| (0..64u32).map(move |k| on_ground(x, k as f32 * 0.02 - 0.6, k * 13))).collect();
        for (&x, found) in places.iter().zip(rig.visibility(&points).chunks(64)) {
            let mean = found.iter().map(|&v| f64::from(v)).sum::<f64>() / 64.0;
            let expected = half_plane_under_disc(f64::from(x) / radius);
            assert!((mean - expected).abs() < 0.06, "at {x}: {mean} for {expected}");
        }
    }
}

#[test]
fn lookups_stay_inside_the_viewport_and_outside_of_the_map_is_lit() {
    for filter in [Filter::Hard, Filter::Pcf { radius_world: 2.0 }, Filter::Pcss] {
        // Fill the whole layer with a roof.
        let roof = slab(3.0, 0.0).into_iter().chain(slab(3.0, std::f32::consts::PI)).collect();
        let mut rig = Rig::new(settings(256), fixed(filter, 256), &ground_and(roof));
        let sun = [sun_above(0.2)];
        rig.draw(&sun);
        assert!(rig.visibility(&grid(8)).iter().all(|&v| v == 0.0), "the roof shades all");
        // Then use a corner of it, without casters.
        rig.shadows.set_options(fixed(filter, 40)).unwrap();
        let plan = rig.shadows.plan(&rig.camera, &rig.bounds, &sun).unwrap();
        rig.shadows.upload(&rig.gpu.queue, &plan);
        let mut encoder = rig.gpu.encoder();
        drop(rig.shadows.begin(&mut encoder, &plan.views()[0]));
        rig.gpu.finish(encoder);
        let everywhere: Vec<Point> = grid(40).into_iter().map(|p| Point { position: 4.0 * p.position, ..p }).collect();
        assert!(rig.visibility(&everywhere).iter().all(|&v| v == 1.0), "{filter:?}");
        let layer = rig.gpu.read_depth(rig.shadows.map_texture(), 0, [256, 256]);
        assert!(layer[39 * 256 + 39] == 1.0 && layer[40 * 256 + 40] < 1.0, "only the viewport is cleared");
    }
}

#[test]
fn a_light_that_reaches_nothing_on_screen_has_no_map_and_leaves_everything_lit() {
    let options = Options { maps: 2, ..fixed(Filter::Pcf { radius_world: 0.3 }, 64) };
    let mut rig = Rig::new(settings(64), options, &ground_and(slab(2.0, 0.0)));
    let lamp = Light::Spot {
        position: DVec3::new(0.0, 3.0, 0.0),
        direction: DVec3::Y,
        cone_half_angle: 0.5,
        radius_world: 0.1,
    };
    let plan = rig.draw(&[lamp, sun_above(0.1)]);
    assert_eq!(plan.views().len(), 1);
    assert_eq!(plan.views()[0].light, 1);
    assert!(rig.visibility(&grid(10)).iter().all(|&v| v == 1.0));
    let second = rig.evaluate("result.x = shadow_visibility(1u, row.a.xyz, row.b.xyz, row.c.xy);", &grid(10));
    assert!(second.iter().any(|v| v[0] == 0.0) && second.iter().any(|v| v[0] == 1.0));
    let beyond = rig.evaluate("result.x = shadow_visibility(77u, row.a.xyz, row.b.xyz, row.c.xy);", &grid(2));
    assert!(beyond.iter().all(|v| v[0] == 1.0), "a light that does not exist is lit");
}

#[test]
fn a_scene_a_million_metres_away_looks_the_same_about_its_origin() {
    let far = DVec3::new(1.0e6, -2.0e6, 3.0e6);
    for light in [sun_above(0.1), Light::Directional { direction: DVec3::new(0.2, -1.0, 0.4), half_angle: 0.1 }] {
        for filter in [Filter::Hard, Filter::Pcf { radius_world: 0.3 }, Filter::Pcss, Filter::Vsm { radius_world: 0.3 }]
        {
            let seen: Vec<Vec<f32>> = [DVec3::ZERO, far]
                .into_iter()
                .map(|origin_world| {
                    let options = Options { origin_world, ..fixed(filter, 200) };
                    let mut rig = Rig::new(settings(256), options, &ground_and(slab(2.0, 0.3)));
                    rig.draw(&[light]);
                    rig.visibility(&grid(30))
                })
                .collect();
            let off = seen[0].iter().zip(&seen[1]).filter(|(a, b)| (**a - **b).abs() > 0.02).count();
            assert!(off <= 2, "{filter:?}: {off} of 900 points differ");
        }
    }
}

#[test]
fn the_filter_as_a_constant_gives_what_the_uploaded_filter_gives() {
    let kinds = [
        ("0u", Filter::Hard),
        ("1u", Filter::Pcf { radius_world: 0.3 }),
        ("2u", Filter::Pcss),
        ("3u", Filter::Vsm { radius_world: 0.3 }),
    ];
    for (value, filter) in kinds {
        let mut rig = Rig::new(settings(128), fixed(filter, 128), &ground_and(slab(2.0, 0.3)));
        rig.draw(&[sun_above(0.2)]);
        let uploaded = rig.visibility(&grid(20));
        let fixed_wgsl = scumble::shadow_wgsl(0)
            .replace("override shadow_filter: u32 = 4u", &format!("override shadow_filter: u32 = {value}"));
        let rows: Vec<[[f32; 4]; 4]> = grid(20)
            .iter()
            .map(|p| {
                let pixel = [p.pixel[0] as f32 + 0.5, p.pixel[1] as f32 + 0.5, 0.0, 0.0];
                [p.position.extend(1.0).to_array(), p.normal.extend(0.0).to_array(), pixel, [0.0; 4]]
            })
            .collect();
        let group = Some((rig.shadows.bind_group_layout(), rig.shadows.bind_group()));
        let body = "result.x = shadow_visibility(0u, row.a.xyz, row.b.xyz, row.c.xy);";
        let constant = rig.gpu.evaluate(&fixed_wgsl, body, group, &rows);
        assert!(uploaded.iter().zip(constant).all(|(a, b)| (a - b[0]).abs() < 1e-4), "{filter:?}");
    }
}

#[test]
fn taps_of_a_receiver_at_the_edge_of_the_screen_still_find_their_caster() {
    // The camera sees x >= 0.2 only; the slab's edge at x = 0 lies outside of the fitted box but within the radius.
    let radius_world = 0.6;
    let options = fixed(Filter::Pcf { radius_world }, 256);
    let mut rig = Rig::new(settings(256), options, &ground_and(slab(2.0, 0.0)));
    rig.camera = Camera { vertical_fov: 0.15, ..camera_above(DVec3::new(1.1, 0.0, 0.0)) };
    let plan = rig.draw(&[sun_above(0.1)]);
    assert!(plan.views()[0].fit.extent_world.max_element() < 4.0);
    let points: Vec<Point> = (0..64).map(|k| on_ground(0.25, (k as f32 - 32.0) * 0.01, k * 7)).collect();
    let found = rig.visibility(&points);
    let mean = found.iter().map(|&v| f64::from(v)).sum::<f64>() / 64.0;
    let expected = half_plane_under_disc(0.25 / radius_world);
    assert!((mean - expected).abs() < 0.03, "{mean} for {expected}");
}

#[test]
fn the_views_say_what_was_drawn() {
    let filter = Filter::Pcf { radius_world: 0.25 };
    let options = Options { filter, fitted: false, ..Options::default() };
    let mut rig = Rig::new(settings(512), options, &ground_and(slab(2.0, 0.0)));
    let plan = rig.draw(&[sun_above(0.1)]);
    let view = &plan.views()[0];
    // By hand: 18 m across (the slab), c = 3.47, r = 0.25 m: texels of 0.072 m, next rung of the ladder 1/16 m.
    assert!((view.fit.extent_world - DVec2::splat(18.0)).length() < 1e-6, "{}", view.fit.extent_world);
    assert_eq!(view.size_texels, [288, 288]);
    assert!(!view.size.capped && (view.size.c_effective - 4.0).abs() < 1e-9);
    assert_eq!(plan.texels(), 288 * 288);
}
