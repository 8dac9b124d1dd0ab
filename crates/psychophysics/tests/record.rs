//! The record on disk: nothing overwritten, nothing lost, damage named, states rebuilt bit for bit.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use std::fs;
use std::path::{Path, PathBuf};

use scumble_psychophysics::{
    EVENTS_FILE, Error, Event, Experiment, HEADER_FILE, Moment, ObserverParameters, Protocol, SessionHeader,
    SessionWriter, Software, Stage, WeibullObserver, read_session, rehearse,
};

const SEED: u64 = 11;

/// A session of one round and some ten trials, small enough to be cut at every byte.
fn small_protocol() -> Protocol {
    let mut protocol = Protocol::two_alternative();
    protocol.conditions.patterns.truncate(1);
    protocol.conditions.contrasts.truncate(1);
    protocol.conditions.texels_px.truncate(2);
    protocol.practice.ratios.truncate(2);
    protocol.schedule.trials_min = 3;
    protocol.schedule.trials_max = 3;
    protocol
}

fn header(protocol: Protocol) -> SessionHeader {
    let started_at = "2026-03-01T09:30:00Z".parse().unwrap();
    let software = Software::of("scumble-psychophysics tests", "0");
    SessionHeader::new("P07", protocol, SEED, started_at, software)
}

fn observer() -> WeibullObserver {
    WeibullObserver::new(ObserverParameters::default(), 5).unwrap()
}

fn moment(note: &str) -> Moment {
    Moment { at: "2026-03-01T09:40:00Z".parse().unwrap(), notes: vec![note.into()] }
}

/// A whole session on disk, its end included, and the machine that ran it.
fn record(directory: &Path, protocol: Protocol) -> (Experiment, Vec<Event>) {
    let header = header(protocol);
    let mut experiment = Experiment::new(header.protocol.clone(), SEED, 7).unwrap();
    let mut events = rehearse(&mut experiment, &observer()).unwrap();
    events.push(Event::End(moment("")));
    let mut writer = SessionWriter::create(directory, &header).unwrap();
    for event in &events {
        writer.append(event).unwrap();
    }
    (experiment, events)
}

struct Place {
    _root: tempfile::TempDir,
    directory: PathBuf,
}

fn place() -> Place {
    let root = tempfile::tempdir().unwrap();
    let directory = root.path().join("study/P07");
    Place { _root: root, directory }
}

#[test]
fn a_session_read_back_rebuilds_every_quest_bit_for_bit() {
    let place = place();
    let (experiment, events) = record(&place.directory, Protocol::two_alternative());
    let session = read_session(&place.directory).unwrap();
    assert_eq!(session.header, header(Protocol::two_alternative()));
    assert_eq!(session.events, events);
    assert!(session.notices.is_empty() && session.is_complete());
    let replayed = session.replay().unwrap();
    for (replayed, original) in replayed.tracks().iter().zip(experiment.tracks()) {
        let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(replayed.staircase().threshold_posterior()), bits(original.staircase().threshold_posterior()));
    }
    assert_eq!(replayed, experiment);
}

#[test]
fn a_session_resumed_after_any_event_goes_on_as_if_nothing_had_happened() {
    let header = header(small_protocol());
    let mut whole = Experiment::new(header.protocol.clone(), SEED, 7).unwrap();
    let events = rehearse(&mut whole, &observer()).unwrap();
    for kept in 0..=events.len() {
        let mut resumed = Experiment::resume(&header, &events[..kept]).unwrap();
        let rest = rehearse(&mut resumed, &observer()).unwrap();
        assert_eq!(rest, events[kept..], "{kept}");
        assert_eq!(resumed, whole);
    }
}

#[test]
fn pauses_and_resumptions_do_not_change_what_follows() {
    let header = header(small_protocol());
    let mut whole = Experiment::new(header.protocol.clone(), SEED, 7).unwrap();
    let mut events = rehearse(&mut whole, &observer()).unwrap();
    events.insert(3, Event::Pause(moment("fire alarm")));
    events.insert(4, Event::Resume(moment("")));
    assert_eq!(Experiment::resume(&header, &events).unwrap(), whole);
}

#[test]
fn a_file_cut_at_any_byte_gives_its_whole_lines_and_one_notice() {
    let place = place();
    let (_, events) = record(&place.directory, small_protocol());
    let path = place.directory.join(EVENTS_FILE);
    let bytes = fs::read(&path).unwrap();
    // From the end of the file backwards, so that a cut is all that each step changes.
    let file = fs::OpenOptions::new().write(true).open(&path).unwrap();
    for length in (0..=bytes.len()).rev() {
        file.set_len(length as u64).unwrap();
        let session = read_session(&place.directory).unwrap();
        let lines = bytes[..length].iter().filter(|b| **b == b'\n').count();
        let is_cut = length > 0 && bytes[length - 1] != b'\n';
        assert_eq!(session.events, events[..lines]);
        assert_eq!(session.notices.len(), usize::from(is_cut), "{length}");
        if is_cut {
            let place = format!("{EVENTS_FILE}:{}: the last line was cut off", lines + 1);
            assert!(session.notices[0].contains(&place));
        }
    }
}

#[test]
fn resuming_after_a_cut_line_never_glues_a_line_to_it() {
    let place = place();
    let (_, events) = record(&place.directory, small_protocol());
    let path = place.directory.join(EVENTS_FILE);
    let bytes = fs::read(&path).unwrap();
    let ends: Vec<usize> = (0..bytes.len()).filter(|i| bytes[*i] == b'\n').collect();
    // Cut before the first byte, inside, before the line break and behind it, of several lines.
    let cuts = [ends[0], ends[1] + 1, ends[2] + 1, ends[3] + 30, ends[5], 0, 1];
    for cut in cuts {
        fs::write(&path, &bytes[..cut]).unwrap();
        let (mut writer, session) = SessionWriter::reopen(&place.directory).unwrap();
        let mut experiment = session.replay().unwrap();
        for event in rehearse(&mut experiment, &observer()).unwrap() {
            writer.append(&event).unwrap();
        }
        writer.append(&events[events.len() - 1]).unwrap();
        drop(writer);
        assert_eq!(fs::read(&path).unwrap(), bytes, "cut at {cut}");
    }
}

#[test]
fn an_append_is_on_disk_when_it_returns() {
    let place = place();
    let header = header(small_protocol());
    let mut writer = SessionWriter::create(&place.directory, &header).unwrap();
    for count in 1..4 {
        writer.append(&Event::Pause(moment("again"))).unwrap();
        let session = read_session(&place.directory).unwrap();
        assert_eq!(session.events.len(), count);
    }
}

#[test]
fn an_existing_session_is_never_overwritten() {
    let place = place();
    record(&place.directory, small_protocol());
    let before = fs::read(place.directory.join(EVENTS_FILE)).unwrap();
    let other = header(Protocol::two_alternative());
    let error = SessionWriter::create(&place.directory, &other).unwrap_err();
    assert!(matches!(error, Error::SessionExists(_)));
    assert_eq!(fs::read(place.directory.join(EVENTS_FILE)).unwrap(), before);

    fs::remove_file(place.directory.join(HEADER_FILE)).unwrap();
    assert!(SessionWriter::create(&place.directory, &other).is_err());
}

#[test]
fn a_second_writer_is_refused_while_the_first_one_lives() {
    let place = place();
    let header = header(small_protocol());
    let writer = SessionWriter::create(&place.directory, &header).unwrap();
    let error = SessionWriter::reopen(&place.directory).unwrap_err();
    assert!(matches!(error, Error::SessionInUse(_)), "{error}");
    drop(writer);
    let (_writer, session) = SessionWriter::reopen(&place.directory).unwrap();
    let stage = *session.replay().unwrap().stage();
    assert_eq!(stage, Stage::Instructions);
}

#[test]
fn damage_inside_the_file_is_an_error_that_names_file_line_and_what_is_allowed() {
    let place = place();
    record(&place.directory, small_protocol());
    let path = place.directory.join(EVENTS_FILE);
    let text = fs::read_to_string(&path).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let with_line = |i: usize, line: &str| {
        let mut lines = lines.clone();
        lines[i] = line;
        lines.join("\n") + "\n"
    };
    let without = |i: usize| [&lines[..i], &lines[i + 1..]].concat().join("\n") + "\n";
    let flipped = if lines[3].contains(r#""correct":true"#) {
        lines[3].replace(r#""correct":true"#, r#""correct":false"#)
    } else {
        lines[3].replace(r#""correct":false"#, r#""correct":true"#)
    };
    let other_radius = lines[3].replace(r#""radius_px":"#, r#""radius_px":1"#);
    let misspelt = lines[4].replace("response_time_secs", "response_time_ms");
    let negative = lines[4].replace(r#""response_time_secs":"#, r#""response_time_secs":-"#);
    let damages = [
        (5, with_line(4, &lines[4][..40]), "one event"),
        (5, with_line(4, ""), "one event"),
        (5, with_line(4, "\0\0\0\0"), "one event"),
        (5, with_line(4, &misspelt), "one event"),
        (5, with_line(4, &negative), "agrees with its trial"),
        (4, with_line(3, &flipped), "agrees with its trial"),
        (4, without(3), "allowed is 2"),
        (5, with_line(4, lines[3]), "allowed is 3"),
        (10, format!("{text}{}\n", lines[8]), "allowed is nothing"),
    ];
    for (line, damaged, allowed) in damages {
        fs::write(&path, &damaged).unwrap();
        let message = read_session(&place.directory).unwrap_err().to_string();
        let place_in_file = format!("{EVENTS_FILE}:{line}: ");
        assert!(message.contains(&place_in_file), "{line}: {message}");
        assert!(message.contains(allowed), "{message}");
        assert!(SessionWriter::reopen(&place.directory).is_err());
        assert_eq!(fs::read_to_string(&path).unwrap(), damaged);
    }

    // A radius that agrees with itself, but not with the seed and the answers before.
    fs::write(&path, with_line(3, &other_radius)).unwrap();
    let session = read_session(&place.directory).unwrap();
    let message = session.replay().unwrap_err().to_string();
    assert!(message.contains(&format!("{EVENTS_FILE}:4: Measure trial 2")), "{message}");
    assert!(SessionWriter::reopen(&place.directory).is_err());
}

#[test]
fn another_seed_in_the_header_is_found_at_the_first_trial() {
    let place = place();
    record(&place.directory, small_protocol());
    let path = place.directory.join(HEADER_FILE);
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replace(r#""seed": 11"#, r#""seed": 12"#)).unwrap();
    let session = read_session(&place.directory).unwrap();
    let message = session.replay().unwrap_err().to_string();
    assert!(message.contains(&format!("{EVENTS_FILE}:1: ")), "{message}");
}

#[test]
fn an_end_before_the_last_trial_is_found() {
    let header = header(small_protocol());
    let end = [Event::End(moment(""))];
    let message = Experiment::resume(&header, &end).unwrap_err().to_string();
    assert_eq!(message, "event 1: the end; allowed is instructions");
}

#[test]
fn a_damaged_header_is_an_error_that_names_file_and_field() {
    let place = place();
    record(&place.directory, small_protocol());
    let path = place.directory.join(HEADER_FILE);
    let text = fs::read_to_string(&path).unwrap();
    for (from, to, named) in [
        ("session/2", "session/1", "schema"),
        ("\"P07\"", "\"Ada Lovelace\"", "participant"),
        ("\"trials_max\": 3", "\"trials_max\": 2", "trials_max"),
        ("\"seed\"", "\"sed\"", "sed"),
        ("}", "", "json:"),
    ] {
        fs::write(&path, text.replace(from, to)).unwrap();
        let message = read_session(&place.directory).unwrap_err().to_string();
        assert!(message.contains(HEADER_FILE), "{message}");
        assert!(message.contains(named), "{named}: {message}");
    }
    fs::remove_file(&path).unwrap();
    let message = read_session(&place.directory).unwrap_err().to_string();
    assert!(message.contains(HEADER_FILE), "{message}");
}

#[test]
fn a_name_in_place_of_a_participant_code_is_refused_before_anything_is_written() {
    let place = place();
    let mut header = header(small_protocol());
    for code in ["", "Ada Lovelace", "a@b.example", "a-code-of-17-chars"] {
        header.participant = code.into();
        let error = SessionWriter::create(&place.directory, &header).unwrap_err();
        assert!(error.to_string().starts_with("participant is"));
    }
    assert!(!place.directory.exists());
}
