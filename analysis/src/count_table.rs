//! A table of correct answers per level, and its psychometric function (command `threshold`).
//!
//! Columns `level,n_correct,n_total`; the fit works on `x = log10(level)`.

use std::path::Path;

use serde::Serialize;

use crate::{
    Error,
    maximum_likelihood::{Count, Fitted, Model, Parameter, most_likely},
};

/// Share of correct answers that defines the reported threshold `x82` (Kreuzer 2017, 4.2).
pub const CORRECT_AT_THRESHOLD: f64 = 0.82;

/// Largest count: beyond it a typing error is likelier than an experiment.
const COUNT_LARGEST: f64 = 1e9;

/// Levels between which the search for a location is fine enough, with any unit.
const LEVELS: std::ops::RangeInclusive<f64> = 1e-12..=1e12;

/// Result of the command `threshold`; the fields are keys of its JSON.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CountTableFit {
    /// Location of the Weibull function, log10 of the level.
    pub threshold_t: f64,
    /// Slope per decade.
    pub slope_beta: f64,
    /// Lapse rate.
    pub lapse: f64,
    /// Guess rate.
    pub guess: f64,
    /// Negative log likelihood without binomial coefficients.
    pub nll: f64,
    /// Deviance against the saturated model.
    pub deviance: f64,
    /// log10 of the level at 82 % correct; `null` where the function never gets there.
    pub x82: Option<f64>,
    /// Standard error of `threshold_t`.
    pub se_t: f64,
    /// Standard error of `slope_beta`.
    pub se_beta: Option<f64>,
    /// Standard error of a free lapse rate; `null` for a fixed one or one at an end of its range.
    pub se_lapse: Option<f64>,
}

/// Reads a table of `level,n_correct,n_total`.
///
/// # Errors
/// Names file and line of the first cell that is not a level from 1e-12 to 1e12 or a pair of whole
/// numbers `0 <= n_correct <= n_total <= 1e9`.
pub fn read_count_table(path: &Path) -> Result<Vec<Count>, Error> {
    let mut counts = Vec::new();
    crate::table::read_rows(path, ["level", "n_correct", "n_total"], |_, [level, correct, total]| {
        if !LEVELS.contains(&level) {
            return Err(format!("level is {level}; allowed is a number above 0, from 1e-12 to 1e12"));
        }
        if !are_counts(correct, total) {
            return Err(not_counts(correct, total));
        }
        counts.push(Count { x: level.log10(), correct, total });
        Ok(())
    })?;
    Ok(counts)
}

/// Fits location and slope, and the lapse rate where it is free, to a table. Rows of one level are one.
///
/// # Errors
/// A guess or lapse rate out of range, a count that is no whole number, or data that leave the function open.
pub fn fit_count_table(counts: &[Count], guess: f64, lapse: Parameter) -> Result<CountTableFit, Error> {
    let model = model(guess, lapse)?;
    Ok(CountTableFit::of(&fit_pooled(&pooled(counts)?, &model)?))
}

/// The model of the command's options.
///
/// # Errors
/// A rate out of range.
pub(crate) fn model(guess: f64, lapse: Parameter) -> Result<Model, Error> {
    let in_range = |name, value: f64, below: f64, allowed| {
        let good = (0.0..below).contains(&value);
        let refusal = || Error::Argument { name, value: value.to_string(), allowed };
        good.then_some(()).ok_or_else(refusal)
    };
    in_range("--guess", guess, 0.8, "at least 0 and below 0.8")?;
    if let Parameter::Fixed(value) = lapse {
        in_range("--lapse", value, 0.2, "at least 0 and below 0.2, or the word free")?;
    }

    Ok(Model { guess, lapse, slope: Parameter::Free })
}

/// One row a level, in the order of levels, without levels that were never shown.
///
/// # Errors
/// A count that is no whole number from 0 to 1e9.
pub(crate) fn pooled(counts: &[Count]) -> Result<Vec<Count>, Error> {
    let mut rows = counts.to_vec();
    rows.sort_by(|a, b| a.x.total_cmp(&b.x));
    let mut pooled: Vec<Count> = Vec::new();
    for Count { x, correct, total } in rows {
        if !x.is_finite() || !are_counts(correct, total) {
            return Err(Error::CannotFit(format!("{} at x = {x}", not_counts(correct, total))));
        }
        match pooled.last_mut() {
            Some(last) if last.x == x => (last.correct, last.total) = (last.correct + correct, last.total + total),
            _ if total > 0.0 => pooled.push(Count { x, correct, total }),
            _ => {}
        }
    }
    Ok(pooled)
}

/// The most likely function of pooled counts.
///
/// # Errors
/// There is none.
pub(crate) fn fit_pooled(counts: &[Count], model: &Model) -> Result<Fitted, Error> {
    most_likely(counts, model).map_err(|reason| Error::CannotFit(reason.to_string()))
}

fn are_counts(correct: f64, total: f64) -> bool {
    let is_count = |value: f64| (0.0..=COUNT_LARGEST).contains(&value) && value.fract() == 0.0;
    is_count(correct) && is_count(total) && correct <= total
}

fn not_counts(correct: f64, total: f64) -> String {
    format!(
        "n_correct is {correct} of n_total {total}; allowed are whole numbers from 0 to 1e9, n_correct at most n_total"
    )
}

impl CountTableFit {
    pub(crate) fn of(fitted: &Fitted) -> Self {
        let weibull = fitted.weibull;
        Self {
            threshold_t: weibull.location,
            slope_beta: weibull.slope,
            lapse: weibull.lapse,
            guess: weibull.guess,
            nll: fitted.negative_log_likelihood,
            deviance: fitted.deviance,
            x82: weibull.x_at_correct(CORRECT_AT_THRESHOLD),
            se_t: fitted.location_se,
            se_beta: fitted.slope_se,
            se_lapse: fitted.lapse_se,
        }
    }
}
