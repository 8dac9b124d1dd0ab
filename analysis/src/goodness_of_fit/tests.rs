//! The statistic by hand, and the p-value on people who obey the model and on people who do not.

#![allow(clippy::unwrap_used, reason = "a test stops at what it did not expect, in helpers too")]

use scumble_psychophysics::{Fatigue, ObserverModel, WeibullObserver};
use scumble_stimuli::Pattern;

use super::{answered::Half, *};
use crate::{Simulation, Study};

/// The step at full contrast with a number of trials a size.
fn protocol(trials: u32) -> Protocol {
    let mut protocol = Protocol::two_alternative();
    protocol.conditions.patterns = vec![Pattern::Step];
    protocol.conditions.contrasts = vec![1.0];
    (protocol.schedule.trials_min, protocol.schedule.trials_max) = (trials, trials);
    protocol
}

/// A study of people of several kinds.
fn study(seed: u64, trials: u32, kinds: &[(u32, WeibullObserver)]) -> Study {
    let of_kind = |(index, (observers, person)): (usize, &(u32, WeibullObserver))| {
        let median = ObserverModel::Weibull(*person);
        let seed = 100 * seed + index as u64;
        let simulation =
            Simulation { protocol: protocol(trials), observers: *observers, seed, median, between_sd_log10: 0.1 };
        simulation.study().unwrap().people
    };
    Study::of(protocol(trials), kinds.iter().enumerate().flat_map(of_kind).collect()).unwrap()
}

fn goodness(study: &Study) -> GoodnessOfFit {
    let series = Series::of(study.protocol.rounds()[0], &study.people, &study.protocol).unwrap();
    GoodnessOfFit::of(&series, &study.people, &study.protocol).unwrap()
}

#[test]
fn the_sum_and_the_drift_are_the_hand_computed_ones() {
    let band = |right, expected, variance| Band { answers: 10.0, right, expected, variance };
    // (3 - 5)^2 / 2.5 + (7 - 6)^2 / 2 + one slip where 0.05 were expected: (9 - 9.95)^2 over the coin's 1/4.
    let bands = [band(3.0, 5.0, 2.5), band(7.0, 6.0, 2.0), band(9.0, 9.95, 0.05)];
    let counted = Counted { bands, halves: [band(8.0, 9.5, 2.0), band(11.0, 9.5, 2.0)] };
    assert!((counted.chi_square() - (1.6 + 0.5 + 0.9025 / 0.25)).abs() < 1e-12);
    assert!((counted.drift() - 1.5).abs() < 1e-12, "3 more over a standard deviation of 2");
}

#[test]
fn an_answer_is_in_the_band_of_its_detection_at_the_persons_threshold_and_in_the_half_of_its_time() {
    // No spread between people: everyone's threshold is the median's.
    let shared = MixedParameters { log10_ratio: 0.5, between_sd: 1e-6, slope: 3.5, blind_share: 0.0 };
    // Detection 1 - 0.36^(10^(3.5 d)): 0.64 at the threshold, 0.4 at half the exponent, 0.95 at three times it.
    let at = |factor: f64| -0.5 + f64::log10(factor) / 3.5;
    let half = |index| Some(Half::of(index, 3));
    let answers = vec![(at(0.5), false, half(0)), (at(1.0), true, half(1)), (at(3.0), true, half(2))];
    let answered = Answered { guess: 0.5, answers };
    let counted = Counted::of(&answered, &answered.gathered(), &shared);
    let expected = [0.4, 0.64, 1.0 - 0.36_f64.powi(3)].map(|detected| 0.5 + 0.5 * detected);
    for (band, (expected, right)) in counted.bands.iter().zip(expected.into_iter().zip([0.0, 1.0, 1.0])) {
        assert_eq!((band.answers, band.right), (1.0, right));
        assert!((band.expected - expected).abs() < 1e-4, "{band:?} expects {expected}");
        assert!((band.variance - expected * (1.0 - expected)).abs() < 1e-4);
    }
    let [early, late] = counted.halves;
    assert_eq!((early.answers, early.right, late.answers, late.right), (1.0, 0.0, 2.0, 2.0));
}

#[test]
fn equal_data_give_equal_numbers_and_the_parts_add_up() {
    let study = study(1, 20, &[(6, WeibullObserver::default())]);
    let found = goodness(&study);
    assert_eq!(found, goodness(&study));
    assert_eq!((found.cohorts, found.parts.len()), (COHORTS, 6));
    assert!((found.parts.iter().map(|(_, part)| part).sum::<f64>() - found.chi_square).abs() < 1e-9);
    let answers: f64 = found.bands.iter().map(|band| band.answers).sum();
    assert_eq!(answers as usize, study.trial_count());
}

#[test]
fn the_answers_tested_are_those_that_were_fitted() {
    let simulation = Simulation {
        protocol: Protocol::named("yes-no").unwrap(),
        observers: 3,
        seed: 4,
        median: ObserverModel::default(),
        between_sd_log10: 0.1,
    };
    let study = simulation.study().unwrap();
    let round = study.protocol.rounds()[0];
    let series = Series::of(round, &study.people, &study.protocol).unwrap();
    for ((fitted, _), person) in series.fit.thresholds().zip(&study.people) {
        assert_eq!(*fitted, Answered::of(round, person, &study.protocol).gathered());
    }
}

/// Largest distance of the distribution of `values` from the uniform one.
fn kolmogorov(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let count = values.len() as f64;
    let distance =
        |(index, p): (usize, &f64)| (p - index as f64 / count).abs().max((p - (index + 1) as f64 / count).abs());
    values.iter().enumerate().map(distance).fold(0.0, f64::max)
}

#[test]
fn both_p_are_uniform_for_cohorts_that_obey_the_model() {
    // Any slope and share of blind trials that everyone shares obeys it.
    let found: Vec<GoodnessOfFit> = (0..30)
        .map(|seed| {
            let (slope_per_log10, lapse_probability) = [(3.5, 0.01), (2.0, 0.05)][seed as usize % 2];
            let person = WeibullObserver { slope_per_log10, lapse_probability, ..WeibullObserver::default() };
            goodness(&study(seed, 20, &[(8, person)]))
        })
        .collect();
    // 99 % quantile of Kolmogorov's distance at n = 30.
    let most = 1.63 / 30.0_f64.sqrt();
    for values in [|fit: &GoodnessOfFit| fit.p_value, |fit: &GoodnessOfFit| fit.drift_p_value] {
        let values: Vec<f64> = found.iter().map(values).collect();
        assert!(kolmogorov(values.clone()) < most, "{values:?}");
    }
}

#[test]
fn people_who_differ_in_lapses_or_slope_scatter_more_than_the_model() {
    let person = WeibullObserver::default();
    let lapsing = WeibullObserver { lapse_probability: 0.3, ..person };
    let (flat, steep) =
        (WeibullObserver { slope_per_log10: 1.0, ..person }, WeibullObserver { slope_per_log10: 10.0, ..person });
    for kinds in [[(8, person), (8, lapsing)], [(8, flat), (8, steep)]] {
        let values: Vec<f64> = (0..4).map(|seed| goodness(&study(seed, 40, &kinds)).p_value).collect();
        // Under the model the mean of four is below 0.2 once in sixty times.
        assert!(values.iter().sum::<f64>() < 4.0 * 0.2, "{values:?}");
    }
}

#[test]
fn people_who_learn_or_tire_drift_and_the_sign_says_which() {
    for fall in [0.4, -0.4] {
        let fatigue = Fatigue { threshold_fall_log10_per_100_trials: fall, ..Fatigue::default() };
        let person = WeibullObserver { fatigue, ..WeibullObserver::default() };
        let found = goodness(&study(1, 20, &[(20, person)]));
        // A ratio that falls is a person who stops seeing: late answers are wrong more often.
        assert!(found.drift_p_value < 0.05 && found.drift * fall < 0.0, "{fall}: {found:?}");
    }
}
