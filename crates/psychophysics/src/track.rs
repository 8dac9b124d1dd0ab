//! One staircase of a session: its condition, its responses and its state.

use serde::{Deserialize, Serialize};

use crate::convergence::Verdict;
use crate::error::Error;
use crate::protocol::Protocol;
use crate::staircase::Staircase;
use crate::trial::{Condition, Trial};

/// One staircase among the session's.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    condition: Condition,
    prior_ratio: f64,
    staircase: Staircase,
    responses: Vec<(f64, bool)>,
    verdict: Verdict,
    done: bool,
}

/// The state of a staircase in terms of the ratio, the radius in texels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// 10 to the posterior's mean log10 ratio.
    pub ratio: f64,
    /// 5 % and 95 % quantiles of the posterior.
    pub ratio_interval90: (f64, f64),
    /// Standard deviation of the posterior in log10 of the ratio.
    pub sd_log10: f64,
}

impl Track {
    /// A staircase at its prior.
    pub(crate) fn new(protocol: &Protocol, condition: Condition, prior_ratio: f64) -> Result<Self, Error> {
        let staircase = protocol.staircase_at(prior_ratio)?;
        let verdict = protocol.convergence.judge(&staircase, &[], intensity_range(protocol, &condition))?;
        Ok(Self { condition, prior_ratio, staircase, responses: Vec::new(), verdict, done: false })
    }

    /// The same staircase at its prior.
    pub(crate) fn restarted(&self, protocol: &Protocol) -> Result<Self, Error> {
        Self::new(protocol, self.condition, self.prior_ratio)
    }

    /// Radius that the staircase asks for.
    pub(crate) fn next_radius_px(&self) -> f64 {
        self.condition.texel_px * libm::exp10(-self.staircase.placement())
    }

    /// Takes a response to `trial`, at the radius that was shown.
    pub(crate) fn respond(&mut self, protocol: &Protocol, trial: &Trial, correct: bool) -> Result<(), Error> {
        self.staircase.update(trial.intensity(), correct)?;
        self.responses.push((trial.intensity(), correct));
        let range = intensity_range(protocol, &self.condition);
        self.verdict = protocol.convergence.judge(&self.staircase, &self.responses, range)?;
        let trials = self.trials();
        self.done = trials >= protocol.schedule.trials_max
            || (trials >= protocol.schedule.trials_min && self.verdict.is_converged());
        Ok(())
    }

    /// What it measures.
    pub fn condition(&self) -> &Condition {
        &self.condition
    }

    /// Its posterior.
    pub fn staircase(&self) -> &Staircase {
        &self.staircase
    }

    /// Its responses in order: intensity as shown, and whether the answer was right.
    pub fn responses(&self) -> &[(f64, bool)] {
        &self.responses
    }

    /// Number of its responses.
    pub fn trials(&self) -> u32 {
        self.responses.len() as u32
    }

    /// What the convergence rule says of it.
    pub fn verdict(&self) -> Verdict {
        self.verdict
    }

    /// Whether it asks for no further trial: converged, or at the most trials.
    pub fn is_done(&self) -> bool {
        self.done
    }

    /// Its threshold as a ratio.
    pub fn estimate(&self) -> Estimate {
        Estimate::of(&self.staircase)
    }

    /// The ratio at which its prior is centred.
    pub fn prior_ratio(&self) -> f64 {
        self.prior_ratio
    }
}

impl Estimate {
    /// The threshold that a staircase of log10 texels over radius tells.
    pub fn of(staircase: &Staircase) -> Self {
        let ratio = |intensity: f64| libm::exp10(-intensity);
        Self {
            ratio: ratio(staircase.mean()),
            ratio_interval90: (ratio(staircase.quantile(0.95)), ratio(staircase.quantile(0.05))),
            sd_log10: staircase.sd(),
        }
    }
}

/// Intensities of the largest and the smallest radius that can be shown.
fn intensity_range(protocol: &Protocol, condition: &Condition) -> (f64, f64) {
    let (smallest_px, largest_px) = protocol.radius_range_px(condition.texel_px);
    (libm::log10(condition.texel_px / largest_px), libm::log10(condition.texel_px / smallest_px))
}
