//! When a staircase is done.
//!
//! The posterior's spread says how well the responses fix the threshold *if the prior and the
//! psychometric function are right*. Taken alone it declares a staircase done that never left a
//! wrong prior (Kreuzer 2017's prior, read literally, lies 2 log10 units from the result, and after
//! ten trials its spread looks fine 98 % of the time). So four things are asked:
//!
//! 1. the interval from the 5 % to the 95 % quantile is narrow,
//! 2. both responses occurred, at least `responses_of_each_kind` times,
//! 3. the estimate stays away from the ends of what can be answered: the table of thresholds and the
//!    radii that a picture can show,
//! 4. the first and the second half of the responses, each from the prior alone, agree within
//!    `half_agreement_sds` of the standard deviation of their difference.
//!
//! The halves' posteriors are made anew after each trial, by one product over the table a response:
//! at 24 trials ten times the cost of a trial's update and placement, 12 us (benchmark `quest`).

use serde::{Deserialize, Serialize};

use crate::error::{Error, require};
use crate::staircase::Staircase;

/// The rule. Lengths are in log10 of the ratio.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Convergence {
    /// Widest interval from the 5 % to the 95 % quantile.
    pub interval_width_log10: f64,
    /// Fewest right and fewest wrong answers.
    pub responses_of_each_kind: u32,
    /// Least distance of the estimate from the ends of the table and of the radii shown.
    pub edge_distance_log10: f64,
    /// Largest difference of the halves, in standard deviations of that difference.
    pub half_agreement_sds: f64,
}

impl Default for Convergence {
    /// A threshold known within a factor of 1.4 to either side with 90 % probability, three
    /// responses of each kind, and two standard deviations between the halves.
    fn default() -> Self {
        Self {
            interval_width_log10: 0.3,
            responses_of_each_kind: 3,
            edge_distance_log10: 0.15,
            half_agreement_sds: 2.0,
        }
    }
}

/// What each part of the rule measured on one staircase, beside its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    /// The limits.
    pub rule: Convergence,
    /// Width of the interval from the 5 % to the 95 % quantile.
    pub interval_width_log10: f64,
    /// Number of right or of wrong answers, whichever is smaller.
    pub fewest_of_a_kind: u32,
    /// Distance of the estimate from the nearest end of the table and of the radii shown; negative
    /// beyond an end.
    pub edge_distance_log10: f64,
    /// Difference of the halves' estimates, in standard deviations of that difference.
    pub half_difference_sds: f64,
}

/// A part of the rule that does not hold; its text has the number and the limit.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Reason {
    /// The interval is wide.
    #[error("the 90 % interval is {width_log10:.2} log10 wide; converged is at most {limit_log10:.2}")]
    Wide {
        /// Width of the interval.
        width_log10: f64,
        /// Widest allowed.
        limit_log10: f64,
    },
    /// One of the responses is rare.
    #[error("{fewest} right or wrong answers, whichever are fewer; converged is at least {limit} of each")]
    OneSided {
        /// Number of the rarer response.
        fewest: u32,
        /// Fewest allowed.
        limit: u32,
    },
    /// The estimate is at an end.
    #[error(
        "the estimate is {distance_log10:.2} log10 from the nearest end of the table and of the radii shown; converged is at least {limit_log10:.2}"
    )]
    AtEdge {
        /// Distance from the nearest end.
        distance_log10: f64,
        /// Least allowed.
        limit_log10: f64,
    },
    /// The halves disagree.
    #[error("the two halves differ by {difference_sds:.1} standard deviations; converged is at most {limit_sds:.1}")]
    HalvesDiffer {
        /// Difference of the halves' estimates.
        difference_sds: f64,
        /// Largest allowed.
        limit_sds: f64,
    },
}

impl Verdict {
    /// Whether every part holds.
    pub fn is_converged(&self) -> bool {
        self.reasons().is_empty()
    }

    /// The parts that do not hold, in the order of the rule.
    pub fn reasons(&self) -> Vec<Reason> {
        let rule = &self.rule;
        let mut reasons = Vec::new();
        // Each part is what must hold, so that a NaN does not.
        if !self.is_narrow() {
            let (width_log10, limit_log10) = (self.interval_width_log10, rule.interval_width_log10);
            reasons.push(Reason::Wide { width_log10, limit_log10 });
        }
        if !self.has_both_responses() {
            reasons.push(Reason::OneSided { fewest: self.fewest_of_a_kind, limit: rule.responses_of_each_kind });
        }
        if !self.is_inside() {
            let (distance_log10, limit_log10) = (self.edge_distance_log10, rule.edge_distance_log10);
            reasons.push(Reason::AtEdge { distance_log10, limit_log10 });
        }
        if !self.halves_agree() {
            let (difference_sds, limit_sds) = (self.half_difference_sds, rule.half_agreement_sds);
            reasons.push(Reason::HalvesDiffer { difference_sds, limit_sds });
        }
        reasons
    }

    /// Whether the interval is narrow.
    pub fn is_narrow(&self) -> bool {
        self.interval_width_log10 <= self.rule.interval_width_log10
    }

    /// Whether both responses occurred often enough.
    pub fn has_both_responses(&self) -> bool {
        self.fewest_of_a_kind >= self.rule.responses_of_each_kind
    }

    /// Whether the estimate is away from every end.
    pub fn is_inside(&self) -> bool {
        self.edge_distance_log10 >= self.rule.edge_distance_log10
    }

    /// Whether the halves agree.
    pub fn halves_agree(&self) -> bool {
        self.half_difference_sds <= self.rule.half_agreement_sds
    }
}

impl Convergence {
    /// Refuses numbers that no QUEST could meet; the error names the field.
    pub fn check(&self) -> Result<(), Error> {
        let positive = [
            ("convergence.interval_width_log10", self.interval_width_log10),
            ("convergence.half_agreement_sds", self.half_agreement_sds),
        ];
        for (field, value) in positive {
            require(value.is_finite() && value > 0.0, field, value, "a finite number above 0")?;
        }
        require(
            self.edge_distance_log10.is_finite() && self.edge_distance_log10 >= 0.0,
            "convergence.edge_distance_log10",
            self.edge_distance_log10,
            "a finite number of at least 0",
        )
    }

    /// Judges a staircase by its posterior, the responses `(intensity, right)` that led to it, in
    /// order, and the lowest and highest intensity that can be shown.
    ///
    /// Errors: responses that the staircase would refuse.
    pub fn judge(
        &self,
        staircase: &Staircase,
        responses: &[(f64, bool)],
        intensity_range: (f64, f64),
    ) -> Result<Verdict, Error> {
        let right = responses.iter().filter(|(_, right)| *right).count();
        let mean = staircase.mean();
        let ends = [staircase.table_range(), intensity_range];
        let distances = ends.map(|(lowest, highest)| (mean - lowest).min(highest - mean));
        Ok(Verdict {
            rule: *self,
            interval_width_log10: staircase.quantile(0.95) - staircase.quantile(0.05),
            fewest_of_a_kind: right.min(responses.len() - right) as u32,
            edge_distance_log10: distances[0].min(distances[1]),
            half_difference_sds: half_difference_sds(staircase, responses)?,
        })
    }
}

/// Difference of the estimates of the first and the second half of the responses, each from the prior
/// alone, in standard deviations of that difference.
fn half_difference_sds(staircase: &Staircase, responses: &[(f64, bool)]) -> Result<f64, Error> {
    let (first, second) = responses.split_at(responses.len() / 2);
    let (first_mean, first_sd) = staircase.mean_and_sd_after(first)?;
    let (second_mean, second_sd) = staircase.mean_and_sd_after(second)?;
    let difference = (first_mean - second_mean).abs();
    // Equal halves agree even where the table is so coarse that both standard deviations are 0.
    Ok(if difference == 0.0 { 0.0 } else { difference / (first_sd * first_sd + second_sd * second_sd).sqrt() })
}
