//! Promises of a rendered stimulus: brute force, levels, symmetry, phase, determinism, refusals.

use image::GrayImage;
use scumble_stimuli::{Encoding, Error, Kernel, Pattern, Shape, Silhouette, Stimulus, Transfer};

const PATTERNS: [Pattern; 3] = [Pattern::Stair, Pattern::Step, Pattern::DoubleStep];

/// The picture on an sRGB display.
fn draw(what: &Stimulus, width_px: u32, height_px: u32) -> GrayImage {
    what.render(width_px, height_px, &Transfer::srgb()).expect("a valid stimulus")
}

/// Light of a level of an sRGB display.
fn light(level: u8) -> f64 {
    Transfer::srgb().light(level)
}

fn stimulus(pattern: Pattern, shape: Shape) -> Stimulus {
    Stimulus {
        pattern,
        shape,
        kernel: Kernel::Disc,
        texel_px: 10.0,
        radius_px: 15.0,
        contrast: 1.0,
        encoding: Encoding::LinearLight,
        phase: 0.3,
        mirrored: false,
        inverted: false,
        tilt_rad: 0.0,
        dither_seed: None,
    }
}

/// Largest difference of a picture's light from the light expected.
fn largest_light_difference(picture: &GrayImage, expected: &[f64]) -> f64 {
    assert_eq!(picture.as_raw().len(), expected.len());
    picture.iter().zip(expected).map(|(level, expected)| (light(*level) - expected).abs()).fold(0.0, f64::max)
}

fn largest_difference(a: &GrayImage, b: &GrayImage) -> u8 {
    assert_eq!(a.dimensions(), b.dimensions());
    a.iter().zip(b.iter()).map(|(x, y)| x.abs_diff(*y)).max().unwrap_or(0)
}

/// A stimulus by definition: the hard shadow, averaged over a dense grid of the disc.
fn supersampled(what: &Stimulus, width_px: u32, height_px: u32) -> Vec<f64> {
    const SIDE: i32 = 120;
    let texel = what.texel_px;
    let slope = match what.pattern {
        Pattern::Stair => 1.0,
        Pattern::Step => texel / f64::from(width_px),
        Pattern::DoubleStep => 1.0 - texel / f64::from(width_px),
    };
    let in_shadow = |x: f64, y: f64| match (what.shape, what.pattern) {
        (Shape::Line, _) => y < slope * x,
        (Shape::Artifact, Pattern::Stair) => {
            let shift = what.phase * texel;
            y - shift < texel * (((x - shift) / texel).floor() + 0.5)
        }
        (Shape::Artifact, Pattern::Step) => {
            let step_px = (what.phase - 0.5) * 0.5 * f64::from(width_px);
            y < slope * step_px + if x < step_px { -0.5 * texel } else { 0.5 * texel }
        }
        (Shape::Artifact, Pattern::DoubleStep) => {
            // The nearest texel centre, and whether the true line is above it.
            let tread_px = (what.phase - 0.5) * 0.5 * f64::from(width_px.min(height_px));
            let centre = |place: f64| texel * ((place / texel).floor() + 0.5);
            centre(y - slope * tread_px) < slope * centre(x - tread_px)
        }
    };
    let pixel = |column: u32, row: u32| {
        let x = f64::from(column) + 0.5 - 0.5 * f64::from(width_px);
        let y = 0.5 * f64::from(height_px) - f64::from(row) - 0.5;
        let (mut inside, mut dark) = (0.0, 0.0);
        for (i, j) in (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (i, j))) {
            let [u, v] = [i, j].map(|k| (2.0 * f64::from(k) + 1.0) / f64::from(SIDE) - 1.0);
            if u * u + v * v < 1.0 {
                inside += 1.0;
                dark += f64::from(u8::from(in_shadow(x + what.radius_px * u, y + what.radius_px * v)));
            }
        }
        what.contrast * (1.0 - dark / inside)
    };
    (0..height_px).flat_map(|row| (0..width_px).map(move |column| (column, row))).map(|(c, r)| pixel(c, r)).collect()
}

#[test]
fn a_picture_agrees_with_a_supersampled_one() {
    for pattern in PATTERNS {
        for shape in [Shape::Artifact, Shape::Line] {
            let what = stimulus(pattern, shape);
            let worst = largest_light_difference(&draw(&what, 48, 32), &supersampled(&what, 48, 32));
            assert!(worst < 0.012, "{pattern:?} {shape:?}: {worst}");
        }
    }
}

#[test]
fn the_supersampled_picture_tells_a_stair_from_a_line() {
    for pattern in PATTERNS {
        let mut what = stimulus(pattern, Shape::Artifact);
        what.radius_px = 5.0;
        let sampled = supersampled(&what, 48, 32);
        what.shape = Shape::Line;
        let worst = largest_light_difference(&draw(&what, 48, 32), &sampled);
        assert!(worst > 0.1, "{pattern:?}: {worst}");
    }
}

#[test]
fn half_contrast_halves_the_light_of_the_lit_side_and_keeps_the_shadow_black() {
    for (contrast, lit) in [(1.0, 255), (0.5, 188)] {
        let what = Stimulus { contrast, ..stimulus(Pattern::Stair, Shape::Line) };
        let picture = draw(&what, 200, 200);
        assert_eq!(picture.get_pixel(0, 0).0, [lit]);
        assert_eq!(picture.get_pixel(199, 199).0, [0]);
    }
}

#[test]
fn mirrored_and_inverted_do_what_they_say() {
    for pattern in PATTERNS {
        let plain = stimulus(pattern, Shape::Artifact);
        let picture = draw(&plain, 60, 60);
        let mirrored = draw(&Stimulus { mirrored: true, ..plain }, 60, 60);
        assert_eq!(mirrored, image::imageops::flip_horizontal(&picture));
        let inverted = draw(&Stimulus { inverted: true, ..plain }, 60, 60);
        for (x, y) in picture.iter().zip(inverted.iter()) {
            let [x, y] = [light(*x), light(*y)];
            // Half a level of sRGB is up to 0.0045 of light.
            assert!((x + y - 1.0).abs() < 0.009, "{x} + {y}");
        }
    }
}

#[test]
fn a_whole_period_of_phase_leaves_the_stair_and_no_phase_moves_a_line() {
    let at = |shape, phase| draw(&Stimulus { phase, ..stimulus(Pattern::Stair, shape) }, 60, 60);
    assert_eq!(largest_difference(&at(Shape::Artifact, 0.0), &at(Shape::Artifact, 1.0)), 0);
    assert!(largest_difference(&at(Shape::Artifact, 0.0), &at(Shape::Artifact, 0.5)) > 10);
    assert_eq!(at(Shape::Line, 0.0), at(Shape::Line, 0.5));
}

#[test]
fn a_step_keeps_a_quarter_of_the_width_from_the_border() {
    for (phase, expected) in [(0.0, 150), (0.5, 300), (1.0, 450)] {
        let what = Stimulus { phase, radius_px: 0.0, ..stimulus(Pattern::Step, Shape::Artifact) };
        let picture = draw(&what, 600, 200);
        let edge_row = |column| (0..200).find(|&row| picture.get_pixel(column, row).0 == [0]).unwrap();
        let step = (1..600).find(|&column| edge_row(column) != edge_row(column - 1)).unwrap();
        assert_eq!(step, expected, "phase {phase}");
        assert_eq!(edge_row(step - 1) - edge_row(step), 10, "one texel high");
    }
}

#[test]
fn the_line_of_a_step_rises_by_one_texel_over_the_width() {
    let what = Stimulus { radius_px: 0.0, ..stimulus(Pattern::Step, Shape::Line) };
    let picture = draw(&what, 600, 100);
    let dark = |column| (0..100).filter(|&row| picture.get_pixel(column, row).0 == [0]).count();
    assert_eq!((dark(0), dark(599)), (45, 55));
}

#[test]
fn equal_stimuli_give_equal_bytes_and_another_seed_gives_other_noise() {
    let seeded = |seed| {
        let what = Stimulus { dither_seed: Some(seed), ..stimulus(Pattern::Step, Shape::Artifact) };
        draw(&what, 120, 80)
    };
    assert_eq!(seeded(7), seeded(7));
    assert_ne!(seeded(7), seeded(8));
}

#[test]
fn dithering_moves_no_pixel_by_more_than_a_level_and_has_the_exact_mean() {
    let plain = stimulus(Pattern::Stair, Shape::Line);
    let rounded = draw(&plain, 200, 200);
    let dithered = draw(&Stimulus { dither_seed: Some(1), ..plain }, 200, 200);
    assert_eq!(largest_difference(&rounded, &dithered), 1);
    assert_eq!(dithered.get_pixel(0, 0).0, [255], "an exact level stays itself");

    let (mut expected, mut found) = (0.0, 0.0);
    for (column, row, level) in dithered.enumerate_pixels() {
        let (x, y) = (f64::from(column) - 99.5, 99.5 - f64::from(row));
        let shadow = Silhouette::Line { slope: 1.0 }.coverage(Kernel::Disc, 1.5, x / 10.0, y / 10.0);
        expected += (1.0 - shadow) / 40_000.0;
        found += light(level.0[0]) / 40_000.0;
    }
    // Some 8,000 partly lit pixels, each with a variance of at most a quarter of a level's light,
    // 0.0087, squared: standard error 1.0e-5.
    assert!((expected - found).abs() < 4e-5, "{found} against {expected}");
}

#[test]
fn numbers_out_of_range_are_refused_by_name() {
    let good = stimulus(Pattern::Stair, Shape::Line);
    let bad = [
        ("texel_px", Stimulus { texel_px: 0.0, ..good }),
        ("texel_px", Stimulus { texel_px: f64::NAN, ..good }),
        ("radius_px", Stimulus { radius_px: -1.0, ..good }),
        ("radius_px", Stimulus { radius_px: f64::INFINITY, ..good }),
        ("contrast", Stimulus { contrast: 1.5, ..good }),
        ("phase", Stimulus { phase: -0.1, ..good }),
        ("tilt_rad", Stimulus { tilt_rad: 3.2, ..good }),
    ];
    for (name, what) in bad {
        let error = what.render(10, 10, &Transfer::srgb()).unwrap_err();
        assert!(matches!(error, Error::Field { field, .. } if field == name), "{error}");
        assert!(error.to_string().contains("allowed is"), "{error}");
    }
    assert!(matches!(good.render(0, 10, &Transfer::srgb()), Err(Error::Size { .. })));
    assert!(matches!(good.render(10, 20_000, &Transfer::srgb()), Err(Error::Size { .. })));
}
