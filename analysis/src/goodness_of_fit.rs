//! Does the mixed model fit? Two p-values per series, by parametric bootstrap with the experiment's own placement.
//!
//! *People.* Each person's answers fall into three bands of the probability with which the model lets the person, at the most
//! probable threshold, detect the artifact ([`BAND_ENDS`]): hidden, near the threshold, plain. Pearson's
//!
//! `X^2 = sum over people and bands of (right - expected)^2 / max(V, 1/4)`, `V = sum p (1 - p)`,
//!
//! grows where people differ in slope or lapses, which the model has everyone share, and where the function has another form.
//!
//! *Time.* `D = sum over people of (right - expected) in late less in early halves of the staircases`, over the root of its
//! `V`: above 0 where people learn, below 0 where they tire.
//!
//! *Their distributions* are not those of tables: a band holds few answers, and the staircases chose what they asked by the
//! answers before; at fixed levels the bootstrap itself errs, and rejects one in ten true models. So the fitted model makes
//! whole [cohorts](cohort): new people, whose staircases run anew. Of each cohort the thresholds are estimated as the data's
//! are, and the shared parameters by one step of scoring. `p = (1 + cohorts that fit as badly) / (1 + cohorts)` (Davison &
//! Hinkley 1997, section 4.2).
//!
//! *Held fixed*: the number of trials of each staircase, whatever rule ended it, and the order of sizes. A share of blind
//! trials or a slope other than the protocol's is no misfit: the model estimates both.

mod answered;
mod bands;
mod cohort;

use rayon::prelude::*;
use scumble_psychophysics::Protocol;

use crate::{
    Error,
    mixed_model::{MixedParameters, PersonAnswers},
    parametric_bootstrap::draws,
    people::Person,
    series::Series,
};
use answered::Answered;
use bands::Counted;
pub use bands::{BAND_ENDS, Band};
use cohort::Design;

/// Cohorts; with it 5 % is a whole number of cohorts, so that the test has that level (Davison & Hinkley 1997).
const COHORTS: u32 = 199;

/// Cohorts of a study of more than [`MANY`] people, which would take minutes otherwise: the fewest that can reject at 5 %.
const COHORTS_OF_MANY: u32 = 19;

/// Number of people above which there are fewer cohorts.
const MANY: usize = 100;

/// Every draw follows from it.
const SEED: u64 = 1;

/// Rounding of a sum: what only it tells from the data's is as large.
const ROUNDING: f64 = 1e-9;

/// How well the model fits a series.
#[derive(Debug, Clone, PartialEq)]
pub struct GoodnessOfFit {
    /// Pearson's sum over people and bands.
    pub chi_square: f64,
    /// Its mean over cohorts that obey the model.
    pub expected: f64,
    /// Share of cohorts, the data among them, with as large a sum.
    pub p_value: f64,
    /// Late answers against early ones, in standard deviations: above 0 where more are right than expected.
    pub drift: f64,
    /// Share of cohorts, the data among them, with as large a drift either way.
    pub drift_p_value: f64,
    /// Number of simulated cohorts.
    pub cohorts: u32,
    /// Over all people, from hidden to plain; what is expected, and its variance, are those of the cohorts.
    pub bands: [Band; 3],
    /// Each person's code and part of Pearson's sum.
    pub parts: Vec<(String, f64)>,
}

impl GoodnessOfFit {
    /// Tests a series, whose people are among `people`.
    ///
    /// # Errors
    /// A staircase that does not follow from the protocol.
    pub fn of(series: &Series, people: &[Person], protocol: &Protocol) -> Result<Self, Error> {
        let designs = Design::of_people(series.round, people, protocol)?;
        let cohorts = if designs.len() > MANY { COHORTS_OF_MANY } else { COHORTS };
        let fitted = series.fit.parameters();
        let cohort = |number| {
            let mut draw = draws(SEED, number);
            designs.iter().map(|design| design.person(&fitted, &mut draw)).collect()
        };
        let answered = (0..cohorts).into_par_iter().map(cohort).collect::<Result<Vec<Vec<Answered>>, Error>>()?;
        let gathered: Vec<Vec<PersonAnswers>> =
            answered.iter().map(|people| people.iter().map(Answered::gathered).collect()).collect();
        let refitted = series.fit.one_step(&gathered);
        let under_model: Vec<Statistics> = answered
            .par_iter()
            .zip(&gathered)
            .zip(&refitted)
            .map(|((people, gathered), fitted)| Statistics::of(&counted(people, gathered, fitted)))
            .collect();

        let own: Vec<Answered> =
            designs.iter().map(|design| Answered::of(series.round, design.asked, protocol)).collect();
        let own_gathered: Vec<PersonAnswers> = own.iter().map(Answered::gathered).collect();
        let own = counted(&own, &own_gathered, &fitted);
        let (found, found_bands) = (Statistics::of(&own), total(&own).bands);
        let p_value = |size: fn(&Statistics) -> f64| {
            let as_large = under_model.iter().filter(|other| size(other) >= size(&found) * (1.0 - ROUNDING)).count();
            (as_large + 1) as f64 / (f64::from(cohorts) + 1.0)
        };
        Ok(Self {
            chi_square: found.chi_square,
            expected: under_model.iter().map(|other| other.chi_square).sum::<f64>() / f64::from(cohorts),
            p_value: p_value(|of| of.chi_square),
            drift: found.drift,
            drift_p_value: p_value(|of| of.drift.abs()),
            cohorts,
            bands: std::array::from_fn(|index| {
                let differences: Vec<f64> = under_model.iter().map(|other| other.differences[index]).collect();
                found_bands[index].against(&differences)
            }),
            parts: designs.iter().zip(&own).map(|(d, own)| (d.asked.code.clone(), own.chi_square())).collect(),
        })
    }
}

/// What is compared.
struct Statistics {
    chi_square: f64,
    drift: f64,
    /// Right answers less expected ones, by band.
    differences: [f64; 3],
}

impl Statistics {
    fn of(people: &[Counted]) -> Self {
        let total = total(people);
        Self {
            chi_square: people.iter().map(Counted::chi_square).sum(),
            drift: total.drift(),
            differences: total.bands.map(|band| band.right - band.expected),
        }
    }
}

fn counted(people: &[Answered], gathered: &[PersonAnswers], shared: &MixedParameters) -> Vec<Counted> {
    people.iter().zip(gathered).map(|(answered, gathered)| Counted::of(answered, gathered, shared)).collect()
}

fn total(people: &[Counted]) -> Counted {
    people.iter().fold(Counted::default(), |sum, person| sum.plus(person))
}

#[cfg(test)]
mod tests;
