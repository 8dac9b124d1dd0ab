//! Which QUEST is asked next: rounds in random order, and within a round cycles that visit every
//! QUEST that is not done once, in random order, so that no size runs ahead of the others.

use crate::draw::{Draw, Purpose};
use crate::error::Error;
use crate::protocol::Protocol;
use crate::track::Track;

/// The QUESTs of one session and the order of their trials.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Schedule {
    seed: u64,
    /// Round after round in the order of the session.
    tracks: Vec<Track>,
    tracks_per_round: usize,
    /// Round under way, from 0; the number of rounds at the end.
    round: usize,
    /// QUESTs left in this cycle, last first.
    cycle: Vec<usize>,
}

impl Schedule {
    /// Draws the order of the rounds.
    pub(crate) fn new(protocol: &Protocol, seed: u64) -> Result<Self, Error> {
        let conditions = protocol.conditions();
        let tracks_per_round = protocol.texels_px.len();
        let mut rounds: Vec<_> = conditions.chunks(tracks_per_round).collect();
        Draw::new(seed, Purpose::Rounds, 0).shuffle(&mut rounds);
        let tracks =
            rounds.concat().into_iter().map(|condition| Track::new(protocol, condition)).collect::<Result<_, _>>()?;
        Ok(Self { seed, tracks, tracks_per_round, round: 0, cycle: Vec::new() })
    }

    /// The QUEST that trial `number` asks; `None` when the round is over.
    pub(crate) fn next_track(&mut self, number: u32) -> Option<usize> {
        if self.cycle.is_empty() {
            let first = self.round * self.tracks_per_round;
            let round = first..first + self.tracks_per_round;
            self.cycle = round.filter(|i| !self.tracks[*i].is_done()).collect();
            Draw::new(self.seed, Purpose::Interleaving, number).shuffle(&mut self.cycle);
        }
        self.cycle.pop()
    }

    /// Moves to the next round; false when there is none.
    pub(crate) fn next_round(&mut self) -> bool {
        self.round += 1;
        self.round < self.rounds()
    }

    /// Round under way, from 1.
    pub(crate) fn round_number(&self) -> u32 {
        self.round.min(self.rounds() - 1) as u32 + 1
    }

    /// Number of rounds.
    pub(crate) fn rounds(&self) -> usize {
        self.tracks.len() / self.tracks_per_round
    }

    /// Every QUEST, in the order of the session.
    pub(crate) fn tracks(&self) -> &[Track] {
        &self.tracks
    }

    /// One QUEST, to respond to.
    pub(crate) fn track_mut(&mut self, index: usize) -> &mut Track {
        &mut self.tracks[index]
    }
}
