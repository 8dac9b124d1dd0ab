//! The texts of the pages before the instructions.

mod english;
mod german;

use crate::setup::FolderProblem;

pub(super) use english::ENGLISH;
pub(super) use german::GERMAN;

/// See [`super::Words::setup`].
///
/// A function takes what is to be said and gives whole sentences, since languages build them differently.
pub(crate) struct SetupWords {
    pub(crate) go_on: &'static str,
    /// Why a folder cannot be the folder of a study, and what is allowed.
    pub(crate) folder_problem: fn(&FolderProblem) -> String,
}
