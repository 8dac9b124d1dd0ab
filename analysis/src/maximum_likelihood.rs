//! Maximum-likelihood fit of a Weibull psychometric function to counts of correct answers.
//!
//! Minimises `-ln L = -sum k ln p(x) + (n - k) ln(1 - p(x))` over the location, and over slope and lapse where these
//! are free (the binomial coefficient is left out). Standard errors come from the inverse of the Hessian at the maximum
//! (observed information).
//!
//! A likelihood can keep growing towards `t -> -inf` (everything seen), `t -> +inf` (everything guessed) or `b -> inf`
//! (a jump): the data do not bound the parameter and there is no estimate. The fit says which of these happened instead
//! of returning the edge of its search range.

mod deviance;
mod place;
mod search;

pub(crate) use deviance::{constant_deviance, deviance};
pub use deviance::{deviance_residuals, log_likelihood};
pub(crate) use place::Place;
pub(crate) use search::{Maximum, Search};

use deviance::constant_log_likelihood;
use place::{LAPSE, PLACE, SLOPE};

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
    /// Standard error of the slope, where it was free and not at an end of its range.
    pub slope_se: Option<f64>,
    /// Standard error of the lapse rate, where it was free and not at an end of its range.
    pub lapse_se: Option<f64>,
}

/// Fits `model` to `counts` and refuses what the data do not bound on both sides.
///
/// # Errors
/// [`Unidentified`] when the data do not bound a parameter, or are no counts. The location counts as bounded when both
/// limits, everything seen and everything guessed, lie outside of its 95 % likelihood-ratio interval;
/// a free slope when both ends of [`SLOPE_RANGE`] do.
pub fn fit(counts: &[Count], model: &Model) -> Result<Fitted, Unidentified> {
    fit_within(counts, model, LIKELIHOOD_DROP_95)
}

/// The function of largest likelihood, whether or not its 95 % interval ends on both sides.
///
/// # Errors
/// [`Unidentified`] when there is none: a limit, everything seen, everything guessed or an end of [`SLOPE_RANGE`], is
/// just as likely; or the data are no counts.
pub fn most_likely(counts: &[Count], model: &Model) -> Result<Fitted, Unidentified> {
    fit_within(counts, model, 0.0)
}

/// Fits, and refuses where a limit is less than `drop` nats below the maximum.
fn fit_within(counts: &[Count], model: &Model, drop: f64) -> Result<Fitted, Unidentified> {
    let counts: Vec<Count> = counts.iter().copied().filter(|count| count.total != 0.0).collect();
    check_model(model)?;
    check_answers(&counts, model)?;
    let search = Search::of(model);
    let top = search.highest(&counts, None).ok_or(Unidentified::Impossible)?;
    if let Some(limit) = Limit::of(&counts, model, &top, drop) {
        return Err(limit.into());
    }
    summarise(&counts, &search, &top).ok_or(Unidentified::FlatLikelihood)
}

fn check_model(model: &Model) -> Result<(), Unidentified> {
    let Model { guess, lapse, slope } = *model;
    let lapse = if let Parameter::Fixed(lapse) = lapse { lapse } else { LAPSE_LARGEST };
    if !(guess >= 0.0 && lapse >= 0.0 && guess + lapse < 1.0) {
        return Err(Unidentified::Rates { guess, lapse });
    }
    match slope {
        Parameter::Fixed(slope) if !(slope > 0.0 && slope.is_finite()) => Err(Unidentified::SlopeRange { slope }),
        _ => Ok(()),
    }
}

/// Refuses what are no counts, data without two kinds of answers, or without two levels for a free slope.
fn check_answers(counts: &[Count], model: &Model) -> Result<(), Unidentified> {
    for &Count { x, correct, total } in counts {
        if !(x.is_finite() && correct >= 0.0 && correct <= total && total.is_finite()) {
            return Err(Unidentified::Count { x, correct, total });
        }
    }
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

/// Where a likelihood keeps growing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Limit {
    /// Everything is seen, the threshold is arbitrarily low.
    Seen,
    /// Everything is guessed, the threshold is arbitrarily high.
    Guessed,
    /// This end of [`SLOPE_RANGE`].
    Slope(f64),
}

impl From<Limit> for Unidentified {
    fn from(limit: Limit) -> Self {
        match limit {
            Limit::Seen => Self::NoLowerBound,
            Limit::Guessed => Self::NoUpperBound,
            Limit::Slope(slope) => Self::Slope { slope },
        }
    }
}

impl Limit {
    /// The limit that lies at most `drop` nats below `top`.
    fn of(counts: &[Count], model: &Model, top: &Maximum, drop: f64) -> Option<Self> {
        let is_near = |end: &f64| model.slope == Parameter::Free && Self::is_slope(*end, counts, model, top, drop);
        let slope = || SLOPE_RANGE.into_iter().find(is_near).map(Self::Slope);
        Self::constant(counts, model, top, drop).or_else(slope)
    }

    /// Whether the best function of slope `end` lies at most `drop` nats below `top`.
    pub(crate) fn is_slope(end: f64, counts: &[Count], model: &Model, top: &Maximum, drop: f64) -> bool {
        let held = Search { slope: Parameter::Fixed(end), ..Search::of(model) };
        held.highest(counts, Some(&top.weibull)).is_some_and(|found| top.is_within(drop, found.ln_likelihood))
    }

    /// The limit of a constant function that lies at most `drop` nats below `top`.
    pub(crate) fn constant(counts: &[Count], model: &Model, top: &Maximum, drop: f64) -> Option<Self> {
        let is_near = |probabilities| top.is_within(drop, constant_log_likelihood(counts, probabilities));
        if is_near(all_seen(counts, model)) {
            Some(Self::Seen)
        } else if is_near([model.guess, 1.0 - model.guess]) {
            Some(Self::Guessed)
        } else {
            None
        }
    }
}

/// Probabilities of a correct and of a wrong answer to what is seen always.
pub(crate) fn all_seen(counts: &[Count], model: &Model) -> [f64; 2] {
    let lapse = match model.lapse {
        Parameter::Fixed(lapse) => lapse,
        Parameter::Free => {
            let total: f64 = counts.iter().map(|count| count.total).sum();
            let wrong: f64 = counts.iter().map(|count| count.total - count.correct).sum();
            (wrong / total).clamp(0.0, LAPSE_LARGEST)
        }
    };
    [1.0 - lapse, lapse]
}

/// Precision and goodness of fit at the maximum; `None` when the likelihood is flat there.
fn summarise(counts: &[Count], search: &Search, top: &Maximum) -> Option<Fitted> {
    let (_, information, free) = search.derivatives(counts, &top.weibull)?;
    let covariance = information.cholesky()?.inverse();
    let error_of = |index: usize| free[index].then(|| covariance[(index, index)].sqrt());
    let (location_se, slope_se, lapse_se) = (error_of(PLACE)?, error_of(SLOPE), error_of(LAPSE));
    let finite = [Some(location_se), slope_se, lapse_se].into_iter().flatten().all(f64::is_finite);
    finite.then(|| Fitted {
        weibull: top.weibull,
        negative_log_likelihood: -top.ln_likelihood,
        deviance: deviance(counts, &top.weibull),
        location_se,
        slope_se,
        lapse_se,
    })
}
