//! What a study as configured will give, before anybody sits down (command `plan`).
//!
//! Simulated people with known thresholds run the real experiment; the analysis' own fit answers.
//!
//! * Error of a threshold: fitted less true log10 ratio of the same person. Its mean is the bias, its
//!   standard deviation the precision, with the person's spread left out.
//! * Interval of c: cohorts are drawn from the pool of simulated people, each pool order one partition
//!   into cohorts of `n`. Coverage is the share of cohorts whose 95 % interval holds the true median.
//!   Its standard error is that of the cohorts of one partition, which share nobody; more orders only
//!   make it smaller.
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
    estimate::MeanOverPeople,
    people::{Person, Track},
    reach::check_reach,
    series::{round_of, series_name},
    simulation::Simulation,
    thresholds::{joint_threshold, thresholds_of},
};

/// Numbers of people for which the interval of c is foretold.
pub const COHORTS: [usize; 3] = [10, 20, 40];

/// Fewest cohorts without a common person from which a coverage is told.
const COHORTS_FEWEST: usize = 10;

/// Pool orders, each of which is cut into cohorts.
const ORDERS: usize = 20;

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
    /// Standard error of the coverage, at most.
    pub coverage_standard_error: Option<f64>,
}

/// What is kept of one simulated person.
struct Outcome {
    trials: usize,
    staircases: Staircases,
    /// Errors of thresholds, log10: one a condition.
    thresholds: Vec<Option<f64>>,
    /// Fitted log10 ratio and its error: one a round.
    ratios: Vec<Option<(f64, f64)>>,
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
        let outcomes: Vec<Outcome> = (0..simulation.observers)
            .into_par_iter()
            .map(|index| {
                let outcome = outcome(simulation, index, &truths);
                finished();
                outcome
            })
            .collect::<Result<_, Error>>()?;

        let series = series_forecasts(protocol, &truths, &outcomes);
        let rounds = protocol.rounds();
        let of_kernel = |index: &usize| rounds[*index].kernel == protocol.conditions.kernels[0];
        let larger = |a: &usize, b: &usize| series[*a].ratio.total_cmp(&series[*b].ratio);
        let Some(worst) = (0..series.len()).filter(of_kernel).max_by(larger) else {
            return Err(Error::CannotPlan("the protocol has no round".to_owned()));
        };
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
            intervals: interval_forecasts(&outcomes, worst, series[worst].ratio),
            series,
        })
    }
}

/// Every condition with the log10 of the median person's ratio at the protocol's threshold.
fn conditions_with_truth(simulation: &Simulation) -> Result<Vec<(Condition, f64)>, Error> {
    let conditions = simulation.protocol.all_conditions().into_iter();
    conditions.map(|condition| Ok((condition, simulation.true_log10(&condition)?))).collect()
}

fn outcome(simulation: &Simulation, index: u32, truths: &[(Condition, f64)]) -> Result<Outcome, Error> {
    let (experiment, events) = simulation.run(index)?;
    let person = Person::of("", &experiment, &events);
    let deviation = simulation.person_deviation_log10(index)?;
    let thresholds = thresholds_of(&person, &simulation.protocol)
        .iter()
        .zip(truths)
        .map(|(entry, (_, truth))| Some(entry.threshold.ok()?.log10_ratio - truth - deviation))
        .collect();
    let known = Assumptions::of_person(&person, &simulation.protocol);
    let ratio_of = |round: Round| {
        let here = person.tracks.iter().filter(|track| round_of(&track.condition) == round);
        let fitted = joint_threshold(here, &known).ok()?.log10_ratio;
        let (_, truth) = truths.iter().find(|(condition, _)| round_of(condition) == round)?;
        Some((fitted, fitted - truth - deviation))
    };
    Ok(Outcome {
        trials: events.iter().filter(|event| event.answered().is_some()).count(),
        staircases: person.tracks.iter().map(Staircases::of).fold(Staircases::default(), Staircases::plus),
        thresholds,
        ratios: simulation.protocol.rounds().into_iter().map(ratio_of).collect(),
    })
}

fn series_forecasts(protocol: &Protocol, truths: &[(Condition, f64)], outcomes: &[Outcome]) -> Vec<SeriesForecast> {
    let forecast = |(index, round): (usize, Round)| {
        let here: Vec<usize> = (0..truths.len()).filter(|&i| round_of(&truths[i].0) == round).collect();
        let errors = outcomes.iter().flat_map(|outcome| here.iter().map(|&condition| outcome.thresholds[condition]));
        let ratios = outcomes.iter().map(|outcome| outcome.ratios[index].map(|(_, error)| error));
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

fn interval_forecasts(outcomes: &[Outcome], worst: usize, truth: f64) -> Vec<IntervalForecast> {
    let pool: Vec<f64> =
        outcomes.iter().filter_map(|outcome| outcome.ratios[worst]).map(|(fitted, _)| fitted).collect();
    COHORTS.iter().filter_map(|&people| interval_forecast(&pool, people, truth.log10())).collect()
}

/// Intervals of cohorts of `people` from a pool of log10 ratios; `None` for a pool without two cohorts.
fn interval_forecast(pool: &[f64], people: usize, truth_log10: f64) -> Option<IntervalForecast> {
    let disjoint = pool.len() / people;
    if disjoint < 2 {
        return None;
    }
    let means: Vec<MeanOverPeople> = strides(pool.len())
        .flat_map(|stride| {
            let order: Vec<f64> = (0..disjoint * people).map(|place| pool[place * stride % pool.len()]).collect();
            order.chunks(people).filter_map(|cohort| MeanOverPeople::of(cohort).ok()).collect::<Vec<_>>()
        })
        .collect();
    let over_cohorts = |value: fn(&MeanOverPeople) -> f64| median(means.iter().map(value).collect());
    let count = means.len() as f64;
    let covered = means.iter().filter(|mean| mean.ci95[0] <= truth_log10 && truth_log10 <= mean.ci95[1]).count();
    let coverage = (disjoint >= COHORTS_FEWEST).then(|| covered as f64 / count);
    Some(IntervalForecast {
        people,
        median_low: over_cohorts(|mean| 10_f64.powf(mean.ci95[0])),
        median_high: over_cohorts(|mean| 10_f64.powf(mean.ci95[1])),
        median_width: over_cohorts(|mean| 10_f64.powf(mean.ci95[1]) - 10_f64.powf(mean.ci95[0])),
        bias_log10: means.iter().map(|mean| mean.mean - truth_log10).sum::<f64>() / count,
        coverage,
        coverage_standard_error: coverage.map(|share| (share * (1.0 - share) / disjoint as f64).sqrt()),
    })
}

/// Steps that visit each of `count` places once: numbers without a common divisor with it.
fn strides(count: usize) -> impl Iterator<Item = usize> {
    let divisor = |mut a: usize, mut b: usize| {
        while b != 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    (1..).filter(move |&stride| divisor(count, stride) == 1).take(ORDERS)
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
    use scumble_psychophysics::ObserverModel;

    /// log10 ratios of people, measured without error: normal with mean log10 3.47 and SD 0.1.
    fn pool(people: u32) -> Vec<f64> {
        let (protocol, median) = (Protocol::two_alternative(), ObserverModel::default());
        let simulation = Simulation { protocol, observers: people, seed: 4, median, between_sd_log10: 0.1 };
        (0..people).map(|index| 3.47_f64.log10() + simulation.person_deviation_log10(index).unwrap()).collect()
    }

    #[test]
    fn intervals_of_normal_numbers_hold_their_mean_in_95_percent_and_a_shifted_one_rarely() {
        let pool = pool(4000);
        for people in COHORTS {
            let forecast = interval_forecast(&pool, people, 3.47_f64.log10()).unwrap();
            let (coverage, error) = (forecast.coverage.unwrap(), forecast.coverage_standard_error.unwrap());
            assert!((coverage - 0.95).abs() < 3.0 * error, "{forecast:?}");
            assert!(interval_forecast(&pool, people, 3.47_f64.log10() + 0.1).unwrap().coverage.unwrap() < 0.3);
        }
        // Student's t(0.975, 9) x 0.1 / sqrt 10 = 0.0715 log10 to either side; the median SD is 0.963 of 0.1.
        let ten = interval_forecast(&pool, 10, 3.47_f64.log10()).unwrap();
        let expected = 3.47 * (10_f64.powf(0.0689) - 10_f64.powf(-0.0689));
        assert!((ten.median_width / expected - 1.0).abs() < 0.05, "{ten:?} is not {expected}");
    }

    #[test]
    fn every_order_visits_everyone_once() {
        for count in [24, 97, 100] {
            for stride in strides(count) {
                let mut places: Vec<usize> = (0..count).map(|place| place * stride % count).collect();
                places.sort_unstable();
                assert_eq!(places, (0..count).collect::<Vec<_>>(), "stride {stride}");
            }
        }
    }

    #[test]
    fn accuracy_is_mean_and_standard_deviation_of_what_was_found() {
        let accuracy = Accuracy::of([Some(0.1), None, Some(0.3)].into_iter());
        assert_eq!((accuracy.count, accuracy.missing), (2, 1));
        assert!((accuracy.bias_log10 - 0.2).abs() < 1e-15 && (accuracy.sd_log10 - 0.02_f64.sqrt()).abs() < 1e-15);
    }
}
