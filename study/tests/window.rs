//! The real window on a virtual screen, with real keys: a session from the first screen to the last,
//! a crash in the middle of it, and what is on disk and on the screen at each step.
//!
//! A second state machine with the same seed runs beside the window and knows what it must show.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod support;

use std::path::Path;

use image::GrayImage;
use scumble_psychophysics::{EVENTS_FILE, Event, Experiment, Protocol, Session, Side, Stage, Trial, read_session};
use support::{Running, Screen, wait_for};

const SEED: u64 = 11;

/// Two rounds of two trials, and two trials to practise.
fn short_protocol() -> Protocol {
    let mut protocol = Protocol::two_alternative();
    protocol.name = "short".into();
    protocol.contrasts = vec![0.5];
    protocol.texels_px = vec![10.0];
    protocol.trials_min = 2;
    protocol.trials_max = 2;
    protocol.practice.ratios = vec![0.5, 1.0];
    protocol
}

fn write_protocol(folder: &Path) -> String {
    let path = folder.join("short.json");
    std::fs::write(&path, serde_json::to_vec(&short_protocol()).unwrap()).unwrap();
    path.to_str().unwrap().to_owned()
}

fn pictures(trial: &Trial) -> [GrayImage; 2] {
    let protocol = short_protocol();
    [trial.left, trial.right].map(|stimulus| {
        let (width_px, height_px) = (protocol.picture_width_px, protocol.picture_height_px);
        stimulus.render(width_px, height_px, &scumble_stimuli::Transfer::srgb()).unwrap()
    })
}

/// Presses the space bar until both pictures of `trial` are on the screen, bit for bit, and gives
/// their corners. The space bar does nothing on a trial's screen.
fn see(screen: &Screen, trial: &Trial) -> [[u32; 2]; 2] {
    let [left, right] = pictures(trial);
    let what = format!("both pictures of {} trial {}, bit for bit", trial.round, trial.number);
    wait_for(&what, || {
        let pixels = screen.pixels();
        let corners = screen.find(&pixels, &left).zip(screen.find(&pixels, &right));
        if corners.is_none() {
            screen.input("key space");
        }
        corners.map(|(left, right)| [left, right])
    })
}

/// Steps over the screens without a question, as the space bar does in the window.
fn next_trial(experiment: &mut Experiment) -> Option<Trial> {
    while experiment.stage().trial().is_none() && *experiment.stage() != Stage::Finished {
        experiment.proceed().unwrap();
    }
    experiment.stage().trial().copied()
}

/// The answers in the record, without moments and response times.
fn answers(session: &Session) -> Vec<(Trial, Side)> {
    let answer = |event: &Event| match event {
        Event::Trial(answered) | Event::Practice(answered) => Some((answered.trial, answered.answer)),
        _ => None,
    };
    session.events.iter().filter_map(answer).collect()
}

fn exit_status(study: &mut Running) -> std::process::ExitStatus {
    wait_for("the program to end", || study.0.try_wait().unwrap())
}

#[test]
fn a_session_through_the_window_survives_a_crash_and_is_on_disk_answer_by_answer() {
    let folder = tempfile::tempdir().unwrap();
    let protocol = write_protocol(folder.path());
    let data = folder.path().join("study");
    let session = data.join("p01");
    let common = ["--data", data.to_str().unwrap(), "--participant", "p01"];
    let fresh = [&common[..], &["--protocol", &protocol, "--seed", "11"]].concat();

    let screen = Screen::start([1280, 800]);
    let mut study = screen.study(&fresh, "1");
    let mut expected = Experiment::new(short_protocol(), SEED).unwrap();
    let mut given = Vec::new();
    let sides = [Side::Left, Side::Right, Side::Left, Side::Right, Side::Left, Side::Right];
    for (index, side) in sides.into_iter().enumerate() {
        let trial = next_trial(&mut expected).unwrap();
        let corners = see(&screen, &trial);

        // A crash while the pictures of the fifth trial are on the screen.
        if index == 4 {
            study.0.kill().unwrap();
            study.0.wait().unwrap();
            study = screen.study(&[&common[..], &["--resume"]].concat(), "1");
            assert_eq!(see(&screen, &trial), corners, "the same trial at the same place");
        }

        match index {
            0 => screen.input("key Left"),
            1 => screen.input("key j"),
            2 => {
                // The button below the left picture; 40 points below its lower edge is its middle.
                let [x, y] = [corners[0][0] + 300, corners[0][1] + 480 + 40];
                screen.input(&format!("mousemove {x} {y} click 1"));
            }
            4 => screen.input("key f"),
            _ => screen.input("key Right"),
        }
        expected.answer(side, 0.0).unwrap();
        given.push((trial, side));
        let lines = given.len() + usize::from(index >= 4);
        wait_for("the answer on disk", || {
            let text = std::fs::read_to_string(session.join(EVENTS_FILE)).unwrap();
            (text.matches('\n').count() >= lines).then_some(())
        });
        assert_eq!(answers(&read_session(&session).unwrap()), given);
    }
    assert_eq!(*expected.stage(), Stage::Finished);

    wait_for("the end on disk", || read_session(&session).unwrap().is_complete().then_some(()));
    screen.input("key space");
    assert!(exit_status(&mut study).success(), "the session is complete");

    let record = read_session(&session).unwrap();
    assert!(record.notices.is_empty(), "{:?}", record.notices);
    assert_eq!(*record.replay().unwrap().stage(), Stage::Finished);
    let kinds = |kind: fn(&Event) -> bool| record.events.iter().filter(|event| kind(event)).count();
    assert_eq!(kinds(|event| matches!(event, Event::Practice(_))), 2);
    assert_eq!(kinds(|event| matches!(event, Event::Trial(_))), 4);
    assert_eq!(kinds(|event| matches!(event, Event::Resume(_))), 1);
    let display = record.header.display.unwrap();
    assert_eq!((display.width_px, display.height_px, display.scale_factor), (1280, 800, 1.0));
    for answered in record.events.iter().filter_map(Event::measured) {
        let secs = answered.response_time_secs;
        assert!(secs > 0.05 && secs < 30.0, "response time {secs} s");
    }
}

#[test]
fn a_texel_is_a_physical_pixel_at_fractional_scale_factors() {
    let folder = tempfile::tempdir().unwrap();
    let protocol = write_protocol(folder.path());
    let screen = Screen::start([1601, 1003]);
    for scale in ["1.25", "1.5"] {
        let data = folder.path().join(scale);
        let arguments = ["--data", data.to_str().unwrap(), "--protocol", &protocol, "--seed", "11"];
        let _study = screen.study(&arguments, scale);
        let mut expected = Experiment::new(short_protocol(), SEED).unwrap();
        let [left, right] = see(&screen, &next_trial(&mut expected).unwrap());
        assert_eq!(left[1], right[1]);
        assert_eq!(right[0] - left[0], 600 + 32, "width and gap in physical pixels");
    }
}

#[test]
fn escape_hides_the_pictures_and_the_pause_is_on_record() {
    let folder = tempfile::tempdir().unwrap();
    let protocol = write_protocol(folder.path());
    let data = folder.path().join("study");
    let common = ["--data", data.to_str().unwrap(), "--participant", "p01"];
    let screen = Screen::start([1280, 800]);
    let arguments = [&common[..], &["--protocol", &protocol, "--seed", "11"]].concat();
    let mut study = screen.study(&arguments, "1");
    let trial = next_trial(&mut Experiment::new(short_protocol(), SEED).unwrap()).unwrap();
    see(&screen, &trial);

    screen.input("key Escape");
    let [left, _] = pictures(&trial);
    wait_for("no picture", || screen.find(&screen.pixels(), &left).is_none().then_some(()));
    // An answer to hidden pictures is none.
    screen.input("key Left");
    see(&screen, &trial);
    let record = wait_for("pause and resume on disk", || {
        let record = read_session(&data.join("p01")).unwrap();
        (record.events.len() >= 2).then_some(record)
    });
    assert!(matches!(&record.events[..], [Event::Pause(_), Event::Resume(_)]), "{record:?}");

    // Alt and F4 ask the window manager to close the window.
    screen.input("key alt+F4");
    assert!(!exit_status(&mut study).success(), "the session is not complete");
    let record = read_session(&data.join("p01")).unwrap();
    assert!(matches!(record.events.last(), Some(Event::Pause(_))), "{record:?}");
}
