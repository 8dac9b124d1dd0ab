//! 95 % intervals of one psychometric function by profile likelihood.
//!
//! A quantity, the location, the slope or the level of a share of correct answers, is held at a value while all else is
//! maximised. The interval holds the values whose `ln L` is within [`LIKELIHOOD_DROP_95`] of the largest (Wilks 1938): it
//! follows the likelihood's own shape, where an interval of standard errors is symmetric by force.

use crate::{
    Error,
    crossing::crossing,
    maximum_likelihood::{Count, LIKELIHOOD_DROP_95, Maximum, Model, Parameter, Place, SLOPE_RANGE, Search},
};

/// Farthest that an end is sought beyond the levels shown, decades: what lies farther, the answers do not bound.
pub(crate) const FARTHEST: f64 = 3.0;

/// Distance at which an end is looked for first, standard errors: where it is if the likelihood is normal.
const FIRST: f64 = 2.0;

/// Precision of an end, standard errors.
const PRECISION: f64 = 1e-6;

/// A place's 95 % interval, log10 units, around `value` of standard error about `error`; an end is `None` where the answers
/// do not bound it within [`FARTHEST`].
///
/// # Errors
/// The search for an end failed.
pub(crate) fn place_interval(
    counts: &[Count],
    model: &Model,
    top: &Maximum,
    place: Place,
    (value, error): (f64, f64),
) -> Result<[Option<f64>; 2], Error> {
    let lowest = counts.iter().map(|count| count.x).fold(f64::INFINITY, f64::min) - FARTHEST;
    let highest = counts.iter().map(|count| count.x).fold(f64::NEG_INFINITY, f64::max) + FARTHEST;
    let held = |there| Search { place, at: Parameter::Fixed(there), ..Search::of(model) };
    let low = end(counts, top, |distance| held(value - distance), error, value - lowest)?;
    let high = end(counts, top, |distance| held(value + distance), error, highest - value)?;
    Ok([low.map(|distance| value - distance), high.map(|distance| value + distance)])
}

/// The slope's 95 % interval, per decade, its standard error being about `error`; an end is `None` where the answers do not
/// bound it within [`SLOPE_RANGE`].
///
/// # Errors
/// The search for an end failed.
pub(crate) fn slope_interval(
    counts: &[Count],
    model: &Model,
    top: &Maximum,
    error: f64,
) -> Result<[Option<f64>; 2], Error> {
    let slope = top.weibull.slope;
    let held = |slope| Search { slope: Parameter::Fixed(slope), ..Search::of(model) };
    // In ln slope the likelihood is closer to normal.
    let (error, [least, most]) = (error / slope, SLOPE_RANGE);
    let low = end(counts, top, |factor| held(slope * (-factor).exp()), error, (slope / least).ln())?;
    let high = end(counts, top, |factor| held(slope * factor.exp()), error, (most / slope).ln())?;
    Ok([low.map(|factor| slope * (-factor).exp()), high.map(|factor| slope * factor.exp())])
}

/// The distance at which the profile has fallen by [`LIKELIHOOD_DROP_95`].
fn end(
    counts: &[Count],
    top: &Maximum,
    held: impl Fn(f64) -> Search,
    error: f64,
    farthest: f64,
) -> Result<Option<f64>, Error> {
    // Close to linear in the distance.
    let beyond = |distance: f64| {
        let drop = held(distance)
            .highest(counts, Some(&top.weibull))
            .map_or(f64::INFINITY, |found| top.ln_likelihood - found.ln_likelihood);
        Ok(drop.clamp(0.0, DROP_MOST).sqrt() - LIKELIHOOD_DROP_95.sqrt())
    };
    crossing(beyond, FIRST * error, farthest, PRECISION * error)
}

/// Drop beyond which a value is as good as impossible; finite, so that a secant through it is.
const DROP_MOST: f64 = 1e6;
