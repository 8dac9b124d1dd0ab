//! What a trial is for: lines, catch trials, and what a response of 1 means.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod support;

use scumble_psychophysics::{Answer, Pictures, Role, Stage, Track, Trial};
use scumble_stimuli::Shape;
use support::{NAMES, answers, at_first_trial, named, reply, watch};

#[test]
fn a_response_of_one_means_a_right_answer_whatever_the_task() {
    for name in NAMES {
        let protocol = named(name);
        let mut experiment = at_first_trial(protocol.clone());
        let mut ones = 0;
        while let Stage::Trial(trial) = *experiment.stage() {
            let [first, second] = trial.pictures.answers();
            let answer = if trial.number % 2 == 0 { first } else { second };
            experiment.answer(reply(answer, 1.0)).unwrap();
            let Some(track) = trial.track.filter(|_| trial.role == Role::Measure) else { continue };
            let is_one = match trial.pictures {
                Pictures::Pair { left, .. } => (answer == Answer::Left) == (left.shape == Shape::Line),
                // The single picture that a staircase chose is an artifact: "no, it was no line".
                Pictures::Single { picture } => {
                    assert_eq!(picture.shape, Shape::Artifact);
                    answer == Answer::No
                }
            };
            assert_eq!(experiment.tracks()[track as usize].responses().last(), Some(&(trial.intensity(), is_one)));
            ones += u32::from(is_one);
        }
        assert!(ones > 5, "{name}");
    }
}

#[test]
fn lines_and_catch_trials_come_as_often_as_the_protocol_says() {
    let protocol = named("yes-no");
    let all: Vec<Role> = answers(&protocol, 40).concat().iter().map(|answered| answered.trial.role).collect();
    let count = |role: Role| all.iter().filter(|found| **found == role).count() as f64;
    let total = all.len() as f64;
    let within_four_errors = |found: f64, of: f64, share: f64| {
        let standard_error = (share * (1.0 - share) / of).sqrt();
        assert!((found / of - share).abs() < 4.0 * standard_error, "{found} of {of}, not {share}");
    };
    within_four_errors(count(Role::Catch), total, 0.03);
    within_four_errors(count(Role::Line), total - count(Role::Catch), 0.5);

    for name in ["published", "two-alternative"] {
        let is_measured = |answered: &scumble_psychophysics::Answered| answered.trial.role == Role::Measure;
        assert!(answers(&named(name), 2).concat().iter().all(is_measured));
    }
}

#[test]
fn a_line_has_the_condition_and_radius_of_its_staircase_and_teaches_it_nothing() {
    let mut lines = 0;
    for seed in 0..3 {
        let mut before: Option<(Trial, Vec<Track>)> = None;
        // The radius that the last line of each staircase was shown at, until the staircase's own trial.
        let mut last_line_px = std::collections::HashMap::new();
        watch(&named("yes-no"), seed, 0, |experiment| {
            if let Some((trial, tracks)) = before.take() {
                assert_eq!(trial.role == Role::Measure, tracks != experiment.tracks(), "{:?}", trial.role);
            }
            let Some(trial) = experiment.stage().trial().copied() else { return };
            before = Some((trial, experiment.tracks().to_vec()));
            let Some(track) = trial.track else { return };
            assert_eq!(trial.condition, *experiment.tracks()[track as usize].condition());
            if let Some(radius_px) = last_line_px.remove(&track) {
                assert_eq!(trial.placement_radius_px, radius_px);
            }
            if trial.role == Role::Line {
                lines += 1;
                last_line_px.insert(track, trial.placement_radius_px);
                assert!(trial.pictures.all().iter().all(|picture| picture.shape == Shape::Line));
            }
        });
    }
    assert!(lines > 100, "{lines}");
}

#[test]
fn a_catch_trial_is_a_plain_artifact_of_the_round_and_teaches_nothing() {
    let mut protocol = named("yes-no");
    if let Some(catch) = &mut protocol.catch_trials {
        (catch.share, catch.ratio, catch.texel_px) = (0.4, 0.7, 15.0);
    }
    let mut last: Option<Vec<Track>> = None;
    let mut caught = 0;
    watch(&protocol, 4, 0, |experiment| {
        if let Some(tracks) = last.take() {
            assert_eq!(tracks, experiment.tracks());
        }
        let Some(trial) = experiment.stage().trial().filter(|trial| trial.role == Role::Catch) else { return };
        caught += 1;
        last = Some(experiment.tracks().to_vec());
        assert_eq!((trial.track, trial.condition.texel_px), (None, 15.0));
        assert!((trial.ratio() - 0.7).abs() < 1e-12 && !trial.is_clamped());
        let of_round = experiment.tracks()[(trial.round as usize - 1) * 3].condition();
        assert_eq!((trial.condition.pattern, trial.condition.contrast), (of_round.pattern, of_round.contrast));
        assert!(trial.pictures.all().iter().all(|picture| picture.shape == Shape::Artifact));
    });
    assert!(caught > 50, "{caught}");
}

#[test]
fn catch_trials_at_two_alternatives_show_the_line_beside_the_plain_artifact() {
    let mut protocol = named("two-alternative");
    protocol.catch_trials = named("yes-no").catch_trials;
    let all = answers(&protocol, 4).concat();
    let caught: Vec<_> = all.iter().filter(|answered| answered.trial.role == Role::Catch).collect();
    assert!(caught.len() > 5);
    assert!(caught.iter().all(|answered| matches!(answered.trial.pictures, Pictures::Pair { .. })));
}
