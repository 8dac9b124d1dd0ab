//! Promises of a stimulus as data: the same bytes for the same numbers, refusals, files.

mod common;

use common::{PATTERNS, draw, stimulus};
use image::GrayImage;
use proptest::prelude::*;
use scumble_stimuli::{Encoding, Error, Kernel, Pattern, Shape, Stimulus, Transfer, picture_sha256};

#[test]
fn equal_stimuli_give_equal_bytes_and_another_seed_gives_other_noise() {
    for pattern in PATTERNS {
        let seeded = |seed| draw(&Stimulus { dither_seed: Some(seed), ..stimulus(pattern, Shape::Artifact) }, 120, 80);
        assert_eq!(seeded(7), seeded(7));
        assert_ne!(seeded(7), seeded(8));
    }
}

#[test]
fn the_bytes_are_the_same_on_every_platform() {
    let artifact = |pattern| Stimulus { dither_seed: Some(7), ..stimulus(pattern, Shape::Artifact) };
    let pictures = [
        artifact(Pattern::Stair),
        artifact(Pattern::Step),
        Stimulus { mirrored: true, inverted: true, contrast: 0.5, ..artifact(Pattern::DoubleStep) },
        Stimulus { shape: Shape::Line, tilt_rad: 0.02, ..artifact(Pattern::Step) },
        Stimulus { kernel: Kernel::GaussianThird, tilt_rad: -0.02, ..artifact(Pattern::Stair) },
        Stimulus { kernel: Kernel::Poisson25Rotated, ..artifact(Pattern::DoubleStep) },
    ];
    let found = pictures.map(|what| picture_sha256(&draw(&what, 120, 80)));
    let expected = [
        "89c85d411e1bf2c7849af585716f88af70f0caf8cd9b7935520522aa604ad144",
        "d6774d091159ce68d079c1e32c9025aba250fa345ea4bfed75d743940669706d",
        "76dbc20ca4bef56bccc91da66ed23fc1fcc17147d6f574f1e0b6b0104207af63",
        "8aaae16746b91303da29cd1450c027da05e552dd946d5882b42f9a30d419cd94",
        "4b2d2957d9aab1fc02db57dd282a69615192db908afc4c14ecd757a74b7ac347",
        "901fa6089fcede9c80788b73bbdcea3bb7a51d538458304d1e2424c5c577d6b8",
    ];
    assert_eq!(found.each_ref().map(String::as_str).as_slice(), expected.as_slice());
}

#[test]
fn the_hash_covers_width_height_and_bytes() {
    let picture = |width, height| GrayImage::from_raw(width, height, vec![0, 255]).expect("two pixels");
    // printf '\x02\x00\x00\x00\x01\x00\x00\x00\x00\xff' | sha256sum
    let expected = "7cc612b8eab27581618b41bcfbf8840a2aa7cbc11d335afd1c73c0eeb7f798d5";
    assert_eq!(picture_sha256(&picture(2, 1)), expected);
    assert_ne!(picture_sha256(&picture(1, 2)), expected);
}

#[test]
fn numbers_out_of_range_are_refused_by_name() {
    let good = stimulus(Pattern::Stair, Shape::Line);
    let bad = [
        ("texel_px", Stimulus { texel_px: 0.9, ..good }),
        ("texel_px", Stimulus { texel_px: 16385.0, ..good }),
        ("texel_px", Stimulus { texel_px: f64::NAN, ..good }),
        ("texel_px", Stimulus { texel_px: 10.1, pattern: Pattern::Step, ..good }),
        ("texel_px", Stimulus { texel_px: 10.1, pattern: Pattern::DoubleStep, ..good }),
        ("radius_px", Stimulus { radius_px: -1.0, ..good }),
        ("radius_px", Stimulus { radius_px: f64::INFINITY, ..good }),
        ("contrast", Stimulus { contrast: 1.5, ..good }),
        ("phase", Stimulus { phase: -0.1, ..good }),
        ("tilt_rad", Stimulus { tilt_rad: 3.2, ..good }),
        ("tilt_rad", Stimulus { tilt_rad: f64::NEG_INFINITY, ..good }),
    ];
    for (name, what) in bad {
        let error = what.render(20, 20, &Transfer::srgb()).unwrap_err();
        assert!(matches!(error, Error::Field { field, .. } if field == name), "{error}");
        assert!(error.to_string().contains("allowed is"), "{error}");
    }
    for (width_px, height_px) in [(0, 10), (10, 0), (10, 20_000)] {
        let error = good.render(width_px, height_px, &Transfer::srgb()).unwrap_err();
        assert_eq!(error, Error::Size { width_px, height_px });
    }
}

#[test]
fn the_ends_of_every_range_are_drawn() {
    for (_, kernel) in Kernel::NAMED {
        for (texel_px, radius_px) in [(1.0, 16384.0), (16384.0, 0.0), (16384.0, 16384.0), (1.0, 0.0)] {
            for tilt_rad in [0.0, std::f64::consts::PI] {
                let plain = stimulus(Pattern::Stair, Shape::Artifact);
                draw(&Stimulus { kernel, texel_px, radius_px, tilt_rad, phase: 1.0, ..plain }, 2, 2);
            }
        }
    }
}

#[test]
fn files_name_everything_by_its_word_and_refuse_unknown_fields() {
    let what = Stimulus {
        kernel: Kernel::Poisson25Rotated,
        encoding: Encoding::CodeValues,
        dither_seed: Some(3),
        ..stimulus(Pattern::DoubleStep, Shape::Line)
    };
    let text = serde_json::to_string(&what).unwrap();
    for word in ["\"double_step\"", "\"line\"", "\"poisson25_rotated\"", "\"code_values\"", "\"tilt_rad\":0.0"] {
        assert!(text.contains(word), "{word} in {text}");
    }
    assert_eq!(serde_json::from_str::<Stimulus>(&text).unwrap(), what);
    let unknown = text.replace("\"phase\"", "\"place\":0.0,\"phase\"");
    assert!(serde_json::from_str::<Stimulus>(&unknown).unwrap_err().to_string().contains("place"));
    for (name, kernel) in Kernel::NAMED {
        assert_eq!(serde_json::to_string(&kernel).unwrap(), format!("\"{name}\""));
        assert_eq!(Kernel::from_name(name), Some(kernel));
    }
    assert_eq!(Kernel::from_name("Disc"), None);
}

/// Any stimulus of the ranges, with a ratio up to 300.
fn any_stimulus() -> impl Strategy<Value = Stimulus> {
    let drawn = (
        proptest::sample::select(PATTERNS.to_vec()),
        proptest::sample::select(Kernel::NAMED.to_vec()),
        (0.0..=2.0_f64, -3.0..=2.5_f64),
        (0.0..=1.0_f64, 0.0..=1.0_f64),
        -std::f64::consts::PI..=std::f64::consts::PI,
        any::<[bool; 5]>(),
        any::<Option<u64>>(),
    );
    drawn.prop_map(|(pattern, (_, kernel), (texel, ratio), (contrast, phase), tilt_rad, coins, dither_seed)| Stimulus {
        pattern,
        shape: if coins[0] { Shape::Artifact } else { Shape::Line },
        kernel,
        texel_px: 10.0_f64.powf(texel),
        radius_px: 10.0_f64.powf(texel + ratio).min(16384.0),
        contrast,
        encoding: if coins[1] { Encoding::LinearLight } else { Encoding::CodeValues },
        phase,
        mirrored: coins[2],
        inverted: coins[3],
        tilt_rad: if coins[4] { tilt_rad } else { 0.0 },
        dither_seed,
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn every_valid_stimulus_is_drawn_and_only_a_picture_of_two_texels_holds_a_step(
        what in any_stimulus(), width_px in 1..40_u32, height_px in 1..24_u32,
    ) {
        prop_assert_eq!(what.check(), Ok(()));
        let too_narrow = what.pattern != Pattern::Stair && 2.0 * what.texel_px > f64::from(width_px);
        match what.render(width_px, height_px, &Transfer::srgb()) {
            Ok(picture) => {
                prop_assert!(!too_narrow);
                prop_assert_eq!(picture.dimensions(), (width_px, height_px));
            }
            Err(error) => {
                prop_assert!(too_narrow && error.to_string().starts_with("texel_px is"), "{}", error);
            }
        }
    }

    #[test]
    fn every_invalid_stimulus_is_refused_by_the_name_of_its_field(
        good in any_stimulus(), field in 0..5_usize, above in any::<bool>(), by in 1e-9..1e9_f64, unordered in any::<bool>(),
    ) {
        let mut bad = good;
        let (name, number, least, most) = match field {
            0 => ("texel_px", &mut bad.texel_px, 1.0, 16384.0),
            1 => ("radius_px", &mut bad.radius_px, 0.0, 16384.0),
            2 => ("contrast", &mut bad.contrast, 0.0, 1.0),
            3 => ("phase", &mut bad.phase, 0.0, 1.0),
            _ => ("tilt_rad", &mut bad.tilt_rad, -std::f64::consts::PI, std::f64::consts::PI),
        };
        *number = if unordered { f64::NAN } else if above { most + by } else { least - by };
        let error = bad.render(20, 20, &Transfer::srgb());
        prop_assert!(matches!(error, Err(Error::Field { field, .. }) if field == name), "{:?}", error);
    }
}
