//! The stages of a session: what the person is shown, one after the other.

use crate::trial::{Answer, Trial};

/// What is to be shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stage {
    /// The instructions, once at the beginning.
    Instructions,
    /// A trial with feedback after the answer.
    Practice(Trial),
    /// Whether the answer in practice was right.
    Feedback {
        /// Whether it was.
        correct: bool,
        /// The right one.
        right_answer: Answer,
    },
    /// A trial without feedback.
    Trial(Trial),
    /// A rest; before round 1 it tells that there is no feedback from here on.
    Rest {
        /// The round that follows or goes on, from 1.
        round: u32,
        /// Number of rounds.
        rounds: u32,
        /// Whether the round is under way.
        within_round: bool,
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
