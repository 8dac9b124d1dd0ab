//! What keeps a page from being left forwards; the words have a sentence for each.

use crate::session_folder::Found;

use super::consent::ConsentProblem;
use super::study_folder::FolderProblem;

/// What is missing or wrong on a page.
#[derive(Debug)]
pub(crate) enum Problem<'a> {
    /// No folder is entered.
    NoFolder,
    /// The folder cannot be a study's.
    Folder(&'a FolderProblem),
    /// The study's consent text cannot be shown.
    Consent(&'a ConsentProblem),
    /// The study's table of luminances is none; names file and line.
    Luminance(&'a str),
    /// No participant's code is entered.
    NoCode,
    /// This is not a participant's code.
    NotACode(&'a str),
    /// This is not a participant's number.
    NotANumber(&'a str),
    /// There is a session under this code, to be gone on with or complete.
    Session(&'a Found),
    /// There is a session under this code that cannot be read; names file and line.
    Damaged(&'a scumble_psychophysics::Error),
    /// This is not a viewing distance.
    NotADistance(String),
    /// The participant has not agreed yet.
    NoConsent,
    /// This is not an age.
    NotAnAge(String),
}
