//! Simulated people answer as their models say, and a cohort of them differs as it should.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod support;

use std::sync::LazyLock;

use scumble_psychophysics::{
    Cohort, Condition, EXPONENT_OF_SLOPE_3_5, Experiment, Fatigue, ImageObserver, Observer, ObserverModel, Pictures,
    Protocol, Psychometric, Role, SignalDetectionObserver, Stage, THRESHOLD_PROBABILITY, Thresholds, Trial,
    WeibullObserver, rehearse,
};
use scumble_stimuli::{Kernel, Pattern, Shape, Stimulus};
use support::{header, small};

/// The first main trial of the default protocol.
static FIRST: LazyLock<Trial> = LazyLock::new(|| {
    let mut protocol = Protocol::two_alternative();
    protocol.practice.ratios.clear();
    let mut experiment = Experiment::new(protocol, 1, 0).unwrap();
    while !matches!(experiment.stage(), Stage::Trial(_)) {
        experiment.proceed().unwrap();
    }
    *experiment.stage().trial().unwrap()
});

/// A trial of two pictures at `ratio` texels.
fn pair(ratio: f64) -> Trial {
    at_ratio(*FIRST, ratio)
}

/// A single picture at `ratio` texels.
fn single(shape: Shape, ratio: f64) -> Trial {
    let trial = *FIRST;
    let Pictures::Pair { left, .. } = trial.pictures else { panic!("{trial:?}") };
    let picture = Stimulus { shape, ..left };
    at_ratio(Trial { pictures: Pictures::Single { picture }, ..trial }, ratio)
}

fn at_ratio(trial: Trial, ratio: f64) -> Trial {
    Trial { radius_px: ratio * trial.condition.texel_px, ..trial }
}

fn probability(model: &ObserverModel, trial: &Trial) -> f64 {
    model.probability_correct(trial, &Protocol::two_alternative().pictures).unwrap()
}

/// People with assumed thresholds.
fn assumed() -> [ObserverModel; 2] {
    ["weibull", "signal-detection"].map(|name| ObserverModel::named(name).unwrap())
}

/// Mean, standard deviation and standard error of the mean.
fn moments(values: &[f64]) -> (f64, f64, f64) {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
    let sd = (squares / (count - 1.0)).sqrt();
    (mean, sd, sd / count.sqrt())
}

#[test]
fn the_threshold_means_the_same_for_everyone_lapses_included() {
    for model in assumed() {
        for lapse in [0.0, 0.01, 0.1] {
            let model = model.with_lapse_probability(lapse);
            let threshold = model.threshold_ratio(&pair(1.0).condition).unwrap();
            assert!((probability(&model, &pair(threshold)) - 0.82).abs() < 1e-12, "{model:?}");
            assert!((probability(&model, &pair(1e-3)) - (1.0 - 0.5 * lapse)).abs() < 1e-12);
            assert!((probability(&model, &pair(1e9)) - 0.5).abs() < 1e-12);
        }
    }
}

#[test]
fn the_weibull_person_follows_the_psychometric_function_that_quest_assumes() {
    let person = WeibullObserver::default();
    let quest = Psychometric { beta: 3.5, delta: 0.01, gamma: 0.5, threshold_probability: THRESHOLD_PROBABILITY };
    for step in -20..=20 {
        let offset = f64::from(step) * 0.05;
        let trial = pair(person.thresholds.ratio_of(&pair(1.0).condition) * libm::exp10(-offset));
        assert!((person.probability_correct(&trial) - quest.probability(offset)).abs() < 1e-12, "{offset}");
    }
}

#[test]
fn answers_are_right_as_often_as_the_model_says() {
    let rules = Protocol::two_alternative().pictures;
    for model in assumed() {
        let threshold = model.threshold_ratio(&pair(1.0).condition).unwrap();
        for trial in [pair(threshold), pair(10.0 * threshold), single(Shape::Line, 2.0), single(Shape::Artifact, 2.0)] {
            let probability = probability(&model, &trial);
            let right = (0..4000)
                .filter(|seed| trial.is_correct(Observer::new(model, *seed).unwrap().answer(&trial, &rules).unwrap()));
            let share = right.count() as f64 / 4000.0;
            let standard_error = (probability * (1.0 - probability) / 4000.0f64).sqrt();
            assert!((share - probability).abs() < 4.0 * standard_error, "{model:?}: {share}, {probability}");
        }
    }
}

#[test]
fn single_pictures_are_told_by_the_closed_forms() {
    let weibull = WeibullObserver { lapse_probability: 0.0, ..WeibullObserver::default() };
    let threshold = weibull.thresholds.ratio_of(&pair(1.0).condition);
    // Seen on 64 % of the trials at the threshold: (0.82 - 0.5) / 0.5.
    let told = weibull.probability_correct(&single(Shape::Artifact, threshold));
    assert!((told - (0.64 + 0.36 * 0.1)).abs() < 1e-12, "{told}");
    assert!((weibull.probability_correct(&single(Shape::Line, threshold)) - 0.9).abs() < 1e-12);

    let person = SignalDetectionObserver { lapse_probability: 0.0, ..SignalDetectionObserver::default() };
    // d' at the threshold: sqrt 2 x 0.915365 (the 82 % quantile in any table of the normal distribution).
    assert!((person.d_prime(&pair(threshold)) - 2f64.sqrt() * 0.915_365_087_842_814).abs() < 1e-12);
    assert!((person.probability_correct(&single(Shape::Line, threshold)) - 0.9).abs() < 1e-12);
    // A criterion in the middle makes both errors equally often, Phi(d' / 2) = Phi(0.647261) = 0.741269.
    let middle = SignalDetectionObserver { criterion_sds: 0.5 * person.d_prime(&pair(threshold)), ..person };
    for shape in [Shape::Line, Shape::Artifact] {
        assert!((middle.probability_correct(&single(shape, threshold)) - 0.741_269).abs() < 1e-6);
    }
}

/// The largest difference of the curve of signal detection with this exponent from the Weibull function of
/// slope 3.5, both without lapses.
fn largest_difference(exponent: f64) -> f64 {
    let weibull = WeibullObserver { lapse_probability: 0.0, ..WeibullObserver::default() };
    let person = SignalDetectionObserver { lapse_probability: 0.0, exponent, ..SignalDetectionObserver::default() };
    let threshold = weibull.thresholds.ratio_of(&pair(1.0).condition);
    (-100..=100)
        .map(|step| pair(threshold * libm::exp10(f64::from(step) * 0.01)))
        .map(|trial| (weibull.probability_correct(&trial) - person.probability_correct(&trial)).abs())
        .fold(0.0, f64::max)
}

#[test]
fn the_exponent_is_the_one_whose_curve_is_closest_to_slope_3_5() {
    let exponents = (0..=1000).map(|step| 2.3 + f64::from(step) * 0.001);
    let best = exponents.min_by(|a, b| largest_difference(*a).total_cmp(&largest_difference(*b))).unwrap();
    let difference = largest_difference(EXPONENT_OF_SLOPE_3_5);
    assert!((best - EXPONENT_OF_SLOPE_3_5).abs() < 0.0015, "{best}: {}", largest_difference(best));
    assert!(difference < 0.01, "{difference}");
}

#[test]
fn thresholds_of_the_conditions_are_the_published_ones() {
    let condition = |pattern, contrast, texel_px, kernel| Condition { pattern, contrast, texel_px, kernel };
    for model in assumed() {
        let ratio = |condition| model.threshold_ratio(&condition).unwrap();
        assert!((ratio(condition(Pattern::Step, 1.0, 5.0, Kernel::Disc)) - 3.47).abs() < 1e-12);
        assert!((ratio(condition(Pattern::DoubleStep, 1.0, 20.0, Kernel::Box)) - 3.47).abs() < 1e-12);
        assert!((ratio(condition(Pattern::Stair, 1.0, 10.0, Kernel::Disc)) - 2.5).abs() < 1e-12);
        assert!((ratio(condition(Pattern::Step, 0.5, 10.0, Kernel::Disc)) - 0.95 * 3.47).abs() < 1e-12);
    }
}

#[test]
fn fatigue_lowers_the_threshold_adds_lapses_and_moves_the_criterion_in_its_units() {
    let fatigue = Fatigue {
        threshold_fall_log10_per_100_trials: 0.1,
        lapse_growth_per_100_trials: 0.02,
        criterion_drift_sds_per_100_trials: 0.5,
    };
    let late = |trial: Trial| Trial { number: 201, ..trial };
    let weibull = WeibullObserver { lapse_probability: 0.0, ..WeibullObserver::default() };
    let tired_weibull = WeibullObserver { fatigue, ..weibull };
    let person = SignalDetectionObserver { lapse_probability: 0.0, ..SignalDetectionObserver::default() };
    let tired_person = SignalDetectionObserver { fatigue, ..person };
    for (fresh, tired) in [
        (ObserverModel::Weibull(weibull), ObserverModel::Weibull(tired_weibull)),
        (ObserverModel::SignalDetection(person), ObserverModel::SignalDetection(tired_person)),
    ] {
        // The first trial and practice find a fresh person.
        assert_eq!(probability(&tired, &pair(3.0)), probability(&fresh, &pair(3.0)));
        let practice = Trial { role: Role::Practice, ..late(pair(3.0)) };
        assert_eq!(probability(&tired, &practice), probability(&fresh, &practice));
        // After 200 trials: 0.2 log10 lower, 4 % lapses, the criterion one standard deviation up.
        let expected = 0.04 * 0.5 + 0.96 * probability(&fresh, &pair(3.0 * libm::exp10(0.2)));
        assert!((probability(&tired, &late(pair(3.0))) - expected).abs() < 1e-12, "{tired:?}");
        // Phi(1.2816 + 1) = 0.988742.
        let line = probability(&tired, &late(single(Shape::Line, 3.0)));
        assert!((line - 0.988_742).abs() < 1e-6, "{line}");
    }
}

#[test]
fn an_interrupted_session_gets_the_answers_of_one_that_was_not_from_every_kind_however_tired() {
    let fatigue = Fatigue {
        threshold_fall_log10_per_100_trials: 1.0,
        lapse_growth_per_100_trials: 1.0,
        criterion_drift_sds_per_100_trials: 5.0,
    };
    let people = [
        ObserverModel::Weibull(WeibullObserver { fatigue, ..WeibullObserver::default() }),
        ObserverModel::SignalDetection(SignalDetectionObserver { fatigue, ..SignalDetectionObserver::default() }),
        ObserverModel::Image(ImageObserver { fatigue, ..ImageObserver::default() }),
    ];
    for (model, name) in people.into_iter().flat_map(|model| [(model, "two-alternative"), (model, "yes-no")]) {
        let header = header(small(name));
        let person = Observer::new(model, 5).unwrap();
        let mut whole = Experiment::resume(&header, &[]).unwrap();
        let events = rehearse(&mut whole, &person).unwrap();
        let cut = events.len() / 2;
        let mut resumed = Experiment::resume(&header, &events[..cut]).unwrap();
        assert_eq!(rehearse(&mut resumed, &person).unwrap(), events[cut..], "{model:?}, {name}");
        assert_eq!(resumed, whole);
    }
}

#[test]
fn a_cohort_is_log_normal_about_its_median_person_whatever_the_kind() {
    for name in ObserverModel::NAMES {
        let cohort = Cohort { median: ObserverModel::named(name).unwrap(), between_sd_log10: 0.1, seed: 77 };
        let log10_ratio = |index| match cohort.person(index).unwrap().model() {
            ObserverModel::Image(person) => (3.47 * ImageObserver::default().noise_rad / person.noise_rad).log10(),
            model => {
                model.threshold_ratio(&Condition { pattern: Pattern::Step, ..pair(1.0).condition }).unwrap().log10()
            }
        };
        let logs: Vec<f64> = (0..2000).map(log10_ratio).collect();
        let (mean, sd, standard_error) = moments(&logs);
        assert!((mean - 3.47f64.log10()).abs() < 4.0 * standard_error, "{name}: {mean}");
        assert!((sd - 0.1).abs() < 0.007, "{name}: {sd}");
    }
}

#[test]
fn a_person_is_the_same_each_time_and_different_from_the_next() {
    let cohort = Cohort { median: ObserverModel::default(), between_sd_log10: 0.1, seed: 77 };
    assert_eq!(cohort.person(3).unwrap(), cohort.person(3).unwrap());
    assert_ne!(cohort.person(3).unwrap(), cohort.person(4).unwrap());
    assert_ne!(cohort.session_seed(3), cohort.session_seed(4));
    assert!(Cohort { between_sd_log10: -0.1, ..cohort }.person(0).is_err());
}

#[test]
fn every_kind_survives_its_file_and_a_misspelt_key_is_refused_by_name() {
    for name in ObserverModel::NAMES {
        let model = ObserverModel::named(name).unwrap();
        assert_eq!(model.name(), name);
        let file = serde_json::to_string(&model).unwrap();
        assert!(file.starts_with(&format!(r#"{{"kind":"{}","#, name.replace('-', "_"))), "{file}");
        assert_eq!(serde_json::from_str::<ObserverModel>(&file).unwrap(), model);
        let misspelt = file.replace("lapse_probability", "lapse_propability");
        let message = serde_json::from_str::<ObserverModel>(&misspelt).unwrap_err().to_string();
        assert!(message.contains("lapse_propability"), "{message}");
    }
    let message = ObserverModel::named("oracle").unwrap_err().to_string();
    assert_eq!(message, "observer is oracle; allowed is weibull, signal-detection, image");
}

#[test]
fn parameters_of_a_person_out_of_range_are_refused_by_name() {
    let weibull = WeibullObserver::default();
    let person = SignalDetectionObserver::default();
    let image = ImageObserver::default();
    let thresholds = weibull.thresholds;
    let fatigue = Fatigue::default();
    let with_thresholds = |thresholds: Thresholds| ObserverModel::Weibull(WeibullObserver { thresholds, ..weibull });
    let with_fatigue = |fatigue: Fatigue| ObserverModel::Image(ImageObserver { fatigue, ..image });
    let broken = [
        ("thresholds.ratio", with_thresholds(Thresholds { ratio: 0.0, ..thresholds })),
        ("thresholds.stair_factor", with_thresholds(Thresholds { stair_factor: f64::NAN, ..thresholds })),
        ("thresholds.half_contrast_factor", with_thresholds(Thresholds { half_contrast_factor: -1.0, ..thresholds })),
        ("lapse_probability", ObserverModel::Weibull(WeibullObserver { lapse_probability: 0.37, ..weibull })),
        ("slope_per_log10", ObserverModel::Weibull(WeibullObserver { slope_per_log10: 0.0, ..weibull })),
        (
            "false_alarm_probability",
            ObserverModel::Weibull(WeibullObserver { false_alarm_probability: 0.0, ..weibull }),
        ),
        ("exponent", ObserverModel::SignalDetection(SignalDetectionObserver { exponent: 0.0, ..person })),
        (
            "criterion_sds",
            ObserverModel::SignalDetection(SignalDetectionObserver { criterion_sds: f64::NAN, ..person }),
        ),
        ("noise_rad", ObserverModel::Image(ImageObserver { noise_rad: -0.1, ..image })),
        ("criterion_rad", ObserverModel::Image(ImageObserver { criterion_rad: f64::INFINITY, ..image })),
        (
            "fatigue.threshold_fall_log10_per_100_trials",
            with_fatigue(Fatigue { threshold_fall_log10_per_100_trials: f64::NAN, ..fatigue }),
        ),
        ("fatigue.lapse_growth_per_100_trials", with_fatigue(Fatigue { lapse_growth_per_100_trials: -0.1, ..fatigue })),
        (
            "fatigue.criterion_drift_sds_per_100_trials",
            with_fatigue(Fatigue { criterion_drift_sds_per_100_trials: f64::INFINITY, ..fatigue }),
        ),
    ];
    for (name, model) in broken {
        let message = Observer::new(model, 1).unwrap_err().to_string();
        assert!(message.starts_with(&format!("{name} is")), "{message}");
    }
}
