//! How the program ended, for the exit status.

use std::path::{Path, PathBuf};

/// How the program ended.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// Nobody has begun a session, or the participant did not agree to take part.
    #[default]
    NotBegun,
    /// Every trial is answered, or the administrator ended the session, and all is on disk.
    Complete { directory: PathBuf },
    /// The window was closed before.
    Interrupted { directory: PathBuf },
    /// The experiment or a picture refused to go on; in words.
    Stopped { problem: String, directory: PathBuf },
    /// The window was closed while the disk refused events: why, the lines that are not in the record, and where the
    /// whole session is.
    Unsaved { problem: String, lines: Vec<String>, directory: PathBuf, rescued_to: Option<PathBuf> },
}

impl Outcome {
    /// Where the record of a session is that is over; else what there is to say, and how to go on.
    pub(crate) fn into_result(self) -> anyhow::Result<String> {
        match self {
            Self::Complete { directory } => {
                Ok(format!("the session is over; its record is in {}", directory.display()))
            }
            Self::NotBegun => anyhow::bail!("no session was begun, and nothing is recorded"),
            Self::Interrupted { directory } => anyhow::bail!("not complete; {}", how_to_resume(&directory)),
            Self::Stopped { problem, directory } => anyhow::bail!("{problem}; {}", how_to_resume(&directory)),
            Self::Unsaved { problem, lines, directory, rescued_to } => {
                let whole = rescued_to.map_or_else(String::new, |folder| {
                    format!("the whole session is in {}, to be put in its place; ", folder.display())
                });
                let directory = directory.display();
                let lines = lines.join("\n");
                anyhow::bail!(
                    "{problem}; {whole}these lines are missing at the end of the record in {directory}:\n{lines}"
                )
            }
        }
    }
}

/// What to call to go on with the session in a folder.
fn how_to_resume(directory: &Path) -> String {
    let part = |part: Option<&Path>| part.map_or_else(String::new, |part| part.display().to_string());
    let [data, folder] = [part(directory.parent()), part(directory.file_name().map(Path::new))];
    // A folder is named by the participant's code, and a number where there were sessions before.
    let code = folder.split('.').next().unwrap_or_default();
    format!("continue with --data {data} --participant {code} --resume")
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;

    #[test]
    fn a_session_that_is_over_names_its_record_and_one_that_is_not_how_to_go_on() {
        let directory = PathBuf::from("study/p07.2");
        let over = Outcome::Complete { directory: directory.clone() }.into_result().unwrap();
        assert_eq!(over, "the session is over; its record is in study/p07.2");
        let interrupted = Outcome::Interrupted { directory }.into_result().unwrap_err().to_string();
        assert_eq!(interrupted, "not complete; continue with --data study --participant p07 --resume");
    }
}
