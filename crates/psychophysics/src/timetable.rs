//! Which trial comes next: the order of the rounds, and within a round cycles that visit every
//! staircase that is not done once, in random order, so that no size runs ahead of the others.
//!
//! What a trial is for is drawn by itself, from the seed and its number: a line takes the place of a
//! staircase's artifact in the cycle, so that neither its size, its radius nor what came before tells
//! a line from an artifact.

use crate::draw::{Draw, Purpose};
use crate::error::Error;
use crate::latin_square::balanced_row;
use crate::protocol::{Order, Protocol};
use crate::track::Track;
use crate::trial::Role;

/// The staircases of one session and the order of their trials.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Timetable {
    seed: u64,
    /// Round after round in the order of the session.
    tracks: Vec<Track>,
    tracks_per_round: usize,
    catch_share: f64,
    line_share: f64,
    /// Round under way, from 0; the number of rounds at the end.
    round: usize,
    /// Staircases left in this cycle, last first.
    cycle: Vec<usize>,
}

impl Timetable {
    /// Puts the rounds in order.
    pub(crate) fn new(protocol: &Protocol, seed: u64, participant_number: u32) -> Result<Self, Error> {
        let rounds = protocol.rounds();
        let order = match protocol.schedule.order {
            Order::LatinSquare => balanced_row(rounds.len(), participant_number),
            Order::Random => {
                let mut order: Vec<usize> = (0..rounds.len()).collect();
                Draw::new(seed, Purpose::Rounds, 0).shuffle(&mut order);
                order
            }
        };
        let mut tracks = Vec::new();
        for index in order {
            for condition in protocol.conditions_of(rounds[index]) {
                for prior_ratio in &protocol.staircase.prior_ratios {
                    tracks.push(Track::new(protocol, condition, *prior_ratio)?);
                }
            }
        }
        Ok(Self {
            seed,
            tracks_per_round: tracks.len() / rounds.len(),
            tracks,
            catch_share: protocol.catch_share(),
            line_share: protocol.line_share(),
            round: 0,
            cycle: Vec::new(),
        })
    }

    /// What trial `number` is for and the staircase that it belongs to; `None` when the round is over.
    /// A catch trial belongs to the round alone; the index is then that of the round's first staircase.
    pub(crate) fn next(&mut self, number: u32) -> Option<(Role, usize)> {
        let open = self.open();
        let first = self.round * self.tracks_per_round;
        if open.is_empty() {
            return None;
        }
        let mut draw = Draw::new(self.seed, Purpose::Roles, number);
        if draw.unit() < self.catch_share {
            return Some((Role::Catch, first));
        }
        let role = if draw.unit() < self.line_share { Role::Line } else { Role::Measure };
        if self.cycle.is_empty() {
            self.cycle = open;
            Draw::new(self.seed, Purpose::Interleaving, number).shuffle(&mut self.cycle);
        }
        self.cycle.pop().map(|index| (role, index))
    }

    /// Whether a staircase of the round asks for a further trial.
    pub(crate) fn round_is_open(&self) -> bool {
        !self.open().is_empty()
    }

    /// Moves to the next round; false when there is none.
    pub(crate) fn next_round(&mut self) -> bool {
        self.round += 1;
        self.cycle.clear();
        self.round < self.rounds()
    }

    /// Puts the staircases of the round back to their priors.
    pub(crate) fn restart_round(&mut self, protocol: &Protocol) -> Result<(), Error> {
        let first = self.round * self.tracks_per_round;
        for track in &mut self.tracks[first..first + self.tracks_per_round] {
            *track = track.restarted(protocol)?;
        }
        self.cycle.clear();
        Ok(())
    }

    /// Round under way, from 1.
    pub(crate) fn round_number(&self) -> u32 {
        self.round.min(self.rounds() - 1) as u32 + 1
    }

    /// Number of rounds.
    pub(crate) fn rounds(&self) -> usize {
        self.tracks.len() / self.tracks_per_round
    }

    /// Every staircase, in the order of the session.
    pub(crate) fn tracks(&self) -> &[Track] {
        &self.tracks
    }

    /// One staircase, to respond to.
    pub(crate) fn track_mut(&mut self, index: usize) -> &mut Track {
        &mut self.tracks[index]
    }

    /// The staircases of the round that are not done.
    fn open(&self) -> Vec<usize> {
        let first = self.round * self.tracks_per_round;
        (first..first + self.tracks_per_round).filter(|index| !self.tracks[*index].is_done()).collect()
    }
}
