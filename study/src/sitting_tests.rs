//! What a session does to its record.

use super::*;
use crate::software::software;
use scumble_psychophysics::Protocol;

/// A fresh session of two short rounds, begun on this display.
fn begun(directory: &Path, display: Option<Display>) -> Sitting {
    let mut protocol = Protocol::two_alternative();
    protocol.practice.ratios.clear();
    protocol.conditions.contrasts.truncate(1);
    protocol.conditions.texels_px.truncate(1);
    (protocol.schedule.trials_min, protocol.schedule.trials_max) = (2, 2);
    let file = directory.join("short.toml");
    std::fs::write(&file, protocol.to_toml().unwrap()).unwrap();
    let folder = StudyFolder::open(&directory.join("study"), file.to_str()).unwrap();
    let header = SessionHeader::new("p07", protocol, 1, Timestamp::now(), software());
    let mut sitting = Sitting::fresh(folder, &directory.join("study/p07"), header).unwrap();
    sitting.proceed(|| display).unwrap();
    sitting
}

/// Goes on to the first answer of a round.
fn answer_in(sitting: &mut Sitting, round: u32) {
    loop {
        match sitting.experiment().stage().trial().copied() {
            None => sitting.proceed(|| None).unwrap(),
            Some(trial) => {
                let answer = trial.pictures.right_answer();
                let (pictures_sha256, timing) = (Vec::new(), None);
                sitting.answer(Reply { answer, response_time_secs: 1.0, pictures_sha256, timing }).unwrap();
                if trial.round == round {
                    return;
                }
            }
        }
    }
}

#[test]
fn an_order_to_repeat_a_round_that_is_over_by_then_repeats_no_other_one() {
    let folder = tempfile::tempdir().unwrap();
    let mut sitting = begun(folder.path(), None);
    answer_in(&mut sitting, 2);
    let (before, events) = (sitting.experiment().clone(), sitting.recorder().events().len());
    assert!(!sitting.repeat_round(1));
    assert_eq!((sitting.experiment(), sitting.recorder().events().len()), (&before, events));
    assert!(sitting.repeat_round(2));
    assert!(matches!(sitting.recorder().events().last(), Some(Event::RepeatRound(_))));
}

#[test]
fn a_discarded_session_names_the_number_of_its_participant() {
    let folder = tempfile::tempdir().unwrap();
    drop(begun(folder.path(), None));
    assert_eq!(discard(&folder.path().join("study/p07")).unwrap(), 7);
}

fn monitor(name: &str) -> Display {
    // A rate that is no short decimal number, as they come from systems.
    let (monitor, refresh_hz) = (Some(name.to_owned()), Some(60_000.0 / 1001.0));
    Display { monitor, width_px: 1920, height_px: 1080, scale_factor: 1.0, refresh_hz, ..Display::default() }
}

/// The notes of the record.
fn notes(sitting: &Sitting) -> Vec<String> {
    let moments = sitting.recorder().events().iter().filter_map(Event::moment);
    moments.flat_map(|moment| moment.notes.clone()).collect()
}

#[test]
fn the_record_tells_every_display_that_a_session_was_shown_on() {
    let folder = tempfile::tempdir().unwrap();
    let [a, b] = ["A", "B"].map(|name| format!("{name}, 1920 x 1080 pixels, scale factor 1.00, 59.94 Hz"));
    let mut sitting = begun(folder.path(), Some(monitor("A")));
    sitting.watch_display(&monitor("A"));
    let mut shown = vec![format!("shown on {a}")];
    assert_eq!(sitting.other_display(), None);
    for _ in 0..3 {
        sitting.watch_display(&monitor("B"));
    }
    shown.push(format!("shown on {b}"));
    assert_eq!((notes(&sitting), sitting.other_display()), (shown.clone(), Some(b.as_str())));
    sitting.leave();
    drop(sitting);

    let mut sitting = Sitting::resume(&folder.path().join("study/p07"), ResumePolicy::Continue).unwrap();
    for _ in 0..3 {
        sitting.watch_display(&monitor("A"));
    }
    sitting.go_on();
    shown.push(format!("shown on {a}"));
    assert_eq!((notes(&sitting), sitting.other_display()), (shown, None));
}

#[test]
fn the_display_on_which_a_session_begins_is_in_its_header_and_in_no_note() {
    let folder = tempfile::tempdir().unwrap();
    let header = SessionHeader::new("p08", Protocol::two_alternative(), 1, Timestamp::now(), software());
    let study = StudyFolder::open(&folder.path().join("study"), None).unwrap();
    let mut sitting = Sitting::fresh(study, &folder.path().join("study/p08"), header).unwrap();
    // A window may open on one monitor and be moved to another one before anything begins.
    for name in ["B", "A"] {
        sitting.watch_display(&monitor(name));
    }
    sitting.proceed(|| Some(monitor("A"))).unwrap();
    assert!(!sitting.watch_display(&monitor("A")));
    assert_eq!((notes(&sitting), sitting.other_display()), (Vec::new(), None));
}
