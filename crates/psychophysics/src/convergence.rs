//! When a QUEST is done.
//!
//! The posterior's spread says how well the responses fix the threshold *if the prior and the
//! psychometric function are right*. Taken alone it declares a staircase done that never left a
//! wrong prior (Kreuzer 2017's prior, read literally, lies 2 log10 units from the result, and after
//! ten trials its spread looks fine 98 % of the time). So four things are asked:
//!
//! 1. the interval from the 5 % to the 95 % quantile is narrow,
//! 2. both responses occurred, at least `responses_of_each_kind` times,
//! 3. the estimate stays away from the ends of what can be answered: QUEST's table and the radii
//!    that a picture can show,
//! 4. the first and the second half of the responses, each from the prior alone, agree within
//!    `half_agreement_sds` of the standard deviation of their difference.

use serde::{Deserialize, Serialize};

use crate::error::{Error, require};
use crate::quest::Quest;

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

/// What each part of the rule says of one QUEST.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Verdict {
    /// The interval is narrow.
    pub narrow: bool,
    /// Both responses occurred often enough.
    pub both_responses: bool,
    /// The estimate is away from every end.
    pub inside: bool,
    /// The halves agree.
    pub halves_agree: bool,
}

impl Verdict {
    /// Whether every part holds.
    pub fn is_converged(self) -> bool {
        self.narrow && self.both_responses && self.inside && self.halves_agree
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

    /// Judges a QUEST by its prior, its posterior, the responses `(intensity, correct)` between them
    /// in order, and the range of intensities that can be shown.
    pub fn judge(
        &self,
        prior: &Quest,
        quest: &Quest,
        responses: &[(f64, bool)],
        intensity_range: (f64, f64),
    ) -> Result<Verdict, Error> {
        let right = responses.iter().filter(|(_, correct)| *correct).count();
        let fewest = right.min(responses.len() - right);
        Ok(Verdict {
            narrow: quest.quantile(0.95) - quest.quantile(0.05) <= self.interval_width_log10,
            both_responses: fewest >= self.responses_of_each_kind as usize,
            inside: self.is_inside(quest, intensity_range),
            halves_agree: self.halves_agree(prior, responses)?,
        })
    }

    fn is_inside(&self, quest: &Quest, intensity_range: (f64, f64)) -> bool {
        let config = quest.config();
        let half_table = config.grain * config.half_points() as f64;
        let lowest = intensity_range.0.max(config.t_guess - half_table);
        let highest = intensity_range.1.min(config.t_guess + half_table);
        let mean = quest.mean();
        mean - lowest >= self.edge_distance_log10 && highest - mean >= self.edge_distance_log10
    }

    fn halves_agree(&self, prior: &Quest, responses: &[(f64, bool)]) -> Result<bool, Error> {
        let (first, second) = responses.split_at(responses.len() / 2);
        let mut halves = [prior.clone(), prior.clone()];
        for (half, responses) in halves.iter_mut().zip([first, second]) {
            for (intensity, correct) in responses {
                half.update(*intensity, *correct)?;
            }
        }
        let difference = (halves[0].mean() - halves[1].mean()).abs();
        let sd = halves[0].sd().hypot(halves[1].sd());
        Ok(difference <= self.half_agreement_sds * sd)
    }
}
