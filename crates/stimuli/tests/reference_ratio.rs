//! Promises of the reference filter: known answers, closed forms, brute force, its own definition.

use std::f64::consts::PI;

use scumble_stimuli::{Comparison, Encoding, Error, Kernel, Pattern, Silhouette, reference_ratio};

const STAIR: Comparison = Comparison {
    pattern: Pattern::Stair,
    kernel: Kernel::Disc,
    contrast: 1.0,
    encoding: Encoding::CodeValues,
    width_texels: 60.0,
};
const STEP: Comparison = Comparison { pattern: Pattern::Step, ..STAIR };

#[test]
fn the_stairs_ratios_are_those_of_the_table_of_the_method() {
    // Found by another program on ratios of whole twentieths, the first that is good.
    let known = [
        (Kernel::Disc, [3.95, 2.60, 1.60]),
        (Kernel::Box, [2.85, 2.00, 1.45]),
        (Kernel::GaussianHalf, [2.30, 1.65, 1.25]),
    ];
    for (kernel, ratios) in known {
        for (tolerance, expected) in [1.0, 2.0, 4.0].into_iter().zip(ratios) {
            let found = reference_ratio(&Comparison { kernel, ..STAIR }, tolerance).unwrap();
            assert_eq!((20.0 * found).ceil() / 20.0, expected, "{kernel:?}, D = {tolerance}: {found}");
        }
    }
}

#[test]
fn a_stair_under_a_box_differs_by_its_closed_form() {
    for ratio in [1.0, 1.5, 2.0, 3.0, 4.5] {
        let found = Comparison { kernel: Kernel::Box, ..STAIR }.largest_difference(ratio).unwrap();
        let expected = 255.0 / (32.0 * ratio * ratio);
        assert!((found / expected - 1.0).abs() < 1e-4, "q = {ratio}: {found} against {expected}");
    }
}

#[test]
fn no_larger_ratio_exceeds_the_tolerance_and_the_next_smaller_one_does() {
    let light = Comparison { kernel: Kernel::Box, encoding: Encoding::LinearLight, contrast: 0.5, ..STAIR };
    let double = Comparison { pattern: Pattern::DoubleStep, kernel: Kernel::Box, width_texels: 30.0, ..STAIR };
    for (comparison, tolerance) in [(STAIR, 1.0), (STAIR, 2.0), (light, 4.0), (STEP, 2.0), (double, 4.0)] {
        let ratio = reference_ratio(&comparison, tolerance).unwrap();
        assert!(comparison.largest_difference(0.999 * ratio).unwrap() > tolerance, "{comparison:?} {ratio}");
        for step in 0..40 {
            let larger = ratio * (1.001 + 0.02 * f64::from(step));
            if comparison.pattern == Pattern::Stair || larger < 0.5 * comparison.width_texels {
                let levels = comparison.largest_difference(larger).unwrap();
                assert!(levels <= tolerance, "{comparison:?}: {levels} at {larger}, beyond {ratio}");
            }
        }
    }
}

#[test]
fn rounded_pictures_differ_far_beyond_the_reference_ratio() {
    // Why the first ratio with equal pictures is no answer: two values that are nearly the same still
    // lie on the two sides of a rounding somewhere.
    let ratio = 4.0 * reference_ratio(&STAIR, 1.0).unwrap();
    assert!(STAIR.largest_difference(ratio).unwrap() < 0.2);
    let level = |edge: Silhouette, x: f64, y: f64| (255.0 * edge.coverage(Kernel::Disc, ratio, x, y)).round();
    let places = (0..20).flat_map(|i| (-2000..2000).map(move |j| (f64::from(i) / 20.0, f64::from(j) / 100.0)));
    let differing =
        places.filter(|&(x, y)| level(Silhouette::Stair, x, x + y) != level(Silhouette::Line { slope: 1.0 }, x, x + y));
    assert!(differing.count() > 100);
}

#[test]
fn a_step_under_a_disc_follows_its_law_of_lowest_order() {
    for width_texels in [240.0, 120.0, 60.0, 30.0] {
        for tolerance in [1.0, 2.0, 4.0] {
            let near = 1.0 / (PI * tolerance / 255.0 + 2.0 / width_texels);
            let far = (255.0 * width_texels / (8.0 * PI * tolerance)).sqrt();
            let law = if near <= 0.25 * width_texels { near } else { far.min(0.5 * width_texels) };
            let found = reference_ratio(&Comparison { width_texels, ..STEP }, tolerance).unwrap();
            assert!((found / law - 1.0).abs() < 2e-3, "W = {width_texels}, D = {tolerance}: {found} against {law}");
        }
    }
}

#[test]
fn a_texel_twice_as_large_asks_for_a_radius_of_a_step_larger_by_the_root_of_two() {
    let radius_px = |texel_px: f64| {
        let width_texels = 600.0 / texel_px;
        texel_px * reference_ratio(&Comparison { width_texels, ..STEP }, 1.0).unwrap()
    };
    let growth = radius_px(10.0) / radius_px(5.0);
    assert!((growth - 2.0_f64.sqrt()).abs() < 1e-3, "{growth}");
}

#[test]
fn brute_force_finds_no_larger_difference_and_hardly_a_smaller_one() {
    let cases = [
        (STAIR, 1.3),
        (Comparison { kernel: Kernel::GaussianHalf, ..STAIR }, 1.3),
        (Comparison { encoding: Encoding::LinearLight, ..STAIR }, 6.3),
        (STEP, 9.0),
        (Comparison { kernel: Kernel::Box, encoding: Encoding::LinearLight, ..STEP }, 12.0),
        (Comparison { pattern: Pattern::DoubleStep, ..STEP }, 9.0),
    ];
    for (comparison, ratio) in cases {
        let found = comparison.largest_difference(ratio).unwrap();
        let brute = brute_force(comparison, ratio);
        assert!(brute <= 1.001 * found, "{comparison:?}: {brute}, but {found}");
        assert!(brute >= 0.97 * found, "{comparison:?}: only {brute}, not {found}");
    }
}

/// Largest difference on a grid, in code values of sRGB, written anew from the definition.
fn brute_force(comparison: Comparison, ratio: f64) -> f64 {
    let width = comparison.width_texels;
    let (artifact, slope, half) = match comparison.pattern {
        Pattern::Stair => (Silhouette::Stair, 1.0, 0.5),
        Pattern::Step => (Silhouette::Step, 1.0 / width, 0.75 * width - ratio),
        Pattern::DoubleStep => (Silhouette::DoubleStep, 1.0 - 1.0 / width, 0.75 * width - ratio),
    };
    let code = |shadow: f64| {
        let value = comparison.contrast * (1.0 - shadow);
        255.0
            * match comparison.encoding {
                Encoding::CodeValues => value,
                Encoding::LinearLight if value <= 0.003_130_8 => 12.92 * value,
                Encoding::LinearLight => 1.055 * value.powf(1.0 / 2.4) - 0.055,
            }
    };
    let mut largest = 0.0_f64;
    for column in -200..=200 {
        let x = half * f64::from(column) / 200.0;
        for row in -1000..=1000 {
            let y = slope * x + 2.0 * (ratio + 0.75) * f64::from(row) / 1000.0;
            let shadow = |edge: Silhouette| edge.coverage(comparison.kernel, ratio, x, y);
            largest = largest.max((code(shadow(artifact)) - code(shadow(Silhouette::Line { slope }))).abs());
        }
    }
    largest
}

#[test]
fn half_the_contrast_in_code_values_is_twice_the_tolerance() {
    let full = reference_ratio(&STAIR, 2.0).unwrap();
    let half = reference_ratio(&Comparison { contrast: 0.5, ..STAIR }, 1.0).unwrap();
    assert!((full - half).abs() < 1e-5, "{full} and {half}");
}

#[test]
fn a_difference_that_is_never_large_asks_for_no_filter() {
    assert_eq!(reference_ratio(&Comparison { contrast: 0.1, ..STAIR }, 40.0), Ok(0.0));
}

#[test]
fn a_picture_too_narrow_leaves_half_its_width() {
    let ratio = reference_ratio(&Comparison { width_texels: 30.0, ..STEP }, 1.0).unwrap();
    assert!((ratio - 15.0).abs() < 1e-6, "{ratio}");
}

#[test]
fn what_has_no_answer_is_refused() {
    let taps = Comparison { kernel: Kernel::Poisson25, ..STAIR };
    assert_eq!(reference_ratio(&taps, 1.0), Err(Error::Taps));
    let wide = Comparison { width_texels: 4096.0, ..STEP };
    assert!(matches!(reference_ratio(&wide, 0.5), Err(Error::Reference { .. })));
    for (comparison, tolerance, field) in [
        (STAIR, 0.4, "tolerance_levels"),
        (STAIR, f64::NAN, "tolerance_levels"),
        (Comparison { contrast: 0.0, ..STAIR }, 1.0, "contrast"),
        (Comparison { width_texels: f64::NAN, ..STEP }, 1.0, "width_texels"),
    ] {
        let error = reference_ratio(&comparison, tolerance).unwrap_err();
        assert!(matches!(error, Error::Field { field: found, .. } if found == field), "{error}");
    }
}

/// Whether the cells of a row of the documentation's table hold these numbers.
fn states(page: &str, row: &str, expected: [f64; 6]) -> bool {
    let Some(cells) = page.lines().find_map(|line| line.strip_prefix(row)) else { return false };
    let cells: Vec<&str> = cells.trim_matches(['|', ' ']).split('|').map(str::trim).collect();
    cells.len() == 6 && cells.iter().zip(expected).all(|(cell, number)| *cell == format!("{number:.2}"))
}

#[test]
fn the_documentation_states_what_is_computed() {
    let page = include_str!("../../../docs/reference-filter.md");
    assert_eq!(page.lines().filter(|line| line.contains("| code |") || line.contains("| light |")).count(), 56);
    let six = |comparison: Comparison| {
        let ratio =
            |contrast: f64, tolerance: f64| reference_ratio(&Comparison { contrast, ..comparison }, tolerance).unwrap();
        [(1.0, 1.0), (1.0, 2.0), (1.0, 4.0), (0.5, 1.0), (0.5, 2.0), (0.5, 4.0)].map(|(c, d)| ratio(c, d))
    };
    let stair_under_box = six(Comparison { kernel: Kernel::Box, encoding: Encoding::LinearLight, ..STAIR });
    let rows = [
        ("| stair | any | disc | code ", six(STAIR)),
        ("| stair | any | box | light ", stair_under_box),
        ("| step | 10 | disc | code ", six(STEP)),
        (
            "| step | 10 | gauss2 | light ",
            six(Comparison { kernel: Kernel::GaussianHalf, encoding: Encoding::LinearLight, ..STEP }),
        ),
        (
            "| double step | 10 | box | code ",
            six(Comparison { pattern: Pattern::DoubleStep, kernel: Kernel::Box, ..STEP }),
        ),
    ];
    for (row, expected) in rows {
        assert!(states(page, row, expected), "{row}| {expected:.2?} is not in docs/reference-filter.md");
    }
    assert!(!states(page, rows[0].0, rows[1].1), "a wrong row passes for a right one");
}
