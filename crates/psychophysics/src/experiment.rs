//! The experiment: one state machine, without a window and without a clock, for people, simulations
//! and tests.
//!
//! Everything that it shows follows from the protocol, the seed and the answers: the same seed and
//! the same answers give the same session, image for image, and an interrupted session is resumed by
//! feeding its recorded answers to a new machine. A staircase learns from the radius that was *shown*;
//! a placement beyond what a picture can hold is clamped, and [`Trial`] holds both.

use crate::error::{Error, require};
use crate::event::{Answered, DURATION_ALLOWED, Event, Reply, Timing, is_duration};
use crate::picture::{Request, draw_trial};
use crate::progress::Progress;
use crate::protocol::Protocol;
use crate::stage::Stage;
use crate::timetable::Timetable;
use crate::track::Track;
use crate::trial::{Condition, Role, Trial};

/// A session as it runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Experiment {
    protocol: Protocol,
    seed: u64,
    timetable: Timetable,
    stage: Stage,
    practised: u32,
    /// Practice trials that were answered when practice began, for the last time.
    practised_before: u32,
    /// Trials answered after practice, whatever their role.
    answered: u32,
    /// Those of them that do not stand, since their round was repeated.
    replaced: u32,
    /// Trials answered since the round under way began, for the last time.
    answered_of_round: u32,
    /// Trials answered since the last rest.
    since_rest: u32,
    /// The latest known onset of pictures, and the answer to them, since the session began.
    onset_secs: f64,
    answered_secs: f64,
}

impl Experiment {
    /// A session before its first screen; errors name the parameter that is out of its range.
    pub fn new(protocol: Protocol, seed: u64, participant_number: u32) -> Result<Self, Error> {
        protocol.check()?;
        let timetable = Timetable::new(&protocol, seed, participant_number)?;
        let stage = Stage::Instructions;
        Ok(Self {
            protocol,
            seed,
            timetable,
            stage,
            practised: 0,
            practised_before: 0,
            answered: 0,
            replaced: 0,
            answered_of_round: 0,
            since_rest: 0,
            onset_secs: 0.0,
            answered_secs: 0.0,
        })
    }

    /// What is to be shown.
    pub fn stage(&self) -> &Stage {
        &self.stage
    }

    /// Moves on from a screen that asks nothing.
    pub fn proceed(&mut self) -> Result<(), Error> {
        self.stage = match self.stage {
            Stage::Instructions | Stage::Feedback { .. } => self.next_practice(),
            Stage::Rest { .. } => {
                self.since_rest = 0;
                self.next_trial()
            }
            _ => return Err(self.refuse("proceed", "instructions, feedback and rest")),
        };
        Ok(())
    }

    /// Takes an answer, and gives the event that must be on disk before the next stage is shown.
    ///
    /// Errors, which leave the session as it was: a stage without a trial, an answer that the question
    /// does not allow, a response time that is negative or not finite, and an onset before the previous one.
    pub fn answer(&mut self, reply: Reply) -> Result<Event, Error> {
        let Some(trial) = self.stage.trial().copied() else {
            return Err(self.refuse("answer", "practice and trial"));
        };
        let Reply { answer, response_time_secs, pictures_sha256, timing } = reply;
        require(is_duration(response_time_secs), "response_time_secs", response_time_secs, DURATION_ALLOWED)?;
        let of_question = trial.pictures.answers().contains(&answer);
        let allowed = "left and right for two pictures, yes and no for one";
        require(of_question, "answer", answer.name(), allowed)?;
        let correct = trial.is_correct(answer);
        if let Some(Timing { onset_secs, .. }) = timing {
            let is_later = onset_secs.is_finite() && onset_secs >= self.onset_secs;
            let allowed = "a finite number of seconds, not before the previous onset";
            require(is_later, "timing.onset_secs", onset_secs, allowed)?;
        }
        let answered = Answered { trial, answer, correct, response_time_secs, pictures_sha256, timing };
        if trial.role == Role::Practice {
            self.practised += 1;
            self.stage = Stage::Feedback { correct, right_answer: trial.pictures.right_answer() };
        } else {
            self.learn(&trial, correct)?;
            self.answered += 1;
            self.answered_of_round += 1;
            self.since_rest += 1;
            self.stage = self.after_answer();
        }
        if let Some(Timing { onset_secs, .. }) = timing {
            (self.onset_secs, self.answered_secs) = (onset_secs, onset_secs + response_time_secs);
        }
        Ok(Event::of(answered))
    }

    /// Begins practice anew, with other pictures; the round under way goes on, or begins, after it.
    ///
    /// Errors, which leave the session as it was: a stage other than instructions, practice, feedback and rest.
    pub fn repeat_practice(&mut self) -> Result<(), Error> {
        match self.stage {
            Stage::Instructions | Stage::Practice(_) | Stage::Feedback { .. } | Stage::Rest { .. } => {
                self.practised_before = self.practised;
                self.stage = self.next_practice();
                Ok(())
            }
            _ => Err(self.refuse("repeat_practice", "instructions, practice, feedback and rest")),
        }
    }

    /// Begins the round under way anew, with other pictures and staircases at their priors; the answers that it
    /// has do not stand.
    ///
    /// Errors, which leave the session as it was: a round without an answer, and a stage other than trial and rest.
    pub fn repeat_round(&mut self) -> Result<(), Error> {
        let is_under_way = matches!(self.stage, Stage::Trial(_) | Stage::Rest { .. }) && self.answered_of_round > 0;
        if !is_under_way {
            return Err(self.refuse("repeat_round", "trial and rest, after the round's first answer"));
        }
        self.timetable.restart_round(&self.protocol)?;
        self.replaced += self.answered_of_round;
        (self.answered_of_round, self.since_rest) = (0, 0);
        self.stage = self.rest();
        Ok(())
    }

    /// Ends the session early. Errors: the stage finished.
    pub fn stop(&mut self) -> Result<(), Error> {
        match self.stage {
            Stage::Finished => Err(self.refuse("stop", "every other stage")),
            _ => {
                self.stage = Stage::Finished;
                Ok(())
            }
        }
    }

    /// Number of measured trials and rounds.
    pub fn progress(&self) -> Progress {
        Progress::of(&self.protocol, &self.timetable, self.answered - self.replaced)
    }

    /// Every QUEST, in the order of the session's rounds.
    pub fn tracks(&self) -> &[Track] {
        self.timetable.tracks()
    }

    /// Seconds from the session's start to the latest answer whose time is known; 0 before it.
    pub(crate) fn answered_secs(&self) -> f64 {
        self.answered_secs
    }

    /// The parameters.
    pub fn protocol(&self) -> &Protocol {
        &self.protocol
    }

    fn learn(&mut self, trial: &Trial, correct: bool) -> Result<(), Error> {
        match (trial.role, trial.track) {
            (Role::Measure, Some(track)) => {
                self.timetable.track_mut(track as usize).respond(&self.protocol, trial, correct)
            }
            _ => Ok(()),
        }
    }

    fn refuse(&self, call: &'static str, allowed: &'static str) -> Error {
        Error::Stage { call, stage: self.stage.name(), allowed }
    }

    fn next_practice(&self) -> Stage {
        let practice = &self.protocol.practice;
        let index = (self.practised - self.practised_before) as usize;
        let Some(ratio) = practice.ratios.get(index) else {
            return self.rest();
        };
        let conditions = &self.protocol.conditions;
        let condition = Condition {
            pattern: conditions.patterns[index % conditions.patterns.len()],
            contrast: practice.contrast,
            kernel: conditions.kernels[0],
            texel_px: practice.texel_px,
        };
        Stage::Practice(self.draw(Role::Practice, None, condition, ratio * practice.texel_px))
    }

    fn after_answer(&mut self) -> Stage {
        let is_rest = self.protocol.schedule.rest_every_trials == Some(self.since_rest);
        if is_rest && self.timetable.round_is_open() { self.rest() } else { self.next_trial() }
    }

    fn next_trial(&mut self) -> Stage {
        let Some((role, index)) = self.timetable.next(self.answered + 1) else {
            self.answered_of_round = 0;
            return if self.timetable.next_round() { self.rest() } else { Stage::Finished };
        };
        let track = &self.tracks()[index];
        let asked = *track.condition();
        let (track, condition, radius_px) = match (role, self.protocol.catch_trials) {
            (Role::Catch, Some(catch)) => {
                (None, Condition { texel_px: catch.texel_px, ..asked }, catch.ratio * catch.texel_px)
            }
            _ => (Some(index as u32), asked, track.next_radius_px()),
        };
        Stage::Trial(self.draw(role, track, condition, radius_px))
    }

    fn rest(&self) -> Stage {
        let (round, rounds) = (self.timetable.round_number(), self.timetable.rounds() as u32);
        Stage::Rest { round, rounds, within_round: self.answered_of_round > 0 }
    }

    fn draw(&self, role: Role, track: Option<u32>, condition: Condition, placement_radius_px: f64) -> Trial {
        let (number, round) = match role {
            Role::Practice => (self.practised + 1, 0),
            _ => (self.answered + 1, self.timetable.round_number()),
        };
        let request = Request { seed: self.seed, number, round, role, track, condition, placement_radius_px };
        draw_trial(&self.protocol, request)
    }
}
