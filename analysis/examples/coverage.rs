//! Bias and coverage of the analysis on simulated cohorts with a known truth.
//!
//! Every cohort runs the experiment's own state machine: log-normal people, median 3.47, between-person
//! SD 0.1 log10, lapse 0.01, slope 3.5. Printed for the step pattern at 100 % contrast, the true worst case:
//! bias of the ratio, coverage of its 95 % interval, rejections of a true exponent 1 and intercept 0,
//! coverage of the ratio that hides the artifact from 95 % of viewers at 10 % detection, the same
//! for the published estimator, and the bias of the reported worst condition, which is chosen after
//! seeing the data.
//!
//! ```sh
//! cargo run --release -p scumble-analysis --example coverage -- COHORTS PEOPLE SLOPE PROTOCOL
//! ```

use rayon::prelude::*;
use scumble_analysis::{Analysis, Error, Simulation};
use scumble_psychophysics::{ObserverModel, Protocol, WeibullObserver};

const RATIO: f64 = 3.47;
const BETWEEN_SD: f64 = 0.1;

/// What one cohort says.
struct Outcome {
    log10_ratio: f64,
    covers: bool,
    worst_log10: f64,
    worst_covers: bool,
    origin_slope: f64,
    origin_covers: bool,
    exponent_rejected: bool,
    intercept_rejected: bool,
    hidden_log10_error: f64,
    hidden_covers: bool,
    without_threshold: usize,
    unconverged: usize,
    thresholds: usize,
    trials: usize,
}

fn cohort(protocol: &Protocol, people: u32, slope: f64, seed: u64) -> Result<Outcome, Error> {
    let person = WeibullObserver { slope_per_log10: slope, ..Default::default() };
    let median = ObserverModel::Weibull(person).with_ratio(RATIO)?;
    let simulation =
        Simulation { protocol: protocol.clone(), observers: people, seed, median, between_sd_log10: BETWEEN_SD };
    let study = simulation.study()?;
    let analysis = Analysis::of(&study)?;
    let step = analysis.series.iter().find(|s| s.name == "step, 100 % contrast");
    let step = step.ok_or_else(|| Error::CannotFit("no step at 100 %".to_owned()))?;
    let within = |[low, high]: [f64; 2], value: f64| low <= value && value <= high;

    // The truth for 95 % of viewers at 10 % detection, by the observer's own function.
    let hidden = analysis.population.ratio(0.95, 0.10)?;
    let seen = |p: f64| -(-p / (1.0 - person.lapse_probability)).ln_1p();
    let decades = (seen(analysis.population.detection_at_threshold) / seen(0.10)).log10();
    let hidden_log10 = RATIO.log10() + 1.644_853_627 * BETWEEN_SD + decades / slope;
    let mean_of_ratios = RATIO * (0.5 * (BETWEEN_SD * std::f64::consts::LN_10).powi(2)).exp();
    Ok(Outcome {
        log10_ratio: step.log10_ratio.mean,
        covers: within(step.log10_ratio.ci95, RATIO.log10()),
        worst_log10: analysis.worst().log10_ratio.mean,
        worst_covers: within(analysis.worst().log10_ratio.ci95, RATIO.log10()),
        origin_slope: step.origin_line.slope,
        origin_covers: step.origin_line.over_people.is_some_and(|m| within(m.ci95, mean_of_ratios)),
        exponent_rejected: step.exponent.is_some_and(|mean| mean.p_value(1.0) < 0.05),
        intercept_rejected: step.intercept_px.is_some_and(|mean| mean.p_value(0.0) < 0.05),
        hidden_log10_error: hidden.ratio.log10() - hidden_log10,
        hidden_covers: within(hidden.ci95, 10_f64.powf(hidden_log10)),
        without_threshold: analysis.thresholds.iter().filter(|t| t.threshold.is_err()).count(),
        unconverged: analysis.thresholds.iter().map(|t| t.staircases - t.converged).sum(),
        thresholds: analysis.thresholds.len(),
        trials: study.trial_count(),
    })
}

fn main() -> Result<(), Error> {
    let mut arguments = std::env::args().skip(1);
    let mut next = |default: f64| arguments.next().and_then(|a| a.parse().ok()).unwrap_or(default);
    let (cohorts, people, slope) = (next(200.0) as u64, next(10.0) as u32, next(3.5));
    let protocol = Protocol::open(&arguments.next().unwrap_or("two-alternative".to_owned()))?;
    let outcomes: Vec<Outcome> =
        (0..cohorts).into_par_iter().map(|seed| cohort(&protocol, people, slope, seed)).collect::<Result<_, _>>()?;

    let count = outcomes.len() as f64;
    let mean = |value: fn(&Outcome) -> f64| outcomes.iter().map(value).sum::<f64>() / count;
    let share =
        |holds: fn(&Outcome) -> bool| 100.0 * outcomes.iter().filter(|outcome| holds(outcome)).count() as f64 / count;
    let percent = |log10: f64| 100.0 * (10_f64.powf(log10) - 1.0);
    let sd = mean(|o| (o.log10_ratio - RATIO.log10()).powi(2)).sqrt();
    println!(
        "{}: {cohorts} cohorts of {people} people, slope {slope}, {:.0} trials each",
        protocol.name,
        mean(|o| o.trials as f64) / f64::from(people)
    );
    println!(
        "ratio: bias {:+.2} %, RMS error {:.4} log10, coverage {:.1} %",
        percent(mean(|o| o.log10_ratio) - RATIO.log10()),
        sd,
        share(|o| o.covers)
    );
    println!(
        "worst condition: bias {:+.2} %, coverage {:.1} %",
        percent(mean(|o| o.worst_log10) - RATIO.log10()),
        share(|o| o.worst_covers)
    );
    println!(
        "line through the origin: against 3.47 {:+.2} %, coverage of the mean ratio {:.1} %",
        100.0 * (mean(|o| o.origin_slope) / RATIO - 1.0),
        share(|o| o.origin_covers)
    );
    println!(
        "true null rejected at 5 %: exponent {:.1} %, intercept {:.1} %",
        share(|o| o.exponent_rejected),
        share(|o| o.intercept_rejected)
    );
    println!(
        "95 % of viewers at 10 %: bias {:+.2} %, coverage {:.1} %",
        percent(mean(|o| o.hidden_log10_error)),
        share(|o| o.hidden_covers)
    );
    println!(
        "thresholds: {:.2} % without, {:.2} % not converged",
        100.0 * mean(|o| o.without_threshold as f64 / o.thresholds as f64),
        100.0 * mean(|o| o.unconverged as f64 / o.thresholds as f64),
    );
    Ok(())
}
