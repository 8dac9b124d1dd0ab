//! A session on its way into a BIDS dataset: its labels, and what is told of it as a whole.

use std::path::{Path, PathBuf};

use scumble_psychophysics::{Demographics, Event, Role, Session};

use crate::load::LoadedSession;

/// How a session ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// After its last trial.
    Complete,
    /// Early, by the administrator.
    Stopped,
    /// Not at all: it was interrupted and not resumed, or it goes on.
    Unfinished,
}

/// A session with its place in the dataset.
#[derive(Debug, Clone)]
pub struct ExportedSession {
    /// The record.
    pub loaded: LoadedSession,
    /// The participant's label, as in `sub-p07`.
    pub participant_label: String,
    /// Place among the participant's sessions in time, from 1, as in `ses-1`; `None` in a dataset in which
    /// everyone has one session.
    pub session_number: Option<usize>,
    /// The protocol's label, as in `task-twoalternative`.
    pub task_label: String,
}

impl Status {
    /// Its word in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Complete => "complete",
            Self::Stopped => "stopped",
            Self::Unfinished => "unfinished",
        }
    }
}

impl ExportedSession {
    /// The record.
    pub fn session(&self) -> &Session {
        &self.loaded.session
    }

    /// How it ended.
    pub fn status(&self) -> Status {
        match self.session() {
            session if session.is_complete() => Status::Complete,
            session if session.is_closed() => Status::Stopped,
            _ => Status::Unfinished,
        }
    }

    /// Number of answers, practice and repeated rounds included.
    pub fn answers(&self) -> usize {
        self.session().events.iter().filter_map(Event::answered).count()
    }

    /// Number of answers that a staircase learned from and that stand.
    pub fn standing_trials(&self) -> usize {
        self.session().standing().into_iter().filter(|answered| answered.trial.role == Role::Measure).count()
    }

    /// Number of display refreshes by which pictures came later than due, over all answers.
    pub fn missed_frames(&self) -> u64 {
        let timings = self.session().events.iter().filter_map(|event| event.answered()?.timing);
        timings.map(|timing| u64::from(timing.missed_frames)).sum()
    }

    /// What the participant said about themselves.
    pub(super) fn demographics(&self) -> Option<&Demographics> {
        self.session().header.demographics.as_ref()
    }

    /// `sub-p07` or `sub-p07_ses-1`.
    pub fn name(&self) -> String {
        let number = self.session_number.map_or_else(String::new, |number| format!("_ses-{number}"));
        format!("sub-{}{number}", self.participant_label)
    }

    /// `sub-p07` or `sub-p07/ses-1`, in the dataset.
    pub(super) fn folder(&self) -> PathBuf {
        let subject = Path::new(&format!("sub-{}", self.participant_label)).to_path_buf();
        self.session_number.map_or(subject.clone(), |number| subject.join(format!("ses-{number}")))
    }

    /// `beh/sub-p07_task-twoalternative_events.tsv`, in its folder.
    pub(super) fn events_file(&self) -> String {
        format!("beh/{}_task-{}_events.tsv", self.name(), self.task_label)
    }
}
