//! Whole sessions through the state machine: the order of trials, what is learned, what is refused.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod support;

use scumble_psychophysics::{Answer, Error, Event, Experiment, Protocol, Stage, rehearse};
use scumble_stimuli::Pattern;
use support::{at_first_trial, measured, named, observer, reply, session};

fn default_session(seed: u64) -> (Experiment, Vec<Event>) {
    session(&Protocol::two_alternative(), seed, 0)
}

#[test]
fn a_session_has_four_rounds_of_three_sizes_and_each_size_ten_to_thirty_six_trials() {
    let (experiment, events) = default_session(3);
    assert_eq!(experiment.tracks().len(), 12);
    let conditions = experiment.protocol().all_conditions();
    for track in experiment.tracks() {
        assert!(conditions.contains(track.condition()));
        assert!((10..=36).contains(&track.trials()) && track.is_done());
        assert!(track.trials() == 36 || track.verdict().is_converged());
    }
    for (round, tracks) in (1..).zip(experiment.tracks().chunks(3)) {
        let of_round = measured(&events).into_iter().filter(|t| t.round == round);
        for trial in of_round {
            assert_eq!(trial.condition.pattern, tracks[0].condition().pattern);
            assert_eq!(trial.condition.contrast, tracks[0].condition().contrast);
        }
    }
}

#[test]
fn every_round_comes_first_in_some_session() {
    let mut first_rounds: Vec<String> = (0..40)
        .map(|seed| {
            let experiment = Experiment::new(Protocol::two_alternative(), seed, 0).unwrap();
            let condition = experiment.tracks()[0].condition();
            format!("{:?} {}", condition.pattern, condition.contrast)
        })
        .collect();
    first_rounds.sort();
    first_rounds.dedup();
    assert_eq!(first_rounds.len(), 4);
}

#[test]
fn the_sizes_of_a_round_never_run_apart_by_more_than_one_trial() {
    let trials = measured(&default_session(5).1);
    for round in 1..=4 {
        let of_round: Vec<_> = trials.iter().filter(|trial| trial.round == round).collect();
        // Until the tenth trial no QUEST may stop, so the first 30 trials are ten whole cycles.
        for cycle in of_round[..30].chunks(3) {
            let mut sizes: Vec<f64> = cycle.iter().map(|trial| trial.condition.texel_px).collect();
            sizes.sort_by(f64::total_cmp);
            assert_eq!(sizes, [5.0, 10.0, 20.0]);
        }
    }
}

#[test]
fn practice_gives_feedback_and_teaches_no_quest() {
    let protocol = Protocol::two_alternative();
    let mut experiment = Experiment::new(protocol.clone(), 9, 0).unwrap();
    experiment.proceed().unwrap();
    for (number, ratio) in (1..).zip(&protocol.practice.ratios) {
        let Stage::Practice(trial) = *experiment.stage() else { panic!("{}", experiment.stage().name()) };
        assert_eq!((trial.number, trial.round), (number, 0));
        assert!((trial.ratio() - ratio).abs() < 1e-12);
        let side = [Answer::Left, Answer::Right][number as usize % 2];
        let event = experiment.answer(reply(side, 0.5)).unwrap();
        let correct = trial.is_correct(side);
        assert!(matches!(event, Event::Practice(answered) if answered.correct == correct));
        assert_eq!(*experiment.stage(), Stage::Feedback { correct, right_answer: trial.pictures.right_answer() });
        experiment.proceed().unwrap();
    }
    let first_rest = Stage::Rest { round: 1, rounds: 4, within_round: false };
    assert_eq!(*experiment.stage(), first_rest);
    let prior = protocol.staircase_at(3.0).unwrap();
    assert!(experiment.tracks().iter().all(|track| *track.staircase() == prior));
}

#[test]
fn quest_learns_from_the_radius_shown_where_the_picture_cannot_hold_the_one_asked_for() {
    let mut protocol = Protocol::two_alternative();
    // Radii up to 60 - 20 px: the threshold of 69 px at the largest texel cannot be shown.
    protocol.pictures.height_px = 120;
    let mut experiment = Experiment::new(protocol.clone(), 3, 0).unwrap();
    let events = rehearse(&mut experiment, &observer(3)).unwrap();
    let trials = measured(&events);
    let clamped: Vec<_> = trials.iter().filter(|trial| trial.is_clamped()).collect();
    assert!(clamped.len() > 10);
    for trial in clamped {
        let (smallest_px, largest_px) = protocol.radius_range_px(trial.condition.texel_px);
        assert!(trial.radius_px == smallest_px || trial.radius_px == largest_px);
    }
    for track in experiment.tracks() {
        let mut staircase = protocol.staircase_at(3.0).unwrap();
        let of_track = events.iter().filter_map(Event::measured);
        for answered in of_track.filter(|a| a.trial.condition == *track.condition()) {
            let shown = answered.trial.intensity();
            staircase.update(shown, answered.correct).unwrap();
        }
        assert_eq!(staircase, *track.staircase());
    }
    let largest_step = experiment
        .tracks()
        .iter()
        .filter(|track| track.condition().pattern == Pattern::Step && track.condition().texel_px == 20.0);
    // The threshold lies beyond what was shown, which the rule must not call converged.
    assert!(largest_step.clone().count() == 2);
    assert!(largest_step.clone().all(|track| !track.verdict().is_inside()));
}

#[test]
fn calls_that_the_stage_does_not_take_are_refused_and_change_nothing() {
    let mut experiment = Experiment::new(Protocol::two_alternative(), 1, 0).unwrap();
    let error = experiment.answer(reply(Answer::Left, 1.0)).unwrap_err();
    assert!(error.to_string().contains("answer at the stage instructions"));

    let mut experiment = at_first_trial(Protocol::two_alternative());
    let before = experiment.clone();
    assert!(matches!(experiment.proceed(), Err(Error::Stage { .. })));
    for secs in [-0.1, f64::NAN, f64::INFINITY] {
        let error = experiment.answer(reply(Answer::Left, secs)).unwrap_err();
        assert!(error.to_string().starts_with("response_time_secs is"));
    }
    assert_eq!(experiment, before);
}

#[test]
fn a_protocol_without_practice_starts_with_the_first_rest() {
    let mut protocol = Protocol::two_alternative();
    protocol.practice.ratios.clear();
    let mut experiment = Experiment::new(protocol, 1, 0).unwrap();
    experiment.proceed().unwrap();
    assert!(matches!(experiment.stage(), Stage::Rest { round: 1, .. }));
}

#[test]
fn participants_that_follow_each_other_fill_a_latin_square_of_rounds() {
    let protocol = named("yes-no");
    let order = |number: u32, seed: u64| {
        let experiment = Experiment::new(protocol.clone(), seed, number).unwrap();
        let conditions = experiment.tracks().chunks(3).map(|tracks| tracks[0].condition());
        let rounds = protocol.rounds();
        let place = |c: &scumble_psychophysics::Condition| {
            rounds.iter().position(|r| r.pattern == c.pattern && r.contrast == c.contrast).unwrap()
        };
        conditions.map(place).collect::<Vec<_>>()
    };
    // Williams 1949: each round once in each place, each once behind each other one.
    let square: Vec<_> = (0..4).map(|number| order(number, 1)).collect();
    assert_eq!(square, [[0, 1, 3, 2], [1, 2, 0, 3], [2, 3, 1, 0], [3, 0, 2, 1]]);
    assert_eq!(order(5, 1), square[1]);
    assert_eq!(order(2, 99), square[2], "the seed does not change it");
}

#[test]
fn two_priors_give_two_staircases_a_condition_whose_trials_interleave() {
    let mut protocol = named("two-alternative");
    protocol.staircase.prior_ratios = vec![2.0, 6.0];
    let (experiment, events) = session(&protocol, 3, 0);
    assert_eq!(experiment.tracks().len(), 24);
    for pair in experiment.tracks().chunks(2) {
        assert_eq!(pair[0].condition(), pair[1].condition());
    }
    let trials = measured(&events);
    for round in 1..=4 {
        let of_round: Vec<_> = trials.iter().filter(|trial| trial.round == round).collect();
        for cycle in of_round[..60].chunks(6) {
            let mut tracks: Vec<u32> = cycle.iter().filter_map(|trial| trial.track).collect();
            tracks.sort_unstable();
            let first = (round - 1) * 6;
            assert_eq!(tracks, (first..first + 6).collect::<Vec<_>>());
        }
    }
    // The first radius of each staircase is its own prior's.
    for trial in trials.iter().filter(|trial| trial.number <= 6) {
        let prior = if trial.track.unwrap() % 2 == 0 { 2.0 } else { 6.0 };
        let first_px = trial.condition.texel_px / libm::exp10(protocol.staircase_at(prior).unwrap().placement());
        assert!((trial.placement_radius_px / first_px - 1.0).abs() < 1e-12);
    }
}
