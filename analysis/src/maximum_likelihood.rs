//! Maximum-likelihood fit of a Weibull psychometric function to counts of correct answers.
//!
//! Minimises `-ln L = -sum k ln p(x) + (n - k) ln(1 - p(x))` over the location, and over slope and lapse where these
//! are free (the binomial coefficient is left out). Start: the best point of a coarse grid. Then Newton steps with the
//! analytic Hessian, damped until the likelihood grows (Levenberg). Standard errors come from the inverse of the
//! Hessian at the maximum (observed information).
//!
//! A likelihood can keep growing towards `t -> -inf` (everything seen), `t -> +inf` (everything guessed) or `b -> inf`
//! (a jump): the data do not bound the parameter and there is no estimate. The fit says which of these happened instead
//! of returning the edge of its search range.

use std::f64::consts::LN_10;

use nalgebra::{DMatrix, DVector};

use crate::{error::Unidentified, weibull::Weibull};

/// Correct answers at one intensity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Count {
    /// Intensity, log10 units.
    pub x: f64,
    /// Number of correct answers.
    pub correct: f64,
    /// Number of answers.
    pub total: f64,
}

/// A parameter that is given, or found by the fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Parameter {
    /// Keeps this value.
    Fixed(f64),
    /// Found by the fit.
    Free,
}

/// What is known before the fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Model {
    /// Guess rate, always known: it is one over the number of alternatives.
    pub guess: f64,
    /// Lapse rate; a free one is sought between 0 and [`LAPSE_LARGEST`].
    pub lapse: Parameter,
    /// Slope per decade; a free one is sought between [`SLOPE_RANGE`]'s ends.
    pub slope: Parameter,
}

/// Largest lapse rate that a fit may find: above it the upper asymptote and the threshold trade places.
pub const LAPSE_LARGEST: f64 = 0.2;

/// Slopes per decade that a fit may find. Published slopes lie between 1 and 10; at 100 the function is a jump.
pub const SLOPE_RANGE: [f64; 2] = [0.1, 100.0];

/// Half of the 95 % quantile of chi-squared with one degree of freedom: a likelihood-ratio interval ends where `ln L`
/// fell by this much.
pub const LIKELIHOOD_DROP_95: f64 = 1.920_729_410_347_062;

/// A fitted psychometric function with its precision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fitted {
    /// The function of largest likelihood.
    pub weibull: Weibull,
    /// `-ln L` without binomial coefficients.
    pub negative_log_likelihood: f64,
    /// Twice the log likelihood ratio against the saturated model.
    pub deviance: f64,
    /// Standard error of the location, log10 units.
    pub location_se: f64,
    /// Standard error of the slope, where it was free.
    pub slope_se: Option<f64>,
    /// Standard error of the lapse rate, where it was free and not at an end of its range.
    pub lapse_se: Option<f64>,
}

/// Fits `model` to `counts` (finite intensities, `0 <= correct <= total`, `0 < guess + lapse < 1`).
///
/// # Errors
/// [`Unidentified`] when the data do not bound a parameter. The location counts as bounded when both
/// limits, everything seen and everything guessed, lie outside of its 95 % likelihood-ratio interval;
/// a free slope when both ends of [`SLOPE_RANGE`] do.
pub fn fit(counts: &[Count], model: &Model) -> Result<Fitted, Unidentified> {
    let counts: Vec<Count> = counts.iter().copied().filter(|count| count.total > 0.0).collect();
    check_answers(&counts, model)?;

    let start = best_of_grid(&counts, model);
    let mut best = climb(&counts, start, free_parameters(model));

    // A lapse rate that runs to an end of its range stays there, and the others are found again.
    let mut free = free_parameters(model);
    if free[LAPSE] && (best.lapse <= 0.0 || best.lapse >= LAPSE_LARGEST) {
        free[LAPSE] = false;
        best = climb(&counts, best, free);
    }
    check_bounded(&counts, &best, model)?;
    summarise(&counts, best, free).ok_or(Unidentified::FlatLikelihood)
}

/// Index of the lapse rate in the parameter vector (location, slope, lapse).
const LAPSE: usize = 2;

fn free_parameters(model: &Model) -> [bool; 3] {
    [true, model.slope == Parameter::Free, model.lapse == Parameter::Free]
}

/// Refuses data without two kinds of answers, or without two levels for a free slope.
fn check_answers(counts: &[Count], model: &Model) -> Result<(), Unidentified> {
    let total: f64 = counts.iter().map(|count| count.total).sum();
    let correct: f64 = counts.iter().map(|count| count.correct).sum();
    if total == 0.0 {
        return Err(Unidentified::NoAnswers);
    }
    if correct == total {
        return Err(Unidentified::AllCorrect { total });
    }
    if correct == 0.0 {
        return Err(Unidentified::AllWrong { total });
    }
    let one_level = counts.iter().all(|count| count.x == counts[0].x);
    if one_level && model.slope == Parameter::Free {
        return Err(Unidentified::OneLevel);
    }
    Ok(())
}

/// The most likely of a coarse set of functions: locations every 0.05 from one decade below the data to one above, five
/// slopes, three lapse rates.
fn best_of_grid(counts: &[Count], model: &Model) -> Weibull {
    let lowest = counts.iter().map(|count| count.x).fold(f64::INFINITY, f64::min) - 1.0;
    let highest = counts.iter().map(|count| count.x).fold(f64::NEG_INFINITY, f64::max) + 1.0;
    let steps = ((highest - lowest) / 0.05).ceil().min(2000.0);
    let slopes = candidates(model.slope, &[1.0, 2.0, 3.5, 6.0, 12.0]);
    let lapses = candidates(model.lapse, &[0.001, 0.02, 0.08]);
    let mut best =
        (f64::NEG_INFINITY, Weibull { location: lowest, slope: slopes[0], guess: model.guess, lapse: lapses[0] });
    for step in 0..=steps as usize {
        for &slope in &slopes {
            for &lapse in &lapses {
                let location = lowest + (highest - lowest) * step as f64 / steps;
                let weibull = Weibull { location, slope, guess: model.guess, lapse };
                let likelihood = log_likelihood(counts, &weibull);
                if likelihood > best.0 {
                    best = (likelihood, weibull);
                }
            }
        }
    }
    best.1
}

fn candidates(parameter: Parameter, grid: &[f64]) -> Vec<f64> {
    match parameter {
        Parameter::Fixed(value) => vec![value],
        Parameter::Free => grid.to_vec(),
    }
}

/// Damped Newton ascent over the free parameters, until a full step changes nothing.
fn climb(counts: &[Count], start: Weibull, free: [bool; 3]) -> Weibull {
    let mut weibull = start;
    let mut likelihood = log_likelihood(counts, &weibull);
    let mut damping = 0.0;
    for _ in 0..200 {
        let (gradient, information) = derivatives(counts, &weibull, free);
        let scale = information.diagonal().map(|curvature| curvature.abs().max(1e-9));
        let damped = &information + DMatrix::from_diagonal(&(scale * damping));
        let candidate =
            damped.cholesky().map(|factor| factor.solve(&gradient)).and_then(|step| moved(weibull, &step, free));
        let reached = candidate.map_or(f64::NEG_INFINITY, |candidate| log_likelihood(counts, &candidate));
        match candidate {
            Some(candidate) if reached >= likelihood => {
                let settled = (candidate.location - weibull.location).abs() < 1e-13
                    && (candidate.slope - weibull.slope).abs() < 1e-12
                    && (candidate.lapse - weibull.lapse).abs() < 1e-14;
                (weibull, likelihood) = (candidate, reached);
                damping = if damping < 1e-6 { 0.0 } else { damping * 0.1 };
                if settled {
                    break;
                }
            }
            _ => damping = if damping == 0.0 { 1e-3 } else { damping * 10.0 },
        }
        if damping > 1e12 {
            break;
        }
    }
    weibull
}

/// `weibull` moved by `step` and kept in range; `None` when the step is not finite.
fn moved(mut weibull: Weibull, step: &DVector<f64>, free: [bool; 3]) -> Option<Weibull> {
    let mut steps = step.iter().copied();
    if free[0] {
        weibull.location += steps.next()?;
    }
    if free[1] {
        weibull.slope = (weibull.slope + steps.next()?).clamp(SLOPE_RANGE[0], SLOPE_RANGE[1]);
    }
    if free[LAPSE] {
        weibull.lapse = (weibull.lapse + steps.next()?).clamp(0.0, LAPSE_LARGEST);
    }
    (weibull.location.is_finite() && weibull.slope.is_finite()).then_some(weibull)
}

/// Refuses a location or a slope that only the search range keeps finite.
fn check_bounded(counts: &[Count], best: &Weibull, model: &Model) -> Result<(), Unidentified> {
    let reached = log_likelihood(counts, best);
    let everything_seen = constant_log_likelihood(counts, 1.0 - best.lapse);
    let everything_guessed = constant_log_likelihood(counts, best.guess);
    if reached - everything_seen < LIKELIHOOD_DROP_95 {
        return Err(Unidentified::NoLowerBound);
    }
    if reached - everything_guessed < LIKELIHOOD_DROP_95 {
        return Err(Unidentified::NoUpperBound);
    }
    if model.slope == Parameter::Free {
        for slope in SLOPE_RANGE {
            let fixed = Model { slope: Parameter::Fixed(slope), ..*model };
            let at_limit = climb(counts, best_of_grid(counts, &fixed), free_parameters(&fixed));
            if reached - log_likelihood(counts, &at_limit) < LIKELIHOOD_DROP_95 {
                return Err(Unidentified::Slope { slope });
            }
        }
    }
    Ok(())
}

/// Precision and goodness of fit at the maximum; `None` when the likelihood is flat there.
fn summarise(counts: &[Count], weibull: Weibull, free: [bool; 3]) -> Option<Fitted> {
    let (_, information) = derivatives(counts, &weibull, free);
    let covariance = information.cholesky()?.inverse();
    let mut errors = covariance.diagonal().iter().map(|variance| variance.sqrt()).collect::<Vec<_>>().into_iter();
    let mut error_of = |index: usize| free[index].then(|| errors.next()).flatten();
    let (location_se, slope_se, lapse_se) = (error_of(0)?, error_of(1), error_of(LAPSE));
    let fitted = log_likelihood(counts, &weibull);
    let saturated: f64 = counts.iter().map(|count| bernoulli(count, count.correct / count.total)).sum();
    location_se.is_finite().then_some(Fitted {
        weibull,
        negative_log_likelihood: -fitted,
        deviance: 2.0 * (saturated - fitted),
        location_se,
        slope_se,
        lapse_se,
    })
}

/// `k ln p + (n - k) ln(1 - p)`, with `0 ln 0 = 0`.
fn bernoulli(count: &Count, p: f64) -> f64 {
    let term = |weight: f64, probability: f64| if weight == 0.0 { 0.0 } else { weight * probability.ln() };
    term(count.correct, p) + term(count.total - count.correct, 1.0 - p)
}

fn constant_log_likelihood(counts: &[Count], p: f64) -> f64 {
    counts.iter().map(|count| bernoulli(count, p)).sum()
}

/// `ln L` without binomial coefficients.
pub fn log_likelihood(counts: &[Count], weibull: &Weibull) -> f64 {
    counts.iter().map(|count| bernoulli(count, weibull.correct(count.x))).sum()
}

/// Gradient of `ln L` and its negated Hessian over the free ones of (location, slope, lapse).
///
/// With `u = exp(v)`, `v = ln10 b (x - t)`, `A = 1 - g - l`: `dp = A exp(-u) du`, `d2p = A exp(-u) (d2u - du du')`,
/// `du = u dv`, `d2u = u (d2v + dv dv')`; in the lapse rate `dp/dl = -F`, `d2p/dl dq = -exp(-u) du/dq`.
fn derivatives(counts: &[Count], weibull: &Weibull, free: [bool; 3]) -> (DVector<f64>, DMatrix<f64>) {
    let mut gradient = DVector::zeros(3);
    let mut information = DMatrix::zeros(3, 3);
    let amplitude = 1.0 - weibull.guess - weibull.lapse;
    for count in counts {
        // Beyond u = 700 the function is flat and exp(-u) is zero.
        let u = weibull.exponent(count.x).min(700.0);
        let unseen = (-u).exp();
        let dv = [-LN_10 * weibull.slope, LN_10 * (count.x - weibull.location)];
        let d2v = [[0.0, -LN_10], [-LN_10, 0.0]];
        let mut dp = DVector::zeros(3);
        let mut d2p = DMatrix::zeros(3, 3);
        for i in 0..2 {
            dp[i] = amplitude * unseen * u * dv[i];
            for j in 0..2 {
                d2p[(i, j)] = amplitude * unseen * u * (d2v[i][j] + dv[i] * dv[j] * (1.0 - u));
            }
            d2p[(i, LAPSE)] = -unseen * u * dv[i];
            d2p[(LAPSE, i)] = d2p[(i, LAPSE)];
        }
        dp[LAPSE] = -(1.0 - unseen);

        let p = weibull.correct(count.x);
        let ratio = |weight: f64, probability: f64| if weight == 0.0 { 0.0 } else { weight / probability };
        let (hit, miss) = (ratio(count.correct, p), ratio(count.total - count.correct, 1.0 - p));
        gradient += &dp * (hit - miss);
        information += &dp * dp.transpose() * (ratio(hit, p) + ratio(miss, 1.0 - p)) - d2p * (hit - miss);
    }
    let chosen: Vec<usize> = (0..3).filter(|&index| free[index]).collect();
    (gradient.select_rows(&chosen), information.select_rows(&chosen).select_columns(&chosen))
}
