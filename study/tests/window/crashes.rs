//! A session goes on where it was, however the program ended.

use std::mem::Discriminant;

use scumble_psychophysics::{Answer, EVENTS_FILE, Event, Protocol, Role, Trial, read_session, standing};

use crate::screen::Screen;
use crate::sitting::{Sitting, roles, short};

/// What an answer is for, the trial, the answer, whether it was right, and what was on the screen: everything
/// but when.
type Given = (Discriminant<Event>, Trial, Answer, bool, Vec<String>);

fn given(event: &Event) -> Option<Given> {
    let answered = event.answered()?.clone();
    Some((std::mem::discriminant(event), answered.trial, answered.answer, answered.correct, answered.pictures_sha256))
}

/// Sits through a session; `disturb` is called after every answer but the last.
fn sit(screen: &Screen, protocol: &Protocol, seed: u64, disturb: fn(&mut Sitting)) -> Vec<Given> {
    let folder = tempfile::tempdir().unwrap();
    let mut sitting = Sitting::start(screen, folder.path(), protocol.clone(), seed, &[]);
    let count = roles(protocol, seed).len();
    for index in 0..count {
        sitting.next().unwrap();
        sitting.answer_left(index % 3 != 1);
        if index + 1 < count {
            disturb(&mut sitting);
        }
    }
    sitting.finish().events.iter().filter_map(given).collect()
}

fn assert_survives_a_crash_after_every_trial(protocol: &Protocol, seed: u64) {
    let screen = Screen::start([1280, 800]);
    let undisturbed = sit(&screen, protocol, seed, |_| {});
    let crashed = sit(&screen, protocol, seed, |sitting| {
        sitting.crash();
        sitting.resume();
    });
    assert_eq!(crashed, undisturbed);
}

#[test]
fn a_session_of_two_pictures_killed_after_every_trial_is_that_of_an_undisturbed_one() {
    assert_survives_a_crash_after_every_trial(&short("two-alternative"), 21);
}

#[test]
fn a_published_session_killed_after_every_trial_is_that_of_an_undisturbed_one() {
    assert_survives_a_crash_after_every_trial(&short("published"), 22);
}

#[test]
fn a_yes_no_session_killed_after_every_trial_is_that_of_an_undisturbed_one() {
    let protocol = short("yes-no");
    let is_mixed = |seed: &u64| {
        let roles = roles(&protocol, *seed);
        roles.len() <= 5 && roles.contains(&Role::Line)
    };
    assert_survives_a_crash_after_every_trial(&protocol, (0..).find(is_mixed).unwrap());
}

#[test]
fn a_session_killed_between_its_last_answer_and_its_end_is_completed() {
    let folder = tempfile::tempdir().unwrap();
    let screen = Screen::start([1280, 800]);
    let mut sitting = Sitting::start(&screen, folder.path(), short("two-alternative"), 23, &[]);
    while sitting.next().is_some() {
        sitting.answer_left(true);
    }
    sitting.crash();
    // The record as it is when the end did not get on disk any more.
    let events = sitting.session().join(EVENTS_FILE);
    let text = std::fs::read_to_string(&events).unwrap();
    let answers: String = text.split_inclusive('\n').filter(|line| !line.contains("\"end\"")).collect();
    std::fs::write(&events, answers).unwrap();
    sitting.resume();
    sitting.finish();
}

#[test]
fn a_session_killed_between_its_header_and_its_first_event_goes_on_as_it_would_have_begun() {
    let folder = tempfile::tempdir().unwrap();
    let screen = Screen::start([1280, 800]);
    let mut sitting = Sitting::start(&screen, folder.path(), short("two-alternative"), 28, &[]);
    let (first, corners) = sitting.next().unwrap();
    sitting.crash();
    // The folder as it is when the events did not get a file any more.
    std::fs::remove_file(sitting.session().join(EVENTS_FILE)).unwrap();
    sitting.resume();
    assert_eq!(sitting.see(&first), corners);
    sitting.answer_left(true);
    while sitting.next().is_some() {
        sitting.answer_left(true);
    }
    sitting.finish();
}

#[test]
fn a_window_closed_in_mid_trial_shows_the_same_trial_when_it_is_resumed() {
    let folder = tempfile::tempdir().unwrap();
    let screen = Screen::start([1280, 800]);
    let mut sitting = Sitting::start(&screen, folder.path(), short("yes-no"), 24, &[]);
    let mut index = 0;
    while let Some((trial, corners)) = sitting.next() {
        if index == 1 {
            sitting.close();
            assert!(matches!(sitting.record().events.last(), Some(Event::Pause(_))));
            sitting.resume();
            assert_eq!(sitting.see(&trial), corners, "the same trial at the same place");
        }
        sitting.answer_left(false);
        index += 1;
    }
    sitting.finish();
}

#[test]
fn a_second_program_on_one_session_is_refused_in_words_and_the_first_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let screen = Screen::start([1280, 800]);
    let mut sitting = Sitting::start(&screen, folder.path(), short("two-alternative"), 25, &[]);
    while sitting.next().is_some() {
        for policy in [&["--resume"][..], &[]] {
            let second = sitting.resuming(policy).output().unwrap();
            assert!(!second.status.success());
            let words = String::from_utf8(second.stderr).unwrap();
            assert!(words.contains("someone") && words.contains("another program"), "{words}");
            assert!(!words.contains("interrupted"), "{words}");
        }
        sitting.answer_left(true);
    }
    sitting.finish();
}

#[test]
fn a_round_that_is_repeated_on_resume_shows_new_pictures_and_its_former_answers_do_not_stand() {
    let folder = tempfile::tempdir().unwrap();
    let screen = Screen::start([1280, 800]);
    let mut protocol = short("published");
    protocol.schedule.trials_min = 2;
    protocol.schedule.trials_max = 2;
    let mut sitting = Sitting::start(&screen, folder.path(), protocol, 26, &[]);
    let mut trials = Vec::new();
    while let Some((trial, _)) = sitting.next() {
        sitting.answer_left(true);
        trials.push(trial);
        if trials.len() == 2 {
            sitting.crash();
            sitting.resume_and_repeat_round();
        }
    }
    let record = sitting.finish();
    // One to practise, two rounds of two, and the one that was repeated.
    assert_eq!(trials.len(), 6);
    let former = trials.remove(1);
    assert!(trials.iter().all(|trial| trial.pictures != former.pictures));
    let stand: Vec<Trial> = standing(&record.events).into_iter().map(|answered| answered.trial).collect();
    assert_eq!(stand, trials);
}

#[test]
fn a_session_discarded_on_resume_is_kept_beside_the_one_that_begins_anew() {
    let folder = tempfile::tempdir().unwrap();
    let screen = Screen::start([1280, 800]);
    let mut sitting = Sitting::start(&screen, folder.path(), short("two-alternative"), 27, &[]);
    sitting.next().unwrap();
    sitting.answer_left(true);
    let former = sitting.session().to_path_buf();
    sitting.crash();
    sitting.discard_and_start();
    while sitting.next().is_some() {
        sitting.answer_left(false);
    }
    let record = sitting.finish();
    let former = read_session(&former).unwrap();
    assert_ne!(record.header.seed, former.header.seed);
    assert!(former.is_discarded());
    assert_eq!(former.events.iter().filter_map(Event::answered).count(), 1);
}
