//! A simulated person: names the filtered line with the probability that the psychometric function
//! gives, so that a whole study can be run against thresholds that are known.
//!
//! The person's threshold, the ratio at which 82 % of the answers are right, is
//! `ratio x pattern factor x contrast factor^(log2(1 / contrast))`: the ratio of the worst case
//! (step, 100 %), lowered for the stair by Kreuzer 2017's 2.5 / 3.47 and for each halving of the
//! contrast. The same ratio holds at every texel size, which is the relation `r = c a` itself.
//!
//! Answers depend on the seed and the trial's number alone: a session that is interrupted and
//! resumed gets the answers of one that was not.

use scumble_stimuli::Pattern;
use serde::{Deserialize, Serialize};

use crate::draw::{Draw, Purpose};
use crate::error::{Error, require};
use crate::psychometric::Psychometric;
use crate::trial::{Answer, Condition, Pictures, Role, Trial};

/// Parameters of a simulated person.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ObserverParameters {
    /// Threshold in texels for the step at 100 % contrast.
    pub ratio: f64,
    /// The stair's threshold divided by the step's.
    pub stair_factor: f64,
    /// The threshold at half the contrast divided by that at the full one.
    pub half_contrast_factor: f64,
    /// Slope of the psychometric function, per log10 unit.
    pub slope_per_log10: f64,
    /// Share of trials answered blindly.
    pub lapse_probability: f64,
    /// Share of right answers at the threshold.
    pub threshold_probability: f64,
    /// Probability that a filtered line alone is called an artifact.
    pub false_alarm_probability: f64,
}

impl Default for ObserverParameters {
    /// Kreuzer 2017: 3.47 texels for the step, 2.5 for the stair, and the slope and lapses that its
    /// QUESTs assumed. The factor of the contrast is an assumption: the paper says "slightly".
    fn default() -> Self {
        Self {
            ratio: 3.47,
            stair_factor: 2.5 / 3.47,
            half_contrast_factor: 0.95,
            slope_per_log10: 3.5,
            lapse_probability: 0.01,
            threshold_probability: 0.82,
            false_alarm_probability: 0.1,
        }
    }
}

impl ObserverParameters {
    /// Refuses parameters outside their ranges; the error names the parameter.
    pub fn check(&self) -> Result<(), Error> {
        let positive = [
            ("ratio", self.ratio),
            ("stair_factor", self.stair_factor),
            ("half_contrast_factor", self.half_contrast_factor),
        ];
        for (field, value) in positive {
            require(value.is_finite() && value > 0.0, field, value, "a finite number above 0")?;
        }
        let rate = self.false_alarm_probability;
        require((0.0..1.0).contains(&rate), "false_alarm_probability", rate, "0 to below 1")?;
        self.psychometric().check()
    }

    /// The person's true threshold for a condition, in texels.
    pub fn threshold_ratio(&self, condition: &Condition) -> f64 {
        let pattern_factor = match condition.pattern {
            Pattern::Step | Pattern::DoubleStep => 1.0,
            Pattern::Stair => self.stair_factor,
        };
        let halvings = -libm::log2(condition.contrast);
        self.ratio * pattern_factor * libm::pow(self.half_contrast_factor, halvings)
    }

    /// Probability that the person's answer to this trial is right. A single artifact is told where it
    /// is seen, as often as it is at two alternatives, or by a false alarm.
    pub fn probability_correct(&self, trial: &Trial) -> f64 {
        let threshold = -libm::log10(self.threshold_ratio(&trial.condition));
        let two_alternative = self.psychometric().probability(trial.intensity() - threshold);
        match (trial.pictures, trial.pictures.right_answer()) {
            (Pictures::Pair { .. }, _) => two_alternative,
            (Pictures::Single { .. }, Answer::Yes) => 1.0 - self.false_alarm_probability,
            (Pictures::Single { .. }, _) => {
                let seen = 2.0 * two_alternative - 1.0;
                seen + (1.0 - seen) * self.false_alarm_probability
            }
        }
    }

    fn psychometric(&self) -> Psychometric {
        Psychometric {
            beta: self.slope_per_log10,
            delta: self.lapse_probability,
            gamma: 0.5,
            threshold_probability: self.threshold_probability,
        }
    }
}

/// A simulated person with a seed for the answers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeibullObserver {
    parameters: ObserverParameters,
    seed: u64,
}

impl WeibullObserver {
    /// A person; errors name the parameter that is out of its range.
    pub fn new(parameters: ObserverParameters, seed: u64) -> Result<Self, Error> {
        parameters.check()?;
        Ok(Self { parameters, seed })
    }

    /// The person's parameters.
    pub fn parameters(&self) -> &ObserverParameters {
        &self.parameters
    }

    /// The person's answer; the same for the same trial.
    pub fn answer(&self, trial: &Trial) -> Answer {
        let right = trial.pictures.right_answer();
        if self.draw(trial).unit() < self.parameters.probability_correct(trial) {
            return right;
        }
        let [first, second] = trial.pictures.answers();
        if first == right { second } else { first }
    }

    /// A response time: log-normal, median 2 s, SD 0.15 log10, at random with respect to the trial.
    pub fn response_time_secs(&self, trial: &Trial) -> f64 {
        let mut draw = self.draw(trial);
        draw.unit();
        2.0 * libm::exp10(0.15 * draw.normal())
    }

    fn draw(&self, trial: &Trial) -> Draw {
        let purpose = if trial.role == Role::Practice { Purpose::PracticeAnswer } else { Purpose::Answer };
        Draw::new(self.seed, purpose, trial.number)
    }
}
