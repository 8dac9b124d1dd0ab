//! How long a session of a protocol takes, before it begins: simulated people go through it.

use scumble_psychophysics::{Experiment, Observer, ObserverModel, Protocol, rehearse};

/// Simulated people. The trials of one have a standard deviation of 8 % of their mean under each shipped protocol,
/// so that the mean is known to 2 %, and all of them take a fifth of a second.
const PEOPLE: u32 = 16;

/// Duration of a trial with its empty screen: what `scumble-analysis plan` assumes.
const SECS_PER_TRIAL: f64 = 5.0;

/// What a session asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Effort {
    /// Rounds.
    pub(crate) rounds: usize,
    /// Interleaved staircases of a round.
    pub(crate) staircases: usize,
    /// Trials with practice that a session has on average, to tens: as exactly as they are known.
    pub(crate) trials: u32,
    /// Minutes that they take on average, without rests.
    pub(crate) minutes: f64,
}

impl Effort {
    /// The effort that a protocol means for people who see like those of Kreuzer 2017; `None` for a
    /// protocol that cannot be run.
    pub(crate) fn of(protocol: &Protocol) -> Option<Self> {
        let trials_of = |person: u32| -> Result<u32, scumble_psychophysics::Error> {
            let mut experiment = Experiment::new(protocol.clone(), person.into(), person)?;
            let observer = Observer::new(ObserverModel::named("weibull")?, person.into())?;
            rehearse(&mut experiment, &observer)?;
            Ok(experiment.progress().answered + protocol.practice.ratios.len() as u32)
        };
        let all = (1..=PEOPLE).map(trials_of).sum::<Result<u32, _>>().ok()?;
        let trials = 10 * (f64::from(all) / f64::from(10 * PEOPLE)).round() as u32;
        let rounds = protocol.rounds().len();
        let staircases = protocol.all_conditions().len() * protocol.staircase.prior_ratios.len() / rounds.max(1);
        Some(Self { rounds, staircases, trials, minutes: f64::from(trials) * SECS_PER_TRIAL / 60.0 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_takes_4_rounds_of_3_staircases_and_some_20_minutes() {
        let effort = Effort::of(&Protocol::two_alternative()).unwrap();
        assert_eq!((effort.rounds, effort.staircases), (4, 3));
        // The protocol's own comment: some 240 trials and 8 of practice, 20 minutes.
        assert!((240..=260).contains(&effort.trials), "{effort:?}");
        assert!((20.0..=22.0).contains(&effort.minutes), "{effort:?}");
    }

    #[test]
    fn a_protocol_that_cannot_be_run_has_no_effort() {
        let mut protocol = Protocol::two_alternative();
        protocol.schedule.trials_min = 0;
        assert_eq!(Effort::of(&protocol), None);
    }
}
