//! The person who sees the pictures alone: what is found in the pixels, and which thresholds follow from it.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use scumble_psychophysics::{
    Condition, Contour, Experiment, Fatigue, ImageObserver, Observer, ObserverModel, PictureRules, Pictures, Protocol,
    Role, SignalDetectionObserver, THRESHOLD_PROBABILITY, Thresholds, Trial, rehearse,
};
use scumble_stimuli::{Encoding, IsoContour, Kernel, Pattern, Shape, Silhouette, Stimulus, Transfer};

/// The display's levels make a tilt uncertain by 0.015, and the largest of some 500 is found: three
/// times as much.
const PIXEL_NOISE_RAD: f64 = 0.045;

fn rules() -> PictureRules {
    Protocol::two_alternative().pictures
}

/// A picture without dithering under a disc.
fn stimulus(pattern: Pattern, shape: Shape, texel_px: f64, ratio: f64) -> Stimulus {
    Stimulus {
        pattern,
        shape,
        kernel: Kernel::Disc,
        texel_px,
        radius_px: ratio * texel_px,
        contrast: 1.0,
        encoding: Encoding::LinearLight,
        phase: 0.4,
        mirrored: false,
        inverted: false,
        tilt_rad: 0.0,
        dither_seed: None,
    }
}

fn contour(stimulus: &Stimulus) -> Contour {
    let picture = stimulus.render(600, 480, &Transfer::srgb()).unwrap();
    Contour::of_picture(picture.as_raw(), 600, &Transfer::srgb()).unwrap()
}

fn tilt_rad(stimulus: &Stimulus) -> f64 {
    ImageObserver::tilt_rad(stimulus, &rules()).unwrap()
}

/// A trial of two dithered pictures; each `number` has a phase, a turn and noise of its own.
fn pair(kernel: Kernel, pattern: Pattern, texel_px: f64, ratio: f64, number: u32) -> Trial {
    let turn = if pattern == Pattern::Stair { 0.0 } else { 0.01 * (f64::from(number % 5) - 2.0) };
    let of_shape = |shape, tilt_rad, dither_seed| Stimulus {
        kernel,
        phase: (0.05 + 0.317 * f64::from(number)).fract(),
        tilt_rad,
        dither_seed: Some(dither_seed),
        ..stimulus(pattern, shape, texel_px, ratio)
    };
    Trial {
        number,
        round: 1,
        role: Role::Measure,
        track: Some(0),
        condition: Condition { pattern, contrast: 1.0, kernel, texel_px },
        placement_radius_px: ratio * texel_px,
        radius_px: ratio * texel_px,
        pictures: Pictures::Pair {
            left: of_shape(Shape::Line, turn, 2 * u64::from(number)),
            right: of_shape(Shape::Artifact, -turn, 2 * u64::from(number) + 1),
        },
    }
}

/// Share of right answers to constant stimuli: the mean probability over `PAIRS` pairs of pictures.
fn share_correct(person: &ImageObserver, kernel: Kernel, pattern: Pattern, texel_px: f64, ratio: f64) -> f64 {
    const PAIRS: u32 = 6;
    let trials = (1..=PAIRS).map(|number| pair(kernel, pattern, texel_px, ratio, number));
    trials.map(|trial| person.probability_correct(&trial, &rules()).unwrap()).sum::<f64>() / f64::from(PAIRS)
}

/// The largest ratio, to 2 %, at which the share of right answers reaches 82 %: a stair's curve is not
/// monotonic. Beyond 3 the exact tilt of a stair is below 3.7 degrees, half of what is needed.
fn measured_threshold(person: &ImageObserver, kernel: Kernel, pattern: Pattern, texel_px: f64) -> f64 {
    let seen = |ratio: f64| share_correct(person, kernel, pattern, texel_px, ratio) >= THRESHOLD_PROBABILITY;
    let mut ratio = if pattern == Pattern::Stair { 3.0 } else { 7.0 };
    while !seen(ratio) && ratio > 0.5 {
        ratio /= 1.1;
    }
    let (mut low, mut high) = (ratio, ratio * 1.1);
    while high / low > 1.02 {
        let middle = (low * high).sqrt();
        if seen(middle) { low = middle } else { high = middle }
    }
    (low * high).sqrt()
}

fn lapse_free() -> ImageObserver {
    ImageObserver { lapse_probability: 0.0, ..ImageObserver::default() }
}

#[test]
fn a_line_is_found_where_it_is_to_a_part_of_a_pixel() {
    for (pattern, slope) in [(Pattern::Step, 20.0 / 600.0), (Pattern::Stair, 1.0)] {
        let found = contour(&stimulus(pattern, Shape::Line, 20.0, 3.0));
        let error_px = |(index, height): (usize, &f64)| {
            let x_px = (found.first_column + index) as f64 + 0.5 - 300.0;
            height - (240.0 - slope * x_px)
        };
        let errors: Vec<f64> = found.heights_px.iter().enumerate().map(error_px).collect();
        let rms_px = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
        assert!(rms_px < found.height_noise_px && found.height_noise_px < 0.07, "{rms_px}");
        assert!(errors.len() > 400);
    }
}

#[test]
fn a_step_is_found_where_the_exact_contour_lies() {
    let picture = stimulus(Pattern::Step, Shape::Artifact, 20.0, 3.0);
    let found = contour(&picture);
    let exact = IsoContour::of(Silhouette::Step, Kernel::Disc, 3.0, 0.5).unwrap();
    // The riser lies on the line of slope 20 / 600, at phase 0.4 30 px left of the centre.
    let expected_px = |column: usize| {
        let x_px = column as f64 + 0.5 - 300.0;
        240.0 - (-1.0 + 20.0 * exact.offset((x_px + 30.0) / 20.0))
    };
    let rms_px = |shift: usize| {
        let columns = found.first_column..found.first_column + found.heights_px.len();
        let squares =
            columns.zip(&found.heights_px).map(|(column, height)| (height - expected_px(column + shift)).powi(2));
        (squares.sum::<f64>() / found.heights_px.len() as f64).sqrt()
    };
    assert!(rms_px(0) < 0.06, "{}", rms_px(0));
    assert!(rms_px(2) > 0.12, "a contour two columns off is told from the right one: {}", rms_px(2));
}

#[test]
fn tilts_in_the_pixels_are_those_of_the_exact_contour() {
    let exact_rad = |silhouette, ratio| IsoContour::of(silhouette, Kernel::Disc, ratio, 0.5).unwrap().tilt();
    for ratio in [1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0] {
        for texel_px in [5.0, 10.0, 20.0] {
            let found = tilt_rad(&stimulus(Pattern::Step, Shape::Artifact, texel_px, ratio));
            let exact = exact_rad(Silhouette::Step, ratio);
            assert!((found - exact).abs() < 0.04, "{texel_px} {ratio}: {found}, {exact}");
        }
    }
    // Beyond a ratio of 2 a stair's steepest parts are shorter than what the pixels resolve.
    for ratio in [1.0, 1.5, 2.0] {
        let found = tilt_rad(&stimulus(Pattern::Stair, Shape::Artifact, 20.0, ratio));
        let exact = exact_rad(Silhouette::Stair, ratio);
        assert!((found - exact).abs() < 0.03, "{ratio}: {found}, {exact}");
    }
}

#[test]
fn without_internal_noise_every_artifact_above_the_noise_of_the_pixels_is_found() {
    let person = ImageObserver { noise_rad: 0.0, ..lapse_free() };
    let right = |pattern, texel_px, ratio| share_correct(&person, Kernel::Disc, pattern, texel_px, ratio);
    for texel_px in [5.0, 10.0, 20.0] {
        for ratio in [0.5, 1.0, 2.0, 4.0, 6.0] {
            assert_eq!(right(Pattern::Step, texel_px, ratio), 1.0, "{texel_px} {ratio}");
        }
        for ratio in [0.5, 1.0, 1.25] {
            assert_eq!(right(Pattern::Stair, texel_px, ratio), 1.0, "{texel_px} {ratio}");
        }
    }
    // A stair of 5 px under a disc of 30 px leaves less than a level: a guess.
    let guess = right(Pattern::Stair, 5.0, 6.0);
    assert!((0.1..0.9).contains(&guess), "{guess}");
}

#[test]
fn mirrored_inverted_and_turned_pictures_are_judged_alike() {
    for pattern in [Pattern::Step, Pattern::Stair] {
        for shape in [Shape::Artifact, Shape::Line] {
            let plain = stimulus(pattern, shape, 10.0, 1.2);
            let expected = tilt_rad(&plain);
            let mirrored = tilt_rad(&Stimulus { mirrored: true, ..plain });
            assert!((mirrored - expected).abs() < 1e-9, "{pattern:?}: {mirrored} {expected}");
            for other in [
                Stimulus { inverted: true, ..plain },
                Stimulus { tilt_rad: 0.03, ..plain },
                Stimulus { tilt_rad: -0.03, mirrored: true, inverted: true, ..plain },
                Stimulus { contrast: 0.5, ..plain },
            ] {
                let found = tilt_rad(&other);
                assert!((found - expected).abs() < PIXEL_NOISE_RAD, "{other:?}: {found}, {expected}");
            }
        }
    }
}

#[test]
fn the_relation_follows_from_the_pictures_alone() {
    let person = lapse_free();
    let threshold = |pattern, texel_px| measured_threshold(&person, Kernel::Disc, pattern, texel_px);
    for texel_px in [5.0, 10.0, 20.0] {
        let (step, stair) = (threshold(Pattern::Step, texel_px), threshold(Pattern::Stair, texel_px));
        // r = c a: 3.29, 3.21 and 3.21 over 6 pairs each. The pixels' noise costs 5 to 8 % of the 3.47 that
        // the exact contours give.
        assert!((step / 3.24).ln().abs() < 0.03, "{texel_px}: {step}");
        // The stair, 1.21, 1.19 and 1.23, is easier to hide than the step, as in Kreuzer 2017, and by more than
        // there (2.5 against 3.47).
        assert!((stair / 1.21).ln().abs() < 0.03, "{texel_px}: {stair}");
    }
}

#[test]
fn a_double_step_is_a_little_easier_to_hide_than_a_step_and_half_the_contrast_changes_nothing() {
    let person = lapse_free();
    let double_step = measured_threshold(&person, Kernel::Disc, Pattern::DoubleStep, 10.0);
    assert!((double_step / 2.95).ln().abs() < 0.04, "{double_step}");

    let share = |contrast| {
        let right = |number| {
            let mut trial = pair(Kernel::Disc, Pattern::Step, 10.0, 3.2, number);
            if let Pictures::Pair { left, right } = &mut trial.pictures {
                (left.contrast, right.contrast) = (contrast, contrast);
            }
            person.probability_correct(&trial, &rules()).unwrap()
        };
        (1..=6).map(right).sum::<f64>() / 6.0
    };
    assert!((share(1.0) - share(0.5)).abs() < 0.02, "{} {}", share(1.0), share(0.5));
}

#[test]
fn a_gaussian_of_half_the_radius_hides_less_than_a_disc_by_its_steepness() {
    let person = lapse_free();
    let threshold = |kernel| measured_threshold(&person, kernel, Pattern::Step, 10.0);
    // Steepness 0.798 / c against 0.5 / c. The disc's steep part is the longer one, so that the pixels' noise
    // adds more to its largest tilt.
    let factor = threshold(Kernel::GaussianHalf) / threshold(Kernel::Disc);
    assert!((factor / 1.596).ln().abs() < 0.12, "{factor}");
}

#[test]
fn single_pictures_are_compared_with_the_criterion_and_fatigue_makes_the_noise_grow() {
    let person = lapse_free();
    let of = |person: &ImageObserver, shape, ratio, number| {
        let picture = stimulus(Pattern::Step, shape, 10.0, ratio);
        let trial = pair(Kernel::Disc, Pattern::Step, 10.0, ratio, number);
        person.probability_correct(&Trial { pictures: Pictures::Single { picture }, ..trial }, &rules()).unwrap()
    };
    // Without tilt the false alarms are 10 %; the pixels' noise adds to them.
    let line = of(&person, Shape::Line, 3.0, 1);
    assert!((0.85..0.9).contains(&line), "{line}");
    assert!(of(&person, Shape::Artifact, 0.5, 1) > 0.999);
    let blunt = ImageObserver { noise_rad: 0.0, ..person };
    assert_eq!((of(&blunt, Shape::Line, 3.0, 1), of(&blunt, Shape::Artifact, 2.0, 1)), (1.0, 1.0));

    // 100 trials later the same pair is told as often as by someone with twice the noise.
    let fatigue = Fatigue { threshold_fall_log10_per_100_trials: std::f64::consts::LOG10_2, ..Fatigue::default() };
    let late = pair(Kernel::Disc, Pattern::Step, 10.0, 3.0, 101);
    let tired = ImageObserver { fatigue, ..person }.probability_correct(&late, &rules()).unwrap();
    let noisy = ImageObserver { noise_rad: 2.0 * person.noise_rad, ..person };
    assert!((tired - noisy.probability_correct(&late, &rules()).unwrap()).abs() < 1e-12);
}

/// One round of three QUESTs for the step, 80 trials each: mean log10 of the estimates.
fn session_log10(model: ObserverModel, seed: u64) -> f64 {
    let mut protocol = Protocol::two_alternative();
    protocol.conditions.patterns = vec![Pattern::Step];
    protocol.conditions.contrasts = vec![1.0];
    protocol.practice.ratios.truncate(2);
    protocol.schedule.trials_min = 80;
    protocol.schedule.trials_max = 80;
    let person = Observer::new(model, seed).unwrap();
    let mut experiment = Experiment::new(protocol, seed, 0).unwrap();
    let events = rehearse(&mut experiment, &person).unwrap();
    assert_eq!(events.len(), 2 + 3 * 80);
    assert!(experiment.tracks().iter().all(|track| track.verdict().is_converged()));
    experiment.tracks().iter().map(|track| track.estimate().ratio.log10() / 3.0).sum()
}

#[test]
fn a_session_converges_to_the_threshold_that_constant_stimuli_measure() {
    let constant = measured_threshold(&ImageObserver::default(), Kernel::Disc, Pattern::Step, 10.0);
    // The scatter of such sessions: a person whose d' falls with the first power of the ratio. QUEST, which
    // assumes a slope three times as steep, states a fifth of it.
    let thresholds = Thresholds { ratio: constant, ..Thresholds::default() };
    let person = SignalDetectionObserver { thresholds, exponent: 1.0, ..SignalDetectionObserver::default() };
    let errors: Vec<f64> =
        (0..40).map(|seed| session_log10(ObserverModel::SignalDetection(person), seed) - constant.log10()).collect();
    let mean = errors.iter().sum::<f64>() / 40.0;
    let sd = (errors.iter().map(|error| (error - mean).powi(2)).sum::<f64>() / 39.0).sqrt();
    let found = session_log10(ObserverModel::named("image").unwrap(), 9) - constant.log10();
    assert!((found - mean).abs() < 3.0 * sd && sd < 0.1, "{constant}: {found}, {mean} +- {sd}");
}

#[test]
fn a_picture_without_an_edge_has_no_contour() {
    assert_eq!(Contour::of_picture(&[7; 100], 10, &Transfer::srgb()), None);
    assert_eq!(Contour::of_picture(&[], 10, &Transfer::srgb()), None);
    let upright: Vec<u8> = (0..100).map(|index| if index % 10 < 5 { 0 } else { 255 }).collect();
    assert_eq!(Contour::of_picture(&upright, 10, &Transfer::srgb()), None);
    let grey = Stimulus { contrast: 0.0, ..stimulus(Pattern::Step, Shape::Artifact, 10.0, 1.0) };
    assert_eq!(tilt_rad(&grey), 0.0);
}
