//! What a study as configured will give, before anybody sits down (command `plan`).
//!
//! Simulated people with known thresholds run the real experiment; the analysis' own fit answers.
//!
//! * Error of a threshold: fitted less true log10 ratio of the same person. Its mean is the bias, its
//!   standard deviation the precision, with the person's spread left out.
//! * Interval of c: the simulated people are cut into cohorts of `n`, each fitted as a study is. Coverage is the share of
//!   cohorts whose 95 % interval holds the true median.
//! * Time: trials, practice included, times an assumed duration; rests are not in it.
//!
//! A study is refused where fewer than half of the staircases converge: its people sit there for nothing.
//!
//! What it says holds for people like the simulated ones: their slope and lapses are assumptions too.

use rayon::prelude::*;
use scumble_psychophysics::{Condition, Protocol, Reason, Round};
use serde::Serialize;

use crate::{
    Error,
    assumptions::Assumptions,
    mixed_model::{Interval, MixedModel, PersonAnswers, Quantity},
    people::{Person, Track},
    reach::check_reach,
    series::{answers_of, round_of, series_name},
    simulation::Simulation,
    thresholds::{joint_threshold, thresholds_of},
};

/// Numbers of people for which the interval of c is foretold.
pub const COHORTS: [usize; 3] = [10, 20, 40];

/// Fewest cohorts from which a coverage is told.
const COHORTS_FEWEST: usize = 10;

/// The forecast.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Plan {
    /// Name of the protocol.
    pub protocol: String,
    /// Simulated people.
    pub sessions: usize,
    /// Trials of a session, practice included: mean, 5 % and 95 % quantile.
    pub trials: Spread,
    /// Minutes of a session without rests.
    pub minutes: Spread,
    /// Assumed seconds for one trial.
    pub secs_per_trial: f64,
    /// How the staircases end.
    pub staircases: Staircases,
    /// One a pattern, contrast and kernel.
    pub series: Vec<SeriesForecast>,
    /// The series with the largest expected threshold under the protocol's first kernel, which a fit writes
    /// for renderers and the intervals are about.
    pub worst: String,
    /// The median person's true ratio there.
    pub worst_ratio: f64,
    /// One a size of cohort; sizes above the pool are left out.
    pub intervals: Vec<IntervalForecast>,
}

/// A number over people.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    /// Mean.
    pub mean: f64,
    /// 5 % quantile.
    pub q05: f64,
    /// 95 % quantile.
    pub q95: f64,
}

/// How staircases end; a staircase that did not converge may have several reasons.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Staircases {
    /// Number of them, over all people.
    pub count: usize,
    /// Those that converged.
    pub converged: usize,
    /// The interval was still wide.
    pub wide: usize,
    /// One of the answers was rare.
    pub one_sided: usize,
    /// The estimate was at an end.
    pub at_edge: usize,
    /// The halves differed.
    pub halves_differ: usize,
}

/// Bias and standard deviation of an estimate, log10 units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Accuracy {
    /// Estimates that the answers carried.
    pub count: usize,
    /// Estimates that they did not.
    pub missing: usize,
    /// Mean error.
    pub bias_log10: f64,
    /// Standard deviation of the error.
    pub sd_log10: f64,
}

/// A pattern at a contrast under a kernel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SeriesForecast {
    /// As in the report of a fit.
    pub name: String,
    /// The median person's true ratio.
    pub ratio: f64,
    /// Thresholds of single texel sizes.
    pub threshold: Accuracy,
    /// A person's ratio from all texel sizes.
    pub person_ratio: Accuracy,
}

/// The 95 % interval of c from a number of people.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct IntervalForecast {
    /// People in the cohort.
    pub people: usize,
    /// Median lower limit, texels.
    pub median_low: f64,
    /// Median upper limit, texels.
    pub median_high: f64,
    /// Median width, texels.
    pub median_width: f64,
    /// Bias of the cohort's ratio, log10 units.
    pub bias_log10: f64,
    /// Share of intervals that hold the truth; `None` where the pool is too small to tell.
    pub coverage: Option<f64>,
    /// Standard error of the coverage.
    pub coverage_standard_error: Option<f64>,
}

/// What is kept of one simulated person.
struct Outcome {
    trials: usize,
    staircases: Staircases,
    /// Errors of thresholds, log10: one a condition.
    thresholds: Vec<Option<f64>>,
    /// Errors of the person's ratio from all texel sizes, log10: one a round.
    ratios: Vec<Option<f64>>,
    /// The answers in the worst round.
    answers: Option<PersonAnswers>,
}

impl Plan {
    /// Simulates `simulation`'s people, calling `finished` after each.
    ///
    /// # Errors
    /// A protocol that cannot measure what is expected ([`check_reach`]), before anything is simulated;
    /// an observer without known thresholds; options out of range.
    pub fn of(simulation: &Simulation, secs_per_trial: f64, finished: impl Fn() + Sync) -> Result<Self, Error> {
        simulation.check()?;
        if !(secs_per_trial.is_finite() && secs_per_trial > 0.0) {
            let value = secs_per_trial.to_string();
            return Err(Error::Argument { name: "--seconds-per-trial", value, allowed: "a finite number above 0" });
        }
        let protocol = &simulation.protocol;
        let truths = conditions_with_truth(simulation)?;
        check_reach(protocol, &truths, simulation.between_sd_log10)?;
        let worst = worst_round(protocol, &truths)?;
        let outcomes: Vec<Outcome> = (0..simulation.observers)
            .into_par_iter()
            .map(|index| {
                let outcome = outcome(simulation, index, &truths, worst);
                finished();
                outcome
            })
            .collect::<Result<_, Error>>()?;

        let series = series_forecasts(protocol, &truths, &outcomes);
        let worst = protocol.rounds().iter().position(|round| *round == worst).unwrap_or_default();
        let staircases = outcomes.iter().fold(Staircases::default(), |sum, outcome| sum.plus(outcome.staircases));
        check_staircases(protocol, &staircases)?;
        let trials: Vec<f64> = outcomes.iter().map(|outcome| outcome.trials as f64).collect();
        let minutes: Vec<f64> = trials.iter().map(|trials| trials * secs_per_trial / 60.0).collect();
        Ok(Self {
            protocol: protocol.name.clone(),
            sessions: outcomes.len(),
            trials: Spread::of(trials),
            minutes: Spread::of(minutes),
            secs_per_trial,
            staircases,
            worst: series[worst].name.clone(),
            worst_ratio: series[worst].ratio,
            intervals: interval_forecasts(protocol, outcomes, series[worst].ratio),
            series,
        })
    }
}

/// Every condition with the log10 of the median person's ratio at the protocol's threshold.
fn conditions_with_truth(simulation: &Simulation) -> Result<Vec<(Condition, f64)>, Error> {
    let conditions = simulation.protocol.all_conditions().into_iter();
    conditions.map(|condition| Ok((condition, simulation.true_log10(&condition)?))).collect()
}

/// The round with the largest expected threshold under the first kernel.
fn worst_round(protocol: &Protocol, truths: &[(Condition, f64)]) -> Result<Round, Error> {
    let of_kernel =
        truths.iter().filter(|(condition, _)| Some(&condition.kernel) == protocol.conditions.kernels.first());
    let worst = of_kernel.max_by(|(_, a), (_, b)| a.total_cmp(b));
    let no_round = || Error::CannotPlan("the protocol has no round".to_owned());
    worst.map(|(condition, _)| round_of(condition)).ok_or_else(no_round)
}

fn outcome(simulation: &Simulation, index: u32, truths: &[(Condition, f64)], worst: Round) -> Result<Outcome, Error> {
    let (experiment, events) = simulation.run(index)?;
    let person = Person::of("", &experiment, &events);
    let deviation = simulation.person_deviation_log10(index)?;
    let thresholds = thresholds_of(&person, &simulation.protocol, |_| None)
        .iter()
        .zip(truths)
        .map(|(entry, (_, truth))| Some(entry.threshold.ok()?.log10_ratio - truth - deviation))
        .collect();
    let known = Assumptions::of_person(&person, &simulation.protocol);
    let ratio_of = |round: Round| {
        let here = person.tracks.iter().filter(|track| round_of(&track.condition) == round);
        let fitted = joint_threshold(here, &known).ok()?.log10_ratio;
        let (_, truth) = truths.iter().find(|(condition, _)| round_of(condition) == round)?;
        Some(fitted - truth - deviation)
    };
    Ok(Outcome {
        trials: events.iter().filter(|event| event.answered().is_some()).count(),
        staircases: person.tracks.iter().map(Staircases::of).fold(Staircases::default(), Staircases::plus),
        thresholds,
        ratios: simulation.protocol.rounds().into_iter().map(ratio_of).collect(),
        answers: answers_of(worst, &person, &simulation.protocol),
    })
}

fn series_forecasts(protocol: &Protocol, truths: &[(Condition, f64)], outcomes: &[Outcome]) -> Vec<SeriesForecast> {
    let forecast = |(index, round): (usize, Round)| {
        let here: Vec<usize> = (0..truths.len()).filter(|&i| round_of(&truths[i].0) == round).collect();
        let errors = outcomes.iter().flat_map(|outcome| here.iter().map(|&condition| outcome.thresholds[condition]));
        let ratios = outcomes.iter().map(|outcome| outcome.ratios[index]);
        SeriesForecast {
            name: series_name(round, protocol),
            ratio: here.first().map_or(f64::NAN, |&first| 10_f64.powf(truths[first].1)),
            threshold: Accuracy::of(errors),
            person_ratio: Accuracy::of(ratios),
        }
    };
    protocol.rounds().into_iter().enumerate().map(forecast).collect()
}

/// Refuses a study most of whose staircases end without a threshold.
fn check_staircases(protocol: &Protocol, staircases: &Staircases) -> Result<(), Error> {
    if 2 * staircases.converged >= staircases.count {
        return Ok(());
    }
    let reasons = [
        ("interval too wide", staircases.wide),
        ("too few answers of a kind", staircases.one_sided),
        ("estimate at an end", staircases.at_edge),
        ("halves differ", staircases.halves_differ),
    ];
    let (reason, _) = reasons.into_iter().max_by_key(|(_, count)| *count).unwrap_or_default();
    Err(Error::CannotPlan(format!(
        "{} of {} simulated staircases converge within {} trials, most often for this reason: {reason}; allowed is half of \
         them and more",
        staircases.converged, staircases.count, protocol.schedule.trials_max
    )))
}

fn interval_forecasts(protocol: &Protocol, outcomes: Vec<Outcome>, truth: f64) -> Vec<IntervalForecast> {
    let pool: Vec<PersonAnswers> = outcomes.into_iter().filter_map(|outcome| outcome.answers).collect();
    let known = Assumptions::of_protocol(protocol);
    let fitted = |cohort: &[PersonAnswers]| {
        let fit = MixedModel::new(cohort.to_vec(), known).fit()?;
        Interval::of(&fit, Quantity::MEDIAN)
    };
    let forecast = |&people: &usize| {
        let cohorts: Vec<&[PersonAnswers]> = pool.chunks_exact(people).collect();
        let intervals: Vec<Interval> = cohorts.into_par_iter().filter_map(|cohort| fitted(cohort).ok()).collect();
        interval_forecast(&intervals, people, truth.log10())
    };
    COHORTS.iter().filter_map(forecast).collect()
}

/// What the intervals of cohorts of `people` have in common; `None` below two.
fn interval_forecast(cohorts: &[Interval], people: usize, truth_log10: f64) -> Option<IntervalForecast> {
    if cohorts.len() < 2 {
        return None;
    }
    let over_cohorts = |value: fn(&Interval) -> f64| median(cohorts.iter().map(value).collect());
    let count = cohorts.len() as f64;
    let covers = |interval: &&Interval| interval.ci95[0] <= truth_log10 && truth_log10 <= interval.ci95[1];
    let coverage = (cohorts.len() >= COHORTS_FEWEST).then(|| cohorts.iter().filter(covers).count() as f64 / count);
    Some(IntervalForecast {
        people,
        median_low: over_cohorts(|interval| 10_f64.powf(interval.ci95[0])),
        median_high: over_cohorts(|interval| 10_f64.powf(interval.ci95[1])),
        median_width: over_cohorts(|interval| 10_f64.powf(interval.ci95[1]) - 10_f64.powf(interval.ci95[0])),
        bias_log10: cohorts.iter().map(|interval| interval.value - truth_log10).sum::<f64>() / count,
        coverage,
        coverage_standard_error: coverage.map(|share| (share * (1.0 - share) / count).sqrt()),
    })
}

impl Staircases {
    fn of(track: &Track) -> Self {
        let with = |is: fn(&Reason) -> bool| track.runs.iter().filter(|run| run.unconverged.iter().any(is)).count();
        Self {
            count: track.runs.len(),
            converged: track.converged(),
            wide: with(|reason| matches!(reason, Reason::Wide { .. })),
            one_sided: with(|reason| matches!(reason, Reason::OneSided { .. })),
            at_edge: with(|reason| matches!(reason, Reason::AtEdge { .. })),
            halves_differ: with(|reason| matches!(reason, Reason::HalvesDiffer { .. })),
        }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            count: self.count + other.count,
            converged: self.converged + other.converged,
            wide: self.wide + other.wide,
            one_sided: self.one_sided + other.one_sided,
            at_edge: self.at_edge + other.at_edge,
            halves_differ: self.halves_differ + other.halves_differ,
        }
    }
}

impl Accuracy {
    /// Of errors, log10 units; `None` where the answers carried no estimate.
    fn of(errors: impl Iterator<Item = Option<f64>>) -> Self {
        let all: Vec<Option<f64>> = errors.collect();
        let found: Vec<f64> = all.iter().copied().flatten().collect();
        let count = found.len() as f64;
        let bias_log10 = found.iter().sum::<f64>() / count;
        let squares: f64 = found.iter().map(|error| (error - bias_log10).powi(2)).sum();
        let sd_log10 = (squares / (count - 1.0)).sqrt();
        Self { count: found.len(), missing: all.len() - found.len(), bias_log10, sd_log10 }
    }
}

impl Spread {
    fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let quantile = |share: f64| values[((values.len() - 1) as f64 * share).round() as usize];
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        Self { mean, q05: quantile(0.05), q95: quantile(0.95) }
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_coverage_is_the_share_of_intervals_that_hold_the_truth() {
        let of = |low: f64| Interval { value: low + 0.1, ci95: [low, low + 0.2], standard_error: 0.05 };
        let cohorts: Vec<Interval> = (0..20).map(|index| of(0.01 * f64::from(index))).collect();
        let forecast = interval_forecast(&cohorts, 10, 0.095).unwrap();
        assert_eq!(forecast.coverage, Some(0.5), "ten begin below the truth, and all end above it");
        assert!((forecast.bias_log10 - (0.095 + 0.1 - 0.095)).abs() < 1e-12);
        assert_eq!(interval_forecast(&cohorts[..9], 10, 0.095).unwrap().coverage, None, "nine are too few to tell");
        assert_eq!(interval_forecast(&cohorts[..1], 10, 0.095), None);
    }

    #[test]
    fn accuracy_is_mean_and_standard_deviation_of_what_was_found() {
        let accuracy = Accuracy::of([Some(0.1), None, Some(0.3)].into_iter());
        assert_eq!((accuracy.count, accuracy.missing), (2, 1));
        assert!((accuracy.bias_log10 - 0.2).abs() < 1e-15 && (accuracy.sd_log10 - 0.02_f64.sqrt()).abs() < 1e-15);
    }
}
