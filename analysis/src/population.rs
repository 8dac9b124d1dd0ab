//! From the median person's threshold to the ratio that hides the texels from most viewers.
//!
//! `log10 c(v, d) = m + z(v) s + log10(w(d0) / w(d)) / b` with `w(d) = -ln(1 - d / (1 - e))`.
//!
//! `v` share of viewers, `d` probability that one of them sees the artifact on a trial, `d0` detection at the threshold
//! (0.64 at 82 % correct), `z` normal quantile; `m`, `s`, `b`, `e` of the [mixed model](crate::MixedModel), from which the
//! interval comes as well: every ratio is profiled by itself, so that what the answers leave open of spread, slope
//! and blind trials is in it. Detection counts blind trials as unseen, so that `d = (p - guess) / (1 - guess)` of the
//! answers that are correct.
//!
//! Assumes log-normal thresholds: far quantiles (99 % of viewers) lean on that, not on data.

use std::f64::consts::LN_10;

use statrs::distribution::{ContinuousCDF, Normal};

use crate::{
    Error,
    mixed_model::{Interval, MixedFit, Profiled, Quantity},
};

/// Shares of viewers for which a ratio is reported.
pub const VIEWERS: [f64; 4] = [0.50, 0.90, 0.95, 0.99];

/// Detection probabilities for which a ratio is reported: Kreuzer's threshold (82 % correct with
/// two alternatives, seen on 64 % of trials), and seen on one trial in ten.
pub const DETECTIONS: [f64; 2] = [0.64, 0.10];

/// A group of people.
#[derive(Debug, Clone, PartialEq)]
pub struct Population {
    /// log10 of the standard deviation between people, log10 units; without a lower end where none is possible.
    pub log10_between_sd: Profiled,
    /// log10 of the slope of the psychometric function.
    pub log10_slope: Profiled,
    /// Ratios of all [`DETECTIONS`] x [`VIEWERS`].
    pub curve: Vec<PopulationPoint>,
}

/// The ratio that hides the artifact from `viewers` at `detection`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PopulationPoint {
    /// Share of viewers who see the artifact at most that often.
    pub viewers: f64,
    /// Probability of seeing it on one trial.
    pub detection: f64,
    /// Ratio, radius in texels.
    pub ratio: f64,
    /// Standard error of the ratio: what its interval is wide, by Student's quantile.
    pub standard_error: f64,
    /// 95 % interval of the ratio.
    pub ci95: [f64; 2],
}

impl Population {
    /// The population behind a fit.
    ///
    /// # Errors
    /// The answers do not bound one of the ratios.
    pub fn of(fit: &MixedFit) -> Result<Self, Error> {
        let points = DETECTIONS.iter().flat_map(|&detection| VIEWERS.iter().map(move |&viewers| (viewers, detection)));
        Ok(Self {
            log10_between_sd: fit.interval(Quantity::Log10BetweenSd)?,
            log10_slope: fit.interval(Quantity::Log10Slope)?,
            curve: points
                .map(|(viewers, detection)| PopulationPoint::of(fit, viewers, detection))
                .collect::<Result<_, Error>>()?,
        })
    }

    /// A point of the curve.
    pub fn point(&self, viewers: f64, detection: f64) -> Option<&PopulationPoint> {
        self.curve.iter().find(|point| (point.viewers, point.detection) == (viewers, detection))
    }
}

impl PopulationPoint {
    /// The ratio for `viewers` and `detection`, both inside 0..1, `viewers` at least one half.
    ///
    /// # Errors
    /// Names the argument that is out of range; the answers do not bound the ratio.
    pub fn of(fit: &MixedFit, viewers: f64, detection: f64) -> Result<Self, Error> {
        check("viewers", viewers, (0.5..1.0).contains(&viewers), "at least 0.5 and below 1")?;
        let allowed = "above 0 and below the share of trials that are looked at";
        check("detection", detection, detection > 0.0 && detection < 1.0 - fit.parameters().blind_share, allowed)?;
        let quantity = Quantity::Log10Ratio { z: Normal::standard().inverse_cdf(viewers), detection };
        let Interval { value, ci95, standard_error } = Interval::of(fit, quantity)?;
        let ratio = 10_f64.powf(value);
        Ok(Self {
            viewers,
            detection,
            ratio,
            standard_error: ratio * LN_10 * standard_error,
            ci95: ci95.map(|limit| 10_f64.powf(limit)),
        })
    }
}

fn check(name: &'static str, value: f64, good: bool, allowed: &'static str) -> Result<(), Error> {
    if good {
        return Ok(());
    }
    Err(Error::Argument { name, value: value.to_string(), allowed })
}
