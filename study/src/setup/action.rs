//! What the set-up asks of the program around it.

use std::path::PathBuf;

use super::Ready;

/// What somebody asked for on a page that the set-up itself cannot do.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum SetupAction {
    /// Begin the session; everything is entered.
    Done(Box<Ready>),
    /// Do this with the interrupted session of this folder. After [`Choice::Discard`] the set-up goes on,
    /// once it was told to [`super::Setup::look_again`].
    Interrupted(PathBuf, Choice),
    /// Move the window to the monitor of this index.
    Monitor(usize),
    /// Close the program. Nothing is to be recorded.
    Quit,
}

/// What to do with an interrupted session.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Choice {
    /// Go on where it was interrupted.
    Resume,
    /// Go on at the beginning of the round that was interrupted.
    RepeatRound,
    /// Close it for good; its answers are not to be used, and the participant begins anew.
    Discard,
}
