//! Where the demand pass found all corners of a block of pixels lit or dark, one lookup stands for the filter, and the
//! picture is the filter's.

mod common;

use common::casters::cuboid;
use common::rig::{Point, Rig, fixed, ground_and, ground_points, slab, sun_above};
use glam::Vec3;
use scumble::{Filter, Light, Options, Settings};

const LIT: f32 = 1.0;
const UMBRA: f32 = 2.0;
const MIXED: f32 = 3.0;

/// Pixels a side of the prepass: the 8 m of ground below `camera_above`.
const SIDE: u32 = 96;

fn rig(filter: Filter, casters: Vec<Vec3>) -> Rig {
    let options = Options { measure_stride: 4, ..fixed(filter, 512) };
    Rig::new(Settings { cap: 512, ..Settings::default() }, options, &ground_and(casters))
}

/// What the pixels' blocks are.
fn kinds(rig: &Rig) -> Vec<f32> {
    let results = rig.evaluate("result.x = f32(shadow_block(0u, vec2u(row.c.xy)));", &ground_points(SIDE));
    results.into_iter().map(|result| result[0]).collect()
}

/// Visibility of all points without and with what the demand pass found, and the kinds of the blocks.
fn without_and_with(rig: &mut Rig, light: Light) -> (Vec<f32>, Vec<f32>, Vec<f32>) {
    rig.draw(&[light]);
    let without = rig.visibility(&ground_points(SIDE));
    rig.draw_and_measure(&[light], SIDE);
    (without, rig.visibility(&ground_points(SIDE)), kinds(rig))
}

fn share(kinds: &[f32], kind: f32) -> f64 {
    kinds.iter().filter(|&&found| found == kind).count() as f64 / kinds.len() as f64
}

#[test]
fn lit_and_dark_blocks_pay_one_lookup_and_the_picture_is_the_filters() {
    for filter in [Filter::Pcf { radius_world: 0.3 }, Filter::Pcss] {
        let mut rig = rig(filter, slab(2.0, 0.3));
        let (without, with, kinds) = without_and_with(&mut rig, sun_above(0.15));
        // The penumbra is 0.6 m of 8; the filter's noise leaves no corner in it lit.
        assert!(share(&kinds, LIT) > 0.3 && share(&kinds, MIXED) < 0.25, "{filter:?}: {}", share(&kinds, MIXED));
        for ((without, with), kind) in without.iter().zip(&with).zip(&kinds) {
            assert!((without - with).abs() < 1e-6 || (*kind == LIT && (without - with).abs() < 0.05), "{filter:?}");
        }
    }
}

#[test]
fn the_umbra_is_found_dark() {
    // A roof over everything but a border, seen from below it.
    let mut rig = rig(Filter::Pcss, cuboid(Vec3::new(-3.0, 2.0, -3.0), Vec3::new(3.0, 2.1, 3.0)));
    rig.camera.eye.y = 1.9;
    rig.camera.near = 0.1;
    rig.draw_and_measure(&[sun_above(0.1)], SIDE);
    assert_eq!(share(&kinds(&rig), UMBRA), 1.0);
}

#[test]
fn what_no_corner_has_seen_is_filtered_where_the_lookup_meets_it() {
    // A ribbon of one pixel between two columns of corners, 1 m up under a small sun: its umbra is half as wide.
    let pixel = 8.0 / SIDE as f32;
    let x = (50.0 - SIDE as f32 / 2.0) * pixel;
    let ribbon = cuboid(Vec3::new(x, 1.0, -4.0), Vec3::new(x + pixel, 1.01, 4.0));
    let mut rig = rig(Filter::Pcss, ribbon);
    let (without, with, kinds) = without_and_with(&mut rig, sun_above(0.01));
    let dark: Vec<usize> = (0..without.len()).filter(|&i| without[i] < 0.5).collect();
    assert!(!dark.is_empty() && dark.iter().any(|&i| kinds[i] == LIT), "the ribbon is between lit corners");
    for i in dark {
        assert_eq!(with[i], without[i]);
    }
}

#[test]
fn blocks_hold_for_the_plan_they_were_found_under() {
    let mut rig = rig(Filter::Pcss, slab(2.0, 0.0));
    let light = sun_above(0.1);
    let is_used = |rig: &Rig| kinds(rig).iter().any(|&kind| kind != MIXED);
    rig.draw(&[light]);
    assert!(!is_used(&rig), "nothing is measured yet");
    rig.draw_and_measure(&[light], SIDE);
    assert!(is_used(&rig));
    rig.draw(&[light]);
    assert!(!is_used(&rig), "the next plan has other maps");
}

#[test]
fn prepasses_of_any_size_and_stride_have_blocks() {
    let light = sun_above(0.1);
    for (stride, side) in [(1, 1), (4, 1), (4, 5), (7, 33), (64, 32)] {
        let options = Options { measure_stride: stride, ..fixed(Filter::Pcss, 64) };
        let mut rig = Rig::new(Settings { cap: 64, ..Settings::default() }, options, &ground_and(slab(2.0, 0.0)));
        rig.draw_and_measure(&[light], side);
        let points: Vec<Point> =
            ground_points(SIDE).into_iter().filter(|p| p.pixel.iter().all(|&i| i < side)).collect();
        assert!(rig.visibility(&points).iter().all(|v| (0.0..=1.0).contains(v)), "{stride} {side}");
    }
}
