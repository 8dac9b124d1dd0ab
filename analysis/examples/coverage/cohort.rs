//! A cell of the table: cohorts of simulated people whose truth is known, and what the analysis says of each.

use rayon::prelude::*;
use scumble_analysis::{Error, MeanOverPeople, PopulationPoint, Series, Simulation};
use scumble_psychophysics::{ObserverModel, Protocol, WeibullObserver};
use scumble_stimuli::Pattern;

pub const RATIO: f64 = 3.47;
pub const BETWEEN_SD: f64 = 0.1;

/// Normal quantile of 95 % of viewers.
pub const NORMAL_95: f64 = 1.644_853_627;

/// People x trials, and what the people are like.
pub struct Cell {
    pub name: &'static str,
    pub people: u32,
    pub trials: u32,
    pub protocol: Protocol,
    pub person: WeibullObserver,
}

/// What one cohort says.
pub struct Outcome {
    pub error_log10: f64,
    pub ci95: [f64; 2],
    pub log_mean: Option<MeanOverPeople>,
    pub origin_slope: f64,
    pub hidden_error_log10: f64,
    pub hidden_covers: bool,
    pub exponent_rejected: bool,
}

impl Cell {
    /// The study of one cohort.
    fn simulation(&self, seed: u64) -> Result<Simulation, Error> {
        let mut protocol = self.protocol.clone();
        protocol.conditions.patterns = vec![Pattern::Step];
        protocol.conditions.contrasts = vec![1.0];
        (protocol.schedule.trials_min, protocol.schedule.trials_max) = (self.trials, self.trials);
        let median = ObserverModel::Weibull(self.person).with_ratio(RATIO)?;
        Ok(Simulation { protocol, observers: self.people, seed, median, between_sd_log10: BETWEEN_SD })
    }

    fn cohort(&self, seed: u64) -> Result<Outcome, Error> {
        let study = self.simulation(seed)?.study()?;
        let [round] = study.protocol.rounds()[..] else {
            return Err(Error::CannotFit("a cell has one round".to_owned()));
        };
        let series = Series::of(round, &study.people, &study.protocol)?;
        let hidden = PopulationPoint::of(&series.fit, 0.95, 0.10)?;
        let truth = self.hidden_log10();
        Ok(Outcome {
            error_log10: series.log10_ratio.value - RATIO.log10(),
            ci95: series.log10_ratio.ci95,
            log_mean: series.log_mean,
            origin_slope: series.origin_line.map_or(f64::NAN, |line| line.slope),
            hidden_error_log10: hidden.ratio.log10() - truth,
            hidden_covers: holds(hidden.ci95, 10_f64.powf(truth)),
            exponent_rejected: series.exponent.is_some_and(|mean| mean.p_value(1.0) < 0.05),
        })
    }

    /// log10 of the ratio for 95 % of viewers at 10 % detection, by the person's own function.
    fn hidden_log10(&self) -> f64 {
        let seen = |detection: f64| -(-detection / (1.0 - self.person.lapse_probability)).ln_1p();
        RATIO.log10() + NORMAL_95 * BETWEEN_SD + (seen(0.64) / seen(0.10)).log10() / self.person.slope_per_log10
    }

    /// Outcomes of this many cohorts, those that were refused left out.
    pub fn outcomes(&self, cohorts: u64, first_seed: u64) -> Vec<Outcome> {
        (0..cohorts).into_par_iter().filter_map(|index| self.cohort(first_seed + index).ok()).collect()
    }
}

impl Outcome {
    /// Whether the ratio's interval holds the truth.
    pub fn covers(&self) -> bool {
        holds(self.ci95, RATIO.log10())
    }
}

/// Whether an interval holds a value.
pub fn holds([low, high]: [f64; 2], value: f64) -> bool {
    low <= value && value <= high
}
