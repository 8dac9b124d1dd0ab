//! How far a session is, and where it rests.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod support;

use scumble_psychophysics::{Experiment, Protocol, Role, Stage};
use support::{NAMES, at_first_trial, named, observer, reply, watch};

#[test]
fn a_rest_stands_before_every_round() {
    let mut experiment = at_first_trial(Protocol::two_alternative());
    let mut rests = vec![];
    let person = observer(1);
    while *experiment.stage() != Stage::Finished {
        match *experiment.stage() {
            Stage::Trial(trial) => {
                let progress = experiment.progress();
                assert_eq!(progress.round, trial.round);
                assert_eq!(progress.trials + 1, trial.number);
                assert!(progress.trials < progress.trials_at_least);
                assert!(progress.trials_at_least <= progress.trials_at_most);
                experiment.answer(reply(person.answer(&trial, &experiment.protocol().pictures).unwrap(), 1.0)).unwrap();
            }
            Stage::Rest { round, rounds, .. } => {
                rests.push((round, rounds));
                experiment.proceed().unwrap();
            }
            stage => panic!("{}", stage.name()),
        }
    }
    assert_eq!(rests, [(2, 4), (3, 4), (4, 4)]);
    let progress = experiment.progress();
    assert_eq!(progress.trials, progress.trials_at_least);
    assert_eq!(progress.trials, progress.trials_at_most);
}

#[test]
fn progress_counts_an_answer_of_every_role_and_apart_from_them_those_that_a_staircase_learned_from() {
    let (mut answered, mut measured) = (0, 0);
    watch(&named("yes-no"), 2, 0, |experiment| {
        if let Stage::Trial(trial) = *experiment.stage() {
            let progress = experiment.progress();
            assert_eq!((progress.answered, progress.trials), (answered, measured));
            answered += 1;
            measured += u32::from(trial.role == Role::Measure);
        }
    });
    assert!(answered > measured + 100, "{answered} {measured}");
}

#[test]
fn rests_within_a_round_come_after_so_many_trials_and_never_at_its_end() {
    let mut protocol = named("yes-no");
    protocol.schedule.rest_every_trials = Some(7);
    let (mut since, mut within, mut last_was_rest, mut round) = (0, 0, false, 1);
    watch(&protocol, 2, 0, |experiment| match *experiment.stage() {
        Stage::Rest { round: next, within_round, .. } => {
            assert!(!last_was_rest);
            assert_eq!(within_round, next == round && experiment.progress().trials > 0);
            if within_round {
                assert_eq!(since, 7);
                within += 1;
            } else {
                assert!(since <= 7);
            }
            (since, last_was_rest, round) = (0, true, next);
        }
        Stage::Trial(_) => {
            since += 1;
            assert!(since <= 7);
            last_was_rest = false;
        }
        _ => (),
    });
    assert!(within > 20, "{within}");
}

#[test]
fn progress_moves_forward_only_and_ends_where_it_said() {
    for name in NAMES {
        let mut last = Experiment::new(named(name), 6, 0).unwrap().progress();
        watch(&named(name), 6, 0, |experiment| {
            let now = experiment.progress();
            assert!(now.trials >= last.trials && now.trials <= last.trials + 1);
            assert!(now.trials_at_least >= last.trials_at_least && now.trials_at_most <= last.trials_at_most);
            assert!(now.trials <= now.trials_at_least && now.trials_at_least <= now.trials_at_most);
            assert!(now.round >= last.round && now.round <= now.rounds);
            last = now;
        });
        assert_eq!((last.trials, last.round), (last.trials_at_least, last.rounds));
        assert_eq!(last.trials, last.trials_at_most);
    }
}
