//! "Was the original image a line?"

use scumble_psychophysics::{Answer, Event, Protocol, Role};
use scumble_stimuli::Shape;

use crate::pixels::Pixels;
use crate::screen::Screen;
use crate::sitting::{Sitting, roles, short};

/// Rows at the lower end of the screen that hold the progress.
const PROGRESS_PX: u32 = 60;

/// Lines and catch trials between two rounds of one measured trial, a rest after every second trial.
fn yes_no() -> Protocol {
    let mut protocol = short("yes-no");
    protocol.schedule.rest_every_trials = Some(2);
    protocol.catch_trials.as_mut().unwrap().share = 0.3;
    protocol
}

/// The first seed whose session shows every role in no more than seven trials.
fn seed_with_every_role(protocol: &Protocol) -> u64 {
    let has_all = |seed: &u64| {
        let roles = roles(protocol, *seed);
        roles.len() <= 7 && [Role::Measure, Role::Line, Role::Catch].iter().all(|role| roles.contains(role))
    };
    (0..).find(has_all).unwrap()
}

#[test]
fn a_yes_no_session_survives_a_crash_and_no_trial_looks_unlike_another() {
    let folder = tempfile::tempdir().unwrap();
    let screen = Screen::start([1280, 800]);
    let protocol = yes_no();
    let seed = seed_with_every_role(&protocol);
    let expected_roles = roles(&protocol, seed);
    let mut sitting = Sitting::start(&screen, folder.path(), protocol, seed, &[]);
    let mut surroundings: Option<Pixels> = None;
    for index in 0.. {
        let Some((trial, corners)) = sitting.next() else { break };
        if index == 2 {
            sitting.crash();
            sitting.resume();
            assert_eq!(sitting.see(&trial), corners, "the same trial at the same place");
        }
        let [x, y] = corners[0];
        assert_eq!(x, (1280 - 600) / 2, "in the middle");
        let around = screen.pixels().without([x, y], [600, 480]).without([0, 800 - PROGRESS_PX], [1280, PROGRESS_PX]);
        let first = surroundings.get_or_insert_with(|| around.clone());
        assert!(around == *first, "the screen around {:?} trial {} differs", trial.role, trial.number);
        match index % 5 {
            0 => sitting.answer("key y", Answer::Yes),
            1 => sitting.answer("key n", Answer::No),
            2 => sitting.answer("key Left", Answer::Yes),
            3 => sitting.answer("key Right", Answer::No),
            _ => sitting.answer("key j", Answer::Yes),
        }
    }
    let record = sitting.finish();
    let answered: Vec<_> = record.events.iter().filter_map(Event::answered).collect();
    assert_eq!(answered.iter().map(|answered| answered.trial.role).collect::<Vec<_>>(), expected_roles);
    let catches = record.events.iter().filter(|event| matches!(event, Event::Catch(_))).count();
    let measured = expected_roles.iter().filter(|role| **role == Role::Measure).count();
    assert_eq!(catches + measured + 1, answered.len(), "lines and catch trials are catch events, one was practice");
}

#[test]
fn a_published_session_shows_artifacts_alone_and_takes_clicks() {
    let folder = tempfile::tempdir().unwrap();
    let screen = Screen::start([1920, 1080]);
    let mut sitting = Sitting::start(&screen, folder.path(), short("published"), 5, &[]);
    for index in 0.. {
        let Some((_, corners)) = sitting.next() else { break };
        // Buttons below the halves of the picture; their middles are 46 points below its edge.
        let [x, y] = [corners[0][0] + 150, corners[0][1] + 480 + 46];
        match index {
            0 => sitting.answer("key n", Answer::No),
            1 => sitting.answer(&format!("mousemove {x} {y} click 1"), Answer::Yes),
            _ => sitting.answer(&format!("mousemove {} {y} click 1", x + 300), Answer::No),
        }
    }
    let record = sitting.finish();
    let measured: Vec<_> = record.events.iter().filter_map(Event::measured).collect();
    assert_eq!(measured.len(), 2);
    assert!(measured.iter().all(|answered| answered.trial.pictures.all()[0].shape == Shape::Artifact));
    assert_eq!(measured.iter().map(|answered| answered.correct).collect::<Vec<_>>(), [false, true]);
}
