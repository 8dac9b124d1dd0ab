//! Promises of a rendered stimulus' geometry: brute force, places, symmetries.

mod common;

use common::{PATTERNS, draw, draw_codes, largest_difference, stimulus};
use image::GrayImage;
use image::imageops::{flip_horizontal, rotate90, rotate180};
use scumble_stimuli::{Kernel, Pattern, Shape, Stimulus};

/// A stimulus by definition: the hard shadow that nearest sampling of the true line gives, averaged
/// over a dense grid of the disc; the lit part of each pixel.
fn supersampled(what: &Stimulus, width_px: u32, height_px: u32) -> Vec<f64> {
    const SIDE: i32 = 90;
    let texel = what.texel_px;
    let [width, height] = [width_px, height_px].map(f64::from);
    let slope = match what.pattern {
        Pattern::Stair => 1.0,
        Pattern::Step => texel / width,
        Pattern::DoubleStep => 1.0 - texel / width,
    };
    // Where the shadow map's grid lies: columns and rows of texels begin at whole texels from here.
    let (grid_x, grid_y) = match what.pattern {
        Pattern::Stair => (what.phase * texel, (what.phase - 0.5) * texel),
        Pattern::Step => {
            let x = (what.phase - 0.5) * 0.5 * width;
            (x, slope * x - 0.5 * texel)
        }
        Pattern::DoubleStep => {
            let x = (what.phase - 0.5) * 0.5 * width.min(height);
            (x, slope * x)
        }
    };
    let centre = |place: f64, grid: f64| texel * (((place - grid) / texel).floor() + 0.5) + grid;
    let in_shadow = |x: f64, y: f64| match what.shape {
        Shape::Line => y < slope * x,
        // The line moves with the steps, along itself.
        Shape::Artifact => centre(y, grid_y) < slope * centre(x, grid_x),
    };
    let (sin, cos) = what.tilt_rad.sin_cos();
    let pixel = |column: u32, row: u32| {
        let (x, y) = (f64::from(column) + 0.5 - 0.5 * width, 0.5 * height - f64::from(row) - 0.5);
        let (x, y) = (x * cos + y * sin, y * cos - x * sin);
        let x = if what.mirrored { -x } else { x };
        let (mut inside, mut dark) = (0.0, 0.0);
        for (i, j) in (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (i, j))) {
            let [u, v] = [i, j].map(|k| (2.0 * f64::from(k) + 1.0) / f64::from(SIDE) - 1.0);
            if u * u + v * v < 1.0 {
                inside += 1.0;
                dark += f64::from(u8::from(in_shadow(x + what.radius_px * u, y + what.radius_px * v)));
            }
        }
        what.contrast * if what.inverted { dark / inside } else { 1.0 - dark / inside }
    };
    (0..height_px).flat_map(|row| (0..width_px).map(move |column| (column, row))).map(|(c, r)| pixel(c, r)).collect()
}

/// Largest difference of a picture in code values from the lit part expected.
fn largest_miss(picture: &GrayImage, expected: &[f64]) -> f64 {
    assert_eq!(picture.as_raw().len(), expected.len());
    let miss = |(level, lit): (&u8, &f64)| (f64::from(*level) / 255.0 - lit).abs();
    picture.iter().zip(expected).map(miss).fold(0.0, f64::max)
}

#[test]
fn a_picture_agrees_with_a_supersampled_one() {
    for pattern in PATTERNS {
        for shape in [Shape::Artifact, Shape::Line] {
            for (tilt_rad, mirrored, inverted) in
                [(0.0, false, false), (0.0, true, true), (0.4, false, true), (-2.0, true, false)]
            {
                let plain = stimulus(pattern, shape);
                let what =
                    Stimulus { texel_px: 5.0, radius_px: 8.0, contrast: 0.8, tilt_rad, mirrored, inverted, ..plain };
                let miss = largest_miss(&draw_codes(&what, 26, 20), &supersampled(&what, 26, 20));
                // Half a level is 0.002; the grid's own error a few of its 6400 samples' rows.
                assert!(miss < 0.012, "{what:?}: {miss}");
            }
        }
    }
}

#[test]
fn the_supersampled_picture_tells_an_artifact_from_its_line_and_from_itself_tilted() {
    for pattern in PATTERNS {
        let artifact = Stimulus { texel_px: 5.0, radius_px: 2.5, ..stimulus(pattern, Shape::Artifact) };
        let sampled = supersampled(&artifact, 26, 20);
        for other in [Stimulus { shape: Shape::Line, ..artifact }, Stimulus { tilt_rad: 0.035, ..artifact }] {
            let miss = largest_miss(&draw_codes(&other, 26, 20), &sampled);
            assert!(miss > 0.05, "{other:?}: {miss}");
        }
    }
}

#[test]
fn a_mirrored_picture_is_the_flipped_one_for_every_kernel() {
    for pattern in PATTERNS {
        for (_, kernel) in Kernel::NAMED {
            for tilt_rad in [0.0, 0.2] {
                let plain = Stimulus { kernel, tilt_rad, ..stimulus(pattern, Shape::Artifact) };
                let mirrored = Stimulus { mirrored: true, tilt_rad: -tilt_rad, ..plain };
                assert_eq!(draw(&mirrored, 61, 40), flip_horizontal(&draw(&plain, 61, 40)), "{plain:?}");
            }
        }
    }
}

#[test]
fn light_of_a_picture_and_its_inverse_add_up() {
    for pattern in PATTERNS {
        let plain = stimulus(pattern, Shape::Artifact);
        let (picture, inverted) =
            (draw_codes(&plain, 60, 60), draw_codes(&Stimulus { inverted: true, ..plain }, 60, 60));
        // Both round half up.
        assert!(
            picture.iter().zip(inverted.iter()).all(|(a, b)| [255, 256].contains(&(u32::from(*a) + u32::from(*b))))
        );
    }
}

#[test]
fn a_tilt_turns_the_picture_counter_clockwise() {
    for pattern in PATTERNS {
        for shape in [Shape::Artifact, Shape::Line] {
            for kernel in [Kernel::Disc, Kernel::Box, Kernel::Poisson25] {
                let plain = Stimulus { kernel, ..stimulus(pattern, shape) };
                let picture = draw_codes(&plain, 61, 61);
                let tilted = |turns: f64| {
                    let tilt_rad = turns * std::f64::consts::PI;
                    draw_codes(&Stimulus { tilt_rad, ..plain }, 61, 61)
                };
                // One level where rounding of the sines meets rounding to a level.
                let clockwise = |quarters: &GrayImage| largest_difference(&picture, quarters);
                assert!(clockwise(&rotate90(&tilted(0.5))) <= 1, "{plain:?}");
                assert!(clockwise(&rotate180(&tilted(-1.0))) <= 1, "{plain:?}");
                assert!(clockwise(&tilted(0.5)) > 20, "{plain:?}");
            }
        }
    }
}

#[test]
fn a_whole_period_of_phase_leaves_the_stair_and_no_phase_moves_a_line() {
    let at = |pattern, shape, phase| draw(&Stimulus { phase, ..stimulus(pattern, shape) }, 60, 60);
    let stair = |phase| at(Pattern::Stair, Shape::Artifact, phase);
    assert_eq!(largest_difference(&stair(0.0), &stair(1.0)), 0);
    for pattern in PATTERNS {
        assert!(largest_difference(&at(pattern, Shape::Artifact, 0.0), &at(pattern, Shape::Artifact, 0.5)) > 10);
        assert_eq!(at(pattern, Shape::Line, 0.0), at(pattern, Shape::Line, 0.5));
    }
}

/// Row in which the shadow of a hard picture begins, column by column.
fn tops(what: &Stimulus, width_px: u32, height_px: u32) -> Vec<u32> {
    let picture = draw(&Stimulus { radius_px: 0.0, ..*what }, width_px, height_px);
    let top = |column| (0..height_px).find(|&row| picture.get_pixel(column, row).0 == [0]).unwrap_or(height_px);
    (0..width_px).map(top).collect()
}

#[test]
fn a_step_keeps_a_quarter_of_the_width_from_the_border() {
    for (phase, expected) in [(0.0, 150), (0.5, 300), (1.0, 450)] {
        let tops = tops(&Stimulus { phase, ..stimulus(Pattern::Step, Shape::Artifact) }, 600, 200);
        let rises: Vec<usize> = (1..600).filter(|&column| tops[column] != tops[column - 1]).collect();
        assert_eq!(rises, [expected], "phase {phase}");
        assert_eq!(tops[expected - 1] - tops[expected], 10, "one texel high");
    }
}

#[test]
fn a_double_step_is_a_stair_with_one_tread_of_two_texels_inside_the_middle_half() {
    for (phase, middle) in [(0.0, 150), (0.5, 300), (1.0, 450)] {
        let tops = tops(&Stimulus { phase, ..stimulus(Pattern::DoubleStep, Shape::Artifact) }, 600, 600);
        let rises: Vec<usize> = (1..600).filter(|&column| tops[column] != tops[column - 1]).collect();
        assert!(rises.iter().all(|&column| tops[column - 1] - tops[column] == 10), "one texel high");
        let wide: Vec<&[usize]> = rises.windows(2).filter(|pair| pair[1] - pair[0] != 10).collect();
        assert_eq!(wide, [[middle - 10, middle + 10]], "phase {phase}");
    }
}

#[test]
fn the_line_of_a_step_rises_by_one_texel_over_the_width_and_that_of_a_double_step_by_all_but_one() {
    for (pattern, rise) in [(Pattern::Step, 10), (Pattern::DoubleStep, 590)] {
        let tops = tops(&stimulus(pattern, Shape::Line), 600, 600);
        assert!((tops[0] - tops[599]).abs_diff(rise) <= 1, "{pattern:?}: {} to {}", tops[0], tops[599]);
        assert_eq!(tops[0] + tops[599], 600, "through the centre");
    }
}
