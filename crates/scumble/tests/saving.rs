//! Only what the screen requires is drawn and filtered, and what was saved is counted.

mod common;

use common::rig::{Point, Rig, fixed, ground_and, slab, sun_above};
use glam::{DVec3, Vec3};
use scumble::{BlockCounts, Filter, Light, Options, Settings};

fn settings(cap: u32) -> Settings {
    Settings { cap, ..Settings::default() }
}

/// A lamp beside the ground that shines away from it.
fn lamp_elsewhere() -> Light {
    Light::Spot { position: DVec3::new(20.0, 3.0, 0.0), direction: DVec3::X, cone_half_angle: 0.5, radius_world: 0.1 }
}

fn ground_point() -> Point {
    Point { position: Vec3::new(-2.0, 0.0, 0.5), normal: Vec3::Y, pixel: [3, 5] }
}

#[test]
fn a_light_without_receivers_on_screen_has_no_map_and_no_pass_and_leaves_all_lit() {
    let options = Options { maps: 2, ..fixed(Filter::Pcss, 64) };
    let mut rig = Rig::new(settings(64), options, &ground_and(slab(2.0, 0.0)));
    let plan = rig.draw_and_measure(&[lamp_elsewhere(), sun_above(0.1)], 32);
    assert_eq!((plan.views().len(), plan.maps_skipped(), plan.texels()), (1, 1, 64 * 64));
    let counters = rig.shadows.counters();
    assert_eq!((counters.map_passes, counters.maps_skipped), (1, 1));
    assert_eq!(rig.visibility(&[ground_point()]), [1.0]);
    let second = rig.evaluate("result.x = shadow_visibility(1u, row.a.xyz, row.b.xyz, row.c.xy);", &[ground_point()]);
    assert_eq!(second[0][0], 0.0);
}

/// A camera that sees the ground, and a slab that shadows some of it only when the sun slants.
fn rig_under_a_slab_aside() -> Rig {
    let aside = common::casters::cuboid(Vec3::new(4.5, 0.5, -1.0), Vec3::new(5.0, 4.0, 1.0));
    Rig::new(settings(1024), Options::default(), &ground_and(aside))
}

/// The camera of the rig sees x below 4 m: the shadow of the slab falls to its right, or with a sun from there to its left.
fn sun_from(x: f64) -> Light {
    Light::Directional { direction: DVec3::new(-x, -1.0, 0.0), half_angle: 0.02 }
}

#[test]
fn a_map_that_nobody_is_shadowed_by_rests_and_is_back_with_the_first_shadow() {
    let mut rig = rig_under_a_slab_aside();
    let (outside, inside) = (sun_from(-1.0), sun_from(1.0));
    let whole = rig.draw_and_measure(&[outside], 96);
    assert!(!whole.views()[0].is_resting && whole.views()[0].size_texels[0] > 512);
    let sides: Vec<u32> = (0..40).map(|_| rig.draw_and_measure(&[outside], 96).views()[0].size_texels[0]).collect();
    assert!(sides[..29].iter().all(|&side| side == whole.views()[0].size_texels[0]), "{sides:?}");
    assert!(sides[29..].iter().all(|&side| side == sides[39] && side <= 256), "{sides:?}");
    assert_eq!(rig.shadows.counters().maps_resting, 1);

    // The picture in which the shadow appears is drawn with the small map, the next with a map for what it shows.
    let first = rig.draw_and_measure(&[inside], 96);
    assert!(first.views()[0].is_resting && first.views()[0].radius_min_world > 0.0);
    let next = rig.draw_and_measure(&[inside], 96);
    assert!(!next.views()[0].is_resting && rig.shadows.counters().maps_resting == 0);
    assert_eq!(next.views()[0].texel_world(), whole.views()[0].texel_world());
}

#[test]
fn a_screen_in_the_dark_does_not_rest() {
    let roof = slab(3.0, 0.0).into_iter().chain(slab(3.0, std::f32::consts::PI)).collect();
    let mut rig = Rig::new(settings(512), Options::default(), &ground_and(roof));
    rig.camera.eye.y = 2.5;
    let first = rig.draw_and_measure(&[sun_above(0.1)], 32).views()[0].size_texels;
    for _ in 0..40 {
        assert_eq!(rig.draw_and_measure(&[sun_above(0.1)], 32).views()[0].size_texels, first);
    }
}

#[test]
fn a_measured_map_that_is_not_measured_any_more_does_not_begin_to_rest() {
    let mut rig = rig_under_a_slab_aside();
    let whole = rig.draw_and_measure(&[sun_from(-1.0)], 96);
    for _ in 0..40 {
        assert_eq!(rig.draw(&[sun_from(-1.0)]).views()[0].size_texels, whole.views()[0].size_texels);
    }
}

/// What the picture's blocks are, asked where shading asks.
fn blocks_of_picture(rig: &Rig, side: u32, stride: u32) -> BlockCounts {
    let per_side = side.div_ceil(stride);
    let points: Vec<Point> = (0..per_side * per_side)
        .map(|i| Point { pixel: [i % per_side * stride, i / per_side * stride], ..ground_point() })
        .collect();
    let kinds = rig.evaluate("result.x = f32(shadow_block(0u, vec2u(row.c.xy)));", &points);
    let count = |kind: f32| kinds.iter().filter(|found| found[0] == kind).count() as u32;
    BlockCounts { lit: count(1.0), umbra: count(2.0), mixed: count(3.0) }
}

#[test]
fn blocks_that_skip_and_blocks_that_pay_are_counted_as_shading_reads_them() {
    for (stride, side) in [(4, 96), (4, 97), (7, 33), (1, 20), (64, 32)] {
        let options = Options { measure_stride: stride, ..fixed(Filter::Pcss, 256) };
        let mut rig = Rig::new(settings(256), options, &ground_and(slab(2.0, 0.3)));
        let plan = rig.draw_and_measure(&[sun_above(0.1)], side);
        let found = rig.shadows.measured_blocks(&plan.views()[0]).expect("it was measured");
        assert_eq!(found, blocks_of_picture(&rig, side, stride), "{stride} {side}");
        assert_eq!(found.total(), side.div_ceil(stride).pow(2), "the ground fills the picture");
        if side > 90 {
            assert!(found.lit > 100 && found.mixed > 0 && found.skipped_share() > 0.5, "{found:?}");
        }
    }
}

#[test]
fn blocks_are_counted_by_map() {
    let options = Options { maps: 3, measure_stride: 4, ..fixed(Filter::Pcss, 64) };
    let mut rig = Rig::new(settings(64), options, &ground_and(slab(2.0, 0.3)));
    let lamp = Light::Spot {
        position: DVec3::new(0.0, 6.0, 0.0),
        direction: DVec3::NEG_Y,
        cone_half_angle: 0.9,
        radius_world: 0.2,
    };
    let plan = rig.draw_and_measure(&[sun_above(0.1), lamp_elsewhere(), lamp], 96);
    let of = |view| rig.shadows.measured_blocks(view).expect("it was measured");
    let [sun, lamp] = plan.views() else { panic!("two maps are drawn") };
    assert_eq!((of(sun).total(), of(lamp).total()), (24 * 24, 24 * 24));
    assert_ne!(of(sun), of(lamp));
    assert_eq!((of(sun) + of(lamp)).total(), 2 * 24 * 24);
}
