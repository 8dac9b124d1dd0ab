//! Promises of a rendered stimulus: brute force, levels, symmetry, phase, determinism, refusals.

use image::GrayImage;
use scumble_stimuli::{Error, Kernel, Pattern, Shape, Silhouette, Stimulus, linear_from_srgb, srgb_from_linear};

fn stimulus(pattern: Pattern, shape: Shape) -> Stimulus {
    Stimulus {
        pattern,
        shape,
        texel_px: 10.0,
        radius_px: 15.0,
        contrast: 1.0,
        phase: 0.3,
        mirrored: false,
        inverted: false,
        dither_seed: None,
    }
}

fn largest_difference(a: &GrayImage, b: &GrayImage) -> u8 {
    assert_eq!(a.dimensions(), b.dimensions());
    a.iter().zip(b.iter()).map(|(x, y)| x.abs_diff(*y)).max().unwrap_or(0)
}

/// A stimulus by definition: the hard shadow, averaged over a dense grid of the disc.
fn supersampled(what: &Stimulus, width_px: u32, height_px: u32) -> GrayImage {
    const SIDE: i32 = 120;
    let texel = what.texel_px;
    let slope = match what.pattern {
        Pattern::Stair => 1.0,
        Pattern::Step => texel / f64::from(width_px),
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
    };
    GrayImage::from_fn(width_px, height_px, |column, row| {
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
        image::Luma([(255.0 * srgb_from_linear(what.contrast * (1.0 - dark / inside))).round() as u8])
    })
}

#[test]
fn a_picture_agrees_with_a_supersampled_one() {
    for pattern in [Pattern::Stair, Pattern::Step] {
        for shape in [Shape::Artifact, Shape::Line] {
            let what = stimulus(pattern, shape);
            let exact = what.render(48, 32).unwrap();
            let sampled = supersampled(&what, 48, 32);
            // Compared as light: in the darks one sample of 11,000 is several levels of sRGB.
            for (x, y) in exact.iter().zip(sampled.iter()) {
                let [x, y] = [x, y].map(|level| linear_from_srgb(f64::from(*level) / 255.0));
                assert!((x - y).abs() < 0.012, "{pattern:?} {shape:?}: {x} against {y}");
            }
        }
    }
}

#[test]
fn the_supersampled_picture_tells_a_stair_from_a_line() {
    let mut what = stimulus(Pattern::Stair, Shape::Artifact);
    what.radius_px = 5.0;
    let sampled = supersampled(&what, 48, 32);
    what.shape = Shape::Line;
    assert!(largest_difference(&what.render(48, 32).unwrap(), &sampled) > 20);
}

#[test]
fn half_contrast_halves_the_light_of_the_lit_side_and_keeps_the_shadow_black() {
    for (contrast, lit) in [(1.0, 255), (0.5, 188)] {
        let what = Stimulus { contrast, ..stimulus(Pattern::Stair, Shape::Line) };
        let picture = what.render(200, 200).unwrap();
        assert_eq!(picture.get_pixel(0, 0).0, [lit]);
        assert_eq!(picture.get_pixel(199, 199).0, [0]);
    }
}

#[test]
fn mirrored_and_inverted_do_what_they_say() {
    for pattern in [Pattern::Stair, Pattern::Step] {
        let plain = stimulus(pattern, Shape::Artifact);
        let picture = plain.render(60, 60).unwrap();
        let mirrored = Stimulus { mirrored: true, ..plain }.render(60, 60).unwrap();
        assert_eq!(mirrored, image::imageops::flip_horizontal(&picture));
        let inverted = Stimulus { inverted: true, ..plain }.render(60, 60).unwrap();
        for (x, y) in picture.iter().zip(inverted.iter()) {
            let [x, y] = [x, y].map(|level| linear_from_srgb(f64::from(*level) / 255.0));
            // Half a level of sRGB is up to 0.0045 of light.
            assert!((x + y - 1.0).abs() < 0.009, "{x} + {y}");
        }
    }
}

#[test]
fn a_whole_period_of_phase_leaves_the_stair_and_no_phase_moves_a_line() {
    let at = |shape, phase| Stimulus { phase, ..stimulus(Pattern::Stair, shape) }.render(60, 60).unwrap();
    assert_eq!(largest_difference(&at(Shape::Artifact, 0.0), &at(Shape::Artifact, 1.0)), 0);
    assert!(largest_difference(&at(Shape::Artifact, 0.0), &at(Shape::Artifact, 0.5)) > 10);
    assert_eq!(at(Shape::Line, 0.0), at(Shape::Line, 0.5));
}

#[test]
fn a_step_keeps_a_quarter_of_the_width_from_the_border() {
    for (phase, expected) in [(0.0, 150), (0.5, 300), (1.0, 450)] {
        let what = Stimulus { phase, radius_px: 0.0, ..stimulus(Pattern::Step, Shape::Artifact) };
        let picture = what.render(600, 200).unwrap();
        let edge_row = |column| (0..200).find(|&row| picture.get_pixel(column, row).0 == [0]).unwrap();
        let step = (1..600).find(|&column| edge_row(column) != edge_row(column - 1)).unwrap();
        assert_eq!(step, expected, "phase {phase}");
        assert_eq!(edge_row(step - 1) - edge_row(step), 10, "one texel high");
    }
}

#[test]
fn the_line_of_a_step_rises_by_one_texel_over_the_width() {
    let what = Stimulus { radius_px: 0.0, ..stimulus(Pattern::Step, Shape::Line) };
    let picture = what.render(600, 100).unwrap();
    let dark = |column| (0..100).filter(|&row| picture.get_pixel(column, row).0 == [0]).count();
    assert_eq!((dark(0), dark(599)), (45, 55));
}

#[test]
fn equal_stimuli_give_equal_bytes_and_another_seed_gives_other_noise() {
    let seeded = |seed| {
        let what = Stimulus { dither_seed: Some(seed), ..stimulus(Pattern::Step, Shape::Artifact) };
        what.render(120, 80).unwrap()
    };
    assert_eq!(seeded(7), seeded(7));
    assert_ne!(seeded(7), seeded(8));
}

#[test]
fn dithering_moves_no_pixel_by_more_than_a_level_and_has_the_exact_mean() {
    let plain = stimulus(Pattern::Stair, Shape::Line);
    let rounded = plain.render(200, 200).unwrap();
    let dithered = Stimulus { dither_seed: Some(1), ..plain }.render(200, 200).unwrap();
    assert_eq!(largest_difference(&rounded, &dithered), 1);
    assert_eq!(dithered.get_pixel(0, 0).0, [255], "an exact level stays itself");

    let (mut expected, mut found) = (0.0, 0.0);
    for (column, row, level) in dithered.enumerate_pixels() {
        let (x, y) = (f64::from(column) - 99.5, 99.5 - f64::from(row));
        let shadow = Silhouette::Line { slope: 1.0 }.coverage(Kernel::Disc, 1.5, x / 10.0, y / 10.0);
        expected += 255.0 * srgb_from_linear(1.0 - shadow) / 40_000.0;
        found += f64::from(level.0[0]) / 40_000.0;
    }
    // Some 8,000 partly lit pixels with a variance of at most 1/4 each: standard error 0.0011.
    assert!((expected - found).abs() < 0.0045, "{found} against {expected}");
}

#[test]
fn the_transfer_function_inverts_and_meets_the_standards_values() {
    assert!((srgb_from_linear(0.5) - 0.735_356_98).abs() < 1e-7);
    assert!((srgb_from_linear(0.001) - 0.012_92).abs() < 1e-12);
    for k in 0..=1000 {
        let linear = f64::from(k) / 1000.0;
        assert!((linear_from_srgb(srgb_from_linear(linear)) - linear).abs() < 1e-7);
    }
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
    ];
    for (name, what) in bad {
        let error = what.render(10, 10).unwrap_err();
        assert!(matches!(error, Error::Field { field, .. } if field == name), "{error}");
        assert!(error.to_string().contains("allowed is"), "{error}");
    }
    assert!(matches!(good.render(0, 10), Err(Error::Size { .. })));
    assert!(matches!(good.render(10, 20_000), Err(Error::Size { .. })));
}
