//! One screen a file. A screen draws, and says what the participant asked for; it decides nothing.

mod feedback;
mod finished;
mod in_charge;
mod instructions;
mod page;
mod paused;
#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod pictures;
mod refused;
mod rest;
mod setup;
mod stopped;
mod trial;
mod unsaved;

pub(crate) use feedback::feedback;
pub(crate) use finished::finished;
pub(crate) use in_charge::in_charge;
pub(crate) use instructions::{Examples, instructions};
pub(crate) use paused::paused;
pub(crate) use refused::refused;
pub(crate) use rest::rest;
pub(crate) use setup::setup;
pub(crate) use stopped::stopped;
pub(crate) use trial::{pixels_missing, too_small, trial};
pub(crate) use unsaved::unsaved;

use scumble_psychophysics::{Answer, Task};

use crate::words::participant::ParticipantWords;

/// What a participant can ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Action {
    /// On from a screen that asks nothing.
    Proceed,
    /// This answer to the question of the trial.
    Answer(Answer),
    /// Hide the pictures.
    Pause,
    /// Back from a pause.
    Continue,
    /// Write again what the disk has refused.
    Retry,
    /// Close the window.
    Close,
}

/// What is asked of every trial, the heading of its screen (Kreuzer 2017, figure 4.4, for one picture).
fn question(task: Task, words: &ParticipantWords) -> &'static str {
    match task {
        Task::TwoAlternative => words.question_two,
        Task::YesNo => words.question_one,
    }
}
