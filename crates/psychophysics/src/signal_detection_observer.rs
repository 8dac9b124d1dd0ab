//! A simulated person of signal detection theory: each picture leaves a trace, the artifact a stronger
//! one, and noise blurs both.
//!
//! The trace of a line is N(0, 1), that of an artifact N(d', 1) with `d' = d'0 (c / c0)^(-exponent)`, c
//! the ratio and c0 the threshold of the condition. Of two pictures the one with the weaker trace is named the
//! line, which is right with probability `Phi(d' / sqrt 2)`; a single picture is called "not a line"
//! where its trace exceeds the criterion. A lapse is answered as if both were lines.
//!
//! `d'0` is such that [`THRESHOLD_PROBABILITY`] of the answers to two alternatives are right at c0, lapses
//! included: `d'0 = sqrt 2 Phi^-1((0.82 - lapse / 2) / (1 - lapse))`, 1.2945 without lapses. So the
//! threshold means the same as a [`WeibullObserver`](crate::WeibullObserver)'s; with the exponent
//! [`EXPONENT_OF_SLOPE_3_5`] the two curves differ by less than 1 % of the trials everywhere (0.0099).
//!
//! Sources: Green & Swets 1966; Macmillan & Creelman 2005; that d' is a power of the intensity:
//! Pelli 1987.

use std::f64::consts::SQRT_2;

use serde::{Deserialize, Serialize};

use crate::error::{Error, require};
use crate::fatigue::Fatigue;
use crate::normal;
use crate::thresholds::{THRESHOLD_PROBABILITY, Thresholds};
use crate::trial::{Answer, Pictures, Trial};
use crate::weibull_observer::check_lapses;

/// The exponent whose largest difference from a Weibull function of slope 3.5, both through 82 % at the
/// threshold and without lapses, is smallest; a test minimises it anew.
pub const EXPONENT_OF_SLOPE_3_5: f64 = 2.781;

/// Parameters of the person.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SignalDetectionObserver {
    /// What the person can see.
    pub thresholds: Thresholds,
    /// Power of the ratio by which d' falls, above 0.
    pub exponent: f64,
    /// Trace above which a single picture is called "not a line", in standard deviations of the noise
    /// above a line's mean trace.
    pub criterion_sds: f64,
    /// Share of trials answered as if nothing were to be seen, 0 to below 0.36.
    pub lapse_probability: f64,
    /// Change with the trials; none by default.
    #[serde(default)]
    pub fatigue: Fatigue,
}

impl Default for SignalDetectionObserver {
    /// The thresholds, lapses and false alarms (10 %: Phi(-1.2816)) of the default
    /// [`WeibullObserver`](crate::WeibullObserver), and nearly its slope.
    fn default() -> Self {
        Self {
            thresholds: Thresholds::default(),
            exponent: EXPONENT_OF_SLOPE_3_5,
            criterion_sds: 1.281_551_565_544_6,
            lapse_probability: 0.01,
            fatigue: Fatigue::default(),
        }
    }
}

impl SignalDetectionObserver {
    /// Refuses parameters outside their ranges; the error names the field.
    pub fn check(&self) -> Result<(), Error> {
        self.thresholds.check()?;
        let (exponent, criterion) = (self.exponent, self.criterion_sds);
        require(exponent.is_finite() && exponent > 0.0, "exponent", exponent, "a finite number above 0")?;
        require(criterion.is_finite(), "criterion_sds", criterion, "a finite number")?;
        check_lapses(self.lapse_probability)?;
        self.fatigue.check()
    }

    /// The person's d' at this trial: how far the artifact's mean trace lies above the line's, in
    /// standard deviations.
    pub fn d_prime(&self, trial: &Trial) -> f64 {
        let lapse = self.lapse_probability;
        let at_threshold = SQRT_2 * normal::quantile((THRESHOLD_PROBABILITY - 0.5 * lapse) / (1.0 - lapse));
        let factor = self.fatigue.at(trial).threshold_factor;
        let threshold = factor * self.thresholds.ratio_of(&trial.condition);
        at_threshold * libm::pow(threshold / trial.ratio(), self.exponent)
    }

    /// Probability that the person's answer to this trial is right.
    pub fn probability_correct(&self, trial: &Trial) -> f64 {
        let strain = self.fatigue.at(trial);
        let lapse = strain.lapse_probability(self.lapse_probability);
        let criterion = self.criterion_sds + strain.criterion_shift_sds;
        let d_prime = self.d_prime(trial);
        let false_alarm = normal::below(-criterion);
        match (trial.pictures, trial.pictures.right_answer()) {
            (Pictures::Pair { .. }, _) => lapse * 0.5 + (1.0 - lapse) * normal::below(d_prime / SQRT_2),
            (Pictures::Single { .. }, Answer::Yes) => 1.0 - false_alarm,
            (Pictures::Single { .. }, _) => lapse * false_alarm + (1.0 - lapse) * normal::below(d_prime - criterion),
        }
    }
}
