//! A simulated person who sees the pictures and nothing else of a trial.
//!
//! Each picture is drawn as a participant sees it, 8 bits at the protocol's size, and its contour is
//! found in the pixels ([`Contour`]). The trace that a picture leaves is the contour's largest tilt plus
//! N(0, noise_rad): Kreuzer 2017, 4.1.2, argues that people judge the unevenness of contours. Of two
//! pictures the one with the smaller trace is named the line, right with probability
//! `Phi((tilt_artifact - tilt_line) / (sqrt 2 noise_rad))`; a single one is called "not a line" where its
//! trace exceeds the criterion. A lapse is answered as if there were no tilt.
//!
//! No threshold is put in: it follows from the pictures. The steepest part of a step of size a under a
//! disc of radius r is `atan(a / 2r)` steep, so that for the step
//! `noise_rad = atan(1 / 2c) / (sqrt 2 Phi^-1(0.82))` has the threshold c ([`ImageObserver::of_step_ratio`]);
//! the pixels' noise, which gives a line some tilt too, lowers it by 5 to 8 % at c = 3.47.
//! Here d' falls with the first power of the ratio: the psychometric function is much flatter than
//! QUEST assumes, and a stair's is not even monotonic, as its tilt under a disc is not.
//!
//! The default person's thresholds under a disc, at texels of 5 to 20 pixels: step 3.2 to 3.3, double step
//! 2.8 to 3.0, stair 1.2. Half the contrast changes nothing, for the contour stays where it is; Kreuzer
//! found it slightly harder. The grain of taps turned at each pixel hides artifacts from this person, who does not
//! average over it.

use std::f64::consts::SQRT_2;

use scumble_stimuli::{Stimulus, Transfer};
use serde::{Deserialize, Serialize};

use crate::contour::Contour;
use crate::error::{Error, require};
use crate::fatigue::Fatigue;
use crate::normal;
use crate::protocol::PictureRules;
use crate::thresholds::THRESHOLD_PROBABILITY;
use crate::trial::{Answer, Pictures, Trial};
use crate::weibull_observer::check_lapses;

/// Criterion of the default person, in standard deviations of the noise: 10 % false alarms for a
/// straight line without pixel noise, Phi(-1.2816).
const CRITERION_SDS: f64 = 1.281_551_565_544_6;

/// Parameters of the person.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImageObserver {
    /// Standard deviation of the internal noise, at least 0.
    pub noise_rad: f64,
    /// Largest tilt of a single picture that is called a line.
    pub criterion_rad: f64,
    /// Share of trials answered as if nothing were to be seen, 0 to below 0.36.
    pub lapse_probability: f64,
    /// Change with the trials; none by default. The threshold falls as the noise grows.
    #[serde(default)]
    pub fatigue: Fatigue,
}

impl Default for ImageObserver {
    /// Kreuzer 2017: 3.47 texels for the step.
    fn default() -> Self {
        Self::of_step_ratio(3.47)
    }
}

impl ImageObserver {
    /// The person with 10 % false alarms and 1 % lapses for whom the step under a disc has about this
    /// threshold, in texels.
    pub fn of_step_ratio(ratio: f64) -> Self {
        let noise_rad = libm::atan(0.5 / ratio) / (SQRT_2 * normal::quantile(THRESHOLD_PROBABILITY));
        Self {
            noise_rad,
            criterion_rad: CRITERION_SDS * noise_rad,
            lapse_probability: 0.01,
            fatigue: Fatigue::default(),
        }
    }

    /// Refuses parameters outside their ranges; the error names the field.
    pub fn check(&self) -> Result<(), Error> {
        let (noise, criterion) = (self.noise_rad, self.criterion_rad);
        require(noise.is_finite() && noise >= 0.0, "noise_rad", noise, "a finite number of at least 0")?;
        require(criterion.is_finite(), "criterion_rad", criterion, "a finite number")?;
        check_lapses(self.lapse_probability)?;
        self.fatigue.check()
    }

    /// The largest tilt that the person finds in a picture, radians; 0 where there is no edge. Errors are
    /// those of drawing it.
    pub fn tilt_rad(stimulus: &Stimulus, rules: &PictureRules) -> Result<f64, Error> {
        let transfer = Transfer::srgb();
        let picture = stimulus.render(rules.width_px, rules.height_px, &transfer).map_err(Error::Picture)?;
        let contour = Contour::of_picture(picture.as_raw(), rules.width_px as usize, &transfer);
        Ok(contour.map_or(0.0, |contour| contour.largest_tilt_rad()))
    }

    /// Probability that the person's answer to this trial is right. Errors are those of drawing it.
    pub fn probability_correct(&self, trial: &Trial, rules: &PictureRules) -> Result<f64, Error> {
        let strain = self.fatigue.at(trial);
        let lapse = strain.lapse_probability(self.lapse_probability);
        let noise_rad = self.noise_rad / strain.threshold_factor;
        let criterion_rad = self.criterion_rad + strain.criterion_shift_sds * noise_rad;
        let (right, blind) = match &trial.pictures {
            Pictures::Pair { left, right } => {
                let (left, right) = (Self::tilt_rad(left, rules)?, Self::tilt_rad(right, rules)?);
                let excess = if trial.pictures.right_answer() == Answer::Left { right - left } else { left - right };
                (above(excess, SQRT_2 * noise_rad), 0.5)
            }
            Pictures::Single { picture } => {
                let called_artifact = |tilt_rad| above(tilt_rad - criterion_rad, noise_rad);
                let (seen, blind) = (called_artifact(Self::tilt_rad(picture, rules)?), called_artifact(0.0));
                match trial.pictures.right_answer() {
                    Answer::Yes => (1.0 - seen, 1.0 - blind),
                    _ => (seen, blind),
                }
            }
        };
        Ok(lapse * blind + (1.0 - lapse) * right)
    }
}

/// Probability that `value` plus N(0, sd) is above 0; half at 0 without noise.
fn above(value: f64, sd: f64) -> f64 {
    if value == 0.0 { 0.5 } else { normal::below(value / sd) }
}
