//! The maximum-likelihood fit against another program's numbers, and its refusals.
//!
//! `data/weibull_fit_data.csv`: 13 levels, two alternatives, 90 answers each, from psignifit's
//! documentation. `data/weibull_fit_reference.json`: its fit by SciPy, checked against psignifit 4.3.

#![allow(clippy::unwrap_used, reason = "a test stops at what it did not expect, in helpers too")]

use std::{io::Write, path::Path};

use scumble_analysis::{Count, Model, Parameter, Unidentified, Weibull, fit, fit_count_table, read_count_table};

fn data(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

fn table(text: &str) -> tempfile::NamedTempFile {
    let mut file = tempfile::NamedTempFile::new().unwrap();
    file.write_all(text.as_bytes()).unwrap();
    file
}

#[test]
fn the_fit_equals_scipy_within_1e_5() {
    let reference = std::fs::read_to_string(data("weibull_fit_reference.json")).unwrap();
    let reference: serde_json::Value = serde_json::from_str(&reference).unwrap();
    let reference = reference["lapse fixed .01"].as_object().unwrap();

    let counts = read_count_table(&data("weibull_fit_data.csv")).unwrap();
    let fitted = fit_count_table(&counts, 0.5, Parameter::Fixed(0.01)).unwrap();
    let fitted = serde_json::to_value(fitted).unwrap();
    for (key, expected) in reference {
        let (found, expected) = (fitted[key].as_f64().unwrap(), expected.as_f64().unwrap());
        assert!((found - expected).abs() < 1e-5, "{key}: {found} is not {expected}");
    }
}

#[test]
fn a_free_lapse_rate_is_at_least_as_likely_and_stays_in_its_range() {
    let counts = read_count_table(&data("weibull_fit_data.csv")).unwrap();
    let fixed = fit_count_table(&counts, 0.5, Parameter::Fixed(0.01)).unwrap();
    let free = fit_count_table(&counts, 0.5, Parameter::Free).unwrap();
    assert!(free.nll <= fixed.nll + 1e-9, "{free:?} against {fixed:?}");
    assert!((0.0..=0.2).contains(&free.lapse), "{free:?}");
    assert!(free.se_t.is_finite() && free.se_beta.unwrap().is_finite());
}

#[test]
fn exact_expected_counts_give_back_the_function_that_made_them() {
    for (location, slope, guess, lapse) in [(-0.5, 3.5, 0.5, 0.005), (1.2, 1.5, 0.0, 0.02), (0.0, 8.0, 0.25, 0.0)] {
        let truth = Weibull { location, slope, guess, lapse };
        let counts: Vec<Count> = (-20..=20)
            .map(|step| location + f64::from(step) * 0.05)
            .map(|x| Count { x, correct: 1000.0 * truth.correct(x), total: 1000.0 })
            .collect();
        let model = Model { guess, lapse: Parameter::Fixed(lapse), slope: Parameter::Free };
        let fitted = fit(&counts, &model).unwrap();
        assert!((fitted.weibull.location - location).abs() < 1e-7, "{fitted:?}");
        assert!((fitted.weibull.slope - slope).abs() < 1e-6, "{fitted:?}");
        assert!(fitted.deviance.abs() < 1e-6, "{fitted:?}");
    }
}

#[test]
fn the_estimate_moves_with_the_levels() {
    let counts = read_count_table(&data("weibull_fit_data.csv")).unwrap();
    let shifted: Vec<Count> = counts.iter().map(|count| Count { x: count.x + 3.0, ..*count }).collect();
    let here = fit_count_table(&counts, 0.5, Parameter::Fixed(0.01)).unwrap();
    let there = fit_count_table(&shifted, 0.5, Parameter::Fixed(0.01)).unwrap();
    assert!((there.threshold_t - here.threshold_t - 3.0).abs() < 1e-9);
    assert!((there.se_t - here.se_t).abs() < 1e-9);
}

#[test]
fn data_that_bound_nothing_are_refused_with_the_reason() {
    let row = |x, correct, total| Count { x, correct, total };
    let fixed = Model { guess: 0.5, lapse: Parameter::Fixed(0.005), slope: Parameter::Fixed(3.5) };
    let free = Model { slope: Parameter::Free, ..fixed };
    let cases = [
        (vec![], fixed, Unidentified::NoAnswers),
        (vec![row(0.0, 10.0, 10.0)], fixed, Unidentified::AllCorrect { total: 10.0 }),
        (vec![row(0.0, 0.0, 10.0)], fixed, Unidentified::AllWrong { total: 10.0 }),
        (vec![row(0.0, 5.0, 10.0), row(0.1, 5.0, 10.0)], fixed, Unidentified::NoUpperBound),
        (vec![row(0.0, 30.0, 31.0), row(0.1, 5.0, 5.0)], fixed, Unidentified::NoLowerBound),
        (vec![row(0.0, 80.0, 100.0)], free, Unidentified::OneLevel),
    ];
    for (counts, model, reason) in cases {
        assert_eq!(fit(&counts, &model), Err(reason));
    }
}

#[test]
fn a_jump_from_guessing_to_certainty_has_no_slope() {
    let counts = [Count { x: 0.0, correct: 50.0, total: 100.0 }, Count { x: 1.0, correct: 100.0, total: 100.0 }];
    let refusal = fit_count_table(&counts, 0.5, Parameter::Fixed(0.0)).unwrap_err().to_string();
    assert!(refusal.contains("do not bound the slope"), "{refusal}");
}

#[test]
fn every_damage_to_a_table_is_named_with_its_line() {
    let cases = [
        ("level,n_correct,n_total\n0.1,3,5\n0.2,4", "line 3: the row has 2 cells"),
        ("level,n_correct,n_total\n0.1,3,5\nNaN,4,5\n", "line 3: level is NaN"),
        ("level,n_correct,n_total\n0.1,x,5\n", "line 2"),
        ("level,n_correct,n_total\n0.1,6,5\n", "line 2: n_correct is 6 of n_total 5"),
        ("level,n_correct,n_total\n-1,3,5\n", "line 2: level is -1"),
        ("level,n_correct,n_total\n", "line 2: the table has no row"),
        ("", "line 1: column level is missing"),
        ("level,right,n_total\n0.1,3,5\n", "line 1: column n_correct is missing"),
    ];
    for (text, expected) in cases {
        let file = table(text);
        let refusal = read_count_table(file.path()).unwrap_err().to_string();
        assert!(refusal.contains(expected), "{text:?}: {refusal}");
        assert!(refusal.contains(file.path().to_str().unwrap()) && !refusal.contains('\n'));
    }
    let refusal = read_count_table(Path::new("no/such.csv")).unwrap_err().to_string();
    assert!(refusal.contains("no/such.csv"), "{refusal}");
}
