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

mod cohort;

use std::f64::consts::LN_10;

use scumble_analysis::{Error, MeanOverPeople};
use scumble_psychophysics::{Fatigue, Protocol, WeibullObserver};

use cohort::{BETWEEN_SD, Cell, Outcome, RATIO, holds};

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

fn row(cell: &Cell, cohorts: u64, first_seed: u64) -> String {
    let outcomes = cell.outcomes(cohorts, first_seed);
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
        cell.name,
        cell.people,
        cell.trials,
        percent(mean(&|o| o.error_log10)),
        share(&Outcome::covers),
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
        println!("{}", row(&cell, cohorts, first_seed));
    }
    Ok(())
}
