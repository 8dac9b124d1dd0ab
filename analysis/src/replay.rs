//! Replay of a session (command `replay`): what the record says was shown is what its seed, protocol and
//! answers lead to.
//!
//! The state machine runs through the answers; every placement, radius and draw that it makes must
//! equal the recorded one bit for bit. Where the record has hashes of the pictures, each picture is drawn
//! again, for the display that the header describes, and its hash compared. A record without hashes
//! says nothing about pixels.

use rayon::prelude::*;
use scumble_psychophysics::{Answered, EVENTS_FILE, Event, Role, Session};
use scumble_stimuli::{Transfer, picture_sha256};

use crate::Error;

/// What a replay compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Replayed {
    /// Trials after practice.
    pub trials: usize,
    /// Practice trials.
    pub practice: usize,
    /// Staircases whose states were recomputed.
    pub staircases: usize,
    /// Pictures that were drawn again.
    pub pictures: usize,
}

/// Number of pictures whose hashes a session holds.
pub fn hashed_pictures(session: &Session) -> usize {
    answers(session).map(|(_, answered)| answered.pictures_sha256.len()).sum()
}

/// Replays a session and calls `drawn` after each trial's pictures, with their number.
///
/// # Errors
/// The first line of the record that differs, with what was found and what the seed leads to.
pub fn replay_session(session: &Session, drawn: impl Fn(usize) + Sync) -> Result<Replayed, Error> {
    let experiment = session.replay()?;
    let transfer = session.header.transfer()?;
    let hashed: Vec<_> = answers(session).filter(|(_, answered)| !answered.pictures_sha256.is_empty()).collect();
    let difference = hashed.par_iter().find_map_first(|(line, answered)| {
        let found = check_pictures(session, *line, answered, &transfer);
        drawn(answered.pictures_sha256.len());
        found.err()
    });
    if let Some(difference) = difference {
        return Err(difference);
    }
    let practice = answers(session).filter(|(_, answered)| answered.trial.role == Role::Practice).count();
    Ok(Replayed {
        trials: answers(session).count() - practice,
        practice,
        staircases: experiment.tracks().len(),
        pictures: hashed_pictures(session),
    })
}

/// Every answer with its line.
fn answers(session: &Session) -> impl Iterator<Item = (usize, &Answered)> {
    (1..).zip(&session.events).filter_map(|(line, event): (usize, &Event)| Some((line, event.answered()?)))
}

fn check_pictures(session: &Session, line: usize, answered: &Answered, transfer: &Transfer) -> Result<(), Error> {
    let damaged = |found: String, allowed: String| scumble_psychophysics::Error::Damaged {
        path: session.directory.join(EVENTS_FILE),
        line,
        found,
        allowed,
    };
    let pictures = &session.header.protocol.pictures;
    for (place, (stimulus, recorded)) in
        answered.trial.pictures.all().into_iter().zip(&answered.pictures_sha256).enumerate()
    {
        let picture = stimulus
            .render(pictures.width_px, pictures.height_px, transfer)
            .map_err(|error| damaged(error.to_string(), "a picture that can be drawn".to_owned()))?;
        let drawn = picture_sha256(&picture);
        if drawn != *recorded {
            let found = format!("pictures_sha256[{place}] is {recorded}");
            return Err(damaged(found, format!("{drawn}, the hash of the picture that the trial describes")).into());
        }
    }
    Ok(())
}
