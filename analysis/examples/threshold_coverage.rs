//! How often the intervals of the command `threshold` hold the truth, and how often its p-value is below 5 %, for simulated
//! people whose function is known: location -0.1, slope 3, two alternatives, 1 % lapses, seven levels that span it.
//!
//! Printed as a Markdown table, a row for each number of answers a level: coverage in percent of the intervals of location,
//! slope and x82 by both methods, share of slopes without an upper end, p-values below 5 %, tables without an estimate.
//!
//! ```sh
//! cargo run --release -p scumble-analysis --example threshold_coverage -- EXPERIMENTS [FIRST_SEED]
//! ```

use rand_chacha::{
    ChaCha8Rng,
    rand_core::{Rng, SeedableRng},
};
use rayon::prelude::*;
use scumble_analysis::{CORRECT_AT_THRESHOLD, Count, Intervals, Parameter, Resampling, ThresholdReport, Weibull};

const TRUTH: Weibull = Weibull { location: -0.1, slope: 3.0, guess: 0.5, lapse: 0.01 };

/// From 3 % to 99.9 % seen.
const LEVELS: [f64; 7] = [-0.5, -0.375, -0.25, -0.125, 0.0, 0.125, 0.25];

/// One experiment; `None` where the table holds no estimate.
fn experiment(total: u32, lapse: Parameter, seed: u64) -> Option<ThresholdReport> {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    let mut is_correct = |x: f64| (generator.next_u64() as f64 / 2.0_f64.powi(64)) < TRUTH.correct(x);
    let level = |x: f64| {
        let correct = (0..total).filter(|_| is_correct(x)).count();
        Count { x, correct: correct as f64, total: total.into() }
    };
    let counts = LEVELS.map(level);
    ThresholdReport::of(&counts, TRUTH.guess, lapse, &Resampling { resamples: 999, seed }, || ()).ok()
}

fn holds(ends: [Option<f64>; 2], truth: Option<f64>) -> bool {
    truth.is_some_and(|truth| ends[0].is_none_or(|low| low <= truth) && ends[1].is_none_or(|high| truth <= high))
}

fn main() {
    let mut arguments = std::env::args().skip(1).map(|argument| argument.parse().ok());
    let mut next = |default: u64| arguments.next().flatten().unwrap_or(default);
    let (experiments, first_seed) = (next(1000), next(1));
    println!("{experiments} experiments a row, seeds from {first_seed}\n");
    println!(
        "| answers a level | lapse rate | profile: location, slope, x82 | bootstrap | slope has no upper end | p < 5 % | no estimate |"
    );
    println!("|---|---|---|---|---|---|---|");
    for (total, lapse) in [
        (10, Parameter::Fixed(0.01)),
        (20, Parameter::Fixed(0.01)),
        (40, Parameter::Fixed(0.01)),
        (100, Parameter::Fixed(0.01)),
        (100, Parameter::Free),
    ] {
        let one = |index| experiment(total, lapse, first_seed + index);
        let reports: Vec<ThresholdReport> = (0..experiments).into_par_iter().filter_map(one).collect();
        let share = |is: &dyn Fn(&ThresholdReport) -> bool| {
            100.0 * reports.iter().filter(|report| is(report)).count() as f64 / reports.len() as f64
        };
        let coverage = |of: fn(&ThresholdReport) -> &Intervals| {
            format!(
                "{:.1}, {:.1}, {:.1}",
                share(&|report| holds(of(report).threshold_t, Some(TRUTH.location))),
                share(&|report| holds(of(report).slope_beta, Some(TRUTH.slope))),
                share(&|report| holds(of(report).x82, TRUTH.x_at_correct(CORRECT_AT_THRESHOLD))),
            )
        };
        println!(
            "| {total} | {} | {} | {} | {:.1}, {:.1} % | {:.1} % | {} |",
            if lapse == Parameter::Free { "free" } else { "given" },
            coverage(|report| &report.ci95_profile),
            coverage(|report| &report.ci95_bootstrap),
            share(&|report| report.ci95_profile.slope_beta[1].is_none()),
            share(&|report| report.ci95_bootstrap.slope_beta[1].is_none()),
            share(&|report| report.deviance_p < 0.05),
            experiments - reports.len() as u64,
        );
    }
}
