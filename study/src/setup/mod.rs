//! The set-up of a session: what a researcher and a participant say before the instructions.
//!
//! No window: the pages in [`crate::screen`] show a [`Setup`] and pass on what was done. It leads to a
//! [`Ready`], from which a session header is made.

mod about;
mod action;
mod calibration;
mod consent;
mod effort;
mod gamma;
mod luminance;
mod model;
mod page;
mod problem;
mod ready;
mod recent;
mod study_entry;
mod study_folder;

pub(crate) use about::About;
pub(crate) use action::SetupAction;
pub(crate) use calibration::arcmin;
pub(crate) use consent::ConsentProblem;
pub(crate) use effort::Effort;
pub(crate) use gamma::{SRGB_LEVEL, gamma, is_near_srgb};
pub(crate) use luminance::LuminanceTable;
pub(crate) use model::{Given, Setup};
pub(crate) use page::Page;
pub(crate) use problem::Problem;
pub(crate) use ready::{MeasuredDisplay, Ready};
pub(crate) use recent::RecentFolders;
pub(crate) use study_entry::OFFERED_PROTOCOLS;
pub(crate) use study_folder::{FolderProblem, StudyFolder};
