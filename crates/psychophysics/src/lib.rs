//! The experiment of Kreuzer 2017, chapter 4, without pictures, window and clock.
//!
//! A participant sees two pictures of the same shadow edge under the same filter. One was made from
//! the straight edge, the other from the edge as a shadow map stores it, with its steps. "Which one
//! was the line?" The larger the filter's radius in texels, the *ratio*, the harder the question;
//! the threshold is the ratio at which 82 % of the answers are right.
//!
//! | Part | Is |
//! |---|---|
//! | [`Staircase`] | chooses each radius: [`Quest`], equal to Psychtoolbox's to 1e-9, or [`QuestPlus`], after Watson 2017 |
//! | [`Convergence`] | when a staircase is done, and why not |
//! | [`BetaPosterior`] | whether the responses fit the slope that QUEST assumed |
//! | [`Protocol`] | every parameter of a session, with units; three come with the crate |
//! | [`Experiment`] | the state machine: what to show, what an answer leads to |
//! | [`SessionWriter`], [`read_session`] | the record: one line an event, on disk before the next picture |
//! | [`standing`] | the answers that count, as a round may be repeated |
//! | [`Observer`], [`Cohort`] | simulated people, of three kinds, to rehearse with |
//! | [`YesNoReport`] | hits, false alarms, d' and criterion of single pictures |
//!
//! QUEST's intensity is `x = log10(texel / radius) = -log10(ratio)`: a larger x is easier, as the
//! psychometric function wants it. A response of 1 means "correct".
//!
//! ```
//! use scumble_psychophysics::{Experiment, Observer, ObserverModel, Protocol, rehearse};
//!
//! let person = Observer::new(ObserverModel::default(), 1)?;
//! let mut experiment = Experiment::new(Protocol::two_alternative(), 2, 0)?;
//! let events = rehearse(&mut experiment, &person)?;
//! assert_eq!(events.len(), 8 + experiment.progress().trials as usize);
//! assert!(experiment.tracks().iter().all(|track| track.trials() >= 10));
//! # Ok::<(), scumble_psychophysics::Error>(())
//! ```
//!
//! It does not fit a relation to sessions; that is the analysis. QUEST's estimate steers the session
//! and is a diagnostic, not the result of a study.

mod beta_posterior;
mod cohort;
mod complaint;
mod contour;
mod convergence;
mod demographics;
mod display;
mod draw;
mod error;
mod event;
mod event_line;
mod exclusions;
mod experiment;
mod fatigue;
mod grid;
mod header;
mod header_file;
mod image_observer;
mod language;
mod latin_square;
mod likelihood;
mod normal;
mod observer;
mod picture;
mod posterior;
mod progress;
mod protocol;
mod protocol_check;
mod protocol_file;
mod psychometric;
mod quest;
mod quest_config;
mod quest_plus;
mod read;
mod record;
mod recover;
mod rehearse;
mod replay;
mod signal_detection_observer;
mod stage;
mod staircase;
mod staircase_config;
mod standing;
mod summary;
mod text;
mod thresholds;
mod timetable;
mod track;
mod trial;
mod weibull_observer;
mod yes_no;

pub use beta_posterior::{BetaPosterior, BetaRow};
pub use cohort::Cohort;
pub use contour::Contour;
pub use convergence::{Convergence, Reason, Verdict};
pub use demographics::{Demographics, Experience, Gender, Handedness, Vision};
pub use display::Display;
pub use error::Error;
pub use event::{Answered, Event, Moment, Reply, Timing};
pub use exclusions::Exclusions;
pub use experiment::Experiment;
pub use fatigue::Fatigue;
pub use grid::Shown;
pub use header::{Consent, SESSION_SCHEMA, SessionHeader, Software};
pub use image_observer::ImageObserver;
pub use language::Language;
pub use observer::{Observer, ObserverModel};
pub use progress::Progress;
pub use protocol::{
    CatchTrials, Conditions, LineTrials, Order, PictureRules, Practice, Protocol, Round, Schedule, Task,
};
pub use psychometric::Psychometric;
pub use quest::Quest;
pub use quest_config::{PlacementRule, QuestConfig};
pub use quest_plus::{QuestPlus, QuestPlusConfig};
pub use read::{Session, read_session};
pub use record::{EVENTS_FILE, HEADER_FILE, SessionWriter, is_being_written};
pub use rehearse::rehearse;
pub use signal_detection_observer::{EXPONENT_OF_SLOPE_3_5, SignalDetectionObserver};
pub use stage::Stage;
pub use staircase::Staircase;
pub use staircase_config::{StaircaseConfig, StaircaseMethod};
pub use standing::standing;
pub use summary::QuestSummary;
pub use thresholds::{THRESHOLD_PROBABILITY, Thresholds};
pub use track::{Estimate, Track};
pub use trial::{Answer, Condition, Pictures, Role, Trial};
pub use weibull_observer::WeibullObserver;
pub use yes_no::{YesNoCounts, YesNoReport, YesNoStatistics};
