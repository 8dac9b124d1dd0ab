//! The mixed model of a series: every answer of every person in one likelihood, thresholds normal over people.
//!
//! Person `i` has the threshold `t_i = m + s z_i`, log10 of the ratio, `z_i` standard normal. An artifact at
//! intensity `x = -log10(ratio)` is seen by who looks with probability `F = 1 - exp(-w0 10^(b (x + t_i)))`
//! and answered rightly with `p = g_i + (1 - g_i)(1 - e) F`. `w0 = -ln(1 - d0 / (1 - e))` is such that the
//! artifact is detected in the share `d0` ([`DETECTION_AT_THRESHOLD`]) of all trials where `x = -t_i`. In
//! `ln(-ln(1 - F)) = ln w0 + b ln10 (x + t_i)` this is regression with complementary log-log link and a
//! random intercept per person.
//!
//! | | | |
//! |---|---|---|
//! | `m` | median person's log10 ratio | free |
//! | `s` | standard deviation between people, log10 units | free |
//! | `b` | slope per decade, shared | free under [`SLOPE_PRIOR_SD_LN`] |
//! | `e` | blind share, shared | free under [`BLIND_PRIOR_SD_LOGIT`] |
//! | `g_i` | guess rate | known: the protocol's or counted |
//!
//! Maximised is `sum_i ln L_i(m, s, b, e) + ln prior(b) + ln prior(e)`, `L_i` the integral of a person's
//! likelihood over `z_i`. A person whose own answers bound no threshold still counts for what
//! they say, which a mean over fitted thresholds cannot do, and the bias of a fit to one person's few adaptive
//! answers, of order one over their number, is not inherited.
//!
//! Intervals are profile likelihoods.

mod fit;
mod interval;
mod one_step;
mod person;
mod profile;

use std::f64::consts::{LN_2, LN_10};

use rayon::prelude::*;

use crate::{
    Error, Unidentified,
    assumptions::{Assumptions, DETECTION_AT_THRESHOLD},
    maximum_likelihood::Count,
};
pub use interval::Interval;
pub use profile::{Profiled, Quantity};

use fit::Maximum;
use person::Marginal;

/// Standard deviation of the prior of `ln b`, centred at the protocol's slope: a factor of two either way within one
/// standard deviation. Slopes that people have in detection of contrast and position are 1 to 10 per decade; the prior
/// keeps a few answers from claiming a jump.
pub const SLOPE_PRIOR_SD_LN: f64 = LN_2;

/// Standard deviation of the prior of `logit e`, centred at the protocol's blind share: 1 % stands for 0.1 % to 7 % in
/// nineteen of twenty studies.
pub const BLIND_PRIOR_SD_LOGIT: f64 = 1.0;

/// What the model says of everyone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MixedParameters {
    /// Median person's log10 ratio at the threshold.
    pub log10_ratio: f64,
    /// Standard deviation between people, log10 units, at least 0.
    pub between_sd: f64,
    /// Slope of the psychometric function, per decade.
    pub slope: f64,
    /// Share of trials answered blindly.
    pub blind_share: f64,
}

impl MixedParameters {
    /// Probability that an artifact is detected, blind trials included, this far above the person's threshold in log10 of
    /// the intensity.
    pub fn detection(&self, decades: f64) -> f64 {
        let seeing = 1.0 - self.blind_share;
        let w0 = -(-DETECTION_AT_THRESHOLD / seeing).ln_1p();
        -seeing * (-w0 * 10_f64.powf(self.slope * decades)).exp_m1()
    }

    /// A person's threshold, log10 of the ratio: the mean of what is probable after everyone's answers.
    pub(crate) fn threshold_of(&self, answers: &PersonAnswers) -> f64 {
        self.log10_ratio + self.between_sd * person::marginal(answers, self).z
    }
}

/// One person's answers in the model.
#[derive(Debug, Clone, PartialEq)]
pub struct PersonAnswers {
    /// Probability of a right answer to what is not seen.
    guess: f64,
    /// Right answers by intensity, each intensity once; whole numbers.
    counts: Vec<Count>,
}

impl PersonAnswers {
    /// Probability of a right answer to what is not seen.
    pub fn guess(&self) -> f64 {
        self.guess
    }

    /// Right answers by intensity, ascending.
    pub fn counts(&self) -> &[Count] {
        &self.counts
    }

    /// Gathers single answers `(x, correct)` by intensity.
    pub fn new(guess: f64, answers: impl IntoIterator<Item = (f64, bool)>) -> Self {
        let mut answers: Vec<_> = answers.into_iter().collect();
        answers.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut counts: Vec<Count> = Vec::new();
        for (x, correct) in answers {
            let correct = f64::from(u8::from(correct));
            match counts.last_mut() {
                Some(last) if last.x == x => {
                    last.correct += correct;
                    last.total += 1.0;
                }
                _ => counts.push(Count { x, correct, total: 1.0 }),
            }
        }
        Self { guess, counts }
    }
}

/// A fitted model.
#[derive(Debug, Clone, PartialEq)]
pub struct MixedFit {
    model: MixedModel,
    top: Maximum<4>,
}

impl MixedFit {
    /// The most likely parameters.
    pub fn parameters(&self) -> MixedParameters {
        parameters_of(&self.top.at)
    }

    /// Number of people.
    pub fn people(&self) -> usize {
        self.model.people.len()
    }

    /// Answers and threshold of every person, in the order of [`MixedModel::new`]: the threshold, log10 of the ratio, is
    /// the mean of what is probable after everyone's answers, drawn to the median where the person's own say little.
    pub fn thresholds(&self) -> impl Iterator<Item = (&PersonAnswers, f64)> {
        let parameters = self.parameters();
        let of = move |answers| (answers, parameters.threshold_of(answers));
        self.model.people.iter().map(of)
    }

    /// A quantity with its 95 % interval.
    ///
    /// # Errors
    /// The search for a maximum failed.
    pub fn interval(&self, quantity: Quantity) -> Result<Profiled, Error> {
        self.model.profile(quantity, &self.top)
    }
}

/// The answers of a series and what is known before them.
#[derive(Debug, Clone, PartialEq)]
pub struct MixedModel {
    people: Vec<PersonAnswers>,
    known: Assumptions,
}

/// Coordinates in which the likelihood is maximised: `m`, `ln s`, `ln b`, `ln(e / (BLIND_MOST - e))`.
pub(crate) type Coordinates = [f64; 4];

/// Largest blind share: above 0.36 nobody detects the share that defines the threshold.
pub(crate) const BLIND_MOST: f64 = 0.3;

/// People whose likelihoods are one task of a thread.
const PEOPLE_A_TASK: usize = 16;

/// Smallest and largest standard deviation between people, log10 units: beyond them nothing changes.
pub(crate) const SD_LEAST: f64 = 1e-6;
pub(crate) const SD_MOST: f64 = 3.0;

/// Range of `ln b`: slopes from 0.1 to 100 per decade.
const LN_SLOPE_RANGE: [f64; 2] = [-LN_10, 2.0 * LN_10];

/// Derivative of the standard deviation in its coordinate.
pub(crate) fn sd_rise(sd: f64) -> f64 {
    if sd <= SD_LEAST || sd >= SD_MOST { 0.0 } else { sd }
}

impl MixedModel {
    /// The model of `people`; `known` holds the centres of the priors.
    pub fn new(people: Vec<PersonAnswers>, known: Assumptions) -> Self {
        Self { people, known }
    }

    /// Finds the most likely parameters.
    ///
    /// # Errors
    /// The answers do not bound them.
    pub fn fit(self) -> Result<MixedFit, Error> {
        self.check()?;
        let top = self.most_likely()?;
        Ok(MixedFit { model: self, top })
    }

    /// Refuses answers that carry no spread over people or no threshold.
    fn check(&self) -> Result<(), Error> {
        if self.people.len() < 2 {
            return Err(Error::CannotFit(format!(
                "an interval over people needs at least 2 people with answers, found {}; ten make it narrow enough to use",
                self.people.len()
            )));
        }
        let counts = || self.people.iter().flat_map(|person| &person.counts);
        let total: f64 = counts().map(|count| count.total).sum();
        let correct: f64 = counts().map(|count| count.correct).sum();
        let reason = match correct {
            0.0 => Unidentified::AllWrong { total },
            _ if correct == total => Unidentified::AllCorrect { total },
            _ => return Ok(()),
        };
        Err(Error::CannotFit(reason.to_string()))
    }

    /// Log of likelihood and priors with its gradient.
    pub(crate) fn objective(&self, at: &Coordinates) -> (f64, Coordinates) {
        let parameters = parameters_of(at);
        let sum_of = |people: &[PersonAnswers]| {
            let of_person = |person| person::marginal(person, &parameters);
            people.iter().map(of_person).fold(Marginal::default(), |sum, next| sum.plus(&next))
        };
        // Chunks of one size whatever the machine: the same sum, bit for bit.
        let chunks: Vec<Marginal> = self.people.par_chunks(PEOPLE_A_TASK).map(sum_of).collect();
        let total = chunks.iter().fold(Marginal::default(), |sum, next| sum.plus(next));
        let mut gradient = total.gradient;
        gradient[1] *= sd_rise(parameters.between_sd);
        if !(LN_SLOPE_RANGE[0]..=LN_SLOPE_RANGE[1]).contains(&at[2]) {
            gradient[2] = 0.0;
        }
        gradient[3] *= blind_rise(parameters.blind_share);
        let mut value = total.ln_likelihood;
        for (index, centre, sd) in self.priors() {
            let deviation = (at[index] - centre) / sd;
            value -= 0.5 * deviation * deviation;
            gradient[index] -= deviation / sd;
        }
        (value, gradient)
    }

    /// Coordinate, centre and standard deviation of each prior.
    fn priors(&self) -> [(usize, f64, f64); 2] {
        [(2, self.known.slope.ln(), SLOPE_PRIOR_SD_LN), (3, logit(self.known.blind_share), BLIND_PRIOR_SD_LOGIT)]
    }
}

pub(crate) fn parameters_of(at: &Coordinates) -> MixedParameters {
    MixedParameters {
        log10_ratio: at[0],
        between_sd: at[1].exp().clamp(SD_LEAST, SD_MOST),
        slope: at[2].clamp(LN_SLOPE_RANGE[0], LN_SLOPE_RANGE[1]).exp(),
        blind_share: BLIND_MOST / (1.0 + (-at[3]).exp()),
    }
}

/// Derivative of the blind share in its coordinate.
pub(crate) fn blind_rise(blind_share: f64) -> f64 {
    blind_share * (1.0 - blind_share / BLIND_MOST)
}

fn logit(blind_share: f64) -> f64 {
    let share = blind_share.clamp(1e-4, 0.9 * BLIND_MOST) / BLIND_MOST;
    (share / (1.0 - share)).ln()
}

#[cfg(test)]
mod tests;
