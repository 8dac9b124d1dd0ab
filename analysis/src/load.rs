//! Sessions on disk: where they are, and that each is whole and counts once.
//!
//! Every session is replayed through the experiment's state machine, so that a record that its seed and protocol
//! do not lead to is refused.

use std::{
    collections::BTreeMap,
    io::ErrorKind,
    path::{Path, PathBuf},
};

use rayon::prelude::*;
use scumble_psychophysics::{EVENTS_FILE, Error::NeverBegan, Experiment, HEADER_FILE, Session, read_session};
use sha2::{Digest, Sha256};

use crate::Error;

/// A session with what identifies it.
#[derive(Debug, Clone)]
pub struct LoadedSession {
    /// The record.
    pub session: Session,
    /// SHA-256 of `session.json` followed by `events.jsonl`, hexadecimal.
    pub sha256: String,
}

/// What lies in folders of sessions.
pub(crate) struct Sessions {
    /// Each with the experiment at its end, by path.
    pub loaded: Vec<(LoadedSession, Experiment)>,
    /// Folders of sessions that ended before their header was whole.
    pub never_began: Vec<PathBuf>,
}

/// Why a session that never began is left out.
pub(crate) const NEVER_BEGAN: &str = "the session ended before its header was whole, and so before the first answer";

/// Reads sessions; each of `paths` is a session or a folder of sessions.
///
/// # Errors
/// Names the folder without sessions, the damaged file and line, or the copy of a session.
pub(crate) fn load_sessions(paths: &[PathBuf]) -> Result<Sessions, Error> {
    let mut directories = Vec::new();
    for path in paths {
        directories.extend(session_directories(path)?);
    }
    directories.sort();
    directories.dedup();
    let (mut loaded, mut never_began) = (Vec::new(), Vec::new());
    let read: Vec<_> = directories.par_iter().map(|path| load(path)).collect();
    for (session, directory) in read.into_iter().zip(directories) {
        match session {
            Err(Error::Psychophysics(NeverBegan { .. })) => never_began.push(directory),
            other => loaded.push(other?),
        }
    }
    let mut known: BTreeMap<&str, &Path> = BTreeMap::new();
    for (LoadedSession { session, sha256 }, _) in &loaded {
        if let Some(original) = known.insert(sha256, &session.directory) {
            let reason = format!("a copy of the session {}; each counts once", original.display());
            return Err(Error::File { path: session.directory.join(HEADER_FILE), reason });
        }
    }
    Ok(Sessions { loaded, never_began })
}

/// Refuses a simulated person beside a human.
///
/// # Errors
/// Names both sessions.
pub(crate) fn check_kind(first: &Session, session: &Session) -> Result<(), Error> {
    let simulated = |session: &Session| session.header.simulated_observer.is_some();
    if simulated(session) == simulated(first) {
        return Ok(());
    }
    let other = first.directory.display();
    let reason = format!("one of this session and {other} is simulated; a study has people of one kind");
    Err(Error::File { path: session.directory.join(HEADER_FILE), reason })
}

/// A directory's own name.
pub(crate) fn directory_name(directory: &Path) -> String {
    directory.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

/// `path` itself where it holds a session, else the folders directly below it that do, by name.
///
/// # Errors
/// A path that cannot be read or holds no session.
pub fn session_directories(path: &Path) -> Result<Vec<PathBuf>, Error> {
    let is_session = |path: &Path| path.join(HEADER_FILE).exists() || path.join(EVENTS_FILE).exists();
    let path = path.canonicalize().map_err(Error::io(path))?;
    if is_session(&path) {
        return Ok(vec![path]);
    }
    let mut found = Vec::new();
    for entry in std::fs::read_dir(&path).map_err(Error::io(&path))? {
        let entry = entry.map_err(Error::io(&path))?.path();
        if is_session(&entry) {
            found.push(entry);
        }
    }
    if found.is_empty() {
        let reason = format!("no session: neither the folder nor a folder in it has {HEADER_FILE}");
        return Err(Error::File { path, reason });
    }
    found.sort();
    Ok(found)
}

fn load(directory: &Path) -> Result<(LoadedSession, Experiment), Error> {
    let sha256 = record_sha256(directory)?;
    let session = read_session(directory)?;
    let experiment = session.replay()?;
    Ok((LoadedSession { session, sha256 }, experiment))
}

/// SHA-256 of `session.json` followed by `events.jsonl`, hexadecimal; a session that ended before its first answer
/// may have no file of events.
///
/// # Errors
/// The system's refusal to read them.
pub(crate) fn record_sha256(directory: &Path) -> Result<String, Error> {
    let mut hash = Sha256::new();
    for name in [HEADER_FILE, EVENTS_FILE] {
        let path = directory.join(name);
        match std::fs::read(&path) {
            Ok(bytes) => hash.update(bytes),
            Err(error) if name == EVENTS_FILE && error.kind() == ErrorKind::NotFound => {}
            Err(error) => return Err(Error::io(&path)(error)),
        }
    }
    Ok(hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}
