//! A simulated person of the kind that QUEST assumes: sees the artifact or does not (high threshold).
//!
//! The artifact at a ratio `c` is seen with probability
//! `s = (1 - lapse) (1 - exp(-k (c0 / c)^beta))`, c0 the threshold of the condition. Two pictures are told
//! apart where it is seen and by guessing elsewhere, `p = s + (1 - s) / 2`; `k` is such that
//! `p(c0)` is [`THRESHOLD_PROBABILITY`]. A single picture is called "not a line" where the artifact is
//! seen, and elsewhere, as every line, with the probability of a false alarm.
//!
//! Source: Watson & Pelli 1983; the values of Kreuzer 2017, 4.2.

use serde::{Deserialize, Serialize};

use crate::error::{Error, require};
use crate::fatigue::Fatigue;
use crate::normal;
use crate::thresholds::{THRESHOLD_PROBABILITY, Thresholds};
use crate::trial::{Answer, Pictures, Trial};

/// Parameters of the person.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WeibullObserver {
    /// What the person can see.
    pub thresholds: Thresholds,
    /// Slope beta of the psychometric function, per log10 unit of the ratio.
    pub slope_per_log10: f64,
    /// Share of trials answered as if nothing were to be seen, 0 to below 0.36, where the threshold
    /// is out of reach.
    pub lapse_probability: f64,
    /// Probability that a picture in which nothing is seen is called "not a line", above 0 to below 1.
    pub false_alarm_probability: f64,
    /// Change with the trials; none by default.
    #[serde(default)]
    pub fatigue: Fatigue,
}

impl Default for WeibullObserver {
    /// The slope and lapses that Kreuzer's QUESTs assumed. The false alarms are an assumption.
    fn default() -> Self {
        Self {
            thresholds: Thresholds::default(),
            slope_per_log10: 3.5,
            lapse_probability: 0.01,
            false_alarm_probability: 0.1,
            fatigue: Fatigue::default(),
        }
    }
}

impl WeibullObserver {
    /// Refuses parameters outside their ranges; the error names the field.
    pub fn check(&self) -> Result<(), Error> {
        self.thresholds.check()?;
        let (slope, rate) = (self.slope_per_log10, self.false_alarm_probability);
        require(slope.is_finite() && slope > 0.0, "slope_per_log10", slope, "a finite slope above 0")?;
        check_lapses(self.lapse_probability)?;
        require(rate > 0.0 && rate < 1.0, "false_alarm_probability", rate, "above 0 to below 1")?;
        self.fatigue.check()
    }

    /// Probability that the person's answer to this trial is right.
    pub fn probability_correct(&self, trial: &Trial) -> f64 {
        let strain = self.fatigue.at(trial);
        let threshold = strain.threshold_factor * self.thresholds.ratio_of(&trial.condition);
        let lapse = self.lapse_probability;
        let k = libm::log(0.5 * (1.0 - lapse) / (1.0 - 0.5 * lapse - THRESHOLD_PROBABILITY));
        let strength = k * libm::pow(threshold / trial.ratio(), self.slope_per_log10);
        let seen = (1.0 - strain.lapse_probability(lapse)) * (1.0 - libm::exp(-strength));
        let false_alarm = normal::below(normal::quantile(self.false_alarm_probability) - strain.criterion_shift_sds);
        match (trial.pictures, trial.pictures.right_answer()) {
            (Pictures::Pair { .. }, _) => seen + 0.5 * (1.0 - seen),
            (Pictures::Single { .. }, Answer::Yes) => 1.0 - false_alarm,
            (Pictures::Single { .. }, _) => seen + (1.0 - seen) * false_alarm,
        }
    }
}

/// Refuses lapses with which nobody is right on [`THRESHOLD_PROBABILITY`] of the trials.
pub(crate) fn check_lapses(probability: f64) -> Result<(), Error> {
    let limit = 2.0 * (1.0 - THRESHOLD_PROBABILITY);
    let allowed = "0 to below 0.36, beyond which no threshold of 82 % exists";
    require(probability >= 0.0 && probability < limit, "lapse_probability", probability, allowed)
}
