//! Studies of simulated people: the experiment's own state machine, the real record.
//!
//! Person `i` of a cohort has the threshold `log10 c_i = log10 c + sd z_i` and answers by a Weibull
//! psychometric function; person, answers and session each have a seed of their own, drawn from the
//! study's. Equal arguments give equal files: a simulated session has no date and stands at the Unix
//! epoch.

use std::path::{Path, PathBuf};

use jiff::Timestamp;
use rayon::prelude::*;
use scumble_psychophysics::{
    Cohort, Condition, EXPONENT_OF_SLOPE_3_5, Event, Experiment, Moment, ObserverModel, Protocol, SessionHeader,
    SessionWriter, Software, rehearse,
};
use statrs::distribution::{ContinuousCDF, Normal};

use crate::{
    Error,
    people::{Person, Study},
};

/// Most people of one simulated study; beyond it a typing error is likelier than a wish.
const OBSERVERS_MOST: u32 = 99_999;

/// A study of simulated people.
#[derive(Debug, Clone, PartialEq)]
pub struct Simulation {
    /// The protocol that everyone follows.
    pub protocol: Protocol,
    /// Number of people.
    pub observers: u32,
    /// Everything random follows from it.
    pub seed: u64,
    /// The median person.
    pub median: ObserverModel,
    /// Standard deviation between people, log10 of the ratio.
    pub between_sd_log10: f64,
}

impl Simulation {
    /// Refuses numbers out of range; the error names the option.
    ///
    /// # Errors
    /// No observer or too many, a ratio, deviation, lapse rate or protocol parameter out of range.
    pub fn check(&self) -> Result<(), Error> {
        if !(1..=OBSERVERS_MOST).contains(&self.observers) {
            let value = self.observers.to_string();
            return Err(Error::Argument { name: "--observers", value, allowed: "1 to 99999" });
        }
        let sd = self.between_sd_log10;
        if !(0.0..=1.0).contains(&sd) {
            let allowed = "0 to 1, log10 units";
            return Err(Error::Argument { name: "--between-sd", value: sd.to_string(), allowed });
        }
        self.protocol.check()?;
        self.median.check()?;
        Ok(())
    }

    /// Lets person `index` run the whole experiment, and gives its end and every event in order.
    ///
    /// # Errors
    /// Those of the experiment.
    pub fn run(&self, index: u32) -> Result<(Experiment, Vec<Event>), Error> {
        let observer = self.cohort().person(index)?;
        let seed = self.cohort().session_seed(index);
        let mut experiment = Experiment::new(self.protocol.clone(), seed, index + 1)?;
        let mut events = rehearse(&mut experiment, &observer)?;
        events.push(Event::End(Moment { at: Timestamp::UNIX_EPOCH, notes: Vec::new(), interrupted_secs: None }));
        Ok((experiment, events))
    }

    /// The study in memory, without files.
    ///
    /// # Errors
    /// As [`Self::check`] and [`Self::run`].
    pub fn study(&self) -> Result<Study, Error> {
        self.check()?;
        let person = |index| {
            let (experiment, events) = self.run(index)?;
            Ok(Person::of(&code(index), &experiment, &events))
        };
        let people = (0..self.observers).into_par_iter().map(person).collect::<Result<_, Error>>()?;
        Study::of(self.protocol.clone(), people)
    }

    /// Writes a session directory per person below `out`, and calls `finished` after each.
    ///
    /// # Errors
    /// A session that exists already, before anything is written; the system's refusals.
    pub fn write(&self, out: &Path, finished: impl Fn() + Sync) -> Result<Vec<PathBuf>, Error> {
        self.check()?;
        let directories: Vec<_> = (0..self.observers).map(|index| out.join(code(index))).collect();
        if let Some(existing) = directories.iter().find(|directory| directory.exists()) {
            let reason = "exists; allowed is a folder without these sessions".to_owned();
            return Err(Error::File { path: existing.clone(), reason });
        }
        (0..self.observers).into_par_iter().zip(&directories).try_for_each(
            |(index, directory)| -> Result<(), Error> {
                let mut writer = SessionWriter::create(directory, &self.header(index)?)?;
                let (_, events) = self.run(index)?;
                events.iter().try_for_each(|event| writer.append(event))?;
                finished();
                Ok(())
            },
        )?;
        Ok(directories)
    }

    /// log10 of the median person's ratio at the threshold.
    ///
    /// # Errors
    /// An observer whose thresholds are not known in advance.
    pub fn true_log10(&self, condition: &Condition) -> Result<f64, Error> {
        Ok(self.known_ratio(&self.median, condition)?.log10())
    }

    /// How far person `index`'s thresholds lie from the median person's, log10 units.
    ///
    /// # Errors
    /// Parameters out of range.
    pub fn person_deviation_log10(&self, index: u32) -> Result<f64, Error> {
        let Some(condition) = self.protocol.all_conditions().into_iter().next() else { return Ok(0.0) };
        let own = self.known_ratio(self.cohort().person(index)?.model(), &condition)?;
        Ok((own / self.known_ratio(&self.median, &condition)?).log10())
    }

    fn known_ratio(&self, model: &ObserverModel, condition: &Condition) -> Result<f64, Error> {
        let allowed = "weibull or signal-detection, whose thresholds are known in advance";
        let unknown = || Error::Argument { name: "--observer", value: model.name().to_owned(), allowed };
        model.threshold_ratio(condition).ok_or_else(unknown)
    }

    fn cohort(&self) -> Cohort {
        Cohort { median: self.median, between_sd_log10: self.between_sd_log10, seed: self.seed }
    }

    fn header(&self, index: u32) -> Result<SessionHeader, Error> {
        let mut header = SessionHeader::new(
            &code(index),
            self.protocol.clone(),
            self.cohort().session_seed(index),
            Timestamp::UNIX_EPOCH,
            Software::of(env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION")),
        );
        header.simulated_observer = Some(*self.cohort().person(index)?.model());
        Ok(header)
    }
}

/// The same person with this slope of the psychometric function, per log10 unit. A signal-detection
/// observer's exponent is proportional to it.
///
/// # Errors
/// An observer whose slope follows from the pictures.
pub fn with_slope(mut person: ObserverModel, slope_per_log10: f64) -> Result<ObserverModel, Error> {
    match &mut person {
        ObserverModel::Weibull(person) => person.slope_per_log10 = slope_per_log10,
        ObserverModel::SignalDetection(person) => person.exponent = EXPONENT_OF_SLOPE_3_5 * slope_per_log10 / 3.5,
        ObserverModel::Image(_) => return Err(assumed_by_others("--slope", slope_per_log10)),
    }
    Ok(person)
}

/// The same person, who calls a line alone an artifact with this probability, above 0 to below 1.
///
/// # Errors
/// A number that is no such probability; an observer whose criterion is one on the pictures.
pub fn with_false_alarms(mut person: ObserverModel, probability: f64) -> Result<ObserverModel, Error> {
    if !(probability > 0.0 && probability < 1.0) {
        let (value, allowed) = (probability.to_string(), "above 0 to below 1");
        return Err(Error::Argument { name: "--false-alarms", value, allowed });
    }
    match &mut person {
        ObserverModel::Weibull(person) => person.false_alarm_probability = probability,
        ObserverModel::SignalDetection(person) => {
            person.criterion_sds = -Normal::standard().inverse_cdf(probability);
        }
        ObserverModel::Image(_) => return Err(assumed_by_others("--false-alarms", probability)),
    }
    Ok(person)
}

fn assumed_by_others(name: &'static str, value: f64) -> Error {
    let allowed = "no such option with the observer image, who follows from the pictures";
    Error::Argument { name, value: value.to_string(), allowed }
}

/// Participant code and folder of person `index`, whose number in the study is `index + 1`.
fn code(index: u32) -> String {
    format!("sim-{:04}", index + 1)
}
