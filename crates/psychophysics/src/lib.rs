//! The experiment of Kreuzer 2017, chapter 4, without pictures, window and clock.
//!
//! A participant sees two pictures of the same shadow edge under the same filter. One was made from
//! the straight edge, the other from the edge as a shadow map stores it, with its steps. "Which one
//! was the line?" The larger the filter's radius in texels, the *ratio*, the harder the question;
//! the threshold is the ratio at which 82 % of the answers are right.
//!
//! | Part | Is |
//! |---|---|
//! | [`Quest`] | the Bayesian staircase that chooses each radius, equal to Psychtoolbox's to 1e-9 |
//! | [`Protocol`] | every parameter of a session, with units; three come with the crate |
//! | [`Experiment`] | the state machine: what to show, what an answer leads to |
//! | [`SessionWriter`], [`read_session`] | the record: one line an event, on disk before the next picture |
//! | [`WeibullObserver`], [`Population`] | simulated people whose thresholds are known |
//!
//! QUEST's intensity is `x = log10(texel / radius) = -log10(ratio)`: a larger x is easier, as the
//! psychometric function wants it. A response of 1 means "correct".
//!
//! ```
//! use scumble_psychophysics::{Experiment, ObserverParameters, Protocol, WeibullObserver, rehearse};
//!
//! let person = WeibullObserver::new(ObserverParameters::default(), 1)?;
//! let mut experiment = Experiment::new(Protocol::two_alternative(), 2, 0)?;
//! let events = rehearse(&mut experiment, &person)?;
//! assert_eq!(events.len(), 8 + experiment.progress().trials as usize);
//! assert!(experiment.tracks().iter().all(|track| track.trials() >= 10));
//! # Ok::<(), scumble_psychophysics::Error>(())
//! ```
//!
//! It does not fit a relation to sessions; that is the analysis. QUEST's estimate steers the session
//! and is a diagnostic, not the result of a study.

mod complaint;
mod convergence;
mod draw;
mod error;
mod event;
mod event_line;
mod experiment;
mod grid;
mod header;
mod header_file;
mod latin_square;
mod likelihood;
mod observer;
mod picture;
mod population;
mod posterior;
mod protocol;
mod protocol_check;
mod protocol_file;
mod psychometric;
mod quest;
mod quest_config;
mod quest_plus;
mod read;
mod record;
mod rehearse;
mod replay;
mod staircase;
mod staircase_config;
mod summary;
mod text;
mod timetable;
mod track;
mod trial;

pub use convergence::{Convergence, Reason, Verdict};
pub use error::Error;
pub use event::{Answered, Event, Moment, Reply};
pub use experiment::{Experiment, Progress, Stage};
pub use grid::Shown;
pub use header::{Display, Luminance, SESSION_SCHEMA, SessionHeader, Software};
pub use observer::{ObserverParameters, WeibullObserver};
pub use population::Population;
pub use protocol::{
    CatchTrials, Conditions, LineTrials, Order, PictureRules, Practice, Protocol, Round, Schedule, Task,
};
pub use psychometric::Psychometric;
pub use quest::Quest;
pub use quest_config::{PlacementRule, QuestConfig};
pub use quest_plus::{QuestPlus, QuestPlusConfig};
pub use read::{Session, read_session};
pub use record::{EVENTS_FILE, HEADER_FILE, SessionWriter};
pub use rehearse::rehearse;
pub use staircase::Staircase;
pub use staircase_config::{StaircaseConfig, StaircaseMethod};
pub use summary::QuestSummary;
pub use track::{Estimate, Track};
pub use trial::{Answer, Condition, Pictures, Role, Trial};
