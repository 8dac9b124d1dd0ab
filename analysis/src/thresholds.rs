//! One threshold per person and condition: the maximum-likelihood Weibull function at the slope,
//! guess and lapse rates that [`Assumptions`] name.
//!
//! The intensity is QUEST's, `x = log10(texel / radius) = -log10(ratio)`: the larger the radius, the
//! harder it is to tell an artifact from a line. The threshold is the ratio at which the artifact is seen in
//! the share of trials that the protocol's threshold stands for, whatever the person's guess rate.
//!
//! The slope is not a person's own: 10 to 36 adaptive answers a condition sit at one or two intensities and
//! bound a location, not a slope. It is everyone's, of the mixed model. A wrong slope hardly moves the threshold,
//! because QUEST places its trials there.

use scumble_psychophysics::{Condition, Protocol, Round};

use crate::{
    assumptions::Assumptions,
    error::Unidentified,
    maximum_likelihood::{Count, fit},
    mixed_model::MixedParameters,
    people::{Person, Track},
    series::round_of,
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
    /// Pattern, contrast, kernel and texel size.
    pub condition: Condition,
    /// Number of answers.
    pub trials: usize,
    /// Number of correct answers.
    pub correct: usize,
    /// Number of staircases.
    pub staircases: usize,
    /// Number of them that met the experiment's own convergence rule at their last trial.
    pub converged: usize,
    /// Why the others did not, in sentences.
    pub unconverged: Vec<String>,
    /// The threshold, or why the answers do not carry one.
    pub threshold: Result<Threshold, Unidentified>,
}

impl ConditionThreshold {
    /// Radius at threshold, pixels of the screen.
    pub fn radius_px(&self) -> Option<f64> {
        self.threshold.ok().map(|threshold| threshold.ratio() * self.condition.texel_px)
    }
}

/// The thresholds of a person, one per track; `fitted` gives the mixed model of a round, where there is one.
pub fn thresholds_of(
    person: &Person,
    protocol: &Protocol,
    fitted: impl Fn(Round) -> Option<MixedParameters>,
) -> Vec<ConditionThreshold> {
    let known = Assumptions::of_person(person, protocol);
    let of_track = |track: &Track| {
        let known = fitted(round_of(&track.condition)).map_or(known, |fitted| known.with(&fitted));
        threshold_of(&person.code, track, &known)
    };
    person.tracks.iter().map(of_track).collect()
}

/// One threshold of a person for a pattern at a contrast under a kernel: all texel sizes in one likelihood, at one
/// ratio, which is the relation `r = c a` itself.
///
/// A maximum-likelihood location from `n` adaptive answers is off by a term of order `1 / n`: the mean of
/// three separate fits of 10 to 36 answers overstates the ratio by 5 %, the joint fit by less than 1 %
/// (simulated cohorts, `examples/coverage.rs`).
///
/// # Errors
/// Why the answers do not carry a threshold.
pub fn joint_threshold<'a>(
    tracks: impl IntoIterator<Item = &'a Track>,
    known: &Assumptions,
) -> Result<Threshold, Unidentified> {
    let counts: Vec<Count> = tracks
        .into_iter()
        .flat_map(Track::responses)
        .map(|(x, correct)| Count { x, correct: f64::from(u8::from(correct)), total: 1.0 })
        .collect();
    let fitted = fit(&counts, &known.model())?;
    let x = fitted.weibull.x_at_detection(known.seen_at_threshold());
    let log10_ratio = -x.ok_or(Unidentified::FlatLikelihood)?;
    Ok(Threshold { log10_ratio, standard_error_log10: fitted.location_se })
}

fn threshold_of(person: &str, track: &Track, known: &Assumptions) -> ConditionThreshold {
    ConditionThreshold {
        person: person.to_owned(),
        condition: track.condition,
        trials: track.responses().count(),
        correct: track.responses().filter(|(_, correct)| *correct).count(),
        staircases: track.runs.len(),
        converged: track.converged(),
        unconverged: track.runs.iter().flat_map(|run| &run.unconverged).map(ToString::to_string).collect(),
        threshold: joint_threshold([track], known),
    }
}
