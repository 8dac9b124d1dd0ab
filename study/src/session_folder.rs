//! Where a participant's session goes: `DIR/CODE`, and `DIR/CODE.2` and so on behind sessions that were
//! discarded or ended early. A session that is complete or can be continued is never passed over.

use std::path::{Path, PathBuf};

use scumble_psychophysics::{EVENTS_FILE, Error, HEADER_FILE, read_session};

use crate::clock::secs_between;

/// What a study's folder holds of a participant.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Found {
    /// Nothing that a fresh session could collide with; it goes here.
    Free(PathBuf),
    /// A session that can be continued.
    Interrupted(Interrupted),
    /// A complete session.
    Complete(PathBuf),
}

/// A session that can be continued.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Interrupted {
    pub(crate) directory: PathBuf,
    /// Seconds since its last event.
    pub(crate) age_secs: f64,
    /// Trials answered, and the most that the session can have, for staircases.
    pub(crate) trials: u32,
    pub(crate) trials_at_most: u32,
}

/// Looks for the sessions of a participant; errors are those of reading the last one.
pub(crate) fn find(study: &Path, code: &str) -> Result<Found, Error> {
    let folder = |number: u32| match number {
        1 => study.join(code),
        _ => study.join(format!("{code}.{number}")),
    };
    let is_taken = |number: u32| [HEADER_FILE, EVENTS_FILE].iter().any(|file| folder(number).join(file).exists());
    let taken = (1..).take_while(|&number| is_taken(number)).last();
    let Some(last) = taken else {
        return Ok(Found::Free(folder(1)));
    };
    let directory = folder(last);
    let session = read_session(&directory)?;
    if session.is_complete() {
        return Ok(Found::Complete(directory));
    }
    if session.is_closed() {
        return Ok(Found::Free(folder(last + 1)));
    }
    let progress = session.replay()?.progress();
    let age_secs = secs_between(session.last_known_at(), jiff::Timestamp::now());
    let (trials, trials_at_most) = (progress.trials, progress.trials_at_most);
    Ok(Found::Interrupted(Interrupted { directory, age_secs, trials, trials_at_most }))
}
