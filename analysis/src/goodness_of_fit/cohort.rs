//! People of a fitted model in the experiment that the data come from.
//!
//! A person's threshold is drawn from the model's log-normal. Each of the data's staircases starts at its prior, places
//! its trials by the new answers, within the radii that a picture can show, and ends after as many as in the data. Catch
//! trials are answered at their one ratio. Where lines alone were shown, false alarms are drawn at the person's counted
//! rate and counted again, so that the rate's own error is in the cohort.

use scumble_psychophysics::{Protocol, Round, Staircase};
use statrs::distribution::{ContinuousCDF, Normal};

use super::answered::{Answered, Half};
use crate::{
    Error,
    assumptions::Assumptions,
    checks::Checks,
    mixed_model::MixedParameters,
    people::{Person, Track},
    series::{answers_of, catch_intensity, round_of},
};

/// What one person was asked in a round.
pub(super) struct Design<'a> {
    /// That person.
    pub asked: &'a Person,
    guess: f64,
    /// Intensity of the catch trials.
    catch_intensity: Option<f64>,
    staircases: Vec<Planned>,
}

/// One staircase.
struct Planned {
    /// At its prior.
    start: Staircase,
    /// Intensities of the largest and the smallest radius that can be shown.
    shown: [f64; 2],
    trials: usize,
}

impl<'a> Design<'a> {
    /// That of everyone with answers in the round.
    pub fn of_people(round: Round, people: &'a [Person], protocol: &Protocol) -> Result<Vec<Self>, Error> {
        let answered = people.iter().filter(|person| answers_of(round, person, protocol).is_some());
        answered.map(|person| Self::of(round, person, protocol)).collect()
    }

    fn of(round: Round, asked: &'a Person, protocol: &Protocol) -> Result<Self, Error> {
        let here = asked.tracks.iter().filter(|track| round_of(&track.condition) == round);
        let planned = |track: &Track| -> Result<Vec<Planned>, Error> {
            let texel_px = track.condition.texel_px;
            let (smallest_px, largest_px) = protocol.radius_range_px(texel_px);
            let shown = [largest_px, smallest_px].map(|radius_px| (texel_px / radius_px).log10());
            let runs = track.runs.iter().filter(|run| !run.responses.is_empty());
            runs.map(|run| {
                Ok(Planned { start: protocol.staircase_at(run.prior_ratio)?, shown, trials: run.responses.len() })
            })
            .collect()
        };
        let staircases: Vec<Vec<Planned>> = here.map(planned).collect::<Result<_, Error>>()?;
        Ok(Self {
            asked,
            guess: Assumptions::of_person(asked, protocol).guess,
            catch_intensity: catch_intensity(protocol),
            staircases: staircases.into_iter().flatten().collect(),
        })
    }

    /// The answers of a new person, by draws uniform in 0..1.
    pub fn person(&self, fitted: &MixedParameters, draw: &mut impl FnMut() -> f64) -> Result<Answered, Error> {
        // Draws are multiples of 2^-53: half of one more keeps the quantile finite.
        let z = Normal::standard().inverse_cdf(draw() + 0.5_f64.powi(54));
        let threshold = fitted.log10_ratio + fitted.between_sd * z;
        let right = |x: f64| self.guess + (1.0 - self.guess) * fitted.detection(x + threshold);
        let mut answers = Vec::new();
        for Planned { start, shown: [least, most], trials } in &self.staircases {
            let mut staircase = start.clone();
            for index in 0..*trials {
                let x = staircase.placement().clamp(*least, *most);
                let correct = draw() < right(x);
                staircase.update(x, correct)?;
                answers.push((x, correct, Some(Half::of(index, *trials))));
            }
        }
        let Checks { lines, catches, .. } = self.asked.checks;
        if let Some(x) = self.catch_intensity {
            answers.extend((0..catches).map(|_| (x, draw() < right(x), None)));
        }
        let false_alarms = (0..lines).filter(|_| draw() < self.guess).count() as u32;
        let counted = Checks { lines, false_alarms, ..Checks::default() }.false_alarm_rate();
        Ok(Answered { guess: counted.unwrap_or(self.guess), answers })
    }
}
