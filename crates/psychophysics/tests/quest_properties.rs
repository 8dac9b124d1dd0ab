//! What QUEST promises beyond the tables: probability rules, degenerate input, long sequences.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use proptest::prelude::*;
use scumble_psychophysics::{Error, PlacementRule, Quest, QuestConfig, Shown};

/// Kreuzer 2017's parameters with a prior of 3 texels.
fn config() -> QuestConfig {
    QuestConfig {
        t_guess: -0.477,
        t_guess_sd: 0.6,
        p_threshold: 0.82,
        beta: 3.5,
        delta: 0.01,
        gamma: 0.5,
        grain: 0.01,
        range: 5.0,
        placement: PlacementRule::Quantile,
    }
}

fn prior() -> Quest {
    Quest::new(config()).unwrap()
}

#[test]
fn the_prior_is_the_normal_distribution_on_the_table() {
    let quest = prior();
    let total: f64 = quest.posterior().iter().sum();
    assert!((total - 1.0).abs() < 1e-14);
    assert!((quest.mean() - config().t_guess).abs() < 1e-13);
    // Variance of the normal distribution truncated at z = 2.5 / 0.6 = 4.1667, closed form
    // 1 - 2 z pdf(z) / (1 - 2 (1 - cdf(z))); cdf(-z) = 1.5454e-5.
    let z: f64 = 2.5 / 0.6;
    let density = (-z * z / 2.0).exp() / std::f64::consts::TAU.sqrt();
    let variance = 1.0 - 2.0 * z * density / (1.0 - 2.0 * 1.5454e-5);
    assert!((quest.sd() / 0.6 - variance.sqrt()).abs() < 2e-5);
}

#[test]
fn the_priors_median_lies_half_a_step_below_the_guess() {
    let median = prior().quantile(0.5);
    assert!((median - (config().t_guess - config().grain / 2.0)).abs() < 1e-12);
}

#[test]
fn a_right_answer_lowers_the_threshold_and_a_wrong_one_raises_it() {
    let mut right = prior();
    let mut wrong = prior();
    right.update(prior().placement(), true).unwrap();
    wrong.update(prior().placement(), false).unwrap();
    assert!(right.mean() < prior().mean() && prior().mean() < wrong.mean());
}

#[test]
fn an_intensity_that_is_not_a_number_is_refused_and_changes_nothing() {
    let mut quest = prior();
    for intensity in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = quest.update(intensity, true).unwrap_err();
        assert!(matches!(error, Error::Parameter { .. }));
        assert!(error.to_string().contains("allowed is a finite number"));
    }
    assert_eq!(quest, prior());
}

#[test]
fn an_intensity_off_the_table_counts_as_the_tables_end_and_is_reported() {
    let end = config().t_guess + config().range / 2.0;
    let mut at_end = prior();
    let mut beyond = prior();
    assert_eq!(at_end.update(end, false).unwrap(), Shown::OnTable);
    assert_eq!(beyond.update(1e300, false).unwrap(), Shown::OffTable);
    assert_eq!(at_end, beyond);
}

#[test]
fn an_impossible_response_is_refused_and_changes_nothing() {
    let sure = QuestConfig { delta: 0.0, gamma: 0.0, p_threshold: 0.5, beta: 1e3, ..config() };
    let mut quest = Quest::new(sure).unwrap();
    quest.update(sure.t_guess - 2.5, true).unwrap();
    let before = quest.clone();
    let error = quest.update(sure.t_guess + 2.5, false).unwrap_err();
    assert!(matches!(error, Error::ImpossibleResponse { .. }));
    assert_eq!(quest, before);
}

#[test]
fn ten_thousand_responses_leave_a_distribution() {
    let mut quest = prior();
    for trial in 0..10_000 {
        quest.update(quest.placement(), trial % 5 != 0).unwrap();
    }
    let total: f64 = quest.posterior().iter().sum();
    assert!((total - 1.0).abs() < 1e-12);
    assert!(quest.sd() > 0.0 && quest.sd() < 0.02);
    assert!(quest.placement().is_finite());
}

#[test]
fn quantiles_of_orders_outside_0_to_1_are_those_of_the_ends() {
    let quest = prior();
    assert_eq!(quest.quantile(-1.0), quest.quantile(0.0));
    assert_eq!(quest.quantile(2.0), quest.quantile(1.0));
    assert!((quest.quantile(0.0) - (config().t_guess - 2.5)).abs() < 1e-12);
    assert!((quest.quantile(1.0) - (config().t_guess + 2.5)).abs() < 0.02);
}

#[test]
fn the_posterior_is_bayes_rule_with_the_closed_form_likelihood() {
    let mut quest = prior();
    // On a table point, so that nothing is rounded.
    let intensity = config().t_guess + 0.3;
    quest.update(intensity, false).unwrap();
    let likelihood = |threshold: f64| 1.0 - config().psychometric().probability(intensity - threshold);
    let expected: Vec<f64> =
        prior().thresholds().zip(prior().posterior()).map(|(threshold, prior)| prior * likelihood(threshold)).collect();
    let total: f64 = expected.iter().sum();
    for (found, expected) in quest.posterior().iter().zip(expected) {
        // The tabulated x_threshold is 4e-6 off the closed form, beta ln 10 = 8 times that in p.
        assert!((found - expected / total).abs() < 1e-4 * found.max(1e-6));
    }
}

proptest! {
    #[test]
    fn the_order_of_the_responses_does_not_matter(
        responses in prop::collection::vec((-2.0f64..1.0, any::<bool>()), 1..30)
    ) {
        let mut forward = prior();
        let mut backward = prior();
        for (intensity, response) in &responses {
            forward.update(*intensity, *response).unwrap();
        }
        for (intensity, response) in responses.iter().rev() {
            backward.update(*intensity, *response).unwrap();
        }
        for (a, b) in forward.posterior().iter().zip(backward.posterior()) {
            prop_assert!((a - b).abs() < 1e-12);
        }
    }

    #[test]
    fn the_posterior_stays_a_distribution_with_ordered_quantiles(
        responses in prop::collection::vec((-1e6f64..1e6, any::<bool>()), 0..60)
    ) {
        let mut quest = prior();
        for (intensity, response) in responses {
            quest.update(intensity, response).unwrap();
            let total: f64 = quest.posterior().iter().sum();
            prop_assert!((total - 1.0).abs() < 1e-12);
            prop_assert!(quest.posterior().iter().all(|p| (0.0..=1.0).contains(p)));
            let quantiles = [0.05, 0.25, 0.5, 0.75, 0.95].map(|order| quest.quantile(order));
            prop_assert!(quantiles.is_sorted());
            let half = config().range / 2.0 + 1e-9;
            prop_assert!((quest.mean() - config().t_guess).abs() <= half);
        }
    }
}
