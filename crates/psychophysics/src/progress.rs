//! How far a session is, and how long it can still get: staircases end early, so there are two bounds.

use serde::{Deserialize, Serialize};

use crate::protocol::Protocol;
use crate::timetable::Timetable;
use crate::track::Track;

/// How far a session is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Progress {
    /// Trials answered after practice, whatever their role.
    pub answered: u32,
    /// Trials answered that a staircase learned from.
    pub trials: u32,
    /// Fewest measured trials of the whole session, given the answers so far.
    pub trials_at_least: u32,
    /// Most measured trials of the whole session, given the answers so far.
    pub trials_at_most: u32,
    /// Round under way, from 1.
    pub round: u32,
    /// Number of rounds.
    pub rounds: u32,
}

impl Progress {
    /// Of a session with these staircases, after this many answers that stand.
    pub(crate) fn of(protocol: &Protocol, timetable: &Timetable, answered: u32) -> Self {
        let tracks = timetable.tracks();
        let total = |of_open: fn(u32, &Protocol) -> u32| {
            let of_track = |track: &Track| match track.is_done() {
                true => track.trials(),
                false => of_open(track.trials(), protocol),
            };
            tracks.iter().map(of_track).sum()
        };
        Self {
            answered,
            trials: tracks.iter().map(Track::trials).sum(),
            trials_at_least: total(|trials, protocol| protocol.schedule.trials_min.max(trials + 1)),
            trials_at_most: total(|_, protocol| protocol.schedule.trials_max),
            round: timetable.round_number(),
            rounds: timetable.rounds() as u32,
        }
    }
}
