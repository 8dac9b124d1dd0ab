//! Sessions recorded once, which every version must replay: they fix what a seed means.
//!
//! A study goes on for months, and a session that was interrupted before the program was updated is
//! resumed after it. So the draws, the staircase's placements and the pictures that follow from a
//! seed never change under one schema. Where a change is meant, `SESSION_SCHEMA` gets another number, the
//! older sessions stay as long as they are read, and sessions under the new one are recorded with
//! `cargo test -p scumble-psychophysics --test golden -- --ignored`.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod support;

use std::path::PathBuf;

use scumble_psychophysics::{
    EVENTS_FILE, Event, Experiment, HEADER_FILE, Moment, Protocol, Reply, SessionHeader, SessionWriter, Stage,
    StaircaseConfig, Timing, Trial, read_session, rehearse,
};
use scumble_stimuli::{Encoding, Kernel, Pattern, picture_sha256};
use support::{full_header, moment, observer, reply_of, small};

const TASKS: [&str; 2] = ["two-alternative", "yes-no"];

/// Formats of which sessions are kept: every one that is read, the present one last.
const SCHEMAS: [u32; 2] = [2, 3];

fn directory(schema: u32, name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(format!("session-{schema}-{name}"))
}

/// Small in every way, and with a bit of everything: both staircases, patterns, kernels, tilt, noise,
/// rests, lines, catch trials.
fn protocol(name: &str) -> Protocol {
    let mut protocol = small(name);
    // The recorded protocols are older than the shipped ones' exclusions.
    protocol.exclusions = None;
    protocol.conditions.patterns = vec![Pattern::Stair, Pattern::Step, Pattern::DoubleStep];
    protocol.conditions.kernels = vec![Kernel::Disc, Kernel::GaussianHalf];
    protocol.conditions.contrasts = vec![0.5];
    protocol.conditions.texels_px = vec![5.0];
    (protocol.pictures.width_px, protocol.pictures.height_px) = (96, 80);
    protocol.practice.texel_px = 10.0;
    protocol.schedule.trials_min = 4;
    protocol.schedule.trials_max = 4;
    protocol.schedule.rest_every_trials = Some(3);
    if name == "yes-no" {
        protocol.pictures.encoding = Encoding::CodeValues;
        let StaircaseConfig { threshold_probability, guess_probability, .. } = protocol.staircase;
        protocol.staircase =
            StaircaseConfig { threshold_probability, guess_probability, ..StaircaseConfig::quest_plus() };
        protocol.catch_trials.as_mut().unwrap().share = 0.2;
        protocol.catch_trials.as_mut().unwrap().texel_px = 10.0;
    }
    protocol
}

/// The hashes of a trial's pictures on the header's display.
fn hashes(header: &SessionHeader, trial: &Trial) -> Vec<String> {
    let (pictures, transfer) = (&header.protocol.pictures, header.transfer().unwrap());
    let draw = |picture: &scumble_stimuli::Stimulus| {
        picture_sha256(&picture.render(pictures.width_px, pictures.height_px, &transfer).unwrap())
    };
    trial.pictures.all().into_iter().map(draw).collect()
}

#[test]
fn a_session_recorded_once_replays_for_ever() {
    for (schema, name) in SCHEMAS.into_iter().flat_map(|schema| TASKS.map(|name| (schema, name))) {
        let session = read_session(&directory(schema, name)).unwrap();
        assert!(session.is_complete() && session.notices.is_empty());
        assert_eq!(session.header.schema, format!("scumble/session/{schema}"));
        assert_eq!(session.header.protocol, protocol(name), "the protocol's file is read as it was");
        assert_eq!(*session.replay().unwrap().stage(), Stage::Finished);
        for answered in session.events.iter().filter_map(Event::answered) {
            let number = answered.trial.number;
            let drawn = hashes(&session.header, &answered.trial);
            assert_eq!(answered.pictures_sha256, drawn, "{schema}, {name}, trial {number}");
        }
    }
}

#[test]
fn an_older_session_goes_on_where_it_was_interrupted() {
    let place = tempfile::tempdir().unwrap();
    for file in [HEADER_FILE, EVENTS_FILE] {
        std::fs::copy(directory(2, "yes-no").join(file), place.path().join(file)).unwrap();
    }
    let events = std::fs::read_to_string(place.path().join(EVENTS_FILE)).unwrap();
    let first: String = events.split_inclusive('\n').take(9).collect();
    std::fs::write(place.path().join(EVENTS_FILE), first).unwrap();
    let (mut writer, session) = SessionWriter::reopen(place.path()).unwrap();
    let mut experiment = session.replay().unwrap();
    writer.append(&Event::Resume(Moment { interrupted_secs: Some(3600.0), ..moment("") })).unwrap();
    for event in rehearse(&mut experiment, &observer(5)).unwrap() {
        writer.append(&event).unwrap();
    }
    assert_eq!(*read_session(place.path()).unwrap().replay().unwrap().stage(), Stage::Finished);
}

#[test]
fn the_recorded_sessions_hold_every_key_and_event_of_a_whole_session() {
    for name in TASKS {
        let session = read_session(&directory(SCHEMAS[1], name)).unwrap();
        assert_eq!(session.header, full_header(protocol(name)));
        let events = std::fs::read_to_string(directory(SCHEMAS[1], name).join(EVENTS_FILE)).unwrap();
        for event in ["practice", "trial", "pause", "resume", "note", "repeat_practice", "repeat_round", "end"] {
            assert!(events.contains(&format!("{{\"event\":\"{event}\"")), "{name}: {event}");
        }
        let answers = session.events.iter().filter_map(Event::answered).count();
        assert!(session.standing().len() < answers, "answers of a repeated round");
        assert!(session.events.iter().filter_map(Event::answered).all(|answered| answered.timing.is_some()));
    }
}

/// The acts of an administrator in the recorded sessions, by number of events before them.
fn acts(experiment: &mut Experiment, recorded: usize) -> Vec<Event> {
    match recorded {
        2 => {
            experiment.repeat_practice().unwrap();
            vec![Event::RepeatPractice(moment(""))]
        }
        9 => {
            let resume = Moment { interrupted_secs: Some(95.5), ..moment("") };
            vec![Event::Note(moment("telephone rang")), Event::Pause(moment("")), Event::Resume(resume)]
        }
        13 => {
            experiment.repeat_round().unwrap();
            vec![Event::RepeatRound(moment(""))]
        }
        _ => Vec::new(),
    }
}

#[test]
#[ignore = "records the sessions anew, which is right with a new schema only"]
fn record_the_sessions_anew() {
    for name in TASKS {
        let header = full_header(protocol(name));
        let directory = directory(SCHEMAS[1], name);
        let mut experiment = Experiment::new(header.protocol.clone(), header.seed, header.participant_number).unwrap();
        std::fs::remove_dir_all(&directory).unwrap_or_default();
        let mut writer = SessionWriter::create(&directory, &header).unwrap();
        let (mut recorded, mut onset_secs) = (0, 0.0);
        while *experiment.stage() != Stage::Finished {
            let events = match acts(&mut experiment, recorded) {
                events if !events.is_empty() => events,
                _ => match experiment.stage().trial().copied() {
                    Some(trial) => {
                        onset_secs += 2.5;
                        let timing = Some(Timing { onset_secs, missed_frames: u32::from(recorded == 7) });
                        let pictures_sha256 = hashes(&header, &trial);
                        let reply = Reply { pictures_sha256, timing, ..reply_of(&observer(5), &experiment) };
                        vec![experiment.answer(reply).unwrap()]
                    }
                    None => {
                        experiment.proceed().unwrap();
                        continue;
                    }
                },
            };
            for event in events {
                writer.append(&event).unwrap();
                recorded += 1;
            }
        }
        writer.append(&Event::End(moment(""))).unwrap();
    }
}
