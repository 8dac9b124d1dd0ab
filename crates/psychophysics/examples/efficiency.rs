//! How far off are QUEST and QUEST+ after 10, 20 and 40 trials? Simulated people, one Markdown table.
//!
//! Every person's threshold, at 82 % correct on the person's own psychometric function, lies 0.30
//! log10 above the prior's centre; the prior's SD is 1. The estimate is the posterior's mean. Run `i`
//! has the same random numbers in every row.
//!
//! `cargo run --release -p scumble-psychophysics --example efficiency -- [RUNS]`

use std::time::{Duration, Instant};

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use scumble_psychophysics::{Error, Psychometric, Staircase, StaircaseConfig};

/// Trials after which the estimate is taken.
const CHECKPOINTS: [usize; 3] = [10, 20, 40];

/// The person's threshold above the prior's centre, log10.
const TRUTH: f64 = 0.3;

/// Runs without an argument: a standard error of 3 % of an SD of 10 trials.
const RUNS: u64 = 4000;

/// Runs whose trials are timed.
const TIMED_RUNS: u64 = 10;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let runs = std::env::args().nth(1).map_or(Ok(RUNS), |text| text.parse())?;
    println!("{runs} runs a row; bias and SD in log10, each SD with its standard error.\n");
    println!("| person | method | bias 10 | 20 | 40 | SD 10 | 20 | 40 | µs a trial |");
    println!("|---|---|---:|---:|---:|---:|---:|---:|---:|");
    for (person, slope_per_log10, lapse_probability) in people() {
        let curve =
            Psychometric { beta: slope_per_log10, delta: lapse_probability, gamma: 0.5, threshold_probability: 0.82 };
        for (method, config) in methods() {
            let start = config.staircase(0.0)?;
            let errors = (0..runs).into_par_iter().map(|seed| run(&start, &curve, seed).map(|run| run.0));
            let errors = errors.collect::<Result<Vec<_>, _>>()?;
            let columns = [0, 1, 2].map(|at| Moments::of(errors.iter().map(|errors| errors[at])));
            let [bias, sd] = [
                columns.map(|column| format!("{:+.3}", column.mean)),
                columns.map(|column| format!("{:.3} ± {:.3}", column.sd, column.sd_error)),
            ]
            .map(|cells| cells.join(" | "));
            println!("| {person} | {method} | {bias} | {sd} | {:.1} |", micros_a_trial(&start, &curve)?);
        }
    }
    Ok(())
}

/// Name, slope and lapse of each person; QUEST assumes those of the first.
fn people() -> [(&'static str, f64, f64); 4] {
    [
        ("as QUEST assumes: slope 3.5, lapse 1 %", 3.5, 0.01),
        ("slope 2, lapse 1 %", 2.0, 0.01),
        ("slope 3.5, lapse 5 %", 3.5, 0.05),
        ("slope 2, lapse 5 %", 2.0, 0.05),
    ]
}

/// QUEST, QUEST+ with QUEST's slope and lapse (so that the placement alone differs), and QUEST+ with
/// its default grid.
fn methods() -> [(&'static str, StaircaseConfig); 3] {
    let with_prior = |config| StaircaseConfig { prior_sd_log10: 1.0, ..config };
    let (quest, quest_plus) = (with_prior(StaircaseConfig::quest()), with_prior(StaircaseConfig::quest_plus()));
    let one = StaircaseConfig {
        table_step_log10: quest.table_step_log10,
        slopes_per_log10: vec![3.5],
        lapse_probabilities: vec![0.01],
        ..quest_plus.clone()
    };
    [("QUEST", quest), ("QUEST+, one slope and lapse", one), ("QUEST+", quest_plus)]
}

/// Errors of the estimate at the checkpoints, and the time of each trial's placement and update.
fn run(start: &Staircase, curve: &Psychometric, seed: u64) -> Result<([f64; 3], Vec<Duration>), Error> {
    let mut staircase = start.clone();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut errors = [f64::NAN; 3];
    let mut times = Vec::new();
    for trial in 1..=CHECKPOINTS[2] {
        let begin = Instant::now();
        let intensity = staircase.placement();
        let placed = begin.elapsed();
        let right = curve.probability(intensity - TRUTH) > random.random();
        let begin = Instant::now();
        staircase.update(intensity, right)?;
        times.push(placed + begin.elapsed());
        if let Some(at) = CHECKPOINTS.iter().position(|checkpoint| *checkpoint == trial) {
            errors[at] = staircase.mean() - TRUTH;
        }
    }
    Ok((errors, times))
}

/// Median time of a trial of [`TIMED_RUNS`] runs, one run at a time.
fn micros_a_trial(start: &Staircase, curve: &Psychometric) -> Result<f64, Error> {
    let mut times = Vec::new();
    for seed in 0..TIMED_RUNS {
        times.extend(run(start, curve, seed)?.1);
    }
    times.sort();
    Ok(times[times.len() / 2].as_secs_f64() * 1e6)
}

/// Mean, standard deviation, and the latter's standard error from the fourth moment:
/// `sqrt((m4 - sd^4) / n) / (2 sd)`, as the errors' tails are far from normal.
#[derive(Clone, Copy)]
struct Moments {
    mean: f64,
    sd: f64,
    sd_error: f64,
}

impl Moments {
    fn of(values: impl ExactSizeIterator<Item = f64> + Clone) -> Self {
        let count = values.len() as f64;
        let mean = values.clone().sum::<f64>() / count;
        let moment = |order| values.clone().map(|value| (value - mean).powi(order)).sum::<f64>() / count;
        let (variance, fourth) = (moment(2), moment(4));
        let sd_error = ((fourth - variance * variance) / count).sqrt() / (2.0 * variance.sqrt());
        Self { mean, sd: variance.sqrt(), sd_error }
    }
}
