//! One threshold per person and condition: the maximum-likelihood Weibull function at the slope,
//! guess and lapse rates of the protocol.
//!
//! The intensity is QUEST's, `x = log10(texel / radius) = -log10(ratio)`: the larger the radius, the
//! harder it is to find the line. QUEST mixes lapses with weight `delta`, so the upper asymptote
//! lies `delta (1 - guess)` below 1. The threshold is the ratio at the protocol's threshold probability.
//!
//! The slope is not fitted: 10 to 28 adaptive answers a condition sit at one or two intensities and
//! bound a location, not a slope. A wrong slope hardly moves the threshold, because QUEST places
//! its trials there, but it moves every other probability of detection.

use scumble_psychophysics::{Condition, Protocol};

use crate::{
    error::Unidentified,
    maximum_likelihood::{Count, Model, Parameter, fit},
    people::{Person, Track},
};

/// A threshold with its precision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Threshold {
    /// log10 of the ratio at the threshold, radius in texels.
    pub log10_ratio: f64,
    /// Standard error from the curvature of the likelihood, log10 units.
    pub standard_error_log10: f64,
}

impl Threshold {
    /// Radius in texels.
    pub fn ratio(&self) -> f64 {
        10_f64.powf(self.log10_ratio)
    }
}

/// What one person's answers say about one condition.
#[derive(Debug, Clone, PartialEq)]
pub struct ConditionThreshold {
    /// The person's code.
    pub person: String,
    /// Pattern, contrast and texel size.
    pub condition: Condition,
    /// Number of answers.
    pub trials: usize,
    /// Number of correct answers.
    pub correct: usize,
    /// Whether the experiment's own convergence rule held at the last trial.
    pub converged: bool,
    /// The threshold, or why the answers do not carry one.
    pub threshold: Result<Threshold, Unidentified>,
}

impl ConditionThreshold {
    /// Radius at threshold, pixels of the screen.
    pub fn radius_px(&self) -> Option<f64> {
        self.threshold.ok().map(|threshold| threshold.ratio() * self.condition.texel_px)
    }
}

/// Upper asymptote's distance from 1 in the protocol's psychometric function.
pub fn lapse_of(protocol: &Protocol) -> f64 {
    protocol.lapse_probability * (1.0 - protocol.guess_probability)
}

/// The thresholds of a person, one per track.
pub fn thresholds_of(person: &Person, protocol: &Protocol) -> Vec<ConditionThreshold> {
    person.tracks.iter().map(|track| threshold_of(&person.code, track, protocol)).collect()
}

/// One threshold of a person for a pattern at a contrast: all texel sizes in one likelihood, at one
/// ratio, which is the relation `r = c a` itself.
///
/// A maximum-likelihood location from `n` adaptive answers is off by a term of order `1 / n`: the mean of
/// three separate fits of 10 to 28 answers overstates the ratio by 5 %, the joint fit by less than 1 %
/// (simulated cohorts, `examples/coverage.rs`).
///
/// # Errors
/// Why the answers do not carry a threshold.
pub fn joint_threshold<'a>(
    tracks: impl IntoIterator<Item = &'a Track>,
    protocol: &Protocol,
) -> Result<Threshold, Unidentified> {
    let counts: Vec<Count> = tracks
        .into_iter()
        .flat_map(|track| &track.responses)
        .map(|&(x, correct)| Count { x, correct: f64::from(u8::from(correct)), total: 1.0 })
        .collect();
    let model = Model {
        guess: protocol.guess_probability,
        lapse: Parameter::Fixed(lapse_of(protocol)),
        slope: Parameter::Fixed(protocol.slope_per_log10),
    };
    let fitted = fit(&counts, &model)?;
    let x = fitted.weibull.x_at_correct(protocol.threshold_probability);
    let log10_ratio = -x.ok_or(Unidentified::FlatLikelihood)?;
    Ok(Threshold { log10_ratio, standard_error_log10: fitted.location_se })
}

fn threshold_of(person: &str, track: &Track, protocol: &Protocol) -> ConditionThreshold {
    ConditionThreshold {
        person: person.to_owned(),
        condition: track.condition,
        trials: track.responses.len(),
        correct: track.responses.iter().filter(|(_, correct)| *correct).count(),
        converged: track.converged,
        threshold: joint_threshold([track], protocol),
    }
}
