//! The experiment: one state machine, without a window and without a clock, for people, simulations
//! and tests.
//!
//! Everything that it shows follows from the protocol, the seed and the answers: the same seed and
//! the same answers give the same session, image for image, and an interrupted session is resumed by
//! feeding its recorded answers to a new machine. QUEST learns from the radius that was *shown*; a
//! placement beyond what a picture can hold is clamped, and [`Trial`] holds both.

use serde::{Deserialize, Serialize};

use crate::draw::Purpose;
use crate::error::{Error, require};
use crate::event::{Answered, Event, is_response_time};
use crate::picture::{Place, draw_trial};
use crate::protocol::Protocol;
use crate::schedule::Schedule;
use crate::track::Track;
use crate::trial::{Condition, Side, Trial};

/// What is to be shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stage {
    /// The instructions, once at the beginning.
    Instructions,
    /// Two pictures, with feedback after the answer.
    Practice(Trial),
    /// Whether the answer in practice was right.
    Feedback {
        /// Whether it was.
        correct: bool,
    },
    /// Two pictures.
    Trial(Trial),
    /// A rest before a round; before round 1 it tells that there is no feedback from here on.
    Rest {
        /// The round that follows, from 1.
        round: u32,
        /// Number of rounds.
        rounds: u32,
    },
    /// Thanks.
    Finished,
}

impl Stage {
    /// Its name in messages.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Instructions => "instructions",
            Self::Practice(_) => "practice",
            Self::Feedback { .. } => "feedback",
            Self::Trial(_) => "trial",
            Self::Rest { .. } => "rest",
            Self::Finished => "finished",
        }
    }

    /// The trial on show, in practice or not.
    pub fn trial(&self) -> Option<&Trial> {
        match self {
            Self::Practice(trial) | Self::Trial(trial) => Some(trial),
            _ => None,
        }
    }
}

/// How far a session is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Progress {
    /// Measured trials answered.
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

/// A session as it runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Experiment {
    protocol: Protocol,
    seed: u64,
    schedule: Schedule,
    stage: Stage,
    /// The QUEST that the trial on show asks.
    asked: usize,
    practised: u32,
    answered: u32,
}

impl Experiment {
    /// A session before its first screen; errors name the parameter that is out of its range.
    pub fn new(protocol: Protocol, seed: u64) -> Result<Self, Error> {
        protocol.check()?;
        let schedule = Schedule::new(&protocol, seed)?;
        Ok(Self { protocol, seed, schedule, stage: Stage::Instructions, asked: 0, practised: 0, answered: 0 })
    }

    /// What is to be shown.
    pub fn stage(&self) -> &Stage {
        &self.stage
    }

    /// Moves on from a screen that asks nothing.
    pub fn proceed(&mut self) -> Result<(), Error> {
        self.stage = match self.stage {
            Stage::Instructions | Stage::Feedback { .. } => self.next_practice(),
            Stage::Rest { .. } => self.next_trial(),
            _ => return Err(self.refuse("proceed", "instructions, feedback and rest")),
        };
        Ok(())
    }

    /// Takes the side that the participant names as the line, and gives the event that must be on
    /// disk before the next stage is shown.
    ///
    /// Errors, which leave the session as it was: a stage without a trial, and a response time that
    /// is negative or not finite.
    pub fn answer(&mut self, side: Side, response_time_secs: f64) -> Result<Event, Error> {
        let Some(trial) = self.stage.trial().copied() else {
            return Err(self.refuse("answer", "practice and trial"));
        };
        self.answer_shown(trial, side, response_time_secs)
    }

    /// Number of measured trials and rounds.
    pub fn progress(&self) -> Progress {
        let protocol = &self.protocol;
        let total = |of_open: fn(u32, &Protocol) -> u32| {
            let of_track = |track: &Track| match track.is_done() {
                true => track.trials(),
                false => of_open(track.trials(), protocol),
            };
            self.tracks().iter().map(of_track).sum()
        };
        Progress {
            trials: self.answered,
            trials_at_least: total(|trials, protocol| protocol.trials_min.max(trials + 1)),
            trials_at_most: total(|_, protocol| protocol.trials_max),
            round: self.schedule.round_number(),
            rounds: self.schedule.rounds() as u32,
        }
    }

    /// Every QUEST, in the order of the session's rounds.
    pub fn tracks(&self) -> &[Track] {
        self.schedule.tracks()
    }

    /// The parameters.
    pub fn protocol(&self) -> &Protocol {
        &self.protocol
    }

    /// The answer to a trial whose radii may be the recorded ones.
    pub(crate) fn answer_shown(&mut self, trial: Trial, answer: Side, response_time_secs: f64) -> Result<Event, Error> {
        require(
            is_response_time(response_time_secs),
            "response_time_secs",
            response_time_secs,
            "a finite number of seconds, at least 0",
        )?;
        let correct = trial.is_correct(answer);
        let answered = Answered { trial, answer, correct, response_time_secs };
        if let Stage::Practice(_) = self.stage {
            self.practised += 1;
            self.stage = Stage::Feedback { correct };
            return Ok(Event::Practice(answered));
        }
        self.schedule.track_mut(self.asked).respond(&self.protocol, &trial, correct)?;
        self.answered += 1;
        self.stage = self.next_trial();
        Ok(Event::Trial(answered))
    }

    fn refuse(&self, call: &'static str, allowed: &'static str) -> Error {
        Error::Stage { call, stage: self.stage.name(), allowed }
    }

    fn next_practice(&self) -> Stage {
        let practice = &self.protocol.practice;
        let Some(ratio) = practice.ratios.get(self.practised as usize) else {
            return self.rest();
        };
        let patterns = &self.protocol.patterns;
        let condition = Condition {
            pattern: patterns[self.practised as usize % patterns.len()],
            contrast: practice.contrast,
            texel_px: practice.texel_px,
        };
        let wanted_px = ratio * practice.texel_px;
        let (smallest_px, largest_px) = self.protocol.radius_range_px(practice.texel_px);
        let place = self.place(Purpose::Practice, self.practised + 1, 0);
        let shown_px = wanted_px.clamp(smallest_px, largest_px);
        Stage::Practice(draw_trial(place, condition, wanted_px, shown_px))
    }

    fn next_trial(&mut self) -> Stage {
        let number = self.answered + 1;
        let Some(asked) = self.schedule.next_track(number) else {
            return match self.schedule.next_round() {
                true => self.rest(),
                false => Stage::Finished,
            };
        };
        self.asked = asked;
        let track = &self.tracks()[asked];
        let (wanted_px, shown_px) = track.next_radius_px(&self.protocol);
        let round = self.schedule.round_number();
        let place = self.place(Purpose::Pictures, number, round);
        Stage::Trial(draw_trial(place, *track.condition(), wanted_px, shown_px))
    }

    fn rest(&self) -> Stage {
        Stage::Rest { round: self.schedule.round_number(), rounds: self.schedule.rounds() as u32 }
    }

    fn place(&self, purpose: Purpose, number: u32, round: u32) -> Place {
        Place { seed: self.seed, purpose, number, round }
    }
}
