//! Sessions on disk become people with answers.
//!
//! Every session is replayed through the experiment's state machine, so that a record that its seed
//! and protocol do not lead to is refused and the convergence rule is the experiment's own. Sessions
//! of one participant code are one person. All sessions must share one protocol; simulated people
//! and humans are not mixed.

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

use rayon::prelude::*;
use scumble_core::SessionHash;
use scumble_psychophysics::{
    Condition, EVENTS_FILE, Event, Experiment, HEADER_FILE, Protocol, Reason, Session, read_session,
};
use sha2::{Digest, Sha256};

use crate::{Error, checks::Checks};

/// The answers that one staircase of one session learned from, in the order of the trials.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Intensity `log10(texel / radius)` as shown, and whether the answer was right.
    pub responses: Vec<(f64, bool)>,
    /// Why the experiment's convergence rule did not hold at the last trial; empty where it did.
    pub unconverged: Vec<Reason>,
}

/// One person's answers in one condition: every staircase of every session.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    /// Pattern, contrast, kernel and texel size.
    pub condition: Condition,
    /// One a prior and session.
    pub runs: Vec<Run>,
}

impl Track {
    /// Every answer, run after run.
    pub fn responses(&self) -> impl Iterator<Item = (f64, bool)> {
        self.runs.iter().flat_map(|run| run.responses.iter().copied())
    }

    /// Number of runs that met the experiment's convergence rule.
    pub fn converged(&self) -> usize {
        self.runs.iter().filter(|run| run.unconverged.is_empty()).count()
    }
}

/// One person.
#[derive(Debug, Clone, PartialEq)]
pub struct Person {
    /// The participant code.
    pub code: String,
    /// The answers that staircases learned from, in the order of the protocol's conditions.
    pub tracks: Vec<Track>,
    /// The answers to the trials between them.
    pub checks: Checks,
}

impl Person {
    /// The person who gave the answers `events` in an experiment.
    pub fn of(code: &str, experiment: &Experiment, events: &[Event]) -> Self {
        let runs_of = |condition: &Condition| {
            let here = experiment.tracks().iter().filter(|track| track.condition() == condition);
            here.map(|track| Run { responses: track.responses().to_vec(), unconverged: track.verdict().reasons() })
                .collect()
        };
        let conditions = experiment.protocol().all_conditions().into_iter();
        let tracks = conditions.map(|condition| Track { runs: runs_of(&condition), condition }).collect();
        Self { code: code.to_owned(), tracks, checks: Checks::of(events) }
    }

    /// Adds the answers of a further session.
    fn append(&mut self, other: Self) {
        for (track, more) in self.tracks.iter_mut().zip(other.tracks) {
            track.runs.extend(more.runs);
        }
        self.checks = self.checks + other.checks;
    }
}

/// A session with what identifies it.
#[derive(Debug, Clone)]
pub struct LoadedSession {
    /// The record.
    pub session: Session,
    /// SHA-256 of `session.json` followed by `events.jsonl`, hexadecimal.
    pub sha256: String,
}

/// All people of a study.
#[derive(Debug, Clone)]
pub struct Study {
    /// The protocol that all sessions share.
    pub protocol: Protocol,
    /// The people, by code.
    pub people: Vec<Person>,
    /// The sessions, by path; empty for a study that never was on disk.
    pub sessions: Vec<LoadedSession>,
    /// What the reader dropped or missed, in sentences.
    pub notices: Vec<String>,
}

impl Study {
    /// Reads sessions; each path is a session or a folder of sessions.
    ///
    /// # Errors
    /// Names the folder without sessions, the damaged file and line, the session with another
    /// protocol, or the copy of a session.
    pub fn read(paths: &[PathBuf]) -> Result<Self, Error> {
        let mut directories = Vec::new();
        for path in paths {
            directories.extend(session_directories(path)?);
        }
        directories.sort();
        directories.dedup();
        let loaded: Vec<(LoadedSession, Experiment)> =
            directories.par_iter().map(|path| load(path)).collect::<Result<_, Error>>()?;
        check_alike(&loaded)?;
        let Some((first, _)) = loaded.first() else {
            return Err(Error::CannotFit("no session was given".to_owned()));
        };

        let protocol = first.session.header.protocol.clone();
        let mut people: BTreeMap<String, Person> = BTreeMap::new();
        let mut notices = Vec::new();
        for (LoadedSession { session, .. }, experiment) in &loaded {
            notices.extend(session.notices.iter().cloned());
            if !session.is_complete() {
                let directory = session.directory.display();
                let progress = experiment.progress();
                notices.push(format!(
                    "{directory}: the session was not finished: round {} of {}, {} trials",
                    progress.round, progress.rounds, progress.trials
                ));
            }
            let person = Person::of(&session.header.participant, experiment, &session.events);
            match people.get_mut(&person.code) {
                Some(known) => known.append(person),
                None => _ = people.insert(person.code.clone(), person),
            }
        }
        let sessions = loaded.into_iter().map(|(session, _)| session).collect();
        Ok(Self { protocol, people: people.into_values().collect(), sessions, notices })
    }

    /// Number of measured trials.
    pub fn trial_count(&self) -> usize {
        let tracks = self.people.iter().flat_map(|person| &person.tracks);
        tracks.flat_map(|track| &track.runs).map(|run| run.responses.len()).sum()
    }

    /// Whether the answers are those of simulated people.
    pub fn is_simulated(&self) -> bool {
        self.sessions.iter().any(|loaded| loaded.session.header.simulated_observer.is_some())
    }

    /// Name and content hash of every session.
    pub fn session_hashes(&self) -> Vec<SessionHash> {
        let of = |loaded: &LoadedSession| SessionHash {
            session: directory_name(&loaded.session.directory),
            sha256: loaded.sha256.clone(),
        };
        self.sessions.iter().map(of).collect()
    }
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
    let mut hash = Sha256::new();
    for name in [HEADER_FILE, EVENTS_FILE] {
        let path = directory.join(name);
        hash.update(std::fs::read(&path).map_err(Error::io(&path))?);
    }
    let session = read_session(directory)?;
    if !session.events.iter().any(|event| matches!(event, Event::Trial(_))) {
        let reason = "the session has no measured trial; leave it out".to_owned();
        return Err(Error::File { path: directory.join(EVENTS_FILE), reason });
    }
    let experiment = session.replay()?;
    let sha256 = hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
    Ok((LoadedSession { session, sha256 }, experiment))
}

/// Refuses copies, a second protocol, and humans among simulated people.
fn check_alike(loaded: &[(LoadedSession, Experiment)]) -> Result<(), Error> {
    let mut known: BTreeMap<&str, &Path> = BTreeMap::new();
    let Some((first, _)) = loaded.first() else { return Ok(()) };
    let first = &first.session;
    for (LoadedSession { session, sha256 }, _) in loaded {
        let path = session.directory.join(HEADER_FILE);
        if let Some(original) = known.insert(sha256, &session.directory) {
            let reason = format!("a copy of the session {}; each counts once", original.display());
            return Err(Error::File { path, reason });
        }
        if session.header.protocol != first.header.protocol {
            let other = first.directory.display();
            let reason = format!("its protocol differs from that of {other}; a fit takes one protocol");
            return Err(Error::File { path, reason });
        }
        let simulated = |session: &Session| session.header.simulated_observer.is_some();
        if simulated(session) != simulated(first) {
            let other = first.directory.display();
            let reason = format!("one of this session and {other} is simulated; a fit takes one kind");
            return Err(Error::File { path, reason });
        }
    }
    Ok(())
}
