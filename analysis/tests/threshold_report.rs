//! Intervals and goodness of fit of one psychometric function: against normal theory, by simulation of people whose
//! function is known, and over random tables.

#![allow(clippy::unwrap_used, reason = "a test stops at what it did not expect, in helpers too")]

use std::path::Path;

use proptest::prelude::*;
use rand_chacha::{
    ChaCha8Rng,
    rand_core::{Rng, SeedableRng},
};
use scumble_analysis::{
    Count, Model, Parameter, Resampling, ThresholdReport, Weibull, log_likelihood, most_likely, read_count_table,
};
use statrs::distribution::{Binomial, DiscreteCDF};

const LAPSE: Parameter = Parameter::Fixed(0.01);

fn psignifit() -> Vec<Count> {
    read_count_table(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/weibull_fit_data.csv")).unwrap()
}

fn report(counts: &[Count], resampling: &Resampling) -> Result<ThresholdReport, scumble_analysis::Error> {
    ThresholdReport::of(counts, 0.5, LAPSE, resampling, || ())
}

fn few(seed: u64) -> Resampling {
    Resampling { resamples: 199, seed }
}

/// Answers of a function to `total` trials at each of `levels`.
fn answers(truth: &Weibull, levels: &[f64], total: u32, draw: &mut ChaCha8Rng) -> Vec<Count> {
    let answer = |x: f64, draw: &mut ChaCha8Rng| {
        let unit = (draw.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        f64::from(u8::from(unit < truth.correct(x)))
    };
    let level = |&x: &f64| Count { x, correct: (0..total).map(|_| answer(x, draw)).sum(), total: total.into() };
    levels.iter().map(level).collect()
}

/// Whether `found` of `trials` is within the central 99.8 % of a binomial distribution.
fn is_plausible(found: u64, trials: u64, share: f64) -> bool {
    let binomial = Binomial::new(share, trials).unwrap();
    (binomial.inverse_cdf(0.001)..=binomial.inverse_cdf(0.999)).contains(&found)
}

fn holds(ends: [Option<f64>; 2], value: f64) -> bool {
    ends[0].is_none_or(|low| low <= value) && ends[1].is_none_or(|high| value <= high)
}

#[test]
fn the_ends_of_a_profile_interval_lie_1_92_nats_below_the_maximum() {
    let counts = psignifit();
    let report = report(&counts, &few(1)).unwrap();
    let slopes = || (0..40_000).map(|step| 1.0 + 1e-4 * f64::from(step) * 2.0);
    let ln = |location: f64, slope: f64| {
        log_likelihood(&counts, &Weibull { location, slope, guess: 0.5, lapse: 0.01 }) + report.fit.nll
    };
    let decades = |slope: f64| {
        let unit = Weibull { location: 0.0, slope, guess: 0.5, lapse: 0.01 };
        unit.x_at_correct(0.82).unwrap()
    };
    let highest = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::NEG_INFINITY, f64::max);
    for side in 0..2 {
        let location = report.ci95_profile.threshold_t[side].unwrap();
        let x82 = report.ci95_profile.x82[side].unwrap();
        let slope = report.ci95_profile.slope_beta[side].unwrap();
        // A grid of what is free: its best is below the profile by 1e-6 nats at most.
        let drops = [
            highest(&mut slopes().map(|slope| ln(location, slope))),
            highest(&mut slopes().map(|slope| ln(x82 - decades(slope), slope))),
            highest(&mut (0..40_000).map(|step| ln(-2.4 + 5e-6 * f64::from(step), slope))),
        ];
        for drop in drops {
            assert!((drop + 1.920_729).abs() < 1e-4, "{drops:?}");
        }
    }
}

#[test]
fn with_many_answers_both_intervals_are_those_of_the_standard_errors() {
    let counts: Vec<Count> = psignifit()
        .iter()
        .map(|count| Count { correct: 1000.0 * count.correct, total: 1000.0 * count.total, ..*count })
        .collect();
    let report = report(&counts, &Resampling::default()).unwrap();
    let cases = [
        (report.fit.threshold_t, report.fit.se_t, report.ci95_profile.threshold_t, report.ci95_bootstrap.threshold_t),
        (
            report.fit.slope_beta,
            report.fit.se_beta.unwrap(),
            report.ci95_profile.slope_beta,
            report.ci95_bootstrap.slope_beta,
        ),
    ];
    for (value, error, profile, bootstrap) in cases {
        for (end, sign) in [(0, -1.0), (1, 1.0)] {
            let errors = |ends: [Option<f64>; 2]| sign * (ends[end].unwrap() - value) / error;
            assert!((errors(profile) - 1.96).abs() < 0.02, "{}", errors(profile));
            // An end of 2000 resamples has a standard error of 0.06.
            assert!((errors(bootstrap) - 1.96).abs() < 0.25, "{}", errors(bootstrap));
        }
    }
}

#[test]
fn both_intervals_cover_the_truth_in_95_of_100_experiments() {
    let truth = Weibull { location: -0.1, slope: 3.0, guess: 0.5, lapse: 0.01 };
    let x82 = truth.x_at_correct(0.82).unwrap();
    let levels: Vec<f64> = (0..7).map(|step| -0.5 + 0.125 * f64::from(step)).collect();
    let mut draw = ChaCha8Rng::seed_from_u64(1);
    let experiments = 150;
    let mut covered = [[0; 3]; 2];
    let mut estimates = 0;
    for seed in 0..experiments {
        let Ok(report) = report(&answers(&truth, &levels, 40, &mut draw), &few(seed)) else { continue };
        estimates += 1;
        for (counts, intervals) in covered.iter_mut().zip([report.ci95_profile, report.ci95_bootstrap]) {
            counts[0] += u64::from(holds(intervals.threshold_t, truth.location));
            counts[1] += u64::from(holds(intervals.slope_beta, truth.slope));
            counts[2] += u64::from(holds(intervals.x82, x82));
        }
    }
    println!("profile, bootstrap: {covered:?} of {estimates}");
    // The others look like a jump and have no estimate.
    assert!(estimates >= 145, "{estimates}");
    for count in covered.as_flattened() {
        assert!(is_plausible(*count, estimates, 0.95), "{covered:?}");
    }
}

#[test]
fn the_p_value_of_the_deviance_is_uniform_under_the_model_and_small_under_another() {
    let truth = Weibull { location: -0.1, slope: 3.0, guess: 0.5, lapse: 0.01 };
    let levels: Vec<f64> = (0..7).map(|step| -0.5 + 0.125 * f64::from(step)).collect();
    let mut draw = ChaCha8Rng::seed_from_u64(2);
    let experiments = 80;
    let mut p_values = |truth: &Weibull, total: u32| -> Vec<f64> {
        let p_value = |seed| Some(report(&answers(truth, &levels, total, &mut draw), &few(seed)).ok()?.deviance_p);
        (0..experiments).filter_map(p_value).collect()
    };
    let below = |values: &[f64], bound: f64| values.iter().filter(|value| **value <= bound).count() as u64;
    let uniform = p_values(&truth, 20);
    for bound in [0.05, 0.25, 0.5, 0.75] {
        let found = below(&uniform, bound);
        println!("{bound}: {found} of {}", uniform.len());
        assert!(is_plausible(found, uniform.len() as u64, bound), "{found} below {bound}");
    }
    // Who lapses on a fifth of the trials where the fit allows one in a hundred.
    let wrong = p_values(&Weibull { lapse: 0.2, slope: 8.0, location: -0.4, ..truth }, 60);
    println!("{} of {}", below(&wrong, 0.05), wrong.len());
    assert!(below(&wrong, 0.05) > wrong.len() as u64 / 2);
}

#[test]
fn equal_seeds_give_equal_reports_and_other_seeds_others() {
    let counts = psignifit();
    let reports = [1, 1, 2].map(|seed| report(&counts, &few(seed)).unwrap());
    assert_eq!(reports[0], reports[1]);
    assert_ne!(reports[0].ci95_bootstrap, reports[2].ci95_bootstrap);
    assert_eq!(reports[0].ci95_profile, reports[2].ci95_profile);
}

#[test]
fn the_bootstrap_of_the_reference_table_has_the_same_ends_on_every_machine() {
    let ends = report(&psignifit(), &few(1)).unwrap().ci95_bootstrap.slope_beta.map(Option::unwrap);
    for (end, expected) in ends.into_iter().zip([2.808_599_802_981_832, 4.950_063_912_840_591]) {
        assert!((end - expected).abs() < 1e-9, "{ends:?}");
    }
}

#[test]
fn rows_of_one_level_count_as_one_in_any_order() {
    let counts = psignifit();
    let mut rows: Vec<Count> = counts
        .iter()
        .flat_map(|count| {
            let part = (count.correct / 3.0).floor();
            [
                Count { correct: part, total: 30.0, ..*count },
                Count { correct: count.correct - part, total: 60.0, ..*count },
            ]
        })
        .collect();
    rows.reverse();
    rows.push(Count { x: 5.0, correct: 0.0, total: 0.0 });
    assert_eq!(report(&rows, &few(1)).unwrap(), report(&counts, &few(1)).unwrap());
}

#[test]
fn an_end_that_the_data_do_not_bound_is_missing_and_a_sentence_says_so() {
    // Few answers on the rise: a jump fits nearly as well.
    let row = |x, correct| Count { x, correct, total: 12.0 };
    let report = report(&[row(0.0, 7.0), row(0.1, 9.0), row(0.2, 11.0), row(0.5, 12.0)], &few(1)).unwrap();
    assert_eq!(report.ci95_profile.slope_beta[1], None);
    assert_eq!(report.ci95_bootstrap.slope_beta[1], None);
    for expected in ["ci95_profile: the answers do not bound slope_beta from above", "ci95_bootstrap: "] {
        assert!(report.notes.iter().any(|note| note.starts_with(expected)), "{:?}", report.notes);
    }
    let json = serde_json::to_value(&report).unwrap();
    assert!(json["ci95_profile"]["slope_beta"][1].is_null() && json["threshold_t"].is_f64());
}

#[test]
fn what_holds_no_estimate_is_refused_with_the_reason() {
    let row = |x, correct, total| Count { x, correct, total };
    let cases: [(&[Count], &str); 9] = [
        (&[], "there is no answer"),
        (&[row(0.0, 0.0, 0.0)], "there is no answer"),
        (&[row(0.0, 7.0, 9.0)], "all answers are at one level"),
        (&[row(0.0, 9.0, 9.0), row(1.0, 9.0, 9.0)], "all 18 answers were correct"),
        (&[row(0.0, 0.0, 9.0), row(1.0, 0.0, 9.0)], "all 18 answers were wrong"),
        (&[row(0.0, 50.0, 100.0), row(1.0, 99.0, 100.0)], "do not bound the slope"),
        (&[row(0.0, f64::NAN, 9.0)], "n_correct is NaN of n_total 9; allowed are whole numbers"),
        (&[row(0.0, -1.0, 9.0)], "n_correct is -1"),
        (&[row(0.0, 1.5, 9.0)], "n_correct is 1.5"),
    ];
    for (counts, expected) in cases {
        let refusal = report(counts, &few(1)).unwrap_err().to_string();
        assert!(refusal.contains(expected) && !refusal.contains('\n'), "{counts:?}: {refusal}");
    }
    for (lapse, guess) in [(0.6, 0.5), (0.01, 0.9), (f64::NAN, 0.5)] {
        let refusal = ThresholdReport::of(&psignifit(), guess, Parameter::Fixed(lapse), &few(1), || ()).unwrap_err();
        assert!(refusal.to_string().contains("allowed is at least 0 and below"), "{refusal}");
    }
    let refusal = report(&psignifit(), &Resampling { resamples: 99, seed: 1 }).unwrap_err().to_string();
    assert_eq!(refusal, "--resamples is 99; allowed is 100 to 1000000");
}

#[test]
fn the_library_refuses_what_is_no_count_and_no_model() {
    let row = |x, correct, total| [Count { x: 0.0, correct: 5.0, total: 9.0 }, Count { x, correct, total }];
    let model = Model { guess: 0.5, lapse: LAPSE, slope: Parameter::Fixed(3.5) };
    for (x, correct, total) in
        [(f64::NAN, 1.0, 2.0), (0.0, f64::NAN, 2.0), (0.0, 3.0, 2.0), (0.0, 1.0, f64::INFINITY), (0.0, 0.0, -1.0)]
    {
        let refusal = most_likely(&row(x, correct, total), &model).unwrap_err().to_string();
        assert!(refusal.contains("is no count; allowed is"), "{refusal}");
    }
    let wrong = [
        Model { guess: -0.1, ..model },
        Model { guess: f64::NAN, ..model },
        Model { lapse: Parameter::Fixed(0.5), ..model },
        Model { guess: 0.9, lapse: Parameter::Free, ..model },
        Model { slope: Parameter::Fixed(0.0), ..model },
    ];
    for model in wrong {
        let refusal = most_likely(&row(0.3, 8.0, 9.0), &model).unwrap_err().to_string();
        assert!(refusal.contains("; allowed is"), "{refusal}");
    }
}

#[test]
fn a_billion_answers_a_level_are_fitted() {
    let truth = Weibull { location: 0.0, slope: 3.5, guess: 0.5, lapse: 0.01 };
    let counts: Vec<Count> = (-3..=3)
        .map(|step| 0.1 * f64::from(step))
        .map(|x| Count { x, correct: (1e9 * truth.correct(x)).round(), total: 1e9 })
        .collect();
    let report = report(&counts, &few(1)).unwrap();
    assert!((report.fit.threshold_t).abs() < 1e-6 && (report.fit.slope_beta - 3.5).abs() < 1e-5, "{:?}", report.fit);
    assert!(report.fit.deviance < 1e-3 && report.notes.is_empty(), "{report:?}");
    assert!(holds(report.ci95_profile.threshold_t, 0.0) && holds(report.ci95_bootstrap.threshold_t, 0.0));
}

/// Tables of 1 to 6 levels between 1e-3 and 1e3, few answers or very many.
fn any_table() -> impl Strategy<Value = Vec<Count>> {
    let total = prop_oneof![4 => 0_u32..12, 1 => 12_u32..200, 1 => Just(1_000_000_000)];
    let level = (prop_oneof![-30_i32..=30, Just(0), Just(1)], total, 0.0..=1.0_f64).prop_map(|(x, total, share)| {
        Count { x: f64::from(x) * 0.1, correct: (f64::from(total) * share).round(), total: total.into() }
    });
    prop::collection::vec(level, 1..=6)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_table_gives_finite_numbers_and_intervals_that_hold_their_value_or_one_line(
        counts in any_table(),
        guess in prop_oneof![Just(0.0), Just(0.5), 0.0..0.8],
        lapse in prop_oneof![Just(Parameter::Free), Just(Parameter::Fixed(0.0)), Just(LAPSE), (0.0..0.2).prop_map(Parameter::Fixed)],
    ) {
        let resampling = Resampling { resamples: 100, seed: 5 };
        match ThresholdReport::of(&counts, guess, lapse, &resampling, || ()) {
            Err(refusal) => prop_assert!(!refusal.to_string().contains('\n')),
            Ok(report) => {
                let fit = &report.fit;
                let required = [fit.threshold_t, fit.slope_beta, fit.lapse, fit.nll, fit.deviance, fit.se_t, report.deviance_p];
                prop_assert!(required.iter().chain(fit.se_beta.iter()).all(|value| value.is_finite()), "{report:?}");
                prop_assert!(fit.deviance >= 0.0 && report.deviance_p > 0.0 && report.deviance_p <= 1.0);
                prop_assert!(report.levels.iter().all(|level| level.residual.is_finite()), "{report:?}");
                for intervals in [&report.ci95_profile, &report.ci95_bootstrap] {
                    let ends = [intervals.threshold_t, intervals.slope_beta, intervals.x82];
                    prop_assert!(ends.iter().flatten().flatten().all(|end| end.is_finite()), "{report:?}");
                    let values = [Some(fit.threshold_t), Some(fit.slope_beta), fit.x82];
                    for (ends, value) in ends.into_iter().zip(values) {
                        prop_assert!(value.is_none_or(|value| holds(ends, value)), "{report:?}");
                    }
                }
            }
        }
    }
}
