//! The set-up of a session: what a researcher and a participant say before the instructions.
//!
//! No window: the pages in [`crate::screen`] show a [`Setup`] and pass on what was done.

mod study_folder;

pub(crate) use study_folder::{FolderProblem, PROTOCOL_FILE, StudyFolder};
