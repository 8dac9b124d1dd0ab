//! Promises of the renderer's taps: bilinear comparisons of stored texels, as a shadow map's filter makes them.

mod common;

use std::sync::LazyLock;

use common::{PATTERNS, draw_codes, stimulus};
use scumble_core::{Taps, rotation_angle};
use scumble_stimuli::{Kernel, Pattern, Shape, Silhouette, Stimulus};

/// The taps that the drop-in filters with.
static TAPS: LazyLock<Taps> = LazyLock::new(Taps::default);

/// What a map stores of the pattern's line, 1 dark: nearest sampling at the texel's centre. Texels
/// begin at `grid_y` and whole texels from it.
fn texel(pattern: Pattern, column: f64, row: f64) -> f64 {
    // The line passes between the centres, so any slope that gives the pattern near the origin will do.
    let slope = match pattern {
        Pattern::Stair => 1.0,
        Pattern::Step => 1.0 / 100.0,
        Pattern::DoubleStep => 1.0 - 1.0 / 100.0,
    };
    f64::from(u8::from(row + 0.5 + grid_y(pattern) < slope * (column + 0.5)))
}

fn grid_y(pattern: Pattern) -> f64 {
    if pattern == Pattern::DoubleStep { 0.0 } else { -0.5 }
}

/// The comparison at a point, in texels from the silhouette's origin: four texels, bilinearly.
fn bilinear(pattern: Pattern, x: f64, y: f64) -> f64 {
    let (x, y) = (x - 0.5, y - 0.5 - grid_y(pattern));
    let (column, row) = (x.floor(), y.floor());
    let (right, upper) = (x - column, y - row);
    let of_row = |row: f64| texel(pattern, column, row) * (1.0 - right) + texel(pattern, column + 1.0, row) * right;
    of_row(row) * (1.0 - upper) + of_row(row + 1.0) * upper
}

/// The renderer's filter at a point: its taps in the disc of a radius, turned.
fn tapped(pattern: Pattern, ratio: f64, turn: f64, x: f64, y: f64) -> f64 {
    let (sin, cos) = turn.sin_cos();
    let taps = &TAPS.filter;
    let tap = |(u, v): (f64, f64)| bilinear(pattern, x + ratio * (cos * u - sin * v), y + ratio * (sin * u + cos * v));
    taps.iter().map(|at| tap((at.x, at.y))).sum::<f64>() / taps.len() as f64
}

fn silhouette(pattern: Pattern) -> Silhouette {
    match pattern {
        Pattern::Stair => Silhouette::Stair,
        Pattern::Step => Silhouette::Step,
        Pattern::DoubleStep => Silhouette::DoubleStep,
    }
}

#[test]
fn the_closed_form_is_the_renderers_filter_over_stored_texels() {
    for pattern in PATTERNS {
        for (index, ratio) in [0.0, 0.3, 1.0, 3.47, 8.0].into_iter().enumerate() {
            for step in 0..400 {
                // Places all over the edge and beside it (R2 sequence).
                let step = f64::from(step) + index as f64 / 7.0;
                let along = 20.0 * (step * 0.754_877_666).fract() - 10.0;
                let across = (2.0 * ratio + 3.0) * ((step * 0.569_840_291).fract() - 0.5);
                let rise = if pattern == Pattern::Step { 0.0 } else { along };
                let (x, y) = (along + across, rise - across);
                let found = silhouette(pattern).coverage(Kernel::Poisson25, ratio, x, y);
                let expected = tapped(pattern, ratio, 0.0, x, y);
                assert!((found - expected).abs() < 1e-12, "{pattern:?} {ratio} {x} {y}: {found} against {expected}");
            }
        }
    }
}

#[test]
fn the_stored_texels_tell_a_double_step_from_a_stair() {
    let found = silhouette(Pattern::Stair).coverage(Kernel::Poisson25, 1.0, 0.2, 0.1);
    assert!((found - tapped(Pattern::DoubleStep, 1.0, 0.0, 0.2, 0.1)).abs() > 1e-3);
}

#[test]
fn turned_taps_turn_by_the_hash_of_their_pixel() {
    let side_px = 64;
    let what = Stimulus {
        kernel: Kernel::Poisson25Rotated,
        radius_px: 20.0,
        phase: 0.0,
        ..stimulus(Pattern::Stair, Shape::Artifact)
    };
    for (column, row, level) in draw_codes(&what, side_px, side_px).enumerate_pixels() {
        let place = |index: u32| (f64::from(index) + 0.5 - 0.5 * f64::from(side_px)) / what.texel_px;
        let turn = rotation_angle([column, row]);
        let lit = 1.0 - tapped(Pattern::Stair, 2.0, turn, place(column), -place(row));
        assert!((f64::from(level.0[0]) - 255.0 * lit).abs() < 0.5 + 1e-6, "{column}, {row}");
    }
}

#[test]
fn over_all_turns_the_taps_of_a_line_and_of_a_stair_come_near_the_disc() {
    // Twenty-five rings of squares: the disc to a few hundredths.
    const TURNS: u32 = 360;
    let turns = || (0..TURNS).map(|turn| f64::from(turn).to_radians());
    let mut largest = 0.0_f64;
    for step in -40..=40 {
        let x = f64::from(step) / 8.0;
        let disc = Silhouette::Stair.coverage(Kernel::Disc, 3.47, x, 0.0);
        let mean = turns().map(|turn| tapped(Pattern::Stair, 3.47, turn, x, 0.0)).sum::<f64>() / f64::from(TURNS);
        largest = largest.max((mean - disc).abs());
    }
    assert!(largest < 0.03, "{largest}");
    let unturned = Silhouette::Stair.coverage(Kernel::Poisson25, 3.47, 1.0, 0.0);
    let disc = Silhouette::Stair.coverage(Kernel::Disc, 3.47, 1.0, 0.0);
    assert!((unturned - disc).abs() > 1e-3, "25 taps are not a disc");
}

#[test]
fn a_line_gets_the_same_taps_and_squares() {
    for slope in [1.0, 0.3] {
        for (x, y) in [(0.1, 0.4), (2.0, -0.7), (-1.3, 0.9)] {
            let line = Silhouette::Line { slope };
            let squares =
                TAPS.filter.iter().map(|tap| line.coverage(Kernel::Box, 0.5, x + 3.47 * tap.x, y + 3.47 * tap.y));
            let expected = squares.sum::<f64>() / 25.0;
            assert!((line.coverage(Kernel::Poisson25, 3.47, x, y) - expected).abs() < 1e-12);
        }
    }
}
