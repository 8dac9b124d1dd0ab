//! A disk that refuses a session: the write that fails says so, and the session goes on without a lost answer.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod support;

use std::fs;
use std::path::PathBuf;

use scumble_psychophysics::{EVENTS_FILE, Event, HEADER_FILE, SessionHeader, SessionWriter, read_session};
use support::{header, moment, session, small};

/// A session on disk with some of its events, and all that the program knows.
struct Place {
    root: tempfile::TempDir,
    directory: PathBuf,
    header: SessionHeader,
    events: Vec<Event>,
}

impl Place {
    fn new() -> Self {
        let root = tempfile::tempdir().unwrap();
        let header = header(small("two-alternative"));
        let (_, mut events) = session(&header.protocol, header.seed, header.participant_number);
        events.push(Event::End(moment("")));
        Self { directory: root.path().join("study/P07"), root, header, events }
    }

    /// Writes the first `count` events.
    fn write(&self, count: usize) -> SessionWriter {
        let mut writer = SessionWriter::create(&self.directory, &self.header).unwrap();
        self.events[..count].iter().for_each(|event| writer.append(event).unwrap());
        writer
    }

    fn file(&self, name: &str) -> PathBuf {
        self.directory.join(name)
    }

    fn recover(&self, count: usize) -> Result<SessionWriter, String> {
        SessionWriter::recover(&self.directory, &self.header, &self.events[..count]).map_err(|error| error.to_string())
    }

    /// Recovers with `count` events, goes on to the end, and finds the very bytes of a session without a fault.
    fn goes_on_from(&self, count: usize) {
        let mut writer = self.recover(count).unwrap();
        self.events[count..].iter().for_each(|event| writer.append(event).unwrap());
        drop(writer);
        let whole =
            Self { directory: self.root.path().join("whole"), root: tempfile::tempdir().unwrap(), ..self.copy() };
        drop(whole.write(whole.events.len()));
        for name in [HEADER_FILE, EVENTS_FILE] {
            assert_eq!(fs::read_to_string(self.file(name)).unwrap(), fs::read_to_string(whole.file(name)).unwrap());
        }
        let session = read_session(&self.directory).unwrap();
        assert!(session.is_complete() && session.notices.is_empty() && session.replay().is_ok());
        fs::remove_dir_all(&whole.directory).unwrap();
    }

    fn copy(&self) -> Self {
        let (header, events) = (self.header.clone(), self.events.clone());
        Self { root: tempfile::tempdir().unwrap(), directory: PathBuf::new(), header, events }
    }
}

#[test]
#[cfg_attr(windows, ignore = "Windows refuses to remove a file that is open")]
fn a_folder_that_vanished_is_noticed_at_the_next_answer_and_made_anew_in_whole() {
    let place = Place::new();
    let mut writer = place.write(4);
    fs::remove_dir_all(&place.directory).unwrap();
    let error = writer.append(&place.events[4]).unwrap_err().to_string();
    assert!(error.contains(EVENTS_FILE), "{error}");
    drop(writer);
    place.goes_on_from(5);
}

#[test]
#[cfg_attr(windows, ignore = "Windows refuses to rename a folder with a file that is open")]
fn a_folder_that_was_replaced_by_a_copy_is_noticed_and_goes_on() {
    let place = Place::new();
    let mut writer = place.write(4);
    let moved = place.root.path().join("moved");
    fs::rename(&place.directory, &moved).unwrap();
    fs::create_dir(&place.directory).unwrap();
    for name in [HEADER_FILE, EVENTS_FILE] {
        fs::copy(moved.join(name), place.file(name)).unwrap();
    }
    let error = writer.append(&place.events[4]).unwrap_err().to_string();
    assert!(error.contains("it was changed or replaced during the session"), "{error}");
    assert_eq!(read_session(&moved).unwrap().events, place.events[..4], "what failed is not in the record");
    drop(writer);
    place.goes_on_from(5);
}

#[test]
fn a_file_that_somebody_cut_off_gets_no_hole() {
    let place = Place::new();
    let mut writer = place.write(4);
    fs::OpenOptions::new().write(true).open(place.file(EVENTS_FILE)).unwrap().set_len(10).unwrap();
    assert!(writer.append(&place.events[4]).is_err());
    assert_eq!(fs::metadata(place.file(EVENTS_FILE)).unwrap().len(), 10);
    drop(writer);
    place.goes_on_from(5);
}

#[test]
fn files_cut_off_anywhere_go_on() {
    let place = Place::new();
    drop(place.write(5));
    let [header, events] = [HEADER_FILE, EVENTS_FILE].map(|name| fs::read(place.file(name)).unwrap());
    let ends = events.iter().enumerate().filter(|(_, byte)| **byte == b'\n').map(|(place, _)| place);
    let cuts: Vec<usize> = ends.flat_map(|end| [end - 7, end, end + 1]).chain([0, 1]).collect();
    for cut in cuts {
        fs::write(place.file(HEADER_FILE), &header).unwrap();
        fs::write(place.file(EVENTS_FILE), &events[..cut]).unwrap();
        place.goes_on_from(5);
    }
    for cut in [0, 1, header.len() / 2, header.len() - 1] {
        fs::write(place.file(HEADER_FILE), &header[..cut]).unwrap();
        fs::write(place.file(EVENTS_FILE), &events).unwrap();
        place.goes_on_from(6);
    }
}

#[test]
fn a_session_whose_files_were_never_written_or_are_gone_is_made_anew() {
    let place = Place::new();
    place.goes_on_from(0);
    for gone in [HEADER_FILE, EVENTS_FILE] {
        fs::remove_file(place.file(gone)).unwrap();
        place.goes_on_from(place.events.len());
    }
}

#[test]
fn what_is_not_this_sessions_is_named_and_stays_as_it_is() {
    let place = Place::new();
    drop(place.write(3));
    let [header, events] = [HEADER_FILE, EVENTS_FILE].map(|name| fs::read_to_string(place.file(name)).unwrap());
    let other = |answer: &str| match answer.contains("\"answer\":\"left\"") {
        true => answer.replace("\"answer\":\"left\",\"correct\":true", "\"answer\":\"right\",\"correct\":false"),
        false => answer.replace("\"answer\":\"right\",\"correct\":true", "\"answer\":\"left\",\"correct\":false"),
    };
    let first = events.lines().next().unwrap();
    let answered_otherwise = format!("{}\n", other(first));
    assert_ne!(answered_otherwise.trim(), first);
    for (header, events, known, said) in [
        (&header.replace("P07", "P08"), &events, 3, "session.json:3: \"participant\": \"P08\",; allowed is"),
        (&"shopping list".to_owned(), &events, 3, "session.json:1: shopping list; allowed is {"),
        (&header, &"shopping list\n".to_owned(), 3, "events.jsonl:1: "),
        (&header, &answered_otherwise, 3, "events.jsonl:1: {\"event\":\"practice\""),
        (&header, &events, 2, "nothing, as this session has no further event"),
    ] {
        fs::write(place.file(HEADER_FILE), header).unwrap();
        fs::write(place.file(EVENTS_FILE), events).unwrap();
        let message = place.recover(known).unwrap_err();
        assert!(message.contains(said), "{said}: {message}");
        let left = [HEADER_FILE, EVENTS_FILE].map(|name| fs::read_to_string(place.file(name)).unwrap());
        assert_eq!([&left[0], &left[1]], [header, events]);
    }
    // Somebody's events without a header get no header of this session.
    fs::remove_file(place.file(HEADER_FILE)).unwrap();
    fs::write(place.file(EVENTS_FILE), "shopping list\n").unwrap();
    assert!(place.recover(3).is_err() && !place.file(HEADER_FILE).exists());
}

#[test]
fn a_session_that_another_program_writes_is_not_recovered() {
    let place = Place::new();
    let _writer = place.write(3);
    let message = place.recover(3).unwrap_err();
    assert!(message.contains("is being written by another program"), "{message}");
}
