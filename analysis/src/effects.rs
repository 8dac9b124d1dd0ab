//! What pattern, contrast and the place of a round in the session do to a person's ratio.
//!
//! From each person's own log10 ratios, one a series under the first kernel, of people who have all of them:
//!
//! * pattern, contrast: mean of one level less mean of the first, within the person;
//! * round: slope of the ratio, less the mean of its series over people, against the place of the round in the session:
//!   learning or fatigue.
//!
//! Over people: Student's t, so that a difference between people in the effect itself is in the interval.

use scumble_psychophysics::{Protocol, Round};

use crate::{
    estimate::{MeanOverPeople, line},
    people::Person,
    series::{Series, pattern_name, round_of},
};

/// A difference in the ratio.
#[derive(Debug, Clone, PartialEq)]
pub struct Effect {
    /// What is compared: `step against stair`.
    pub name: String,
    /// Over people, log10 of the factor on the ratio.
    pub log10_factor: MeanOverPeople,
}

/// One person's log10 ratio in a round, and the round's place in the session, from 1.
#[derive(Debug, Clone, Copy)]
struct Cell {
    round: Round,
    place: f64,
    log10_ratio: f64,
}

/// The effects that the study can show: those of factors with several levels.
pub(crate) fn effects(series: &[Series], people: &[Person], protocol: &Protocol) -> Vec<Effect> {
    let Some(&kernel) = protocol.conditions.kernels.first() else { return Vec::new() };
    let series: Vec<&Series> = series.iter().filter(|series| series.round.kernel == kernel).collect();
    let cells: Vec<Vec<Cell>> = people.iter().filter_map(|person| cells_of(person, &series)).collect();
    let effect = |name: String, of: &dyn Fn(&[Cell]) -> Option<f64>| {
        let values: Vec<f64> = cells.iter().filter_map(|person| of(person)).collect();
        Some(Effect { name, log10_factor: MeanOverPeople::of(&values).ok()? })
    };

    let mut found = Vec::new();
    if let [first, others @ ..] = &protocol.conditions.patterns[..] {
        found.extend(others.iter().filter_map(|other| {
            let name = format!("{} against {}", pattern_name(*other), pattern_name(*first));
            effect(name, &|cells| difference(cells, |round| round.pattern == *other, |round| round.pattern == *first))
        }));
    }
    if let [first, others @ ..] = &protocol.conditions.contrasts[..] {
        found.extend(others.iter().filter_map(|other| {
            let name = format!("contrast {} % against {} %", other * 100.0, first * 100.0);
            effect(name, &|cells| difference(cells, |round| round.contrast == *other, |round| round.contrast == *first))
        }));
    }
    if series.len() > 1 {
        let means: Vec<f64> = (0..series.len())
            .map(|index| cells.iter().map(|person| person[index].log10_ratio).sum::<f64>() / cells.len() as f64)
            .collect();
        let per_round = |person: &[Cell]| {
            let points = person.iter().zip(&means).map(|(cell, mean)| (cell.place, cell.log10_ratio - mean));
            line(&points.collect::<Vec<_>>()).map(|(_, slope)| slope)
        };
        found.extend(effect("each round later in the session".to_owned(), &per_round));
    }
    found
}

/// A person's ratios in the order of `series`; `None` where one is missing.
fn cells_of(person: &Person, series: &[&Series]) -> Option<Vec<Cell>> {
    let cell = |series: &&Series| {
        let own = series.people.iter().find(|entry| entry.person == person.code)?;
        let here = person.tracks.iter().filter(|track| round_of(&track.condition) == series.round);
        let places: Vec<f64> = here.flat_map(|track| &track.runs).map(|run| f64::from(run.round)).collect();
        let place = places.iter().sum::<f64>() / places.len() as f64;
        Some(Cell { round: series.round, place, log10_ratio: own.log10_ratio })
    };
    series.iter().map(cell).collect()
}

/// Mean over the cells of one level less that over those of the other.
fn difference(cells: &[Cell], one: impl Fn(&Round) -> bool, other: impl Fn(&Round) -> bool) -> Option<f64> {
    let mean = |is: &dyn Fn(&Round) -> bool| {
        let values: Vec<f64> = cells.iter().filter(|cell| is(&cell.round)).map(|cell| cell.log10_ratio).collect();
        (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
    };
    Some(mean(&one)? - mean(&other)?)
}

impl Effect {
    /// Factor on the ratio.
    pub fn factor(&self) -> f64 {
        10_f64.powf(self.log10_factor.mean)
    }

    /// 95 % interval of the factor.
    pub fn factor_ci95(&self) -> [f64; 2] {
        self.log10_factor.ci95.map(|limit| 10_f64.powf(limit))
    }

    /// Probability of a difference at least as far from none where there is none.
    pub fn p_value(&self) -> f64 {
        self.log10_factor.p_value(0.0)
    }
}

#[cfg(test)]
mod tests {
    use scumble_stimuli::Pattern;

    use super::*;
    use crate::{Analysis, Simulation};
    use scumble_psychophysics::{Fatigue, ObserverModel, WeibullObserver};

    fn simulated(fatigue: Fatigue) -> Analysis {
        let median = ObserverModel::Weibull(WeibullObserver { fatigue, ..Default::default() });
        let protocol = Protocol::two_alternative();
        let simulation = Simulation { protocol, observers: 16, seed: 11, median, between_sd_log10: 0.1 };
        Analysis::of(&simulation.study().unwrap()).unwrap()
    }

    fn holds(effect: &Effect, log10_factor: f64) -> bool {
        let [low, high] = effect.log10_factor.ci95;
        low <= log10_factor && log10_factor <= high
    }

    #[test]
    fn effects_that_people_were_given_are_found_and_others_are_not() {
        let analysis = simulated(Fatigue::default());
        let [pattern, contrast, round] = &analysis.effects[..] else { panic!("{:?}", analysis.effects) };
        assert_eq!(pattern.name, "step against stair");
        // The simulated median: 2.5 for the stair, 3.47 for the step; 0.95 of it at half the contrast.
        assert!(holds(pattern, (3.47_f64 / 2.5).log10()) && pattern.p_value() < 1e-3, "{pattern:?}");
        assert!(holds(contrast, 0.95_f64.log10()), "{contrast:?}");
        assert!(holds(round, 0.0), "{round:?}");
    }

    #[test]
    fn people_who_learn_have_falling_ratios_from_round_to_round() {
        let fall = 0.2;
        let analysis = simulated(Fatigue { threshold_fall_log10_per_100_trials: fall, ..Fatigue::default() });
        let round = analysis.effects.last().unwrap();
        // A round has 60 trials or so.
        assert!((round.log10_factor.mean + 0.6 * fall).abs() < 0.05 && round.p_value() < 0.01, "{round:?}");
    }

    #[test]
    fn a_person_without_one_of_the_series_is_not_in_a_comparison() {
        let round = |pattern, contrast| Round { pattern, contrast, kernel: scumble_stimuli::Kernel::NAMED[0].1 };
        let cell = |pattern, contrast, log10_ratio| Cell { round: round(pattern, contrast), place: 1.0, log10_ratio };
        let cells = [cell(Pattern::Stair, 1.0, 0.4), cell(Pattern::Stair, 0.5, 0.3), cell(Pattern::Step, 1.0, 0.6)];
        let of = |pattern| move |round: &Round| round.pattern == pattern;
        let found = difference(&cells, of(Pattern::Step), of(Pattern::Stair)).unwrap();
        assert!((found - 0.25).abs() < 1e-12);
        assert_eq!(difference(&cells, of(Pattern::DoubleStep), of(Pattern::Stair)), None);
    }
}
