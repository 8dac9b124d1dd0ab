//! Sessions as a BIDS dataset (command `export`): the layout that other laboratories' programs read.
//!
//! The Brain Imaging Data Structure, <https://bids-specification.readthedocs.io>, knows experiments without brain
//! recordings: a table of events a session, a JSON beside each table that describes its columns, a table of
//! the participants. Every fact of a trial becomes a cell; the records themselves go into `sourcedata`, so that
//! nothing is lost and the dataset can be fitted again. Numbers are those of the record: nothing is
//! computed here but sums.

mod dataset;
mod description;
mod event_column;
mod event_row;
mod events_sidecar;
mod exported_session;
mod labels;
mod people_column;

use std::{
    collections::{BTreeMap, BTreeSet},
    path::{Path, PathBuf},
};

use jiff::Timestamp;
use scumble_psychophysics::{Protocol, Session, SessionHeader};

use event_row::event_rows;
pub use exported_session::{ExportedSession, Status};
use labels::unique_labels;

use crate::{
    Error,
    load::{LoadedSession, NEVER_BEGAN, Sessions, check_kind, load_sessions},
};

/// Sessions that are ready to be written as a dataset.
#[derive(Debug, Clone)]
pub struct Export {
    /// By participant's code, then in the order of time.
    pub sessions: Vec<ExportedSession>,
    /// Sessions that stay out, each with the reason.
    pub left_out: Vec<(PathBuf, &'static str)>,
}

impl Export {
    /// Reads sessions; each path is a session or a folder of sessions. Discarded sessions and sessions without
    /// an answer stay out.
    ///
    /// # Errors
    /// Names the folder without sessions, the damaged file and line, the copy of a session, simulated
    /// people among humans, the session without onsets; no session that is left to export.
    pub fn read(paths: &[PathBuf]) -> Result<Self, Error> {
        let (mut kept, mut left_out) = (Vec::new(), Vec::new());
        let Sessions { loaded, never_began } = load_sessions(paths)?;
        left_out.extend(never_began.into_iter().map(|path| (path, NEVER_BEGAN)));
        for (loaded, _) in loaded {
            match reason_to_leave_out(&loaded.session) {
                Some(reason) => left_out.push((loaded.session.directory, reason)),
                None => kept.push(loaded),
            }
        }
        let Some(first) = kept.first() else {
            let reasons = left_out.iter().map(|(path, reason)| format!("{}: {reason}", path.display()));
            return Err(Error::CannotExport(reasons.collect::<Vec<_>>().join("; ")));
        };
        for loaded in &kept {
            check_kind(&first.session, &loaded.session)?;
            // An answer without onset is found before anything is written.
            event_rows(&loaded.session)?;
        }
        Ok(Self { sessions: labelled(kept), left_out })
    }

    /// Writes the dataset into the folder `out`, which must not exist or be empty: all of it, or nothing.
    ///
    /// # Errors
    /// A folder with other files, before anything is written; the system's refusals.
    pub fn write(&self, out: &Path) -> Result<(), Error> {
        dataset::write(&self.sessions, out)
    }
}

fn reason_to_leave_out(session: &Session) -> Option<&'static str> {
    let has_answers = session.events.iter().any(|event| event.answered().is_some());
    match (session.is_discarded(), has_answers) {
        (true, _) => Some("the administrator discarded it"),
        (false, false) => Some("it has no answer"),
        (false, true) => None,
    }
}

/// The sessions by participant's code and time, with their labels. Everyone has numbered sessions where one
/// participant has several, so that all folders are alike.
fn labelled(mut loaded: Vec<LoadedSession>) -> Vec<ExportedSession> {
    loaded.sort_by(|one, other| order(&one.session).cmp(&order(&other.session)));
    let mut protocols: Vec<Protocol> = Vec::new();
    for LoadedSession { session, .. } in &loaded {
        if !protocols.contains(&session.header.protocol) {
            protocols.push(session.header.protocol.clone());
        }
    }
    let task_labels = unique_labels(protocols.iter().map(|protocol| protocol.name.as_str()));
    let codes: BTreeSet<String> = loaded.iter().map(|loaded| loaded.session.header.participant.clone()).collect();
    let participant_labels = unique_labels(codes.iter().map(String::as_str));
    let label_of: BTreeMap<&String, String> = codes.iter().zip(participant_labels).collect();
    let are_numbered = codes.len() < loaded.len();

    let mut count_of: BTreeMap<String, usize> = BTreeMap::new();
    let with_labels = |loaded: LoadedSession| {
        let SessionHeader { participant, protocol, .. } = &loaded.session.header;
        let number = count_of.entry(participant.clone()).or_default();
        *number += 1;
        let task = protocols.iter().position(|other| other == protocol);
        ExportedSession {
            participant_label: label_of[participant].clone(),
            session_number: are_numbered.then_some(*number),
            task_label: task.map_or_else(String::new, |task| task_labels[task].clone()),
            loaded,
        }
    };
    loaded.into_iter().map(with_labels).collect()
}

fn order(session: &Session) -> (&str, Timestamp, &Path) {
    (&session.header.participant, session.header.started_at, &session.directory)
}
