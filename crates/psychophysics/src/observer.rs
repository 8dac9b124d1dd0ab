//! Simulated people: of three kinds, with known parameters, so that a whole study can be run against a
//! truth that is known.
//!
//! | Kind | Knows | Answers by |
//! |---|---|---|
//! | [`WeibullObserver`] | ratio, condition | the psychometric function that QUEST assumes |
//! | [`SignalDetectionObserver`] | ratio, condition | noisy traces and a criterion |
//! | [`ImageObserver`] | the pictures alone | the unevenness of the contour in the pixels |
//!
//! Each gives the probability of a right answer to a trial; a draw decides. Answers depend on the
//! person's seed and the trial, its number and role, alone: a session that is interrupted and resumed gets the
//! answers of one that was not.

use serde::{Deserialize, Serialize};

use crate::draw::{Draw, Purpose};
use crate::error::{Error, require};
use crate::image_observer::ImageObserver;
use crate::protocol::PictureRules;
use crate::signal_detection_observer::SignalDetectionObserver;
use crate::trial::{Answer, Condition, Role, Trial};
use crate::weibull_observer::WeibullObserver;

/// Median and spread of simulated response times: 2 s, 0.15 log10, typical of a choice at leisure.
const RESPONSE_TIME: (f64, f64) = (2.0, 0.15);

/// The parameters of a simulated person, as they stand in `session.json`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum ObserverModel {
    /// Sees the artifact or does not.
    Weibull(WeibullObserver),
    /// Has noisy traces and a criterion.
    SignalDetection(SignalDetectionObserver),
    /// Sees the pictures and nothing else.
    Image(ImageObserver),
}

impl ObserverModel {
    /// The names of the kinds on command lines.
    pub const NAMES: [&'static str; 3] = ["weibull", "signal-detection", "image"];

    /// The default person of a kind; the error lists the names.
    pub fn named(name: &str) -> Result<Self, Error> {
        match name {
            "weibull" => Ok(Self::Weibull(WeibullObserver::default())),
            "signal-detection" => Ok(Self::SignalDetection(SignalDetectionObserver::default())),
            "image" => Ok(Self::Image(ImageObserver::default())),
            _ => Err(Error::parameter("observer", name, "weibull, signal-detection, image")),
        }
    }

    /// The name of its kind.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Weibull(_) => Self::NAMES[0],
            Self::SignalDetection(_) => Self::NAMES[1],
            Self::Image(_) => Self::NAMES[2],
        }
    }

    /// Refuses parameters outside their ranges; the error names the field.
    pub fn check(&self) -> Result<(), Error> {
        match self {
            Self::Weibull(person) => person.check(),
            Self::SignalDetection(person) => person.check(),
            Self::Image(person) => person.check(),
        }
    }

    /// The same kind of person with this threshold, in texels, for the step at 100 % contrast under a disc;
    /// an [`ImageObserver`], who has none by assumption, gets the noise and the criterion of
    /// [`ImageObserver::of_step_ratio`].
    pub fn with_ratio(mut self, ratio: f64) -> Result<Self, Error> {
        require(ratio.is_finite() && ratio > 0.0, "ratio", ratio, "a finite number above 0")?;
        match &mut self {
            Self::Weibull(person) => person.thresholds.ratio = ratio,
            Self::SignalDetection(person) => person.thresholds.ratio = ratio,
            Self::Image(person) => {
                let ImageObserver { noise_rad, criterion_rad, .. } = ImageObserver::of_step_ratio(ratio);
                (person.noise_rad, person.criterion_rad) = (noise_rad, criterion_rad);
            }
        }
        Ok(self)
    }

    /// The same person with thresholds `factor` times as large; an [`ImageObserver`]'s noise and
    /// criterion are divided by it.
    pub fn with_thresholds_times(mut self, factor: f64) -> Self {
        match &mut self {
            Self::Weibull(person) => person.thresholds.ratio *= factor,
            Self::SignalDetection(person) => person.thresholds.ratio *= factor,
            Self::Image(person) => {
                person.noise_rad /= factor;
                person.criterion_rad /= factor;
            }
        }
        self
    }

    /// The same person with this probability of a lapse.
    pub fn with_lapse_probability(mut self, probability: f64) -> Self {
        match &mut self {
            Self::Weibull(person) => person.lapse_probability = probability,
            Self::SignalDetection(person) => person.lapse_probability = probability,
            Self::Image(person) => person.lapse_probability = probability,
        }
        self
    }

    /// The fresh person's threshold for a condition by assumption, in texels; `None` for an
    /// [`ImageObserver`], whose thresholds follow from the pictures.
    pub fn threshold_ratio(&self, condition: &Condition) -> Option<f64> {
        match self {
            Self::Weibull(person) => Some(person.thresholds.ratio_of(condition)),
            Self::SignalDetection(person) => Some(person.thresholds.ratio_of(condition)),
            Self::Image(_) => None,
        }
    }

    /// Probability that the person's answer to this trial, drawn by these rules, is right. Only an
    /// [`ImageObserver`] looks at the pictures; its errors are those of drawing them.
    pub fn probability_correct(&self, trial: &Trial, rules: &PictureRules) -> Result<f64, Error> {
        match self {
            Self::Weibull(person) => Ok(person.probability_correct(trial)),
            Self::SignalDetection(person) => Ok(person.probability_correct(trial)),
            Self::Image(person) => person.probability_correct(trial, rules),
        }
    }
}

impl Default for ObserverModel {
    /// The default [`WeibullObserver`].
    fn default() -> Self {
        Self::Weibull(WeibullObserver::default())
    }
}

/// A simulated person with a seed for the answers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observer {
    model: ObserverModel,
    seed: u64,
}

impl Observer {
    /// A person; errors name the parameter that is out of its range.
    pub fn new(model: ObserverModel, seed: u64) -> Result<Self, Error> {
        model.check()?;
        Ok(Self { model, seed })
    }

    /// The person's parameters.
    pub fn model(&self) -> &ObserverModel {
        &self.model
    }

    /// The person's answer; the same for the same trial drawn by the same rules.
    pub fn answer(&self, trial: &Trial, rules: &PictureRules) -> Result<Answer, Error> {
        let right = trial.pictures.right_answer();
        if self.draw(trial).unit() < self.model.probability_correct(trial, rules)? {
            return Ok(right);
        }
        let [first, second] = trial.pictures.answers();
        Ok(if first == right { second } else { first })
    }

    /// A response time: log-normal, at random with respect to the trial.
    pub fn response_time_secs(&self, trial: &Trial) -> f64 {
        let (median_secs, sd_log10) = RESPONSE_TIME;
        let mut draw = self.draw(trial);
        draw.unit();
        median_secs * libm::exp10(sd_log10 * draw.normal())
    }

    fn draw(&self, trial: &Trial) -> Draw {
        let purpose = if trial.role == Role::Practice { Purpose::PracticeAnswer } else { Purpose::Answer };
        Draw::new(self.seed, purpose, trial.number)
    }
}
