//! Sessions recorded once, which every version must replay: they fix what a seed means.
//!
//! A study goes on for months, and a session that was interrupted before the program was updated is
//! resumed after it. So the draws, the staircase's placements and the pictures that follow from a
//! seed never change under one schema. Where a change is meant, `SESSION_SCHEMA` gets another number,
//! and the sessions are recorded anew with
//! `cargo test -p scumble-psychophysics --test golden -- --ignored`.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod support;

use std::path::PathBuf;

use scumble_psychophysics::{
    Event, Experiment, Protocol, Reply, SessionHeader, SessionWriter, Stage, StaircaseConfig, Trial, read_session,
};
use scumble_stimuli::{Encoding, Kernel, Pattern, Transfer, picture_sha256};
use support::{header, moment, observer, reply_of, small};

const TASKS: [&str; 2] = ["two-alternative", "yes-no"];

fn directory(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(format!("session-{name}"))
}

/// Small in every way, and with a bit of everything: both staircases, patterns, kernels, tilt, noise,
/// rests, lines, catch trials.
fn protocol(name: &str) -> Protocol {
    let mut protocol = small(name);
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

/// The hashes of a trial's pictures as an sRGB display shows them.
fn hashes(header: &SessionHeader, trial: &Trial) -> Vec<String> {
    let pictures = &header.protocol.pictures;
    let draw = |picture: &scumble_stimuli::Stimulus| {
        picture_sha256(&picture.render(pictures.width_px, pictures.height_px, &Transfer::srgb()).unwrap())
    };
    trial.pictures.all().into_iter().map(draw).collect()
}

#[test]
fn a_session_recorded_once_replays_for_ever() {
    for name in TASKS {
        let session = read_session(&directory(name)).unwrap();
        assert!(session.is_complete() && session.notices.is_empty());
        assert_eq!(session.header.protocol, protocol(name), "the protocol's file is read as it was");
        assert_eq!(*session.replay().unwrap().stage(), Stage::Finished);
        for answered in session.events.iter().filter_map(Event::answered) {
            let number = answered.trial.number;
            assert_eq!(answered.pictures_sha256, hashes(&session.header, &answered.trial), "{name}, trial {number}");
        }
    }
}

#[test]
#[ignore = "records the sessions anew, which is right with a new schema only"]
fn record_the_sessions_anew() {
    for name in TASKS {
        let header = header(protocol(name));
        let mut experiment = Experiment::new(header.protocol.clone(), header.seed, header.participant_number).unwrap();
        std::fs::remove_dir_all(directory(name)).unwrap_or_default();
        let mut writer = SessionWriter::create(&directory(name), &header).unwrap();
        while *experiment.stage() != Stage::Finished {
            match experiment.stage().trial().copied() {
                Some(trial) => {
                    let pictures_sha256 = hashes(&header, &trial);
                    let reply = Reply { pictures_sha256, ..reply_of(&observer(5), &experiment) };
                    writer.append(&experiment.answer(reply).unwrap()).unwrap();
                }
                None => experiment.proceed().unwrap(),
            }
        }
        writer.append(&Event::End(moment(""))).unwrap();
    }
}
