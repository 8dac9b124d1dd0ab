//! What a long session does to a simulated person: thresholds fall, slips grow, the criterion drifts.
//!
//! All three are linear in the number of main trials before the one at hand; practice leaves a person
//! fresh. At trial `n` the threshold ratio is the person's times `10^(-fall (n - 1) / 100)`, the
//! probability of a lapse grows by `growth (n - 1) / 100`, to at most 1, and the criterion moves by
//! `drift (n - 1) / 100` standard deviations of the person's noise.

use serde::{Deserialize, Serialize};

use crate::error::{Error, require};
use crate::trial::{Role, Trial};

/// How a simulated person changes with the trials; the default does not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Fatigue {
    /// Fall of the threshold ratio, log10 units per 100 trials; negative for someone who learns.
    pub threshold_fall_log10_per_100_trials: f64,
    /// Growth of the probability of a lapse per 100 trials, at least 0.
    pub lapse_growth_per_100_trials: f64,
    /// Rise of the criterion per 100 trials, in standard deviations of the noise; positive for someone
    /// who takes more and more pictures for lines. Single pictures only.
    pub criterion_drift_sds_per_100_trials: f64,
}

/// How far a person is from fresh at one trial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Strain {
    /// The threshold divided by the fresh one.
    pub(crate) threshold_factor: f64,
    /// What the criterion has risen by, in standard deviations.
    pub(crate) criterion_shift_sds: f64,
    lapse_growth: f64,
}

impl Fatigue {
    /// Refuses numbers outside their ranges; the error names the field.
    pub fn check(&self) -> Result<(), Error> {
        let finite = [
            ("fatigue.threshold_fall_log10_per_100_trials", self.threshold_fall_log10_per_100_trials),
            ("fatigue.criterion_drift_sds_per_100_trials", self.criterion_drift_sds_per_100_trials),
        ];
        for (field, value) in finite {
            require(value.is_finite(), field, value, "a finite number")?;
        }
        let growth = self.lapse_growth_per_100_trials;
        require((0.0..=1.0).contains(&growth), "fatigue.lapse_growth_per_100_trials", growth, "0 to 1")
    }

    /// The strain at a trial.
    pub(crate) fn at(&self, trial: &Trial) -> Strain {
        let before = if trial.role == Role::Practice { 0 } else { trial.number.saturating_sub(1) };
        let hundreds = f64::from(before) / 100.0;
        Strain {
            threshold_factor: libm::exp10(-self.threshold_fall_log10_per_100_trials * hundreds),
            criterion_shift_sds: self.criterion_drift_sds_per_100_trials * hundreds,
            lapse_growth: self.lapse_growth_per_100_trials * hundreds,
        }
    }
}

impl Strain {
    /// Probability of a lapse of someone whose fresh one is `fresh`.
    pub(crate) fn lapse_probability(&self, fresh: f64) -> f64 {
        (fresh + self.lapse_growth).min(1.0)
    }
}
