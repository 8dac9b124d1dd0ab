//! Bias, coverage and width of the analysis on simulated cohorts with a known truth.
//!
//! Each cell is a number of people x trials of each of three texel sizes (5, 10, 20 px): one staircase a size, step
//! pattern at 100 % contrast, two alternatives, the experiment's own state machine and the fit of a series. People are
//! log-normal with median 3.47 and SD 0.1 log10, slope 3.5, lapse 0.01; further rows have people that the model
//! or the protocol do not know. Printed as a Markdown table: bias of the ratio, coverage and mean width of its 95 %
//! interval; the same for the mean of logarithms; bias of the line through the origin; bias and coverage of the ratio
//! that hides the artifact from 95 % of viewers at 10 % detection; share of cohorts in which a true exponent 1 is rejected
//! at 5 %; cohorts that were refused.
//!
//! ```sh
//! cargo run --release -p scumble-analysis --example coverage -- COHORTS [FIRST_SEED]
//! ```

use std::f64::consts::LN_10;

use rayon::prelude::*;
use scumble_analysis::{Error, MeanOverPeople, PopulationPoint, Series, Simulation};
use scumble_psychophysics::{Fatigue, ObserverModel, Protocol, WeibullObserver};
use scumble_stimuli::Pattern;

const RATIO: f64 = 3.47;
const BETWEEN_SD: f64 = 0.1;

/// Normal quantile of 95 % of viewers.
const NORMAL_95: f64 = 1.644_853_627;

/// People x trials, and what the people are like.
struct Cell {
    name: &'static str,
    people: u32,
    trials: u32,
    protocol: Protocol,
    person: WeibullObserver,
}

/// What one cohort says.
struct Outcome {
    error_log10: f64,
    ci95: [f64; 2],
    log_mean: Option<MeanOverPeople>,
    origin_slope: f64,
    hidden_error_log10: f64,
    hidden_covers: bool,
    exponent_rejected: bool,
}

fn cells(yes_no: &Protocol) -> Vec<Cell> {
    let sizes = [10, 20, 40];
    let cell =
        |name, people, trials, person| Cell { name, people, trials, protocol: Protocol::two_alternative(), person };
    let person = WeibullObserver::default();
    let mut cells: Vec<Cell> = sizes
        .iter()
        .flat_map(|&people| sizes.iter().map(move |&trials| cell("as assumed", people, trials, person)))
        .collect();
    let flat = WeibullObserver { slope_per_log10: 2.0, ..person };
    let lapsing = WeibullObserver { lapse_probability: 0.05, ..person };
    let tiring = Fatigue { criterion_drift_sds_per_100_trials: 0.5, ..Fatigue::default() };
    cells.push(cell("slope 2", 20, 20, flat));
    cells.push(cell("lapses 5 %", 20, 20, lapsing));
    cells.push(Cell { protocol: yes_no.clone(), ..cell("yes-no", 20, 20, person) });
    cells.push(Cell {
        protocol: yes_no.clone(),
        ..cell("yes-no, criterion drifts", 20, 20, WeibullObserver { fatigue: tiring, ..person })
    });
    cells
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

    fn row(&self, cohorts: u64, first_seed: u64) -> String {
        let all: Vec<Result<Outcome, Error>> =
            (0..cohorts).into_par_iter().map(|index| self.cohort(first_seed + index)).collect();
        let outcomes: Vec<Outcome> = all.into_iter().flatten().collect();
        let count = outcomes.len() as f64;
        let mean = |value: &dyn Fn(&Outcome) -> f64| outcomes.iter().map(value).sum::<f64>() / count;
        let share = |is: &dyn Fn(&Outcome) -> bool| 100.0 * mean(&|outcome| f64::from(u8::from(is(outcome))));
        let percent = |log10: f64| 100.0 * (10_f64.powf(log10) - 1.0);
        let width = |ci95: [f64; 2]| 10_f64.powf(ci95[1]) - 10_f64.powf(ci95[0]);
        let log_mean =
            |value: &dyn Fn(&MeanOverPeople) -> f64| mean(&|o: &Outcome| o.log_mean.as_ref().map_or(f64::NAN, value));
        let truth = RATIO.log10();
        format!(
            "| {} | {} x {} | {:+.1} % | {:.1} % | {:.2} | {:+.1} %, {:.1} %, {:.2} | {:+.1} % | {:+.1} %, {:.1} % | {:.1} % | {} |",
            self.name,
            self.people,
            self.trials,
            percent(mean(&|o| o.error_log10)),
            share(&|o| holds(o.ci95, truth)),
            mean(&|o| width(o.ci95)),
            percent(log_mean(&|m| m.mean - truth)),
            100.0 * log_mean(&|m| f64::from(u8::from(holds(m.ci95, truth)))),
            log_mean(&|m| width(m.ci95)),
            100.0 * (mean(&|o| o.origin_slope) / RATIO - 1.0),
            percent(mean(&|o| o.hidden_error_log10)),
            share(&|o| o.hidden_covers),
            share(&|o| o.exponent_rejected),
            cohorts - outcomes.len() as u64,
        )
    }
}

fn holds([low, high]: [f64; 2], value: f64) -> bool {
    low <= value && value <= high
}

fn main() -> Result<(), Error> {
    let mut arguments = std::env::args().skip(1).map(|argument| argument.parse().ok());
    let mut next = |default: u64| arguments.next().flatten().unwrap_or(default);
    let (cohorts, first_seed) = (next(400), next(1));
    // The line's target is the mean person.
    let mean_person = 100.0 * ((0.5 * (BETWEEN_SD * LN_10).powi(2)).exp() - 1.0);
    println!(
        "{cohorts} cohorts a cell, seeds from {first_seed}; the mean person lies {mean_person:+.1} % above the median one\n"
    );
    println!(
        "| people are | people x trials | bias | coverage | width | mean of logarithms: bias, coverage, width | line \
         through 0: bias | 95 % of viewers at 10 %: bias, coverage | exponent 1 rejected | refused |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    for cell in cells(&Protocol::named("yes-no")?) {
        println!("{}", cell.row(cohorts, first_seed));
    }
    Ok(())
}
