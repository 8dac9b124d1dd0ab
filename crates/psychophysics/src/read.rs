//! Reading a session back: the record is the truth, and damage is named by file and line.
//!
//! A last line without its line break was cut off by a crash before it was on disk: it is dropped
//! with a notice. Anything else that is not an event in its place is an error.

use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::event::Event;
use crate::experiment::Experiment;
use crate::header::SessionHeader;
use crate::record::{EVENTS_FILE, HEADER_FILE};

/// A session read from its directory.
#[derive(Clone, Debug, PartialEq)]
pub struct Session {
    /// Its directory.
    pub directory: PathBuf,
    /// Its header.
    pub header: SessionHeader,
    /// Its events, in order; event `i` stands in line `i + 1`.
    pub events: Vec<Event>,
    /// What the reader had to drop, in words; empty for a whole session.
    pub notices: Vec<String>,
    whole_lines_bytes: u64,
}

/// Reads a session and checks each event by itself and its place in the numbering;
/// [`Session::replay`] checks it against the seed.
pub fn read_session(directory: &Path) -> Result<Session, Error> {
    let path = directory.join(EVENTS_FILE);
    let bytes = std::fs::read(&path).map_err(Error::io(&path))?;
    parse_session(directory, &bytes)
}

/// The session of a directory whose events are `bytes`.
pub(crate) fn parse_session(directory: &Path, bytes: &[u8]) -> Result<Session, Error> {
    let header = read_header(&directory.join(HEADER_FILE))?;
    let path = directory.join(EVENTS_FILE);
    let whole = bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |last| last + 1);
    let (lines, tail) = bytes.split_at(whole);

    let mut reader = LineReader::new(&path);
    for line in lines.split_inclusive(|byte| *byte == b'\n') {
        reader.read(line)?;
    }
    let mut notices = Vec::new();
    if !tail.is_empty() {
        notices.push(format!(
            "{}:{}: the last line was cut off after {} bytes and is dropped: {}",
            path.display(),
            reader.events.len() + 1,
            tail.len(),
            String::from_utf8_lossy(tail)
        ));
    }
    Ok(Session { directory: directory.into(), header, events: reader.events, notices, whole_lines_bytes: whole as u64 })
}

impl Session {
    /// Runs the state machine through the events: every QUEST as it stood at the end of the record.
    ///
    /// Errors name the line whose event the seed and the protocol do not lead to.
    pub fn replay(&self) -> Result<Experiment, Error> {
        Experiment::resume(&self.header, &self.events).map_err(|error| match error {
            Error::Replay { index, found, allowed } => Error::Damaged {
                path: self.directory.join(EVENTS_FILE),
                line: index + 1,
                found,
                allowed: format!("{allowed}, to which the seed and the answers before lead"),
            },
            other => other,
        })
    }

    /// Whether the record ends with [`Event::End`].
    pub fn is_complete(&self) -> bool {
        matches!(self.events.last(), Some(Event::End(_)))
    }

    /// Length of the events' file up to its last line break.
    pub(crate) fn whole_lines_bytes(&self) -> u64 {
        self.whole_lines_bytes
    }
}

fn read_header(path: &Path) -> Result<SessionHeader, Error> {
    let text = std::fs::read_to_string(path).map_err(Error::io(path))?;
    let damaged = |line, found: String| Error::Damaged {
        path: path.into(),
        line,
        found,
        allowed: "a session header of this version".into(),
    };
    let header: SessionHeader =
        serde_json::from_str(&text).map_err(|error| damaged(error.line(), error.to_string()))?;
    header.check().map_err(|error| damaged(1, error.to_string()))?;
    Ok(header)
}

/// Reads lines in order and remembers what the next trial's number must be.
struct LineReader<'a> {
    path: &'a Path,
    events: Vec<Event>,
    practised: u32,
    answered: u32,
}

impl<'a> LineReader<'a> {
    fn new(path: &'a Path) -> Self {
        Self { path, events: Vec::new(), practised: 0, answered: 0 }
    }

    fn read(&mut self, line: &[u8]) -> Result<(), Error> {
        let event: Event = serde_json::from_slice(line)
            .map_err(|error| self.damaged(error.to_string(), "one event, as JSON, with all of its fields"))?;
        if let Some(Event::End(_)) = self.events.last() {
            return Err(self.damaged("an event after the end", "nothing"));
        }
        let is_practice = matches!(event, Event::Practice(_));
        let count = if is_practice { &mut self.practised } else { &mut self.answered };
        if let Some(answered) = event.answered() {
            *count += 1;
            let expected = *count;
            if answered.trial.number != expected {
                let found = format!("trial number {}", answered.trial.number);
                return Err(self.damaged(found, format!("{expected}")));
            }
            if Event::of(answered.clone()) != event {
                let found = format!("a trial of role {:?} under another event", answered.trial.role);
                return Err(self.damaged(found, "the event of its role"));
            }
            if let Some(found) = answered.contradiction() {
                return Err(self.damaged(found, "an answer that agrees with its trial"));
            }
        }
        self.events.push(event);
        Ok(())
    }

    fn damaged(&self, found: impl Into<String>, allowed: impl Into<String>) -> Error {
        Error::Damaged {
            path: self.path.into(),
            line: self.events.len() + 1,
            found: found.into(),
            allowed: allowed.into(),
        }
    }
}
