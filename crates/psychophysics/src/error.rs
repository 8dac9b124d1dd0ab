//! What can be wrong with a protocol, a response, or a session on disk.

use std::path::PathBuf;

use crate::complaint::quoted;

/// Most characters of a number that is written out: 17 digits, point, sign and some zeros.
const NUMBER_LENGTH_MAX: usize = 24;

/// The errors of this crate: each says what was found and what is allowed.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A parameter is out of its range.
    #[error("{field} is {value}; allowed is {allowed}")]
    Parameter {
        /// The parameter's name as in the file or the struct.
        field: String,
        /// The value found.
        value: String,
        /// The range that is allowed, in words.
        allowed: &'static str,
    },
    /// A response that the psychometric function gives probability zero at every threshold.
    #[error(
        "response {response} at intensity {intensity} has probability 0 at every tabulated threshold; allowed is a delta above 0, which lets a person slip"
    )]
    ImpossibleResponse {
        /// Intensity shown.
        intensity: f64,
        /// The response.
        response: bool,
    },
    /// A call that the stage of the experiment does not take.
    #[error("{call} at the stage {stage}; allowed is {allowed}")]
    Stage {
        /// The call.
        call: &'static str,
        /// Name of the current stage.
        stage: &'static str,
        /// The stages at which the call is allowed.
        allowed: &'static str,
    },
    /// Recorded events that the recorded seed and protocol do not lead to.
    #[error("event {}: {found}; allowed is {allowed}", index + 1)]
    Replay {
        /// Place in the list of events, from 0.
        index: usize,
        /// What the record says.
        found: String,
        /// What the seed and the protocol lead to.
        allowed: String,
    },
    /// A file of a session whose content is damaged.
    #[error("{}:{line}: {found}; allowed is {allowed}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// What was found there.
        found: String,
        /// What is allowed there.
        allowed: String,
    },
    /// A session's header that was cut off before its events had a file: nothing was ever answered.
    #[error(
        "{}: the header ends after {bytes} bytes and there are no events, so that nothing was ever answered and the folder can go; allowed is a whole header",
        path.display()
    )]
    NeverBegan {
        /// The header's file.
        path: PathBuf,
        /// Its length in bytes.
        bytes: usize,
    },
    /// A session that must not be overwritten.
    #[error("{} exists; allowed is a directory without a session", .0.display())]
    SessionExists(PathBuf),
    /// A session that another program is writing.
    #[error("{} is being written by another program; allowed is one writer", .0.display())]
    SessionInUse(PathBuf),
    /// A picture that cannot be drawn.
    #[error("{0}")]
    Picture(scumble_stimuli::Error),
    /// The operating system refused a file.
    #[error("{}: {reason}", path.display())]
    Io {
        /// The file or directory.
        path: PathBuf,
        /// The system's reason.
        reason: std::io::Error,
    },
}

impl Error {
    /// A parameter out of its range.
    pub(crate) fn parameter(field: impl Into<String>, value: impl std::fmt::Display, allowed: &'static str) -> Self {
        let value = value.to_string();
        // 1e308 is a number that everyone can read, its 309 digits are none.
        let value = match value.parse::<f64>() {
            Ok(number) if value.len() > NUMBER_LENGTH_MAX => format!("{number:e}"),
            _ => quoted(&value),
        };
        Self::Parameter { field: field.into(), value, allowed }
    }

    /// A parameter's error under the name that it has in a protocol's table.
    pub(crate) fn in_table(table: &str) -> impl FnOnce(Self) -> Self {
        move |error| match error {
            Self::Parameter { field, value, allowed } => {
                Self::Parameter { field: format!("{table}.{field}"), value, allowed }
            }
            other => other,
        }
    }

    /// The system's refusal of `path`.
    pub(crate) fn io(path: impl Into<PathBuf>) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.into();
        move |reason| Self::Io { path, reason }
    }
}

/// `Ok` when `good`, else the error that names the field.
pub(crate) fn require(
    good: bool,
    field: &str,
    value: impl std::fmt::Display,
    allowed: &'static str,
) -> Result<(), Error> {
    if good { Ok(()) } else { Err(Error::parameter(field, value, allowed)) }
}
