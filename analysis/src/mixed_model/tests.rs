//! The model against brute force, finite differences and normal theory.

#![allow(clippy::unwrap_used, reason = "a test stops at what it did not expect, in helpers too")]

use std::f64::consts::{LN_10, TAU};

use argmin::{
    core::{CostFunction, Executor},
    solver::neldermead::NelderMead,
};

use super::*;
use crate::estimate::MeanOverPeople;

const KNOWN: Assumptions = Assumptions { guess: 0.5, blind_share: 0.01, slope: 3.5 };

/// Probability of a right answer, written anew.
fn right(x: f64, threshold: f64, slope: f64, blind: f64) -> f64 {
    let w0 = -(1.0 - DETECTION_AT_THRESHOLD / (1.0 - blind)).ln();
    let seen = 1.0 - (-w0 * 10_f64.powf(slope * (x + threshold))).exp();
    0.5 + 0.5 * (1.0 - blind) * seen
}

/// Answers of a person of slope 3.5 to `trials` intensities about a threshold, by a fixed generator.
fn person(threshold: f64, trials: u32, seed: u64) -> PersonAnswers {
    let mut state = seed;
    let mut uniform = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let answers = (0..trials).map(|_| {
        let x = -threshold + 0.4 * (uniform() - 0.5);
        (x, uniform() < right(x, threshold, 3.5, 0.01))
    });
    PersonAnswers::new(0.5, answers.collect::<Vec<_>>())
}

fn model(people: u32, trials: u32) -> MixedModel {
    let spread = |index: u32| 0.54 + 0.3 * (f64::from(index) / f64::from(people - 1) - 0.5);
    let people = (0..people).map(|index| person(spread(index), trials, 77 + u64::from(index)));
    MixedModel::new(people.collect(), KNOWN)
}

const PLACES: [Coordinates; 4] =
    [[0.54, -2.3, 1.25, -3.3], [0.6, -2.4, 3.0, -3.7], [0.5, -1.0, 0.5, -1.0], [0.54, -6.0, 1.0, -3.0]];

#[test]
fn the_gradient_is_that_of_the_objective() {
    let model = model(6, 30);
    for at in PLACES {
        let (_, gradient) = model.objective(&at);
        for index in 0..4 {
            let moved = |by: f64| {
                let mut to = at;
                to[index] += by;
                model.objective(&to).0
            };
            let numeric = (moved(1e-5) - moved(-1e-5)) / 2e-5;
            assert!((numeric - gradient[index]).abs() < 1e-6 * numeric.abs().max(1.0), "{at:?}, {index}: {numeric}");
        }
    }
}

#[test]
fn a_persons_integral_is_that_of_a_grid_a_hundred_times_finer() {
    for (at, trials) in PLACES.into_iter().zip([5, 30, 120, 30]) {
        let shared = parameters_of(&at);
        let person = person(0.45, trials, 5);
        let ln_likelihood = |z: f64| -> f64 {
            let threshold = shared.log10_ratio + shared.between_sd * z;
            let of = |count: &Count| {
                let p = right(count.x, threshold, shared.slope, shared.blind_share);
                count.correct * p.ln() + (count.total - count.correct) * (1.0 - p).ln()
            };
            person.counts.iter().map(of).sum()
        };
        let step = 1e-3;
        let sum: f64 = (-8000..=8000)
            .map(|index| step * f64::from(index))
            .map(|z| (ln_likelihood(z) - 0.5 * z * z).exp() * step / TAU.sqrt())
            .sum();
        let found = person::marginal(&person, &shared).ln_likelihood;
        assert!((found - sum.ln()).abs() < 2e-3, "{at:?}: {found} is not {}", sum.ln());
    }
}

#[test]
fn people_measured_without_error_give_their_mean_and_students_interval() {
    let thresholds = [0.40, 0.45, 0.52, 0.55, 0.58, 0.60, 0.63, 0.70];
    let people = thresholds.map(|threshold| {
        // Expected counts at three intensities, so many that rounding them does not matter.
        let counts = [-0.15, 0.0, 0.15].map(|offset| {
            let x = offset - threshold;
            Count { x, correct: (20_000.0 * right(x, threshold, 3.5, 0.01)).round(), total: 20_000.0 }
        });
        PersonAnswers { guess: 0.5, counts: counts.to_vec() }
    });
    let fit = MixedModel::new(people.to_vec(), KNOWN).fit().unwrap();
    let mean = MeanOverPeople::of(&thresholds).unwrap();
    let interval = Interval::of(&fit, Quantity::MEDIAN).unwrap();
    assert!((interval.value - mean.mean).abs() < 3e-4, "{interval:?} is not {mean:?}");
    for (found, expected) in interval.ci95.iter().zip(mean.ci95) {
        assert!((found - expected).abs() < 1e-3, "{interval:?} is not {mean:?}");
    }
    assert!((interval.standard_error - mean.standard_error).abs() < 5e-4);
    // Maximum likelihood divides by the number of people, not by one less.
    let expected_sd = mean.standard_deviation * (7.0_f64 / 8.0).sqrt();
    assert!((fit.parameters().between_sd - expected_sd).abs() < 1e-3, "{:?}", fit.parameters());
    for ((_, found), expected) in fit.thresholds().zip(thresholds) {
        assert!((found - expected).abs() < 1e-3, "{found} is not {expected}");
    }
    assert!(
        (fit.parameters().detection(0.0) - DETECTION_AT_THRESHOLD).abs() < 1e-12,
        "that is what the threshold stands for"
    );
    assert!((fit.parameters().slope - 3.5).abs() < 0.02 && (fit.parameters().blind_share - 0.01).abs() < 0.002);
}

#[test]
fn a_held_quantity_keeps_its_value_and_its_gradient_is_that_of_what_is_free() {
    let model = model(6, 30);
    let hidden = Quantity::Log10Ratio { z: 1.645, detection: 0.1 };
    for quantity in [Quantity::MEDIAN, hidden, Quantity::Log10BetweenSd, Quantity::Log10Slope] {
        let free = [0.3, -1.2, -3.0];
        let value = |free: &[f64; 3]| {
            let at = quantity.place(0.4, free);
            assert!((quantity.value(&at) - 0.4).abs() < 1e-12, "{quantity:?}");
            model.objective(&at).0
        };
        let at = quantity.place(0.4, &free);
        let gradient = quantity.free_gradient(&at, &model.objective(&at).1);
        for index in 0..3 {
            let moved = |by: f64| {
                let mut to = free;
                to[index] += by;
                value(&to)
            };
            let numeric = (moved(1e-5) - moved(-1e-5)) / 2e-5;
            let error = (numeric - gradient[index]).abs();
            assert!(error < 1e-5 * numeric.abs().max(1.0), "{quantity:?}, {index}: {numeric}, {gradient:?}");
        }
    }
}

/// The objective at a slope, maximised over all else by the simplex of Nelder and Mead.
fn best_without_gradient(model: &MixedModel, ln_slope: f64) -> f64 {
    struct Problem<'a>(&'a MixedModel, f64);
    impl CostFunction for Problem<'_> {
        type Param = Vec<f64>;
        type Output = f64;
        fn cost(&self, free: &Vec<f64>) -> Result<f64, argmin::core::Error> {
            Ok(-self.0.objective(&[free[0], free[1], self.1, free[2]]).0)
        }
    }
    let corner = vec![0.54, -2.3, -3.3];
    let mut simplex = vec![corner.clone()];
    for (index, size) in [0.05, 0.3, 1.0].into_iter().enumerate() {
        let mut next = corner.clone();
        next[index] += size;
        simplex.push(next);
    }
    let search = NelderMead::new(simplex).with_sd_tolerance(1e-7).unwrap();
    let found =
        Executor::new(Problem(model, ln_slope), search).configure(|s| s.max_iters(500)).ctrlc(false).run().unwrap();
    -found.state().get_best_cost()
}

#[test]
fn the_ends_of_an_interval_have_the_deviance_of_the_cut() {
    let fit = model(8, 60).fit().unwrap();
    let Profiled { value, ends } = fit.interval(Quantity::Log10Slope).unwrap();
    let cut = 8.0 * (2.364_624_251_f64.powi(2) / 7.0).ln_1p();
    for end in ends {
        let end = end.unwrap();
        let best = best_without_gradient(&fit.model, end * LN_10);
        let deviance = 2.0 * (fit.top.value - best);
        assert!((deviance - cut).abs() < 0.01, "{value}, {end}: {deviance} is not {cut}");
    }
}

#[test]
fn people_who_see_everything_or_guess_are_no_reason_to_stop() {
    let mut people: Vec<PersonAnswers> = (0..6).map(|index| person(0.54, 60, index)).collect();
    let without = MixedModel::new(people.clone(), KNOWN).fit().unwrap();
    people.push(PersonAnswers::new(0.5, (0..30).map(|trial| (-0.9 + 0.01 * f64::from(trial), true))));
    let with = MixedModel::new(people, KNOWN).fit().unwrap();
    let ratio = |fit: &MixedFit| Interval::of(fit, Quantity::MEDIAN).unwrap();
    assert!(ratio(&with).value > ratio(&without).value, "who sees what nobody else sees raises the ratio");
    assert!(with.parameters().between_sd > without.parameters().between_sd);
}

#[test]
fn answers_that_bound_nothing_are_refused_with_the_reason() {
    let all = |correct: bool| PersonAnswers::new(0.5, (0..30).map(move |trial| (-0.01 * f64::from(trial), correct)));
    let refusal = |people: Vec<PersonAnswers>| MixedModel::new(people, KNOWN).fit().unwrap_err().to_string();
    assert!(refusal(vec![person(0.5, 60, 1)]).contains("at least 2 people"));
    assert!(refusal(vec![all(true), all(true)]).contains("all 60 answers were correct"));
    assert!(refusal(vec![all(false), all(false)]).contains("all 60 answers were wrong"));
    let halves = PersonAnswers::new(0.5, (0..40).map(|trial| (-0.5, trial % 2 == 0)));
    let fit = MixedModel::new(vec![halves.clone(), halves], KNOWN).fit().unwrap();
    let message = Interval::of(&fit, Quantity::MEDIAN).unwrap_err().to_string();
    assert!(message.contains("do not bound the ratio"), "two people who guess: {message}");
}
