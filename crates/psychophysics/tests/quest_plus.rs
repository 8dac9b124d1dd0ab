//! QUEST+ against a computation by brute force and against QUEST.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use scumble_psychophysics::{
    PlacementRule, Psychometric, Quest, QuestConfig, QuestPlus, QuestPlusConfig, Staircase, StaircaseConfig,
};

/// 41 thresholds, 3 slopes, 2 lapses and 41 intensities.
fn small() -> QuestPlusConfig {
    QuestPlusConfig {
        prior_centre_log10: 0.2,
        prior_sd_log10: 0.5,
        threshold_probability: 0.75,
        guess_probability: 0.5,
        slopes_per_log10: vec![2.0, 3.5, 6.0],
        lapse_probabilities: vec![0.0, 0.08],
        table_step_log10: 0.05,
        table_width_log10: 2.0,
    }
}

fn after(responses: &[(f64, bool)]) -> QuestPlus {
    let mut quest_plus = QuestPlus::new(small()).unwrap();
    for (intensity, response) in responses {
        quest_plus.update(*intensity, *response).unwrap();
    }
    quest_plus
}

const RESPONSES: [(f64, bool); 8] =
    [(0.2, true), (0.0, true), (-0.2, false), (0.35, true), (0.1, false), (0.5, true), (0.3, false), (0.9, true)];

/// Probability of a response 1 for every slope, lapse and threshold at an intensity, each through a
/// QUEST of its own.
fn successes(intensity: f64) -> Vec<f64> {
    let config = small();
    let mut successes = Vec::new();
    for beta in &config.slopes_per_log10 {
        for delta in &config.lapse_probabilities {
            let quest = Quest::new(quest_config(&config, *beta, *delta)).unwrap();
            successes.extend(quest.thresholds().map(|threshold| quest.probability(intensity - threshold)));
        }
    }
    successes
}

fn quest_config(config: &QuestPlusConfig, beta: f64, delta: f64) -> QuestConfig {
    QuestConfig {
        t_guess: config.prior_centre_log10,
        t_guess_sd: config.prior_sd_log10,
        p_threshold: config.threshold_probability,
        beta,
        delta,
        gamma: config.guess_probability,
        grain: config.table_step_log10,
        range: config.table_width_log10,
        placement: PlacementRule::Quantile,
    }
}

fn entropy(weights: &[f64]) -> f64 {
    weights.iter().filter(|p| **p > 0.0).map(|p| -p * p.ln()).sum()
}

/// Entropy that is expected after a response at `intensity`: both posteriors made and summed.
fn expected_entropy(quest_plus: &QuestPlus, intensity: f64) -> f64 {
    let successes = successes(intensity);
    [true, false]
        .map(|response| {
            let joint = quest_plus.posterior().iter().zip(&successes);
            let joint: Vec<f64> = joint.map(|(w, p)| w * if response { *p } else { 1.0 - p }).collect();
            let probability: f64 = joint.iter().sum();
            let posterior: Vec<f64> = joint.iter().map(|w| w / probability).collect();
            probability * entropy(&posterior)
        })
        .iter()
        .sum()
}

fn intensities() -> impl Iterator<Item = f64> {
    (0..41).map(|i| 0.2 + (f64::from(i) - 20.0) * 0.05)
}

#[test]
fn the_information_of_every_intensity_is_the_expected_loss_of_entropy_by_brute_force() {
    for trials in 0..=RESPONSES.len() {
        let quest_plus = after(&RESPONSES[..trials]);
        let now = entropy(quest_plus.posterior());
        for intensity in intensities() {
            let expected = now - expected_entropy(&quest_plus, intensity);
            let found = quest_plus.information(intensity);
            assert!((found - expected).abs() < 1e-12, "{trials} {intensity}: {found} instead of {expected}");
        }
    }
}

#[test]
fn the_placement_is_the_intensity_of_the_least_expected_entropy() {
    for trials in 0..=RESPONSES.len() {
        let quest_plus = after(&RESPONSES[..trials]);
        let best = intensities()
            .map(|intensity| (intensity, expected_entropy(&quest_plus, intensity)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap();
        assert!((quest_plus.placement() - best.0).abs() < 1e-12, "{trials}");
    }
}

#[test]
fn the_posterior_is_bayes_rule_and_its_marginals_are_its_sums() {
    let quest_plus = after(&RESPONSES);
    let mut weights = QuestPlus::new(small()).unwrap().posterior().to_vec();
    for (intensity, response) in RESPONSES {
        let success = successes(intensity);
        weights.iter_mut().zip(success).for_each(|(w, p)| *w *= if response { p } else { 1.0 - p });
    }
    let total: f64 = weights.iter().sum();
    let expected: Vec<f64> = weights.iter().map(|w| w / total).collect();
    for (found, expected) in quest_plus.posterior().iter().zip(&expected) {
        assert!((found - expected).abs() < 1e-13);
    }
    let sum = |keep: &dyn Fn(usize) -> bool| {
        expected.iter().enumerate().filter(|(i, _)| keep(*i)).map(|(_, w)| w).sum::<f64>()
    };
    for (t, found) in quest_plus.threshold_posterior().iter().enumerate() {
        assert!((found - sum(&|i| i % 41 == t)).abs() < 1e-13);
    }
    for (s, found) in quest_plus.slope_posterior().iter().enumerate() {
        assert!((found - sum(&|i| i / 82 == s)).abs() < 1e-13);
    }
    for (l, found) in quest_plus.lapse_posterior().iter().enumerate() {
        assert!((found - sum(&|i| i / 41 % 2 == l)).abs() < 1e-13);
    }
    let slope: f64 = small().slopes_per_log10.iter().zip(quest_plus.slope_posterior()).map(|(v, w)| v * w).sum();
    assert!((quest_plus.mean_slope_per_log10() - slope).abs() < 1e-13);
    assert!((quest_plus.mean_lapse_probability() - 0.08 * quest_plus.lapse_posterior()[1]).abs() < 1e-13);
}

#[test]
fn with_one_slope_and_one_lapse_the_posterior_is_quests() {
    let config = QuestPlusConfig {
        slopes_per_log10: vec![3.5],
        lapse_probabilities: vec![0.01],
        table_step_log10: 0.01,
        table_width_log10: 5.0,
        ..small()
    };
    let mut quest = Quest::new(quest_config(&config, 3.5, 0.01)).unwrap();
    let mut quest_plus = QuestPlus::new(config).unwrap();
    for trial in 0..60 {
        // Off the steps of the table, and off the table now and then.
        let intensity = if trial % 10 == 9 { 4.0 } else { quest.placement() };
        quest.update(intensity, trial % 4 != 0).unwrap();
        quest_plus.update(intensity, trial % 4 != 0).unwrap();
        assert_eq!(quest_plus.posterior(), quest.posterior());
        assert_eq!((quest_plus.mean(), quest_plus.sd()), (quest.mean(), quest.sd()));
        assert_eq!(quest_plus.quantile(0.9), quest.quantile(0.9));
    }
}

#[test]
fn a_prior_much_wider_than_the_table_is_uniform() {
    let uniform = QuestPlus::new(QuestPlusConfig { prior_sd_log10: 1e9, ..small() }).unwrap();
    assert!(uniform.threshold_posterior().iter().all(|weight| (weight - 1.0 / 41.0).abs() < 1e-12));
}

#[test]
fn a_shifted_configuration_is_placed_a_shift_away() {
    let shift = 1.5;
    let mut here = QuestPlus::new(small()).unwrap();
    let mut there =
        QuestPlus::new(QuestPlusConfig { prior_centre_log10: small().prior_centre_log10 + shift, ..small() }).unwrap();
    for trial in 0..20 {
        let (a, b) = (here.placement(), there.placement());
        assert!((b - a - shift).abs() < 1e-12);
        here.update(a, trial % 3 != 0).unwrap();
        there.update(b, trial % 3 != 0).unwrap();
        assert!((there.mean() - here.mean() - shift).abs() < 1e-12);
    }
}

#[test]
fn slope_and_lapse_are_found_from_expected_responses() {
    // 100 responses at each of 7 intensities in the proportions of a slope of 3.5 and a lapse of 0.1.
    let truth = Psychometric { beta: 3.5, delta: 0.1, gamma: 0.5, threshold_probability: 0.82 };
    let Staircase::QuestPlus(mut quest_plus) = StaircaseConfig::quest_plus().staircase(0.0).unwrap() else {
        panic!("another method")
    };
    for intensity in [-0.4, -0.2, 0.0, 0.1, 0.2, 0.4, 1.0] {
        let right = (100.0 * truth.probability(intensity)).round() as usize;
        for trial in 0..100 {
            quest_plus.update(intensity, trial < right).unwrap();
        }
    }
    assert!(quest_plus.mean().abs() < 0.02, "{}", quest_plus.mean());
    assert!((quest_plus.mean_slope_per_log10() - 3.5).abs() < 0.5, "{}", quest_plus.mean_slope_per_log10());
    assert!((quest_plus.mean_lapse_probability() - 0.1).abs() < 0.015, "{}", quest_plus.mean_lapse_probability());
}

#[test]
fn ten_thousand_responses_leave_a_distribution() {
    let mut quest_plus = QuestPlus::new(small()).unwrap();
    for trial in 0..10_000 {
        quest_plus.update(0.2, trial % 5 != 0).unwrap();
    }
    let total: f64 = quest_plus.posterior().iter().sum();
    assert!((total - 1.0).abs() < 1e-12 && quest_plus.sd().is_finite() && quest_plus.placement().is_finite());
}

#[test]
fn what_is_refused_changes_nothing() {
    let mut quest_plus = after(&RESPONSES);
    for intensity in [f64::NAN, f64::INFINITY] {
        assert!(quest_plus.update(intensity, true).unwrap_err().to_string().starts_with("intensity is"));
    }
    assert_eq!(quest_plus, after(&RESPONSES));
    let error = QuestPlus::new(QuestPlusConfig { prior_centre_log10: f64::NAN, ..small() }).unwrap_err().to_string();
    assert!(error.starts_with("prior_centre_log10 is NaN"), "{error}");
}

#[test]
fn an_intensity_half_a_step_off_the_best_costs_at_most_a_twentieth_of_the_information() {
    // On a table of 0.01, after the responses of a person at 0.
    let config = QuestPlusConfig {
        slopes_per_log10: vec![3.5],
        lapse_probabilities: vec![0.01],
        table_step_log10: 0.01,
        table_width_log10: 5.0,
        ..small()
    };
    let mut quest_plus = QuestPlus::new(config).unwrap();
    for trial in 0..20 {
        let intensity = quest_plus.placement();
        quest_plus.update(intensity, trial % 5 != 0).unwrap();
        let information: Vec<f64> = (-200..=200).map(|i| quest_plus.information(f64::from(i) * 0.01)).collect();
        let (best, most) = information.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).unwrap();
        for off in [best - 3, best + 3] {
            assert!(information[off] > 0.95 * most, "{trial}: {} of {most}", information[off]);
        }
    }
}
