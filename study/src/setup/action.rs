//! What the set-up asks of the program around it.

use std::path::PathBuf;

use super::Ready;
use crate::arguments::ResumePolicy;

/// What somebody asked for on a page that the set-up itself cannot do.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum SetupAction {
    /// Begin the session; everything is entered.
    Done(Box<Ready>),
    /// Do this with the interrupted session of this folder. After [`ResumePolicy::Discard`] the set-up goes on,
    /// once it was told to [`super::Setup::discarded`].
    Interrupted(PathBuf, ResumePolicy),
    /// Move the window to the monitor of this index.
    Monitor(usize),
    /// Close the program. Nothing is to be recorded.
    Quit,
}
