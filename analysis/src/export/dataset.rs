//! The files of a dataset, written all together or not at all.
//!
//! They are made in a folder beside the dataset's place, which is renamed when it is whole. Nothing that exists is
//! replaced.

use std::path::{Path, PathBuf};

use rayon::prelude::*;
use scumble_psychophysics::{EVENTS_FILE, HEADER_FILE};
use serde::Serialize;

use super::description::{Description, README};
use super::event_column::event_columns;
use super::event_row::event_rows;
use super::events_sidecar::EventsSidecar;
use super::exported_session::ExportedSession;
use super::people_column::{Participant, participant_columns, session_columns};
use crate::column::{Column, Sidecar, tsv};
use crate::{Error, load::record_sha256};

/// Writes the dataset of `sessions`, which stand together by participant, into the folder `out`.
///
/// # Errors
/// A folder that holds something, before anything is written; a record that changed since it was read; the
/// system's refusals.
pub(super) fn write(sessions: &[ExportedSession], out: &Path) -> Result<(), Error> {
    let out = std::path::absolute(out).map_err(Error::io(out))?;
    check_free(&out)?;
    let (Some(parent), Some(name)) = (out.parent(), out.file_name()) else {
        return Err(Error::File { path: out, reason: "no folder for a dataset".to_owned() });
    };
    std::fs::create_dir_all(parent).map_err(Error::io(parent))?;
    let partial = parent.join(format!(".{}.partial-{}", name.to_string_lossy(), std::process::id()));
    std::fs::create_dir(&partial).map_err(Error::io(&partial))?;
    let written = fill(&Folder(partial.clone()), sessions).and_then(|()| put_in_place(&partial, &out));
    if written.is_err() {
        // The reason for the failure says more than one for which the remains cannot be removed.
        std::fs::remove_dir_all(&partial).ok();
    }
    written
}

/// Refuses a place where anything is, and the current folder, which the dataset would be renamed over.
fn check_free(out: &Path) -> Result<(), Error> {
    let refuse = |found: String| {
        let reason = format!("{found}; allowed is a folder that is empty or does not exist");
        Err(Error::File { path: out.to_path_buf(), reason })
    };
    if !out.exists() {
        return Ok(());
    }
    if !out.is_dir() {
        return refuse("is no folder".to_owned());
    }
    if std::env::current_dir().is_ok_and(|current| current == out) {
        return refuse("is the current folder".to_owned());
    }
    let mut entries = std::fs::read_dir(out).map_err(Error::io(out))?;
    match entries.next() {
        Some(entry) => refuse(format!("holds {}", entry.map_err(Error::io(out))?.file_name().to_string_lossy())),
        None => Ok(()),
    }
}

/// Renames the whole dataset to its place. An empty folder there is removed, which fails where it is not empty.
fn put_in_place(partial: &Path, out: &Path) -> Result<(), Error> {
    if out.exists() {
        std::fs::remove_dir(out).map_err(Error::io(out))?;
    }
    std::fs::rename(partial, out).map_err(Error::io(out))
}

fn fill(folder: &Folder, sessions: &[ExportedSession]) -> Result<(), Error> {
    folder.write_json("dataset_description.json", &Description::new())?;
    folder.write("README.md", README)?;

    let of_one_person =
        |one: &ExportedSession, other: &ExportedSession| one.participant_label == other.participant_label;
    let people: Vec<_> =
        sessions.chunk_by(of_one_person).map(|sessions| Participant { sessions: sessions.iter().collect() }).collect();
    let columns = participant_columns();
    folder.write_json("participants.json", &Sidecar(&columns))?;
    folder.write_table("participants.tsv", &columns, &people)?;

    // By BIDS' rule of inheritance it describes the table of every session.
    folder.write_json("scans.json", &Sidecar(&session_columns()))?;
    sessions.par_iter().try_for_each(|session| fill_session(folder, session))
}

/// The session's row, its events and its record.
fn fill_session(folder: &Folder, session: &ExportedSession) -> Result<(), Error> {
    let own = session.folder();
    folder.write_table(own.join(format!("{}_scans.tsv", session.name())), &session_columns(), &[session])?;

    let columns = event_columns();
    let events = own.join(session.events_file());
    folder.write_table(&events, &columns, &event_rows(session.session())?)?;
    let sidecar = EventsSidecar { header: &session.session().header, columns: &columns };
    folder.write_json(events.with_extension("json"), &sidecar)?;

    let source = Path::new("sourcedata").join(session.name());
    let recorded = &session.session().directory;
    // A session that ended before its first answer may have no file of events.
    for name in [HEADER_FILE, EVENTS_FILE].into_iter().filter(|name| recorded.join(name).exists()) {
        folder.copy(&recorded.join(name), source.join(name))?;
    }
    if record_sha256(&folder.0.join(source))? != session.loaded.sha256 {
        let reason = "the session went on while it was exported; run the export again when it is over".to_owned();
        return Err(Error::File { path: recorded.clone(), reason });
    }
    Ok(())
}

/// Where the files go.
struct Folder(PathBuf);

impl Folder {
    fn write(&self, name: impl AsRef<Path>, content: &str) -> Result<(), Error> {
        let path = self.place(name.as_ref())?;
        std::fs::write(&path, content).map_err(Error::io(&path))
    }

    fn write_json(&self, name: impl AsRef<Path>, content: &impl Serialize) -> Result<(), Error> {
        let failed = |error: serde_json::Error| Error::io(name.as_ref())(error.into());
        self.write(&name, &(serde_json::to_string_pretty(content).map_err(failed)? + "\n"))
    }

    fn write_table<R>(&self, name: impl AsRef<Path>, columns: &[Column<R>], rows: &[R]) -> Result<(), Error> {
        self.write(&name, &tsv(name.as_ref(), columns, rows)?)
    }

    fn copy(&self, from: &Path, name: PathBuf) -> Result<(), Error> {
        let path = self.place(&name)?;
        std::fs::copy(from, &path).map(drop).map_err(Error::io(from))
    }

    /// The path of a file whose folder is made.
    fn place(&self, name: &Path) -> Result<PathBuf, Error> {
        let path = self.0.join(name);
        let folder = path.parent().unwrap_or(&self.0);
        std::fs::create_dir_all(folder).map_err(Error::io(folder))?;
        Ok(path)
    }
}
