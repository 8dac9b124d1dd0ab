//! Reading a session back: the record is the truth, and damage is named by file and line.
//!
//! A last line without its line break was cut off by a crash before it was on disk: it is dropped
//! with a notice. A header without a file of events is a session that ended before its first answer; a header that
//! was cut off, without events, is none that ever began, and has an error of its own. Anything else that is not an event in its place is an error.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use jiff::{SignedDuration, Timestamp};

use crate::complaint::{Complaint, quoted};
use crate::error::Error;
use crate::event::{Answered, Event, Timing};
use crate::experiment::Experiment;
use crate::header::SessionHeader;
use crate::record::{EVENTS_FILE, HEADER_FILE};
use crate::text::{Text, damaged};

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
///
/// Errors: [`Error::NeverBegan`] for a header that was cut off where there are no events; what is damaged, by file
/// and line; the system's.
pub fn read_session(directory: &Path) -> Result<Session, Error> {
    let path = directory.join(EVENTS_FILE);
    let events = match std::fs::read(&path) {
        Ok(events) => Some(events),
        Err(error) if error.kind() == ErrorKind::NotFound => None,
        Err(error) => return Err(Error::io(path)(error)),
    };
    let header_path = directory.join(HEADER_FILE);
    let header = read(&header_path)?;
    if events.is_none() && is_cut_off(&header) {
        return Err(Error::NeverBegan { path: header_path, bytes: header.len() });
    }
    let mut session = Session::parse(directory, &header, events.as_deref().unwrap_or_default())?;
    if events.is_none() {
        session.notices.push(no_events(&path));
    }
    Ok(session)
}

/// What a session without a file of events is told by.
pub(crate) fn no_events(path: &Path) -> String {
    format!("{}: there is no such file: the program ended before the first answer", path.display())
}

/// Whether these bytes are the beginning of some JSON, or the zeros that a loss of power leaves in a new file.
fn is_cut_off(json: &[u8]) -> bool {
    json.iter().all(|byte| *byte == 0)
        || serde_json::from_slice::<serde::de::IgnoredAny>(json).is_err_and(|error| error.is_eof())
}

/// The bytes of a file.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, Error> {
    std::fs::read(path).map_err(Error::io(path))
}

impl Session {
    /// The session whose two files hold these bytes, checked as by [`read_session`]; the file system is
    /// not touched, `directory` is for messages.
    pub fn parse(directory: &Path, header: &[u8], events: &[u8]) -> Result<Self, Error> {
        let header = SessionHeader::parse(&directory.join(HEADER_FILE), header)?;
        let path = directory.join(EVENTS_FILE);
        let whole = events.iter().rposition(|byte| *byte == b'\n').map_or(0, |last| last + 1);
        let (lines, tail) = events.split_at(whole);
        let lines = Text::new(&path, lines)?.refuse_conversions()?.text;

        let mut reader = LineReader { path: &path, events: Vec::new(), practised: 0, answered: 0, onset_secs: 0.0 };
        lines.lines().try_for_each(|line| reader.read(line))?;
        let mut notices = Vec::new();
        if !tail.is_empty() {
            notices.push(format!(
                "{}:{}: the last line was cut off after {} bytes and is dropped: {}",
                path.display(),
                reader.events.len() + 1,
                tail.len(),
                quoted(&String::from_utf8_lossy(tail))
            ));
        }
        let whole_lines_bytes = whole as u64;
        Ok(Self { directory: directory.into(), header, events: reader.events, notices, whole_lines_bytes })
    }

    /// Runs the state machine through the events: every staircase as it stood at the end of the record.
    ///
    /// Errors name the line whose event the seed and the protocol do not lead to.
    pub fn replay(&self) -> Result<Experiment, Error> {
        Experiment::resume(&self.header, &self.events).map_err(|error| match error {
            Error::Replay { index, found, allowed } => {
                let allowed = format!("{allowed}, to which the seed and the answers before lead");
                damaged(&self.directory.join(EVENTS_FILE), index + 1, found, allowed)
            }
            other => other,
        })
    }

    /// Whether the record ends with [`Event::End`].
    pub fn is_complete(&self) -> bool {
        matches!(self.events.last(), Some(Event::End(_)))
    }

    /// Whether nothing may follow: the session is complete, was ended early, or was discarded.
    pub fn is_closed(&self) -> bool {
        self.events.last().is_some_and(Event::is_last)
    }

    /// Whether its answers are not to be used.
    pub fn is_discarded(&self) -> bool {
        matches!(self.events.last(), Some(Event::Discard(_)))
    }

    /// The latest moment that the record tells.
    pub fn last_known_at(&self) -> Timestamp {
        let started_at = self.header.started_at;
        let at = |event: &Event| match event.moment() {
            Some(moment) => Some(moment.at),
            None => event.answered().and_then(|answered| {
                let secs = answered.timing?.onset_secs + answered.response_time_secs;
                started_at.checked_add(SignedDuration::try_from_secs_f64(secs).ok()?).ok()
            }),
        };
        self.events.iter().filter_map(at).fold(started_at, Timestamp::max)
    }

    /// Length of the events' file up to its last line break.
    pub(crate) fn whole_lines_bytes(&self) -> u64 {
        self.whole_lines_bytes
    }
}

/// Reads lines in order and remembers what the next trial's number must be.
struct LineReader<'a> {
    path: &'a Path,
    events: Vec<Event>,
    practised: u32,
    answered: u32,
    onset_secs: f64,
}

impl LineReader<'_> {
    fn read(&mut self, line: &str) -> Result<(), Error> {
        let event = parse_event(line).map_err(|Complaint { found, allowed }| self.damaged(found, allowed))?;
        if self.events.last().is_some_and(Event::is_last) {
            return Err(self.damaged("an event after the end", "nothing"));
        }
        if let Some(answered) = event.answered() {
            self.check_place(&event, answered)?;
            answered.check().map_err(|error| match error {
                Error::Parameter { field, value, allowed } => self.damaged(format!("{field} is {value}"), allowed),
                other => other,
            })?;
            if let Some(Timing { onset_secs, .. }) = answered.timing {
                if onset_secs < self.onset_secs {
                    let allowed = format!("{} and more, the onset before it", self.onset_secs);
                    return Err(self.damaged(format!("timing.onset_secs is {onset_secs}"), allowed));
                }
                self.onset_secs = onset_secs;
            }
        }
        self.events.push(event);
        Ok(())
    }

    fn check_place(&mut self, event: &Event, answered: &Answered) -> Result<(), Error> {
        let is_practice = matches!(event, Event::Practice(_));
        let count = if is_practice { &mut self.practised } else { &mut self.answered };
        *count += 1;
        let expected = *count;
        let number = answered.trial.number;
        if number != expected {
            return Err(self
                .damaged(format!("trial.number is {number}"), format!("{expected}, as no line is missing or twice")));
        }
        if Event::of(answered.clone()) != *event {
            let found = format!("trial.role is {} under another event", answered.trial.role.name());
            let allowed = "the event of the role: trial for measure, catch for line and catch, practice for practice";
            return Err(self.damaged(found, allowed));
        }
        Ok(())
    }

    fn damaged(&self, found: impl Into<String>, allowed: impl Into<String>) -> Error {
        damaged(self.path, self.events.len() + 1, found, allowed)
    }
}

/// The event of a line.
fn parse_event(line: &str) -> Result<Event, Complaint> {
    let allowed = "one event, as JSON in one line, as the program wrote it";
    if line.is_empty() {
        return Err(Complaint { found: "an empty line".into(), allowed: allowed.into() });
    }
    parse_json(line, allowed).map_err(|(_, complaint)| complaint)
}

/// The value that JSON holds, or the byte and the text of the complaint.
pub(crate) fn parse_json<'a, T: serde::Deserialize<'a>>(json: &'a str, allowed: &str) -> Result<T, (usize, Complaint)> {
    let complain = |key: &str, error: &serde_json::Error| {
        // The line and the column that serde_json ends its messages with are told by themselves.
        let message = error.to_string();
        let message = message.rsplit_once(" at line ").map_or(message.as_str(), |(message, _)| message);
        let line_start = json.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum::<usize>();
        (line_start, Complaint::new(key, message, allowed))
    };
    let mut deserializer = serde_json::Deserializer::from_str(json);
    let value = serde_path_to_error::deserialize(&mut deserializer)
        .map_err(|error| complain(&error.path().to_string(), error.inner()))?;
    deserializer.end().map_err(|error| complain(".", &error))?;
    Ok(value)
}
