//! What is recorded: one event a line of `events.jsonl`.

use jiff::Timestamp;
use serde::{Deserialize, Serialize};

use crate::trial::{Side, Trial};

/// One line of the record. The states of the QUESTs are not in it: they follow from the answers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "event", rename_all = "snake_case")]
pub enum Event {
    /// An answer that a QUEST learned from.
    Trial(Answered),
    /// An answer in practice.
    Practice(Answered),
    /// The session was interrupted.
    Pause(Moment),
    /// The session was taken up again.
    Resume(Moment),
    /// The session is complete; nothing follows.
    End(Moment),
}

/// A trial and its answer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Answered {
    /// What was shown.
    pub trial: Trial,
    /// The side that the participant named as the line.
    pub answer: Side,
    /// Whether it was the line.
    pub correct: bool,
    /// From the first frame of the pictures to the answer.
    pub response_time_secs: f64,
}

/// A point in time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Moment {
    /// When.
    pub at: Timestamp,
    /// What else is worth knowing, such as a line that was cut off; may be empty.
    #[serde(default)]
    pub notes: Vec<String>,
}

impl Event {
    /// The answer to a measured trial, else `None`.
    pub fn measured(&self) -> Option<&Answered> {
        match self {
            Self::Trial(answered) => Some(answered),
            _ => None,
        }
    }
}

impl Answered {
    /// What contradicts itself in an answer read from a file, in words.
    pub(crate) fn contradiction(&self) -> Option<String> {
        if self.correct != self.trial.is_correct(self.answer) {
            return Some(format!(
                "correct {} for the answer {:?} where the line is {:?}",
                self.correct, self.answer, self.trial.line_side
            ));
        }
        if !is_response_time(self.response_time_secs) {
            return Some(format!("response_time_secs {}", self.response_time_secs));
        }
        self.trial.contradiction()
    }
}

/// Whether a number can be a response time: finite and at least 0.
pub(crate) fn is_response_time(secs: f64) -> bool {
    secs.is_finite() && secs >= 0.0
}
