//! How far off the estimates are: QUEST's against published-style simulations, and both procedures
//! against what their own posteriors say.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use scumble_psychophysics::{Psychometric, Staircase, StaircaseConfig};

const CURVE: Psychometric = Psychometric { beta: 3.5, delta: 0.01, gamma: 0.5, threshold_probability: 0.82 };

/// The staircase after each number of trials in `checkpoints`, placed by itself and answered by a
/// person of this curve and threshold.
fn run(start: &Staircase, curve: &Psychometric, truth: f64, checkpoints: &[usize], seed: u64) -> Vec<(f64, f64)> {
    let mut staircase = start.clone();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut found = Vec::new();
    for trial in 1..=checkpoints[checkpoints.len() - 1] {
        let intensity = staircase.placement();
        let right = curve.probability(intensity - truth) > random.random();
        staircase.update(intensity, right).unwrap();
        if checkpoints.contains(&trial) {
            found.push((staircase.mean(), staircase.sd()));
        }
    }
    found
}

/// Standard deviation and its standard error `sqrt((m4 - sd^4) / n) / (2 sd)`.
fn sd_and_error(values: &[f64]) -> (f64, f64) {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let moment = |order| values.iter().map(|value| (value - mean).powi(order)).sum::<f64>() / count;
    let (variance, fourth) = (moment(2), moment(4));
    (variance.sqrt(), ((fourth - variance * variance) / count).sqrt() / (2.0 * variance.sqrt()))
}

#[test]
fn the_standard_error_of_an_sd_is_the_closed_form_on_known_moments() {
    // 1, -1 in equal parts: m4 = sd^4 = 1, error 0. 0, 0, 0, 2, -2 ...: variance 8/5, m4 32/5.
    assert_eq!(sd_and_error(&[1.0, -1.0, 1.0, -1.0]), (1.0, 0.0));
    let (sd, error) = sd_and_error(&[0.0, 0.0, 0.0, 2.0, -2.0]);
    assert!((sd - 1.6f64.sqrt()).abs() < 1e-12);
    assert!((error - ((6.4 - 2.56) / 5.0f64).sqrt() / (2.0 * 1.6f64.sqrt())).abs() < 1e-12);
}

#[test]
fn quest_is_0_21_0_14_and_0_066_log10_off_after_10_20_and_40_trials() {
    // A person as QUEST assumes, 0.30 above the centre of a prior with SD 1; the mean's SD over runs.
    // The expected figures are of a simulation of about 1,000 runs, whose standard errors were 0.013,
    // 0.010 and 0.007 (those of 4,000 runs here, doubled).
    const RUNS: u64 = 4000;
    let start = StaircaseConfig { prior_sd_log10: 1.0, ..StaircaseConfig::quest() }.staircase(0.0).unwrap();
    let runs: Vec<_> = (0..RUNS).map(|seed| run(&start, &CURVE, 0.3, &[10, 20, 40], seed)).collect();
    for (at, expected) in [0.21, 0.14, 0.066].into_iter().enumerate() {
        let estimates: Vec<f64> = runs.iter().map(|run| run[at].0).collect();
        let (sd, error) = sd_and_error(&estimates);
        let both_errors = (error * error + 4.0 * error * error).sqrt();
        assert!((sd - expected).abs() < 3.0 * both_errors, "{sd} +- {error} instead of {expected}");
        // No bias beyond what the prior's pull leaves after 10 trials, 5 % of its SD.
        let bias = estimates.iter().sum::<f64>() / RUNS as f64 - 0.3;
        assert!(bias.abs() < [0.05, 0.02, 0.01][at], "{bias}");
    }
}

/// Mean squared error over mean posterior variance, with its standard error, over people drawn from
/// the prior itself: 1 for a posterior that is right.
fn calibration(start: &Staircase, curves: &[Psychometric], trials: usize, runs: u64) -> (f64, f64) {
    let steps = start.threshold_posterior().len() as f64 - 1.0;
    let (lowest, highest) = start.table_range();
    let ratios = (0..runs).map(|seed| {
        let mut random = ChaCha8Rng::seed_from_u64(seed + 1_000_000);
        let uniform: f64 = random.random();
        let mut sum = 0.0;
        let place = start.threshold_posterior().iter().position(|weight| {
            sum += weight;
            sum > uniform
        });
        let truth = lowest + (highest - lowest) * place.unwrap() as f64 / steps;
        let curve = curves[random.random_range(0..curves.len())];
        let (mean, sd) = run(start, &curve, truth, &[trials], seed)[0];
        ((mean - truth) * (mean - truth), sd * sd)
    });
    let ratios: Vec<(f64, f64)> = ratios.collect();
    let variance = ratios.iter().map(|(_, variance)| variance).sum::<f64>() / runs as f64;
    let ratios: Vec<f64> = ratios.iter().map(|(squared_error, _)| squared_error / variance).collect();
    let (sd, _) = sd_and_error(&ratios);
    (ratios.iter().sum::<f64>() / runs as f64, sd / (runs as f64).sqrt())
}

#[test]
fn over_people_drawn_from_its_prior_quests_squared_error_is_its_posterior_variance() {
    let start = StaircaseConfig::quest().staircase(0.0).unwrap();
    let (ratio, error) = calibration(&start, &[CURVE], 15, 4000);
    assert!(error < 0.15 && (ratio - 1.0).abs() < 3.0 * error, "{ratio} +- {error}");
    // A person who is flatter than QUEST assumes is further off than the posterior says.
    let (ratio, error) = calibration(&start, &[Psychometric { beta: 1.0, ..CURVE }], 15, 1000);
    assert!(ratio - 1.0 > 3.0 * error, "{ratio} +- {error}");
}

#[test]
fn over_people_drawn_from_its_prior_quest_pluss_squared_error_is_its_posterior_variance() {
    let config = StaircaseConfig {
        table_step_log10: 0.05,
        slopes_per_log10: vec![2.0, 4.0],
        lapse_probabilities: vec![0.01, 0.1],
        ..StaircaseConfig::quest_plus()
    };
    let curve = |beta, delta| Psychometric { beta, delta, ..CURVE };
    let curves = [curve(2.0, 0.01), curve(2.0, 0.1), curve(4.0, 0.01), curve(4.0, 0.1)];
    let (ratio, error) = calibration(&config.staircase(0.0).unwrap(), &curves, 15, 1000);
    assert!(error < 0.2 && (ratio - 1.0).abs() < 3.0 * error, "{ratio} +- {error}");
}
