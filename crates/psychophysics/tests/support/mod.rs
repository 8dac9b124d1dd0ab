//! People, protocols and sessions that the tests share.

#![allow(dead_code, reason = "each test program uses a part of it")]
#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use std::path::Path;

use scumble_psychophysics::{
    Answer, Answered, Consent, Demographics, Display, EVENTS_FILE, Event, Experience, Experiment, Gender, HEADER_FILE,
    Handedness, Language, Moment, Observer, ObserverModel, Protocol, Reply, SessionHeader, SessionWriter, Software,
    Stage, Trial, Vision, rehearse,
};

/// The protocols that come with the crate.
pub const NAMES: [&str; 3] = ["published", "two-alternative", "yes-no"];

/// Seed of the sessions on disk.
pub const SEED: u64 = 11;

pub fn named(name: &str) -> Protocol {
    Protocol::named(name).unwrap()
}

/// A protocol of one round and some ten trials, small enough to be damaged in every place.
pub fn small(name: &str) -> Protocol {
    let mut protocol = named(name);
    protocol.conditions.patterns.truncate(1);
    protocol.conditions.contrasts.truncate(1);
    protocol.conditions.texels_px.truncate(2);
    protocol.practice.ratios.truncate(2);
    protocol.schedule.trials_min = 3;
    protocol.schedule.trials_max = 3;
    protocol
}

pub fn observer(seed: u64) -> Observer {
    Observer::new(ObserverModel::default(), seed).unwrap()
}

/// A whole session: the machine at its end, and what it recorded.
pub fn session(protocol: &Protocol, seed: u64, participant_number: u32) -> (Experiment, Vec<Event>) {
    let mut experiment = Experiment::new(protocol.clone(), seed, participant_number).unwrap();
    let events = rehearse(&mut experiment, &observer(seed)).unwrap();
    (experiment, events)
}

/// Every answer of many sessions, one list a session; practice left out.
pub fn answers(protocol: &Protocol, sessions: u64) -> Vec<Vec<Answered>> {
    let of_session = |seed| session(protocol, seed, seed as u32).1;
    let is_main = |answered: &&Answered| answered.trial.round > 0;
    (0..sessions)
        .map(|seed| of_session(seed).iter().filter_map(Event::answered).filter(is_main).cloned().collect())
        .collect()
}

pub fn reply(answer: Answer, response_time_secs: f64) -> Reply {
    Reply { answer, response_time_secs, pictures_sha256: Vec::new(), timing: None }
}

/// What `person` replies to the trial on show, without pictures.
pub fn reply_of(person: &Observer, experiment: &Experiment) -> Reply {
    let trial = experiment.stage().trial().unwrap();
    reply(person.answer(trial, &experiment.protocol().pictures).unwrap(), person.response_time_secs(trial))
}

/// Goes through the session, and calls `look` at every stage before it is left.
pub fn watch(protocol: &Protocol, seed: u64, participant_number: u32, mut look: impl FnMut(&Experiment)) {
    let mut experiment = Experiment::new(protocol.clone(), seed, participant_number).unwrap();
    let person = observer(seed);
    loop {
        look(&experiment);
        match experiment.stage() {
            Stage::Finished => break,
            Stage::Trial(_) | Stage::Practice(_) => {
                let reply = reply_of(&person, &experiment);
                experiment.answer(reply).unwrap();
            }
            _ => experiment.proceed().unwrap(),
        }
    }
}

pub fn moment(note: &str) -> Moment {
    Moment { at: "2026-03-01T09:40:00Z".parse().unwrap(), notes: vec![note.into()], interrupted_secs: None }
}

pub fn header(protocol: Protocol) -> SessionHeader {
    let started_at = "2026-03-01T09:30:00Z".parse().unwrap();
    let software = Software::of("scumble-psychophysics tests", "0");
    SessionHeader::new("P07", protocol, SEED, started_at, software)
}

/// A header with everything that may be known.
pub fn full_header(protocol: Protocol) -> SessionHeader {
    SessionHeader {
        language: Some(Language::German),
        consent: Some(Consent {
            text_sha256: "c0ffee00".repeat(8),
            agreed_at: "2026-03-01T09:25:00Z".parse().unwrap(),
        }),
        demographics: Some(Demographics {
            age_years: Some(34),
            gender: Some(Gender::Female),
            handedness: Some(Handedness::Left),
            vision: Some(Vision::Corrected),
            graphics_experience: Some(Experience::Expert),
        }),
        room: Some("curtains drawn, ceiling lamp on".into()),
        display: Some(Display {
            monitor: Some("DP-1".into()),
            width_px: 1920,
            height_px: 1200,
            scale_factor: 1.25,
            refresh_hz: Some(59.95),
            window_px: Some([1920, 1200]),
            px_per_degree: Some(38.0),
            px_per_mm: Some(3.7),
            viewing_distance_mm: Some(588.0),
            // A display of gamma 2 whose black is half a candela per square metre.
            luminance_table: Some(vec![(0, 0.5), (64, 8.0), (128, 30.8), (192, 68.5), (255, 120.5)]),
            gamma_check_level: Some(180),
        }),
        ..header(protocol)
    }
}

/// A whole session on disk, its end included, and the machine that ran it.
pub fn record(directory: &Path, protocol: Protocol) -> (Experiment, Vec<Event>) {
    let header = header(protocol);
    let (experiment, mut events) = session(&header.protocol, SEED, header.participant_number);
    events.push(Event::End(moment("")));
    let mut writer = SessionWriter::create(directory, &header).unwrap();
    for event in &events {
        writer.append(event).unwrap();
    }
    (experiment, events)
}

/// The two files of a whole session of a small protocol: header and events.
pub fn files(name: &str) -> (String, String) {
    let root = tempfile::tempdir().unwrap();
    record(root.path(), small(name));
    let read = |file| std::fs::read_to_string(root.path().join(file)).unwrap();
    (read(HEADER_FILE), read(EVENTS_FILE))
}

/// The trials that staircases learned from.
pub fn measured(events: &[Event]) -> Vec<Trial> {
    let answered = events.iter().filter_map(Event::measured);
    answered.map(|answered| answered.trial).collect()
}

/// A session after its practice.
pub fn at_first_trial(protocol: Protocol) -> Experiment {
    let mut experiment = Experiment::new(protocol, 1, 0).unwrap();
    while !matches!(experiment.stage(), Stage::Trial(_)) {
        match *experiment.stage() {
            Stage::Practice(trial) => drop(experiment.answer(reply(trial.pictures.answers()[0], 1.0)).unwrap()),
            _ => experiment.proceed().unwrap(),
        }
    }
    experiment
}
