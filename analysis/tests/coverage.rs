//! What the documented table promises, on a few cohorts of every run: no bias to speak of, and intervals that cover.
//! `examples/coverage` prints the whole table.

#![allow(dead_code, reason = "the table prints more of an outcome than is asserted")]
#![allow(clippy::unwrap_used, reason = "a test stops at what it did not expect, in helpers too")]

#[path = "../examples/coverage/cohort.rs"]
mod cohort;

use cohort::{Cell, Outcome, RATIO};
use scumble_psychophysics::{Protocol, WeibullObserver};

/// Cohorts a cell: the table has 400.
const COHORTS: u64 = 60;
/// Of 60 intervals that cover with 95 %, fewer than these cover once in 300 times; of ones that cover with 80 %, more do once
/// in 30.
const COVERED_LEAST: usize = 52;

/// Bias in log10 over its standard error, and how many intervals cover.
fn measured(cell: &Cell, first_seed: u64) -> (f64, usize) {
    let outcomes = cell.outcomes(COHORTS, first_seed);
    assert_eq!(outcomes.len() as u64, COHORTS, "no cohort is refused");
    let count = COHORTS as f64;
    let mean = outcomes.iter().map(|outcome| outcome.error_log10).sum::<f64>() / count;
    let variance = outcomes.iter().map(|outcome| (outcome.error_log10 - mean).powi(2)).sum::<f64>() / (count - 1.0);
    (mean / (variance / count).sqrt(), outcomes.iter().filter(|outcome| outcome.covers()).count())
}

fn cell(people: u32, trials: u32, protocol: &str, person: WeibullObserver) -> Cell {
    Cell { name: "", people, trials, protocol: Protocol::named(protocol).unwrap(), person }
}

#[test]
fn few_people_with_few_trials_are_unbiased_and_covered() {
    let (bias, covered) = measured(&cell(10, 10, "two-alternative", WeibullObserver::default()), 51_001);
    assert!(bias.abs() < 3.0 && covered >= COVERED_LEAST, "{bias} standard errors, {covered} of {COHORTS}");
}

#[test]
fn people_of_another_slope_than_the_protocols_are_covered() {
    let flat = WeibullObserver { slope_per_log10: 2.0, ..WeibullObserver::default() };
    let (bias, covered) = measured(&cell(10, 20, "two-alternative", flat), 52_001);
    assert!(bias.abs() < 3.0 && covered >= COVERED_LEAST, "{bias} standard errors, {covered} of {COHORTS}");
}

#[test]
fn counted_false_alarms_do_not_bias() {
    let (bias, covered) = measured(&cell(10, 20, "yes-no", WeibullObserver::default()), 53_001);
    assert!(bias.abs() < 3.0 && covered >= COVERED_LEAST, "{bias} standard errors, {covered} of {COHORTS}");
}

#[test]
fn an_interval_that_is_too_narrow_is_found() {
    let outcomes = cell(10, 10, "two-alternative", WeibullObserver::default()).outcomes(COHORTS, 54_001);
    let half_as_wide = |outcome: &Outcome| {
        let [low, high] = outcome.ci95;
        let quarter = 0.25 * (high - low);
        (low + quarter..=high - quarter).contains(&RATIO.log10())
    };
    assert!(outcomes.into_iter().filter(half_as_wide).count() < COVERED_LEAST);
}
