//! What a fit to seen receivers promises: while the camera moves nothing that is on screen is without a map, and what was
//! seen keeps its fine one.

use proptest::prelude::*;

use super::*;
use crate::fit::tests_support::{lamp, sun};

/// A town of streets: its box.
fn town() -> Aabb {
    Aabb { min: DVec3::new(-40.0, 0.0, -40.0), max: DVec3::new(40.0, 15.0, 40.0) }
}

/// A walker who looks along -z, turned by `yaw` radians to the left.
fn walker(eye: DVec3, yaw: f64) -> Camera {
    Camera {
        eye,
        target: eye + DVec3::new(-yaw.sin(), -0.1, -yaw.cos()),
        up: DVec3::Y,
        vertical_fov: 0.9,
        aspect: 1.6,
        near: 0.1,
        far: f64::INFINITY,
    }
}

fn depth(camera: &Camera, p: DVec3) -> f64 {
    (p - camera.eye).dot(camera.forward())
}

fn is_on_screen(camera: &Camera, p: DVec3) -> bool {
    let clip = camera.clip_from_world() * p.extend(1.0);
    clip.truncate().abs().max_element() <= clip.w && clip.z >= 0.0
}

/// What a pass over a picture of these points finds.
fn seen(camera: &Camera, light: &Light, points: impl IntoIterator<Item = DVec3>) -> Seen {
    let mut bands: Vec<SeenBand> = Vec::new();
    for p in points.into_iter().filter(|&p| is_on_screen(camera, p)) {
        let depth = depth(camera, p);
        let band = (0..Seen::BANDS).find(|&band| depth < Seen::band_depths(band).1).unwrap();
        let plane = light.light_from_world().transform_point3(p).truncate();
        match bands.iter_mut().find(|found| found.band == band) {
            Some(found) => (found.min, found.max) = (found.min.min(plane), found.max.max(plane)),
            None => bands.push(SeenBand { band, min: plane, max: plane }),
        }
    }
    Seen { camera: *camera, light: *light, gap: 0.005, bands }
}

/// The map in which a point on screen is looked up, and whether it is the net.
fn map_of<'a>(maps: &'a SeenCascades, camera: &Camera, p: DVec3) -> (Option<&'a Fit>, bool) {
    let slice = maps.slices.iter().find(|slice| depth(camera, p) <= slice.depth_end).unwrap();
    match slice.fit.as_ref().filter(|fit| fit.covers(p)) {
        Some(fit) => (Some(fit), false),
        None => (Some(&maps.net).filter(|net| net.covers(p)), true),
    }
}

fn four() -> Splits {
    Splits { count: 4, ..Splits::default() }
}

/// The ground of the town, a point every half metre.
fn ground() -> Vec<DVec3> {
    (0..160 * 160).map(|i| DVec3::new(f64::from(i % 160) - 79.5, 0.0, f64::from(i / 160) - 79.5) * 0.5).collect()
}

#[test]
fn bands_follow_each_other_two_an_octave_and_are_the_upper_bits_of_a_depth() {
    for band in 1..Seen::BANDS {
        let (near, far) = Seen::band_depths(band);
        assert_eq!(Seen::band_depths(band - 1).1, near);
        assert!(far.is_infinite() || [4.0 / 3.0, 1.5].contains(&(far / near)));
        assert_eq!(((near as f32).to_bits() >> 22) - (0.0625_f32.to_bits() >> 22), band);
    }
    assert_eq!((Seen::band_depths(0).0, Seen::band_depths(0).1), (0.0, 0.09375));
    assert_eq!(Seen::band_depths(Seen::BANDS - 1), (3072.0, f64::INFINITY));
}

#[test]
fn a_fit_to_what_shows_through_an_arch_is_as_wide_as_that() {
    // A square of 16 m, and 40 m ahead a patch of 4 m.
    let camera = walker(DVec3::new(0.0, 1.7, 30.0), 0.0);
    let shown = |p: &DVec3| (p.x.abs() < 8.0 && p.z > 14.0) || (p.x.abs() < 2.0 && p.z < -8.0 && p.z > -12.0);
    let seen = seen(&camera, &sun(), ground().into_iter().filter(shown));
    let maps = seen_cascades(&camera, &town(), &sun(), &four(), &seen, None).unwrap().unwrap();
    let bounds = crate::cascades(&camera, &town(), &sun(), true, &four()).unwrap();
    assert_eq!(maps.slices.len(), 3);
    let area = |fit: &Fit| fit.extent_world.x * fit.extent_world.y;
    let of_seen: f64 = maps.slices.iter().filter_map(|slice| slice.fit.as_ref()).map(area).sum();
    let of_bounds: f64 = bounds.iter().filter_map(|slice| slice.fit.as_ref()).map(area).sum();
    assert!(of_seen < 0.25 * of_bounds, "{of_seen} {of_bounds}");
    let far = maps.slices[2].fit.as_ref().unwrap();
    assert!(far.extent_world.max_element() < 8.0, "{}", far.extent_world);
    assert_eq!(Some(maps.net), fit(&camera, &town(), &sun(), true).unwrap());
}

#[test]
fn a_walker_at_the_speed_of_a_car_who_looks_around_has_the_ground_in_fine_maps_and_nothing_without_a_map() {
    // 15 m/s and half a turn a second, 60 pictures a second, results three pictures late.
    let pose = |frame: f64| {
        let secs = frame / 60.0;
        walker(DVec3::new(3.0 * secs.sin(), 1.7, 30.0 - 15.0 * secs), 0.8 * (4.0 * secs).sin())
    };
    let (mut fine, mut net, mut depths) = (0, 0, None);
    for frame in 3..120 {
        let (then, now) = (pose(f64::from(frame) - 3.0), pose(f64::from(frame)));
        let seen = seen(&then, &sun(), ground());
        let maps = seen_cascades(&now, &town(), &sun(), &four(), &seen, depths).unwrap().unwrap();
        depths = Some(maps.depths);
        for p in ground().into_iter().filter(|&p| is_on_screen(&now, p)) {
            let (map, is_net) = map_of(&maps, &now, p);
            assert!(map.is_some(), "{p} in frame {frame}");
            *(if is_net { &mut net } else { &mut fine }) += 1;
        }
    }
    assert!(fine > 100_000 && net * 1000 < fine, "{net} of {fine}");
}

#[test]
fn what_was_seen_keeps_its_fine_map_when_the_sun_moves() {
    let camera = walker(DVec3::new(0.0, 1.7, 30.0), 0.0);
    let seen = seen(&camera, &sun(), ground());
    let later = Light::Directional { direction: DVec3::new(0.6, -1.0, -0.1), half_angle: 0.05 };
    let maps = seen_cascades(&camera, &town(), &later, &four(), &seen, None).unwrap().unwrap();
    for p in ground().into_iter().filter(|&p| is_on_screen(&camera, p)) {
        assert!(!map_of(&maps, &camera, p).1, "{p}");
    }
}

#[test]
fn a_box_grows_with_the_first_picture_and_shrinks_with_the_third_without() {
    let camera = walker(DVec3::new(0.0, 1.7, 30.0), 0.0);
    let shown = |x: f64| seen(&camera, &sun(), ground().into_iter().filter(move |p| p.x.abs() < x));
    let (narrow, wide) = (shown(4.0), shown(20.0));
    let mut lately = SeenLately::default();
    assert_eq!(lately.together(), None);
    let sorted = |seen: &Seen| {
        let mut bands = seen.bands.clone();
        bands.sort_by_key(|seen| seen.band);
        bands
    };
    for (picture, expected) in
        [(&narrow, &narrow), (&wide, &wide), (&narrow, &wide), (&narrow, &wide), (&narrow, &narrow)]
    {
        lately.add(picture.clone(), 3);
        assert_eq!(lately.together().unwrap().bands, sorted(expected));
    }
    // Under another sun boxes have other axes.
    lately.add(wide, 3);
    let later = Light::Directional { direction: DVec3::new(0.6, -1.0, -0.1), half_angle: 0.05 };
    let under_later = seen(&camera, &later, [DVec3::ZERO]);
    lately.add(under_later.clone(), 3);
    assert_eq!(lately.together(), Some(&under_later));
}

#[test]
fn a_cut_and_pictures_without_a_receiver_leave_the_bounds() {
    let camera = walker(DVec3::new(0.0, 1.7, 30.0), 0.0);
    let seen_here = seen(&camera, &sun(), ground());
    let maps = |camera: &Camera, light: &Light, splits: &Splits, seen: &Seen| {
        seen_cascades(camera, &town(), light, splits, seen, None).unwrap()
    };
    assert!(maps(&camera, &sun(), &four(), &seen_here).is_some());
    assert_eq!(maps(&walker(camera.eye, 1.5), &sun(), &four(), &seen_here), None);
    assert_eq!(maps(&walker(DVec3::new(20.0, 5.0, -20.0), 0.0), &sun(), &four(), &seen_here), None);
    assert_eq!(maps(&camera, &sun(), &four(), &seen(&camera, &sun(), [])), None);
    assert_eq!(maps(&camera, &sun(), &Splits::default(), &seen_here), None);
    assert_eq!(maps(&camera, &lamp(), &four(), &seen_here), None);
    assert_eq!(maps(&camera, &sun(), &four(), &Seen { light: lamp(), ..seen_here.clone() }), None);
    let bulb = Light::Point { position: DVec3::new(0.0, 5.0, 0.0), radius_world: 0.1, reach_world: 30.0 };
    assert_eq!(maps(&camera, &bulb, &four(), &seen_here), None);
    let nan = Seen { camera: Camera { near: f64::NAN, ..camera }, ..seen_here };
    assert!(seen_cascades(&camera, &town(), &sun(), &four(), &nan, None).is_err());
}

#[test]
fn a_still_camera_has_the_same_maps_in_every_picture() {
    let camera = walker(DVec3::new(0.0, 1.7, 30.0), 0.0);
    let seen = seen(&camera, &sun(), ground());
    let maps = || seen_cascades(&camera, &town(), &sun(), &four(), &seen, None).unwrap();
    assert_eq!(maps(), maps());
}

#[test]
fn the_depths_between_which_a_view_is_cut_follow_what_is_seen_step_by_step() {
    let camera = walker(DVec3::new(0.0, 1.7, 30.0), 0.0);
    let shown = |far: f64| seen(&camera, &sun(), ground().into_iter().filter(move |p| p.z > far));
    let cut = |seen: &Seen, last| seen_cascades(&camera, &town(), &sun(), &four(), seen, last).unwrap().unwrap();
    let (all, near) = (shown(-40.0), shown(20.0));
    let mut depths = cut(&all, None).depths;
    let rest = cut(&near, None).depths;
    assert!(rest[1] < 0.5 * depths[1]);
    for _ in 0..200 {
        let next = cut(&near, Some(depths)).depths;
        for (next, last) in next.iter().zip(depths) {
            assert!((next / last - 1.0).abs() < 0.01 + 1e-9, "{next} after {last}");
        }
        depths = next;
    }
    assert_eq!(depths, rest);
    // On the way there nothing that is seen is without its map.
    let slices = cut(&all, Some(rest)).slices;
    assert!(slices[2].depth_end.is_infinite() && slices[2].fit.as_ref().unwrap().extent_world.max_element() > 20.0);
}

proptest! {
    #[test]
    fn what_was_seen_is_in_the_fine_map_of_its_slice_and_everything_else_in_the_net(
        eye in (-30.0..30.0_f64, 0.5..14.0_f64, -30.0..30.0_f64),
        yaw in -3.0..3.0_f64,
        step in (-0.75..0.75_f64, -0.2..0.2_f64, -0.75..0.75_f64),
        turn in -0.1..0.1_f64,
        shares in prop::collection::vec((0.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64), 200),
        direction in (-1.0..1.0_f64, -1.0..-0.1_f64, -1.0..1.0_f64),
        count in 2..=4_u32,
    ) {
        let light = Light::Directional { direction: DVec3::from(direction), half_angle: 0.01 };
        let (then, now) = (walker(DVec3::from(eye), yaw), walker(DVec3::from(eye) + DVec3::from(step), yaw + turn));
        let points: Vec<DVec3> = shares.iter().map(|&share| town().min + town().size() * DVec3::from(share)).collect();
        // Of all points every other one was hidden.
        let shown: Vec<DVec3> = points.iter().copied().step_by(2).collect();
        let seen = seen(&then, &light, shown.iter().copied());
        let splits = Splits { count, ..Splits::default() };
        if let Some(maps) = seen_cascades(&now, &town(), &light, &splits, &seen, None).unwrap() {
            for &p in points.iter().filter(|&&p| is_on_screen(&now, p)) {
                let (map, is_net) = map_of(&maps, &now, p);
                prop_assert!(map.is_some(), "{p} has no map");
                let was_seen = shown.contains(&p) && is_on_screen(&then, p);
                prop_assert!(!(was_seen && is_net), "{p} was seen");
            }
        }
    }
}
