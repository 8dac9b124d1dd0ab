//! What is recorded: one event a line of `events.jsonl`.

use jiff::Timestamp;
use serde::{Deserialize, Serialize};

use crate::error::{Error, require};
use crate::event_line::EventLine;
use crate::trial::{Answer, Role, Trial};

/// One line of the record. The states of the staircases are not in it: they follow from the answers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "event", rename_all = "snake_case", try_from = "EventLine")]
pub enum Event {
    /// An answer that a staircase learned from.
    Trial(Answered),
    /// An answer to a line alone or to an artifact that everyone sees; no staircase learned from it.
    Catch(Answered),
    /// An answer in practice.
    Practice(Answered),
    /// The session was interrupted.
    Pause(Moment),
    /// The session was taken up again.
    Resume(Moment),
    /// What the administrator noted.
    Note(Moment),
    /// Practice begins anew.
    RepeatPractice(Moment),
    /// The round under way begins anew; the answers it has do not stand.
    RepeatRound(Moment),
    /// The session is complete; nothing follows.
    End(Moment),
    /// The administrator ended the session early; nothing follows.
    Stop(Moment),
    /// The session is not to be used; nothing follows.
    Discard(Moment),
}

/// A trial and its answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Answered {
    /// What was shown.
    pub trial: Trial,
    /// What the participant answered.
    pub answer: Answer,
    /// Whether it was right.
    pub correct: bool,
    /// From the first frame of the pictures to the answer.
    pub response_time_secs: f64,
    /// SHA-256 of the pictures from left to right, as drawn; empty where none was drawn.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pictures_sha256: Vec<String>,
    /// When the pictures were shown; `None` where that is not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub timing: Option<Timing>,
}

/// When the pictures of a trial were shown.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Timing {
    /// Seconds from the session's start to the first frame of the pictures; never decreases within a session,
    /// whatever happens to the computer's clock.
    pub onset_secs: f64,
    /// Refreshes of the display by which the pictures came later than they were due.
    pub missed_frames: u32,
}

/// What comes from outside into a trial.
#[derive(Clone, Debug, PartialEq)]
pub struct Reply {
    /// What the participant answers.
    pub answer: Answer,
    /// From the first frame of the pictures to the answer.
    pub response_time_secs: f64,
    /// SHA-256 of the pictures from left to right, as drawn; empty where none was drawn.
    pub pictures_sha256: Vec<String>,
    /// When the pictures were shown; `None` where that is not known.
    pub timing: Option<Timing>,
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
    /// How long the session had been interrupted, where it is taken up again.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interrupted_secs: Option<f64>,
}

impl Event {
    /// The event of an answer, by the role of its trial.
    pub(crate) fn of(answered: Answered) -> Self {
        match answered.trial.role {
            Role::Practice => Self::Practice(answered),
            Role::Measure => Self::Trial(answered),
            Role::Line | Role::Catch => Self::Catch(answered),
        }
    }

    /// The answer that it holds, if any.
    pub fn answered(&self) -> Option<&Answered> {
        match self {
            Self::Trial(answered) | Self::Catch(answered) | Self::Practice(answered) => Some(answered),
            _ => None,
        }
    }

    /// The point in time that it holds, if any.
    pub fn moment(&self) -> Option<&Moment> {
        match self {
            Self::Trial(_) | Self::Catch(_) | Self::Practice(_) => None,
            Self::Pause(moment)
            | Self::Resume(moment)
            | Self::Note(moment)
            | Self::RepeatPractice(moment)
            | Self::RepeatRound(moment)
            | Self::End(moment)
            | Self::Stop(moment)
            | Self::Discard(moment) => Some(moment),
        }
    }

    /// Whether nothing may follow.
    pub fn is_last(&self) -> bool {
        matches!(self, Self::End(_) | Self::Stop(_) | Self::Discard(_))
    }

    /// The answer that a staircase learned from, else `None`.
    pub fn measured(&self) -> Option<&Answered> {
        match self {
            Self::Trial(answered) => Some(answered),
            _ => None,
        }
    }
}

impl Answered {
    /// Refuses an answer, read from a file, that contradicts itself or its trial; the error names the key.
    pub(crate) fn check(&self) -> Result<(), Error> {
        self.trial.check()?;
        let allowed = "left and right for two pictures, yes and no for one";
        let of_question = self.trial.pictures.answers().contains(&self.answer);
        require(of_question, "answer", self.answer.name(), allowed)?;
        let is_right = self.trial.is_correct(self.answer);
        let allowed = "true where the answer is the right one for the pictures, else false";
        require(self.correct == is_right, "correct", self.correct, allowed)?;
        let secs = self.response_time_secs;
        require(is_duration(secs), "response_time_secs", secs, DURATION_ALLOWED)?;
        if let Some(timing) = self.timing {
            timing.check()?;
        }
        let hashes = &self.pictures_sha256;
        let fits = hashes.is_empty() || hashes.len() == self.trial.pictures.all().len();
        let allowed = "one SHA-256 of 64 hexadecimal digits for each picture, or no such key";
        require(fits && hashes.iter().all(|hash| is_sha256(hash)), "pictures_sha256", format!("{hashes:?}"), allowed)
    }
}

impl Timing {
    /// Refuses an onset that is no time; the error names the key.
    pub(crate) fn check(&self) -> Result<(), Error> {
        require(is_duration(self.onset_secs), "timing.onset_secs", self.onset_secs, DURATION_ALLOWED)
    }
}

/// What a response time, an onset and an interruption may be.
pub(crate) const DURATION_ALLOWED: &str = "a finite number of seconds, at least 0";

/// Whether a number of seconds can be a duration, or a time since the session began: finite and at least 0.
pub(crate) fn is_duration(secs: f64) -> bool {
    secs.is_finite() && secs >= 0.0
}

/// Whether a text is a SHA-256 as it is written here.
pub(crate) fn is_sha256(text: &str) -> bool {
    text.len() == 64 && text.bytes().all(|byte| byte.is_ascii_hexdigit())
}
