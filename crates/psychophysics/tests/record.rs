//! The record on disk: nothing overwritten, nothing lost, damage named, states rebuilt bit for bit.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod support;

use std::fs;
use std::path::PathBuf;

use scumble_psychophysics::{
    EVENTS_FILE, Error, Event, Experiment, HEADER_FILE, Protocol, SessionWriter, Stage, read_session, rehearse,
};
use support::{NAMES, SEED, header, moment, named, observer, record, reply_of, session, small};

fn small_protocol() -> Protocol {
    small("two-alternative")
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
fn a_session_read_back_rebuilds_every_staircase_bit_for_bit() {
    for name in NAMES {
        let place = place();
        let (experiment, events) = record(&place.directory, named(name));
        let session = read_session(&place.directory).unwrap();
        assert_eq!(session.header, header(named(name)));
        assert_eq!(session.events, events);
        assert!(session.notices.is_empty() && session.is_complete());
        let replayed = session.replay().unwrap();
        for (replayed, original) in replayed.tracks().iter().zip(experiment.tracks()) {
            let bits = |track: &scumble_psychophysics::Track| {
                track.staircase().threshold_posterior().iter().map(|v| v.to_bits()).collect::<Vec<_>>()
            };
            assert_eq!(bits(replayed), bits(original));
        }
        assert_eq!(replayed, experiment);
    }
}

#[test]
fn a_crash_after_any_answer_of_any_protocol_loses_nothing() {
    for name in NAMES {
        let mut protocol = named(name);
        // Half the conditions take a quarter of the time, and rests come within rounds in each protocol.
        protocol.conditions.contrasts.truncate(1);
        protocol.schedule.rest_every_trials = Some(10);
        let header = header(protocol);
        let mut experiment = Experiment::new(header.protocol.clone(), SEED, header.participant_number).unwrap();
        let (mut events, mut stages) = (vec![], vec![]);
        while *experiment.stage() != Stage::Finished {
            match experiment.stage().trial() {
                Some(_) => {
                    let reply = reply_of(&observer(SEED), &experiment);
                    events.push(experiment.answer(reply).unwrap());
                    let resumed = Experiment::resume(&header, &events).unwrap();
                    assert_eq!(resumed, experiment, "{name}, {} answers", events.len());
                }
                None => experiment.proceed().unwrap(),
            }
            stages.push(experiment.stage().name());
        }
        for stage in ["practice", "feedback", "trial", "rest", "finished"] {
            assert!(stages.contains(&stage), "{stage}");
        }
    }
}

#[test]
fn a_session_resumed_after_any_event_goes_on_as_if_nothing_had_happened() {
    for name in NAMES {
        let header = header(small(name));
        let (whole, events) = session(&header.protocol, SEED, header.participant_number);
        for kept in 0..=events.len() {
            let mut resumed = Experiment::resume(&header, &events[..kept]).unwrap();
            let rest = rehearse(&mut resumed, &observer(SEED)).unwrap();
            assert_eq!(rest, events[kept..], "{kept}");
            assert_eq!(resumed, whole);
        }
    }
}

#[test]
fn pauses_and_resumptions_do_not_change_what_follows() {
    let header = header(small_protocol());
    let (whole, mut events) = session(&header.protocol, SEED, header.participant_number);
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
        for event in rehearse(&mut experiment, &observer(SEED)).unwrap() {
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
fn another_number_of_the_participant_is_found_where_the_order_of_rounds_differs() {
    let mut header = header(named("yes-no"));
    let (_, events) = session(&header.protocol, SEED, header.participant_number);
    assert!(Experiment::resume(&header, &events).is_ok());
    header.participant_number += 1;
    let message = Experiment::resume(&header, &events).unwrap_err().to_string();
    // Practice is the same for everyone; the first trial of another round is not.
    let first = header.protocol.practice.ratios.len() + 1;
    assert!(message.starts_with(&format!("event {first}: trial.condition.")), "{message}");
}

#[test]
fn an_end_before_the_last_trial_is_found() {
    let header = header(small_protocol());
    let end = [Event::End(moment(""))];
    let message = Experiment::resume(&header, &end).unwrap_err().to_string();
    assert_eq!(
        message,
        "event 1: the end of the session at the stage instructions; allowed is an end after the last trial"
    );
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

#[test]
fn a_header_without_a_file_of_events_is_a_session_without_answers_that_goes_on() {
    let place = place();
    drop(SessionWriter::create(&place.directory, &header(small_protocol())).unwrap());
    let path = place.directory.join(EVENTS_FILE);
    fs::remove_file(&path).unwrap();
    let session = read_session(&place.directory).unwrap();
    assert!(session.events.is_empty() && !session.is_closed());
    assert!(session.notices[0].contains("before the first answer"), "{:?}", session.notices);
    assert!(!path.exists(), "reading writes nothing");

    let (mut writer, reopened) = SessionWriter::reopen(&place.directory).unwrap();
    assert_eq!((&reopened.events, &reopened.notices), (&session.events, &session.notices));
    writer.append(&Event::Resume(moment("taken up"))).unwrap();
    drop(writer);
    assert_eq!(read_session(&place.directory).unwrap().events.len(), 1);
}

#[test]
fn a_header_cut_off_before_there_were_events_is_told_from_damage_and_is_left_alone() {
    let place = place();
    drop(SessionWriter::create(&place.directory, &header(small_protocol())).unwrap());
    let [header, events] = [HEADER_FILE, EVENTS_FILE].map(|name| place.directory.join(name));
    fs::remove_file(&events).unwrap();
    let whole = fs::read(&header).unwrap();
    let zeros = vec![0; whole.len()];
    for cut in [&whole[..0], &whole[..1], &whole[..whole.len() / 2], &whole[..whole.len() - 2], &zeros] {
        fs::write(&header, cut).unwrap();
        let error = read_session(&place.directory).unwrap_err();
        assert!(matches!(&error, Error::NeverBegan { bytes, .. } if *bytes == cut.len()), "{error}");
        assert!(SessionWriter::reopen(&place.directory).is_err() && !events.exists());
        assert_eq!(fs::read(&header).unwrap(), cut);
    }
    for damage in [&b"[]"[..], b"{\"schema\": 1}", b"{]"] {
        fs::write(&header, damage).unwrap();
        assert!(matches!(read_session(&place.directory), Err(Error::Damaged { .. })));
    }
}
