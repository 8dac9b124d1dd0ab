//! Promises about light and levels: encodings, measured displays, dithering.

mod common;

use common::{PATTERNS, draw, draw_codes, stimulus};
use scumble_stimuli::{Encoding, Error, Kernel, Pattern, Shape, Silhouette, Stimulus, Transfer};

/// A display of 0.3 to 250 cd/m2 and gamma 1.8, measured at 18 levels.
fn measured() -> Transfer {
    let rows: Vec<(u8, f64)> =
        (0..=17).map(|row| (15 * row, 0.3 + 249.7 * (f64::from(row) / 17.0).powf(1.8))).collect();
    Transfer::from_table(&rows).expect("a table of a display")
}

/// Lit part of the disc at every pixel of an upright, untilted stair or its line, phase 0.
fn lit_part(what: &Stimulus, side_px: u32) -> Vec<f64> {
    let silhouette = match what.shape {
        Shape::Artifact => Silhouette::Stair,
        Shape::Line => Silhouette::Line { slope: 1.0 },
    };
    let place = |index: u32| (f64::from(index) + 0.5 - 0.5 * f64::from(side_px)) / what.texel_px;
    let pixels = (0..side_px).flat_map(|row| (0..side_px).map(move |column| (column, row)));
    let ratio = what.radius_px / what.texel_px;
    pixels.map(|(c, r)| 1.0 - silhouette.coverage(Kernel::Disc, ratio, place(c), -place(r))).collect()
}

#[test]
fn without_a_seed_each_pixel_has_the_level_whose_light_or_code_is_nearest() {
    let code = |level: u8| f64::from(level) / 255.0;
    for transfer in [Transfer::srgb(), measured()] {
        for shape in [Shape::Artifact, Shape::Line] {
            for contrast in [1.0, 0.37] {
                let plain = Stimulus { phase: 0.0, contrast, ..stimulus(Pattern::Stair, shape) };
                let expected = lit_part(&plain, 80);
                for encoding in [Encoding::LinearLight, Encoding::CodeValues] {
                    let picture = Stimulus { encoding, ..plain }.render(80, 80, &transfer).unwrap();
                    let value = |level: u8| match encoding {
                        Encoding::LinearLight => transfer.light(level),
                        Encoding::CodeValues => code(level),
                    };
                    for (&level, lit) in picture.iter().zip(&expected) {
                        let miss = |level: u8| (value(level) - contrast * lit).abs();
                        let nearest = (0..=255).map(miss).fold(f64::INFINITY, f64::min);
                        assert!(miss(level) <= nearest + 1e-9, "{plain:?}: level {level} for {lit}");
                    }
                }
            }
        }
    }
}

#[test]
fn half_contrast_halves_the_light_or_the_code_and_keeps_the_shadow_black() {
    for pattern in PATTERNS {
        let what = Stimulus { contrast: 0.5, ..stimulus(pattern, Shape::Line) };
        for (picture, lit) in [(draw(&what, 200, 200), 188), (draw_codes(&what, 200, 200), 128)] {
            assert_eq!(picture.get_pixel(0, 0).0, [lit]);
            assert_eq!(picture.get_pixel(199, 199).0, [0]);
        }
    }
}

#[test]
fn dithering_has_the_exact_mean_of_light_or_of_code() {
    for (transfer, encoding) in [
        (Transfer::srgb(), Encoding::LinearLight),
        (measured(), Encoding::LinearLight),
        (measured(), Encoding::CodeValues),
    ] {
        let value = |level: u8| match encoding {
            Encoding::LinearLight => transfer.light(level),
            Encoding::CodeValues => f64::from(level) / 255.0,
        };
        let what = Stimulus { phase: 0.0, encoding, ..stimulus(Pattern::Stair, Shape::Artifact) };
        let lit = lit_part(&what, 200);
        for seed in 1..4 {
            let picture = Stimulus { dither_seed: Some(seed), ..what }.render(200, 200, &transfer).unwrap();
            let (mut error, mut variance) = (0.0, 0.0);
            for (&level, lit) in picture.iter().zip(&lit) {
                // The level above or below; both bound the value.
                let [below, above] = [-1, 1].map(|step| value(level.saturating_add_signed(step)));
                assert!(below <= lit + 1e-5 && lit - 1e-5 <= above, "level {level} for {lit}");
                let gap = if *lit < value(level) { value(level) - below } else { above - value(level) };
                let share = if gap > 0.0 { (lit - value(level)).abs() / gap } else { 0.0 };
                error += value(level) - lit;
                variance += gap * gap * share * (1.0 - share);
            }
            // Four standard errors of the sum of independent pixels.
            assert!(error.abs() < 4.0 * variance.sqrt(), "{encoding:?} {seed}: {error:e} of {:e}", variance.sqrt());
        }
    }
}

#[test]
fn the_upper_level_is_taken_as_often_as_light_asks_not_code() {
    // Between levels 254 and 255 of this display lies nine tenths of its light.
    let steep = Transfer::from_table(&[(0, 0.0), (254, 0.1), (255, 1.0)]).unwrap();
    for (light, expected) in [(0.325, 0.25), (0.55, 0.5), (0.999_99, 1.0)] {
        let what =
            Stimulus { contrast: light, radius_px: 0.0, dither_seed: Some(5), ..stimulus(Pattern::Stair, Shape::Line) };
        let picture = what.render(400, 400, &steep).unwrap();
        let lit: Vec<u8> = picture.iter().copied().filter(|&level| level > 200).collect();
        let share = lit.iter().filter(|&&level| level == 255).count() as f64 / lit.len() as f64;
        // 80,000 pixels: standard error 0.0018 at most.
        assert!((share - expected).abs() < 0.007, "{light}: {share}");
    }
}

#[test]
fn noise_depends_on_the_seed_and_the_place_alone() {
    let lit = |shape, seed, texel_px| {
        let what = Stimulus { contrast: 0.5, dither_seed: Some(seed), texel_px, ..stimulus(Pattern::Stair, shape) };
        let picture = draw(&what, 300, 300);
        image::imageops::crop_imm(&picture, 0, 0, 101, 101).to_image()
    };
    let first = lit(Shape::Artifact, 7, 10.0);
    assert!(first.iter().all(|level| [187, 188].contains(level)));
    assert_eq!(first, lit(Shape::Line, 7, 20.0));
    assert_ne!(first, lit(Shape::Artifact, 8, 10.0));
}

#[test]
fn exact_levels_stay_themselves_under_dithering() {
    let srgb = Transfer::srgb();
    for level in [0, 1, 77, 254, 255] {
        for (encoding, contrast) in
            [(Encoding::LinearLight, srgb.light(level)), (Encoding::CodeValues, f64::from(level) / 255.0)]
        {
            let plain = Stimulus { contrast, encoding, radius_px: 0.0, ..stimulus(Pattern::Stair, Shape::Artifact) };
            assert_eq!(draw(&Stimulus { dither_seed: Some(3), ..plain }, 50, 50), draw(&plain, 50, 50), "{plain:?}");
        }
    }
}

#[test]
fn srgb_has_the_standards_values() {
    let srgb = Transfer::srgb();
    assert_eq!((srgb.light(0), srgb.light(255)), (0.0, 1.0));
    // IEC 61966-2-1: linear below 0.04045, and middle grey.
    assert!((srgb.light(10) - 10.0 / 255.0 / 12.92).abs() < 1e-15);
    assert!((srgb.light(128) - 0.215_860_500_113_899_26).abs() < 1e-15);
    assert_eq!(Transfer::default(), srgb);
}

#[test]
fn a_measured_table_passes_through_its_rows_and_increases_strictly() {
    let rows = [(0, 0.2), (3, 0.21), (90, 0.22), (91, 50.0), (200, 50.1), (255, 300.2)];
    let transfer = Transfer::from_table(&rows).unwrap();
    for (level, luminance) in rows {
        assert!((transfer.light(level) - (luminance - 0.2) / 300.0).abs() < 1e-12, "level {level}");
    }
    assert!((1..=255).all(|level| transfer.light(level) > transfer.light(level - 1)));
}

#[test]
fn the_interpolation_is_that_of_another_program() {
    // SciPy 1.17.1, PchipInterpolator(levels, luminances)(level), as light above level 0.
    let rows = [(0, 0.4), (20, 1.5), (64, 9.0), (96, 30.0), (160, 31.0), (255, 250.0)];
    let expected = [
        (5, 0.000_608_220_734_836_735_1),
        (19, 0.004_096_083_769_613_398_5),
        (40, 0.013_703_542_500_906_022),
        (80, 0.080_450_563_232_989_3),
        (100, 0.119_088_212_861_447_63),
        (130, 0.120_812_874_228_319_23),
        (161, 0.122_846_900_391_067_44),
        (200, 0.316_327_354_972_438_97),
        (254, 0.985_303_110_013_185_5),
    ];
    let transfer = Transfer::from_table(&rows).unwrap();
    for (level, light) in expected {
        assert!((transfer.light(level) - light).abs() < 1e-14, "level {level}: {}", transfer.light(level));
    }
}

#[test]
fn eighteen_rows_of_srgb_give_all_levels_within_a_tenth_of_a_level_but_the_darkest() {
    let srgb = Transfer::srgb();
    let rows: Vec<(u8, f64)> = (0..=17).map(|row| (15 * row, 80.0 * srgb.light(15 * row))).collect();
    let table = Transfer::from_table(&rows).unwrap();
    for level in 0..255 {
        // The first rows span sRGB's bend: up to 0.92 of a level, 3e-4 of the light.
        let allowed = if level < 30 { 1.0 } else { 0.1 };
        let gap = srgb.light(level + 1) - srgb.light(level);
        let miss = (table.light(level) - srgb.light(level)).abs() / gap;
        assert!(miss < allowed, "level {level}: {miss}");
    }
}

#[test]
fn a_table_that_is_no_display_is_refused_with_what_is_allowed() {
    let bad: [(&[(u8, f64)], &str); 8] = [
        (&[], "without rows"),
        (&[(0, 1.0)], "to level 0"),
        (&[(1, 0.0), (255, 1.0)], "from level 1"),
        (&[(0, 0.0), (254, 1.0)], "to level 254"),
        (&[(0, 0.0), (9, 2.0), (255, 2.0)], "level 255 with 2 cd/m2 after level 9"),
        (&[(0, 0.0), (9, 2.0), (9, 3.0), (255, 4.0)], "level 9 with 3 cd/m2 after level 9"),
        (&[(0, -1.0), (255, 2.0)], "level 0 has -1 cd/m2"),
        (&[(0, 0.0), (100, 5e-324), (255, 2.0)], "the same light"),
    ];
    for (rows, found) in bad {
        let error = Transfer::from_table(rows).unwrap_err();
        assert!(matches!(error, Error::Table(_)));
        let text = error.to_string();
        assert!(text.contains(found) && text.contains("allowed"), "{text}");
    }
    assert!(Transfer::from_table(&[(0, 0.0), (255, f64::NAN)]).is_err());
}
