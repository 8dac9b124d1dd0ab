//! Defects of a widespread port of QUEST, each of which fails a session or bends a result there.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use scumble_psychophysics::{PlacementRule, Quest, QuestConfig, Shown};

const CONFIG: QuestConfig = QuestConfig {
    t_guess: -0.5,
    t_guess_sd: 0.6,
    p_threshold: 0.82,
    beta: 3.5,
    delta: 0.01,
    gamma: 0.5,
    grain: 0.01,
    range: 5.0,
    placement: PlacementRule::Quantile,
};

fn prior() -> Quest {
    Quest::new(CONFIG).unwrap()
}

#[test]
fn an_intensity_one_grain_outside_the_table_counts_as_its_end() {
    for (end, beyond) in [(2.0, 2.01), (-3.0, -3.01)] {
        for response in [true, false] {
            let (mut at_end, mut outside) = (prior(), prior());
            assert_eq!(at_end.update(end, response).unwrap(), Shown::OnTable);
            assert_eq!(outside.update(beyond, response).unwrap(), Shown::OffTable);
            assert_eq!(at_end, outside);
        }
    }
}

#[test]
fn the_probability_outside_the_table_is_that_of_its_end_and_never_wraps_round() {
    let quest = prior();
    for beyond in [5.0, 5.01, 7.5, 1e300, f64::INFINITY] {
        assert!((quest.probability(beyond) - 0.995).abs() < 1e-12, "{beyond}");
        assert!((quest.probability(-beyond) - 0.5).abs() < 1e-12, "-{beyond}");
    }
    assert!((quest.probability(0.0) - 0.82).abs() < 1e-4);
    assert!(quest.probability(f64::NAN).is_nan());
}

#[test]
fn the_tabulated_probability_rises_and_is_the_closed_form_between_its_points() {
    let quest = prior();
    let offsets = (-6000..=6000).map(|i| f64::from(i) * 0.001);
    let found: Vec<f64> = offsets.clone().map(|offset| quest.probability(offset)).collect();
    assert!(found.is_sorted());
    for (offset, found) in offsets.zip(found) {
        // Linear interpolation over 0.01 log10: an eighth of the step squared times the curvature.
        assert!((found - CONFIG.psychometric().probability(offset)).abs() < 3e-4, "{offset}");
    }
}

#[test]
fn an_intensity_that_is_not_a_number_is_refused_and_changes_nothing() {
    for intensity in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut quest = prior();
        let error = quest.update(intensity, true).unwrap_err().to_string();
        assert!(error.starts_with("intensity is") && error.ends_with("allowed is a finite number"), "{error}");
        assert_eq!(quest, prior());
    }
}

#[test]
fn a_prior_without_spread_is_refused_by_name() {
    for t_guess_sd in [0.0, -0.6, f64::NAN, f64::INFINITY] {
        let error = Quest::new(QuestConfig { t_guess_sd, ..CONFIG }).unwrap_err().to_string();
        assert!(error.starts_with("tGuessSd is"), "{error}");
    }
}

#[test]
fn a_threshold_below_guessing_is_refused_where_others_change_gamma() {
    for gamma in [0.82, 0.9] {
        let error = Quest::new(QuestConfig { gamma, ..CONFIG }).unwrap_err().to_string();
        assert!(error.starts_with("threshold probability is 0.82"), "{error}");
    }
}

#[test]
fn quest_learns_from_the_intensity_shown_and_not_from_its_placement() {
    let (mut shown, mut placed) = (prior(), prior());
    let placement = prior().placement();
    shown.update(placement + 0.5, true).unwrap();
    placed.update(placement, true).unwrap();
    assert!(shown.mean() > placed.mean() + 0.05);
}

#[test]
fn shifting_guess_and_intensities_shifts_every_summary() {
    // A shift by whole steps of a power of two, so that the sums are exact but for rounding.
    for shift in [-3.25, 0.5, 12.0] {
        let mut here = Quest::new(QuestConfig { grain: 1.0 / 64.0, ..CONFIG }).unwrap();
        let mut there =
            Quest::new(QuestConfig { grain: 1.0 / 64.0, t_guess: CONFIG.t_guess + shift, ..CONFIG }).unwrap();
        for trial in 0..50 {
            let intensity = here.placement();
            here.update(intensity, trial % 4 != 0).unwrap();
            there.update(intensity + shift, trial % 4 != 0).unwrap();
            assert!((there.mean() - here.mean() - shift).abs() < 1e-12);
            assert!((there.mode() - here.mode() - shift).abs() < 1e-12);
            assert!((there.placement() - here.placement() - shift).abs() < 1e-12);
            assert!((there.sd() - here.sd()).abs() < 1e-12);
        }
    }
}

#[test]
fn a_simulated_response_is_right_where_the_probability_exceeds_the_random_number() {
    let quest = prior();
    for (intensity, threshold) in [(0.3, 0.1), (-0.2, 0.4), (0.0, 0.0)] {
        let probability = quest.probability(intensity - threshold);
        assert!(quest.simulate(intensity, threshold, probability - 1e-9).unwrap());
        assert!(!quest.simulate(intensity, threshold, probability).unwrap());
    }
    // Clamped to the table: certain but for slips far above, guessing far below.
    assert!(quest.simulate(1e9, 0.0, 0.994).unwrap() && !quest.simulate(1e9, 0.0, 0.996).unwrap());
    assert!(quest.simulate(-1e9, 0.0, 0.499).unwrap() && !quest.simulate(-1e9, 0.0, 0.501).unwrap());
}

#[test]
fn a_simulation_refuses_what_is_no_number_and_no_random_number() {
    let quest = prior();
    for (name, [intensity, threshold, uniform]) in [
        ("intensity", [f64::NAN, 0.0, 0.5]),
        ("threshold", [0.0, f64::INFINITY, 0.5]),
        ("uniform", [0.0, 0.0, 1.0]),
        ("uniform", [0.0, 0.0, -0.1]),
        ("uniform", [0.0, 0.0, f64::NAN]),
    ] {
        let error = quest.simulate(intensity, threshold, uniform).unwrap_err().to_string();
        assert!(error.starts_with(&format!("{name} is")), "{error}");
    }
}
