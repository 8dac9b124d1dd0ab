//! What can go wrong, said with the file, the place and what is allowed.

use std::path::PathBuf;

use thiserror::Error;

/// Why data do not carry a psychometric function.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum Unidentified {
    /// No trial.
    #[error("there is no answer")]
    NoAnswers,
    /// Every answer was correct.
    #[error("all {total} answers were correct: nothing that was shown was hard enough to reach the threshold")]
    AllCorrect {
        /// Number of answers.
        total: f64,
    },
    /// No answer was correct.
    #[error("all {total} answers were wrong: nothing that was shown was easy enough to reach the threshold")]
    AllWrong {
        /// Number of answers.
        total: f64,
    },
    /// A slope needs at least two intensities.
    #[error("all answers are at one level: a slope needs at least two")]
    OneLevel,
    /// The answers agree with a threshold arbitrarily far below the data.
    #[error("the answers do not bound the threshold: they also fit an observer who sees everything")]
    NoLowerBound,
    /// The answers agree with a threshold arbitrarily far above the data.
    #[error("the answers do not bound the threshold: they also fit an observer who guesses")]
    NoUpperBound,
    /// The answers agree with a slope at an end of its range: a jump, or no dependence on the level.
    #[error("the answers do not bound the slope: they also fit one of {slope} per decade")]
    Slope {
        /// That end.
        slope: f64,
    },
    /// A count is none.
    #[error(
        "{correct} of {total} correct at intensity {x} is no count; allowed is a finite intensity and 0 <= correct <= total"
    )]
    Count {
        /// Intensity.
        x: f64,
        /// Correct answers.
        correct: f64,
        /// Answers.
        total: f64,
    },
    /// Guess and lapse rate leave no room for a function.
    #[error("the guess rate is {guess} and the lapse rate up to {lapse}; allowed is at least 0 each, together below 1")]
    Rates {
        /// Guess rate.
        guess: f64,
        /// Largest lapse rate.
        lapse: f64,
    },
    /// The given slope is none.
    #[error("the slope is {slope} per decade; allowed is a finite number above 0")]
    SlopeRange {
        /// The slope.
        slope: f64,
    },
    /// Every function gives the answers probability 0.
    #[error("no function makes such answers possible; allowed is a guess or lapse rate above 0")]
    Impossible,
    /// The information matrix is singular.
    #[error("the likelihood is flat: its parameters cannot be told apart")]
    FlatLikelihood,
}

/// Errors of the analysis.
#[derive(Debug, Error)]
pub enum Error {
    /// A file or a folder could not be read or written.
    #[error("{}: {reason}", path.display())]
    Io {
        /// File or folder.
        path: PathBuf,
        /// The system's reason.
        reason: std::io::Error,
    },
    /// A table has a wrong cell, row or header.
    #[error("{}: line {line}: {reason}", path.display())]
    Table {
        /// The table.
        path: PathBuf,
        /// Line, counted from 1; the header is line 1.
        line: u64,
        /// What was found and what is allowed.
        reason: String,
    },
    /// A file or folder is not what it has to be.
    #[error("{}: {reason}", path.display())]
    File {
        /// File or folder.
        path: PathBuf,
        /// What was found and what is allowed.
        reason: String,
    },
    /// A value given by the caller is not allowed.
    #[error("{name} is {value}; allowed is {allowed}")]
    Argument {
        /// Name of the option.
        name: &'static str,
        /// What was given.
        value: String,
        /// What is allowed.
        allowed: &'static str,
    },
    /// The data are readable and do not carry the fit.
    #[error("the data cannot carry a fit: {0}")]
    CannotFit(String),
    /// The data do not carry a relation, and what they do carry was written.
    #[error("the data cannot carry a fit: {reason}; {next}; {} has what they carry, and no relation", report.display())]
    Pilot {
        /// Why there is no relation.
        reason: String,
        /// What to do next.
        next: &'static str,
        /// The report.
        report: PathBuf,
    },
    /// There is no session to make a dataset of.
    #[error("nothing to export: {0}")]
    CannotExport(String),
    /// The protocol cannot measure what is expected.
    #[error("the protocol cannot measure the answer: {0}")]
    CannotPlan(String),
    /// A figure could not be drawn.
    #[error("the figure {figure} could not be drawn: {reason}")]
    Figure {
        /// Its file name.
        figure: &'static str,
        /// The plotting library's reason.
        reason: String,
    },
    /// A part of the study refused: configuration, session or experiment.
    #[error(transparent)]
    Psychophysics(#[from] scumble_psychophysics::Error),
    /// The relation is not one a renderer may use.
    #[error(transparent)]
    Relation(#[from] scumble_core::Error),
}

impl Error {
    /// Names the file in an input or output error.
    pub(crate) fn io(path: &std::path::Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_path_buf();
        move |reason| Self::Io { path, reason }
    }
}
