//! What a fit promises, against an independent enumeration of the receivers' vertices.

use glam::{DMat3, DVec2, DVec3};
use proptest::prelude::*;

use super::tests_support::{bulb, lamp, lamp_over_room, observer, room, sun, sun_over_room};
use super::{Fit, fit, fit_face};
use crate::polyhedron::HalfSpace;
use crate::{Aabb, Camera, Face, Light};

fn scene_sides(scene: &Aabb) -> Vec<HalfSpace> {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let side = |axis| [HalfSpace::through(scene.min, axis), HalfSpace::through(scene.max, -axis)];
    axes.into_iter().flat_map(side).collect()
}

/// All half spaces whose intersection is PSR.
fn receiver_sides(camera: &Camera, scene: &Aabb, light: &Light, fit: &Fit) -> Vec<HalfSpace> {
    let mut sides = scene_sides(scene);
    sides.extend(camera.half_spaces(DVec3::ZERO));
    sides.extend(light.half_spaces(fit.face, DVec3::ZERO));
    if let Some(position) = light.position() {
        let axis = light.direction_of(fit.face).normalize();
        sides.push(HalfSpace::through(position + fit.depth_near * axis, axis));
    }
    sides
}

/// The vertices of an intersection of half spaces: the points where three boundaries meet that lie in all.
fn vertices(sides: &[HalfSpace]) -> Vec<DVec3> {
    let mut found = Vec::new();
    for i in 0..sides.len() {
        for j in 0..i {
            for k in 0..j {
                let (a, b, c) = (&sides[i], &sides[j], &sides[k]);
                let planes = DMat3::from_cols(a.normal, b.normal, c.normal).transpose();
                if planes.determinant().abs() < 1e-9 {
                    continue;
                }
                let offsets = DVec3::new(a.distance(DVec3::ZERO), b.distance(DVec3::ZERO), c.distance(DVec3::ZERO));
                let p = planes.inverse() * -offsets;
                if sides.iter().all(|side| side.distance(p) >= -1e-7) {
                    found.push(p);
                }
            }
        }
    }
    found
}

/// Asserts that the receivers' box is the map: nothing outside, nothing left over.
fn assert_tight(camera: &Camera, scene: &Aabb, fit: Option<Fit>) -> Result<(), TestCaseError> {
    let Some(fit) = fit else {
        return Ok(());
    };
    let corners = vertices(&receiver_sides(camera, scene, &fit.light, &fit));
    // Enumeration blurs bodies thinner than its tolerance.
    if fit.extent_world.min_element() < 1e-3 {
        return Ok(());
    }
    prop_assert!(!corners.is_empty());
    let uvs: Vec<DVec2> = corners.iter().map(|&p| fit.uv_from_world(p).0).collect();
    let min = uvs.iter().fold(DVec2::INFINITY, |a, &b| a.min(b));
    let max = uvs.iter().fold(DVec2::NEG_INFINITY, |a, &b| a.max(b));
    prop_assert!(min.abs().max_element() < 1e-3, "{min}");
    prop_assert!((max - 1.0).abs().max_element() < 1e-3, "{max}");
    for &p in &corners {
        let depth = fit.depth(p);
        prop_assert!(depth >= fit.depth_near - 1e-6 && depth <= fit.depth_far + 1e-6);
        let ndc = fit.clip_from_world().project_point3(p);
        prop_assert!((ndc.z - fit.ndc_from_depth(depth)).abs() < 1e-6);
        let uv = DVec2::new(0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y);
        prop_assert!((uv - fit.uv_from_world(p).0).abs().max_element() < 1e-6);
    }
    Ok(())
}

fn vector(size: f64) -> impl Strategy<Value = DVec3> {
    (-size..size, -size..size, -size..size).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

fn any_camera() -> impl Strategy<Value = Camera> {
    (vector(6.0), vector(2.0), 0.2..1.8_f64, 0.5..2.0_f64, 1.0..30.0_f64).prop_map(
        |(eye, target, vertical_fov, aspect, far)| Camera {
            eye,
            target,
            up: DVec3::new(0.1, 1.0, 0.05),
            vertical_fov,
            aspect,
            near: 0.05,
            far,
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(192))]

    #[test]
    fn the_map_of_the_sun_is_the_smallest_box_of_the_receivers(camera in any_camera(), direction in vector(1.0)) {
        let light = Light::Directional { direction, half_angle: 0.01 };
        assert_tight(&camera, &room(), fit(&camera, &room(), &light, true).unwrap())?;
    }

    #[test]
    fn the_map_of_a_lamp_is_the_smallest_box_of_the_receivers(camera in any_camera(), position in vector(6.0), aim in vector(1.5), cone_half_angle in 0.2..1.2_f64) {
        let light = Light::Spot { position, direction: aim - position, cone_half_angle, radius_world: 0.1 };
        assert_tight(&camera, &room(), fit(&camera, &room(), &light, true).unwrap())?;
    }

    #[test]
    fn the_map_of_a_face_is_the_smallest_box_of_its_receivers(camera in any_camera(), position in vector(4.0), face in 0..6_usize, reach_world in 0.5..20.0_f64) {
        let light = Light::Point { position, radius_world: 0.1, reach_world };
        assert_tight(&camera, &room(), fit_face(&camera, &room(), &light, Face::ALL[face], true).unwrap())?;
    }

    #[test]
    fn every_receiver_on_screen_within_reach_is_covered_by_the_map_of_its_face(camera in any_camera(), position in vector(4.0), reach_world in 0.5..20.0_f64, points in prop::collection::vec((0.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64), 64)) {
        let light = Light::Point { position, radius_world: 0.1, reach_world };
        let fits = Face::ALL.map(|face| fit_face(&camera, &room(), &light, face, true).unwrap());
        for &(x, y, z) in &points {
            let p = room().min + room().size() * DVec3::new(x, y, z);
            let clip = camera.clip_from_world() * p.extend(1.0);
            let is_seen = clip.truncate().abs().max_element() <= clip.w && clip.z >= 0.0;
            let distance = (p - position).abs().max_element();
            let near = fits.iter().flatten().map(|fit| fit.depth_near).next().unwrap_or(0.0);
            if !is_seen || distance > reach_world || distance < near {
                continue;
            }
            let fit = fits[Face::of(p - position).index() as usize].as_ref().expect("a face with a point in it has a map");
            let (uv, depth) = fit.uv_from_world(p);
            prop_assert!(uv.min_element() > -1e-9 && uv.max_element() < 1.0 + 1e-9, "{uv}");
            prop_assert!(depth <= fit.depth_far);
        }
    }

    #[test]
    fn every_point_of_the_scene_in_the_box_of_the_map_is_behind_its_near_plane(camera in any_camera(), direction in vector(1.0), points in prop::collection::vec((0.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64), 64)) {
        let light = Light::Directional { direction, half_angle: 0.01 };
        let fit = fit(&camera, &room(), &light, true).unwrap();
        prop_assume!(fit.is_some());
        for (fit, border) in fit.iter().map(|fit| (fit.clone(), fit.with_border(0.3))) {
            for &(x, y, z) in &points {
                let p = room().min + room().size() * DVec3::new(x, y, z);
                for fit in [&fit, &border] {
                    let (uv, depth) = fit.uv_from_world(p);
                    let in_box = uv.cmpge(DVec2::ZERO).all() && uv.cmple(DVec2::ONE).all();
                    prop_assert!(!in_box || depth >= fit.depth_near, "{uv} {depth}");
                }
            }
        }
    }
}

/// A camera that sees a patch of 0.4 m of the room's floor from 2 m above it, and nothing higher than 1.5 m.
fn patch_of_floor() -> Camera {
    let eye = DVec3::new(0.5, 1.5, -0.5);
    Camera {
        eye,
        target: eye - DVec3::Y,
        up: DVec3::Z,
        vertical_fov: 2.0 * 0.1_f64.atan(),
        aspect: 1.0,
        near: 0.1,
        far: 10.0,
    }
}

#[test]
fn the_sun_in_the_zenith_fits_the_patch_that_is_seen_and_casters_up_to_the_top_of_the_scene() {
    let zenith = Light::Directional { direction: DVec3::NEG_Y, half_angle: 0.01 };
    let fit = fit(&patch_of_floor(), &room(), &zenith, true).unwrap().unwrap();
    assert!((fit.extent_world - 0.4).abs().max_element() < 1e-9);
    // The unfitted square has the room's 5 m.
    assert!((fit.scale - 5.0 / 0.4).abs().max_element() < 1e-9);
    // Depth is -y: the room is 3 m high, its top at 2.5 m; the margin is 1e-4 of it.
    assert!((fit.depth_near + 2.5).abs() < 4e-4 && fit.depth_near < -2.5, "{}", fit.depth_near);
    assert!((fit.depth_far - 0.5).abs() < 4e-4 && fit.depth_far > 0.5, "{}", fit.depth_far);
}

#[test]
fn a_wider_border_lets_in_earlier_casters() {
    let fit = fit(&patch_of_floor(), &room(), &sun(), true).unwrap().unwrap();
    let wider = fit.with_border(0.5);
    // The first corner of the room's top in the wider column lies nearer to the light.
    assert!(wider.depth_near < fit.depth_near - 0.05, "{} {}", wider.depth_near, fit.depth_near);
    assert!(fit.with_border(0.0).depth_near <= fit.depth_near);
}

#[test]
fn a_lamp_starts_where_its_cone_enters_the_scene_or_at_a_hundredth_of_its_reach() {
    let lamp = |y: f64| Light::Spot {
        position: DVec3::new(0.5, y, -0.5),
        direction: DVec3::NEG_Y,
        cone_half_angle: 0.3,
        radius_world: 0.1,
    };
    let above = fit(&patch_of_floor(), &room(), &lamp(4.5), true).unwrap().unwrap();
    assert!((above.depth_near - 2.0).abs() < 3e-4 && above.depth_near < 2.0, "{}", above.depth_near);
    assert!((above.depth_far - 5.0).abs() < 1e-3 && above.depth_far > 5.0);
    // What is seen is a pyramid from the camera, widest on the floor, 5 m from the lamp, and 0.4 m wide there.
    assert!((above.extent_at(5.0) - 0.4).abs().max_element() < 1e-6, "{}", above.extent_at(5.0));
    let square = 2.0 * above.depth_near * 0.3_f64.tan();
    assert!((above.scale * above.extent_world - square).abs().max_element() < 1e-9);
    let inside = fit(&patch_of_floor(), &room(), &lamp(1.5), true).unwrap().unwrap();
    assert!((inside.depth_near - 0.02).abs() < 1e-5, "{}", inside.depth_near);
}

#[test]
fn the_faces_of_a_bulb_share_a_near_plane_where_the_scene_begins_or_at_a_hundredth_of_its_reach() {
    let near_of = |position, reach_world| {
        let light = Light::Point { position, radius_world: 0.1, reach_world };
        let fits = Face::ALL.map(|face| fit_face(&observer(), &room(), &light, face, true).unwrap());
        let nears: Vec<f64> = fits.iter().flatten().map(|fit| fit.depth_near).collect();
        assert!(nears.iter().all(|&near| near == nears[0]), "{nears:?}");
        nears[0]
    };
    let above = near_of(DVec3::new(0.5, 4.5, -0.5), f64::INFINITY);
    assert!((above - 2.0).abs() < 3e-4 && above < 2.0, "{above}");
    // The room's far corner is 4 m along -z from here.
    let inside = near_of(DVec3::new(0.5, 1.0, 1.0), f64::INFINITY);
    assert!((inside - 0.04).abs() < 1e-5, "{inside}");
    let short = near_of(DVec3::new(0.5, 1.0, 1.0), 2.0);
    assert!((short - 0.02).abs() < 1e-5, "{short}");
}

#[test]
fn faces_that_nothing_seen_lies_in_have_no_map() {
    // The eye is half a metre below the bulb, and sees what is below it.
    let above = Light::Point { position: DVec3::new(0.4, 2.0, -0.6), radius_world: 0.1, reach_world: f64::INFINITY };
    for face in Face::ALL {
        let fit = fit_face(&patch_of_floor(), &room(), &above, face, true).unwrap();
        assert_eq!(fit.is_some(), face == Face::NegativeY, "{face:?}");
    }
    let far_away = Light::Point { position: DVec3::splat(50.0), radius_world: 0.1, reach_world: 10.0 };
    assert!(Face::ALL.iter().all(|&face| fit_face(&observer(), &room(), &far_away, face, true).unwrap().is_none()));
    assert!(fit(&observer(), &room(), &bulb(), true).unwrap_err().to_string().contains("six faces"));
}

#[test]
fn a_point_goes_to_the_plane_and_back() {
    for fit in [sun_over_room(), lamp_over_room()] {
        let p = DVec3::new(0.3, 0.2, -0.4);
        let back = fit.world_from_plane(fit.plane_from_world(p), fit.depth(p));
        assert!((back - p).length() < 1e-12);
        let depth = fit.depth(p);
        assert!((fit.depth_from_ndc(fit.ndc_from_depth(depth)) - depth).abs() < 1e-9);
        assert!(fit.ndc_from_depth(fit.depth_near).abs() < 1e-12);
        assert!((fit.ndc_from_depth(fit.depth_far) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn a_fitted_map_is_smaller_by_the_scale_of_each_axis() {
    for light in [sun(), lamp()] {
        let fitted = fit(&observer(), &room(), &light, true).unwrap().unwrap();
        let square = fit(&observer(), &room(), &light, false).unwrap().unwrap();
        assert_eq!(square.extent_world.x, square.extent_world.y);
        assert!((square.scale - 1.0).abs().max_element() < 1e-12);
        assert!(fitted.scale.min_element() >= 1.0);
        let side = fitted.extent_world * fitted.scale;
        assert!((side - square.extent_world).abs().max_element() < 1e-9);
        assert!(fitted.scale.x != fitted.scale.y);
        // r_uv = (r_world / L) s (Kreuzer 2017, 5.1.2).
        let radius_uv = 0.1 / square.extent_world.x * fitted.scale;
        assert!((fitted.uv_from_offset(DVec2::splat(0.1)).abs() - radius_uv).length() < 1e-12);
    }
}

#[test]
fn a_border_of_the_radius_keeps_every_tap_inside() {
    for fit in [sun_over_room(), lamp_over_room()] {
        let wider = fit.with_border(0.1);
        let corner = fit.world_from_plane(fit.plane_from_world(DVec3::ZERO), fit.depth(DVec3::ZERO));
        let (narrow, _) = fit.uv_from_world(corner);
        let (wide, _) = wider.uv_from_world(corner);
        let from_edge = narrow * fit.extent_world + 0.1;
        assert!((wide * wider.extent_world - from_edge).length() < 1e-12);
        assert!(wider.depth_near <= fit.depth_near);
        assert!((wider.scale * wider.extent_world - fit.scale * fit.extent_world).length() < 1e-9);
    }
}

#[test]
fn a_point_is_covered_when_it_lies_in_the_box_and_behind_the_near_plane() {
    for fit in [sun_over_room(), lamp_over_room()] {
        let at = |u: f64, v: f64, depth| {
            let offset = (DVec2::new(u, v) - 0.5) * fit.extent_world * DVec2::new(1.0, -1.0);
            let center = fit.plane_from_world(fit.world_from_plane(DVec2::ZERO, depth));
            fit.world_from_plane(center + fit.center + offset, depth)
        };
        let middle = 0.5 * (fit.depth_near + fit.depth_far);
        assert!(fit.covers(at(0.5, 0.5, middle)) && fit.covers(at(0.01, 0.99, middle)));
        for outside in [at(-0.01, 0.5, middle), at(0.5, 1.01, middle), at(0.5, 0.5, fit.depth_near - 0.01)] {
            assert!(!fit.covers(outside));
        }
    }
    let behind_the_lamp = DVec3::new(-0.5, 6.0, 0.5);
    assert!(!lamp_over_room().covers(behind_the_lamp));
}

#[test]
fn the_near_plane_of_a_lamp_does_not_follow_the_observer() {
    let near = lamp_over_room().depth_near;
    for x in [-3.0, 0.0, 2.0] {
        let camera = Camera { eye: DVec3::new(x, 1.0, 3.0), ..observer() };
        let fit = fit(&camera, &room(), &lamp(), true).unwrap().unwrap();
        assert_eq!(fit.depth_near, near);
    }
}

#[test]
fn where_the_light_lights_nothing_seen_there_is_no_map() {
    let away = Camera { target: DVec3::new(2.0, 1.2, 9.0), ..observer() };
    let upwards = Light::Spot {
        position: DVec3::new(0.0, 4.0, 0.0),
        direction: DVec3::Y,
        cone_half_angle: 0.8,
        radius_world: 0.1,
    };
    for light in [sun(), lamp()] {
        assert_eq!(fit(&away, &room(), &light, true).unwrap(), None);
        assert_eq!(fit(&away, &room(), &light, false).unwrap(), None);
        assert_eq!(fit(&observer(), &Aabb::EMPTY, &light, true).unwrap(), None);
    }
    assert_eq!(fit(&observer(), &room(), &upwards, true).unwrap(), None);
}

/// The promise that holds for every degenerate case: finite numbers and an invertible matrix.
fn assert_usable(fit: &Fit) {
    assert!(fit.extent_world.is_finite() && fit.extent_world.min_element() > 0.0);
    assert!(fit.scale.is_finite());
    assert!(fit.depth_near.is_finite() && fit.depth_far > fit.depth_near);
    assert!(fit.clip_from_world().is_finite());
    assert!(fit.clip_from_world().determinant().abs() > 0.0);
}

#[test]
fn degenerate_views_have_a_usable_map() {
    let inside = |eye| Camera { eye, target: DVec3::new(0.0, 0.0, -1.0), ..observer() };
    let spot =
        |position: DVec3, direction| Light::Spot { position, direction, cone_half_angle: 0.7, radius_world: 0.1 };
    let camera = observer();
    let sun_along = Light::Directional { direction: camera.forward(), half_angle: 0.01 };
    let cases = [
        ("the light shines along the view", camera, sun_along),
        (
            "the light shines against the view",
            camera,
            Light::Directional { direction: -camera.forward(), half_angle: 0.01 },
        ),
        ("the sun is in the zenith", camera, Light::Directional { direction: DVec3::NEG_Y, half_angle: 0.0 }),
        ("the lamp is in the view and shines at the camera", camera, spot(DVec3::ZERO, camera.eye)),
        ("the lamp is in the view and shines away", camera, spot(DVec3::ZERO, camera.forward())),
        ("the lamp is in the camera", camera, spot(camera.eye, camera.forward())),
        ("the camera is in a caster", inside(DVec3::new(1.0, 0.5, 0.0)), sun()),
        ("the camera is in the lamp", inside(DVec3::new(-0.5, 4.0, 0.5)), lamp()),
        ("the far plane is infinite", Camera { far: f64::INFINITY, ..camera }, sun()),
        ("the far plane is infinite under a lamp", Camera { far: f64::INFINITY, ..camera }, lamp()),
    ];
    for (name, camera, light) in cases {
        for fitted in [true, false] {
            let fit = fit(&camera, &room(), &light, fitted).unwrap();
            assert_usable(&fit.unwrap_or_else(|| panic!("{name}")));
        }
    }
}

#[test]
fn degenerate_scenes_and_bulbs_have_usable_faces_or_none() {
    let bulb = |position, reach_world| Light::Point { position, radius_world: 0.1, reach_world };
    let flat = |size: DVec3| Aabb { min: -0.5 * size, max: 0.5 * size };
    let scenes =
        [room(), flat(DVec3::new(2.0, 0.0, 2.0)), flat(DVec3::ZERO), flat(DVec3::splat(1e-9)), flat(DVec3::splat(1e6))];
    for scene in scenes {
        for position in [DVec3::ZERO, observer().eye, DVec3::new(0.0, 0.0, 30.0), DVec3::new(1.0, 1.0, 1.0)] {
            for light in [bulb(position, 1e-6), bulb(position, 5.0), bulb(position, f64::INFINITY)] {
                for (face, fitted) in Face::ALL.into_iter().zip([true, false].into_iter().cycle()) {
                    if let Some(fit) = fit_face(&observer(), &scene, &light, face, fitted).unwrap() {
                        assert_usable(&fit);
                    }
                }
            }
        }
    }
}

#[test]
fn flat_thin_and_one_point_scenes_have_a_usable_map() {
    let flat = |size: DVec3| Aabb { min: -0.5 * size, max: 0.5 * size };
    let scenes = [
        flat(DVec3::new(2.0, 0.0, 2.0)),
        flat(DVec3::new(0.0, 2.0, 2.0)),
        flat(DVec3::new(0.0, 2.0, 0.0)),
        flat(DVec3::ZERO),
        flat(DVec3::splat(1e-9)),
    ];
    let across = Light::Directional { direction: DVec3::X, half_angle: 0.01 };
    let down = Light::Directional { direction: DVec3::NEG_Y, half_angle: 0.01 };
    for scene in scenes {
        for light in [sun(), lamp(), across, down] {
            for fitted in [true, false] {
                let fit = fit(&observer(), &scene, &light, fitted).unwrap();
                assert_usable(&fit.unwrap_or_else(|| panic!("{scene:?} {light:?}")));
            }
        }
    }
}

#[test]
fn a_flat_floor_is_fitted_as_tightly_as_a_thin_one() {
    let floor = |thickness: f64| Aabb { min: DVec3::new(-40.0, -thickness, -40.0), max: DVec3::new(40.0, 0.0, 40.0) };
    for light in [sun(), lamp()] {
        let flat = fit(&observer(), &floor(0.0), &light, true).unwrap().unwrap();
        let thin = fit(&observer(), &floor(1e-9), &light, true).unwrap().unwrap();
        assert!((flat.extent_world - thin.extent_world).abs().max_element() < 1e-6);
    }
}

#[test]
fn a_scene_a_million_metres_away_has_the_same_map() {
    let shift = DVec3::new(1e6, -1e6, 1e6);
    let camera = Camera { eye: observer().eye + shift, target: observer().target + shift, ..observer() };
    let scene = Aabb { min: room().min + shift, max: room().max + shift };
    for light in [sun(), lamp()] {
        let moved = match light {
            Light::Spot { position, direction, cone_half_angle, radius_world } => {
                Light::Spot { position: position + shift, direction, cone_half_angle, radius_world }
            }
            sun => sun,
        };
        let near = fit(&observer(), &room(), &light, true).unwrap().unwrap();
        let far = fit(&camera, &scene, &moved, true).unwrap().unwrap();
        assert!((far.extent_world - near.extent_world).abs().max_element() < 1e-7);
        // Uploaded as f32 relative to a point nearby, it loses nothing that a texel of 1 / 4096 shows.
        let relative = far.clip_from_relative(shift).as_mat4();
        let p = DVec3::new(0.2, 0.1, -0.3);
        let expected = near.clip_from_world().project_point3(p);
        let uploaded = relative.project_point3(p.as_vec3()).as_dvec3();
        assert!((uploaded - expected).abs().max_element() < 1e-5, "{uploaded} {expected}");
    }
}

#[test]
fn nan_is_refused_by_name() {
    let scene = Aabb { min: DVec3::NAN, max: DVec3::ONE };
    assert!(fit(&observer(), &scene, &sun(), true).unwrap_err().to_string().contains("bounds"));
    let camera = Camera { eye: DVec3::new(f64::INFINITY, 0.0, 0.0), ..observer() };
    assert!(fit(&camera, &room(), &sun(), true).unwrap_err().to_string().contains("eye"));
}

/// Place of a point in texels of the lattice, fractional part: what must not change while the observer moves.
fn in_texel(fit: &Fit, texels: [u32; 2], p: DVec3) -> DVec2 {
    let (uv, _) = fit.uv_from_world(p);
    let place = uv * DVec2::new(f64::from(texels[0]), f64::from(texels[1]));
    place - place.round()
}

#[test]
fn a_map_on_the_lattice_holds_its_box_with_less_than_a_texel_more_on_each_side() {
    for fit in [sun_over_room(), lamp_over_room()] {
        for texel in [DVec2::splat(0.011), DVec2::new(0.2, 0.03)] {
            let (on, texels) = fit.on_lattice(texel, 8);
            let count = DVec2::new(f64::from(texels[0]), f64::from(texels[1]));
            assert!((on.extent_world - count * texel).abs().max_element() < 1e-9);
            let (low, high) = (fit.center - 0.5 * fit.extent_world, fit.center + 0.5 * fit.extent_world);
            let (on_low, on_high) = (on.center - 0.5 * on.extent_world, on.center + 0.5 * on.extent_world);
            assert!((on_low - low).cmple(1e-5 * texel).all() && (low - on_low).cmplt(texel).all());
            assert!((high - on_high).cmple(1e-5 * texel).all() && (on_high - high).cmplt(texel).all());
        }
        // A box of fewer texels than the least is filled up around it.
        let (padded, texels) = fit.on_lattice(DVec2::splat(50.0), 8);
        assert_eq!(texels, [8, 8]);
        assert!(((padded.center - fit.center) / 400.0).abs().max_element() < 0.51);
    }
}

#[test]
fn a_box_of_whole_texels_gets_no_more() {
    let (on, texels) = sun_over_room().on_lattice(DVec2::splat(0.01), 8);
    let (again, same) = on.on_lattice(DVec2::splat(0.01), 8);
    assert_eq!(texels, same);
    assert!((on.center - again.center).length() < 1e-9);
}

proptest! {
    #[test]
    fn points_of_the_world_keep_their_place_in_the_texel_while_the_observer_moves(
        shift in prop::array::uniform3(-0.4..0.4_f64),
        turn in -0.3..0.3_f64,
        texel in 0.002..0.1_f64,
        is_sun in any::<bool>(),
    ) {
        let light = if is_sun { sun() } else { lamp() };
        let still = observer();
        let mut moved = still;
        moved.eye += DVec3::from_array(shift);
        moved.target += DVec3::new(turn, 0.0, 0.0);
        let p = DVec3::new(0.3, 0.1, -0.2);
        let of = |camera: &Camera| {
            let (fit, texels) = fit(camera, &room(), &light, true).unwrap().unwrap().on_lattice(DVec2::splat(texel), 8);
            in_texel(&fit, texels, p)
        };
        let difference = of(&still) - of(&moved);
        // At a half, rounding may go either way.
        prop_assert!((difference - difference.round()).length() < 1e-6, "{difference}");
    }
}
