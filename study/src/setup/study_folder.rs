//! The folder of a study: the sessions of its participants and the one protocol that they all get.
//!
//! ```text
//! study1/protocol.toml     copied there when the first session begins, and never overwritten
//! study1/p01/              a session
//! study1/p02/
//! ```

use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use scumble_psychophysics::Protocol;

use crate::words;

/// Name of the protocol's file in the folder of a study.
pub(super) const PROTOCOL_FILE: &str = "protocol.toml";

/// The protocol of a new study for which none was asked.
pub(super) const DEFAULT_PROTOCOL: &str = "two-alternative";

/// A study on disk, or one that is on disk once its first session begins.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct StudyFolder {
    directory: PathBuf,
    protocol: Protocol,
    /// What the file of the protocol will hold; `None` where the file is there.
    unkept: Option<Vec<u8>>,
}

/// Why a folder cannot be the folder of a study. [`std::fmt::Display`] says it in English.
#[derive(Debug)]
pub(crate) enum FolderProblem {
    /// Something else than a folder has this path.
    NotAFolder(PathBuf),
    /// The system refused to make or to write this file or folder.
    NotWritable { path: PathBuf, reason: std::io::Error },
    /// The protocol cannot be read; names the file, the line and what is allowed.
    Protocol(scumble_psychophysics::Error),
    /// The study has another protocol than the one asked for.
    Differs {
        /// The study's protocol.
        file: PathBuf,
        /// Its name.
        name: String,
        /// The protocol asked for, as it was written.
        asked: String,
        /// Its name.
        asked_name: String,
    },
}

impl StudyFolder {
    /// The study of a folder. Nothing is written.
    ///
    /// The protocol is the one that the folder holds. A folder without one, and one that is not there
    /// yet, gets the protocol that is asked for, `DEFAULT_PROTOCOL` where none is: the name of a shipped
    /// one, or a file that ends in `.toml`.
    ///
    /// Errors: a path that is no folder, a protocol that cannot be read, and a protocol asked for that
    /// differs in any parameter from the one that the folder holds.
    pub(crate) fn open(directory: &Path, asked: Option<&str>) -> Result<Self, FolderProblem> {
        if directory.exists() && !directory.is_dir() {
            return Err(FolderProblem::NotAFolder(directory.into()));
        }
        let file = directory.join(PROTOCOL_FILE);
        let directory = directory.to_path_buf();
        let Some(protocol) = kept(&file)? else {
            let asked = asked.unwrap_or(DEFAULT_PROTOCOL);
            let (protocol, text) = Protocol::open_with_text(asked).map_err(FolderProblem::Protocol)?;
            return Ok(Self { directory, protocol, unkept: Some(text) });
        };
        if let Some(asked) = asked {
            refuse_another(&file, &protocol, asked, &Protocol::open(asked).map_err(FolderProblem::Protocol)?)?;
        }
        Ok(Self { directory, protocol, unkept: None })
    }

    /// The folder.
    pub(crate) fn directory(&self) -> &Path {
        &self.directory
    }

    /// What every participant of the study gets.
    pub(crate) fn protocol(&self) -> &Protocol {
        &self.protocol
    }

    /// Whether the folder holds no protocol yet, so that another one may still be asked for.
    pub(crate) fn is_new(&self) -> bool {
        self.unkept.is_some()
    }

    /// Whether the system lets a session be written here: makes a file in the folder, or in the nearest one
    /// above that is there, and removes it again.
    pub(super) fn probe(&self) -> Result<(), FolderProblem> {
        let directory = std::path::absolute(&self.directory).unwrap_or_else(|_| self.directory.clone());
        let there = directory.ancestors().find(|folder| folder.exists()).unwrap_or(&directory);
        let file = there.join(format!(".scumble-study-{}", std::process::id()));
        match std::fs::File::create_new(&file).and_then(|_| std::fs::remove_file(&file)) {
            // One that is there could be made.
            Err(error) if error.kind() == ErrorKind::AlreadyExists => Ok(()),
            probed => probed.map_err(|reason| FolderProblem::NotWritable { path: there.into(), reason }),
        }
    }

    /// Makes the folder and puts the protocol into it, for every later participant; does nothing where
    /// it lies there already. To be called when a session begins.
    ///
    /// Errors: what the system refuses, and another protocol that has come there in the meantime.
    pub(crate) fn keep_protocol(&self) -> Result<(), FolderProblem> {
        let Some(text) = &self.unkept else { return Ok(()) };
        let refused = |path: &Path| {
            let path = path.to_path_buf();
            move |reason| FolderProblem::NotWritable { path, reason }
        };
        std::fs::create_dir_all(&self.directory).map_err(refused(&self.directory))?;
        let file = self.directory.join(PROTOCOL_FILE);
        if let Some(protocol) = kept(&file)? {
            return refuse_another(&file, &protocol, &self.protocol.name, &self.protocol);
        }
        let mut opened = std::fs::File::create_new(&file).map_err(refused(&file))?;
        opened.write_all(text).and_then(|()| opened.sync_all()).map_err(|reason| {
            // Half a protocol would stand in the way of every later participant.
            let _ = std::fs::remove_file(&file);
            refused(&file)(reason)
        })
    }
}

/// The protocol of a file, `None` where there is no file.
fn kept(file: &Path) -> Result<Option<Protocol>, FolderProblem> {
    match std::fs::read(file) {
        Ok(text) => Protocol::from_toml(file, text).map(Some).map_err(FolderProblem::Protocol),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(reason) => Err(FolderProblem::Protocol(scumble_psychophysics::Error::Io { path: file.into(), reason })),
    }
}

fn refuse_another(file: &Path, kept: &Protocol, asked: &str, protocol: &Protocol) -> Result<(), FolderProblem> {
    if kept == protocol {
        return Ok(());
    }
    let (name, asked_name) = (kept.name.clone(), protocol.name.clone());
    Err(FolderProblem::Differs { file: file.into(), name, asked: asked.into(), asked_name })
}

impl std::fmt::Display for FolderProblem {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&(words::words(scumble_psychophysics::Language::English).setup.folder_problem)(self))
    }
}

impl std::error::Error for FolderProblem {}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder() -> tempfile::TempDir {
        tempfile::tempdir().unwrap()
    }

    #[test]
    fn a_folder_without_a_protocol_gets_two_alternatives_where_none_is_asked_for() {
        let folder = folder();
        let study = StudyFolder::open(folder.path(), None).unwrap();
        assert_eq!(study.protocol(), &Protocol::two_alternative());
        assert!(study.is_new());
        assert_eq!(study.directory(), folder.path());
    }

    #[test]
    fn opening_writes_nothing_and_keeping_writes_the_file_with_its_comments() {
        let folder = folder();
        let directory = folder.path().join("new/study");
        let study = StudyFolder::open(&directory, Some("yes-no")).unwrap();
        assert!(!directory.exists());

        study.keep_protocol().unwrap();
        let text = std::fs::read_to_string(directory.join(PROTOCOL_FILE)).unwrap();
        assert!(text.starts_with('#'), "{text}");
        for asked in [None, Some("yes-no")] {
            let again = StudyFolder::open(&directory, asked).unwrap();
            assert_eq!(again.protocol(), &Protocol::named("yes-no").unwrap());
            assert!(!again.is_new());
            again.keep_protocol().unwrap();
        }
    }

    #[test]
    fn a_protocol_file_of_ones_own_is_copied_byte_for_byte() {
        let folder = folder();
        let own = folder.path().join("own.toml");
        let text = format!("# ours\n{}", Protocol::two_alternative().to_toml().unwrap().replace("36", "20"));
        std::fs::write(&own, &text).unwrap();
        let study = StudyFolder::open(&folder.path().join("study"), own.to_str()).unwrap();
        study.keep_protocol().unwrap();
        assert_eq!(study.protocol().schedule.trials_max, 20);
        assert_eq!(std::fs::read_to_string(study.directory().join(PROTOCOL_FILE)).unwrap(), text);
    }

    #[test]
    fn another_protocol_than_the_studys_is_refused_with_both_names_and_what_to_do() {
        let folder = folder();
        StudyFolder::open(folder.path(), Some("yes-no")).unwrap().keep_protocol().unwrap();
        let problem = StudyFolder::open(folder.path(), Some("published")).unwrap_err().to_string();
        for part in ["protocol.toml", "\"yes-no\"", "--protocol published", "\"published\"", "leave --protocol out"] {
            assert!(problem.contains(part), "{part}: {problem}");
        }
    }

    #[test]
    fn a_protocol_that_came_in_the_meantime_is_neither_overwritten_nor_overlooked() {
        let folder = folder();
        let [first, second, third] =
            ["yes-no", "published", "yes-no"].map(|name| StudyFolder::open(folder.path(), Some(name)).unwrap());
        first.keep_protocol().unwrap();
        assert!(matches!(second.keep_protocol(), Err(FolderProblem::Differs { .. })));
        third.keep_protocol().unwrap();
        assert_eq!(StudyFolder::open(folder.path(), None).unwrap().protocol().name, "yes-no");
    }

    #[test]
    fn a_damaged_protocol_is_named_with_its_line_and_what_is_allowed() {
        let folder = folder();
        let text = Protocol::two_alternative().to_toml().unwrap().replace("trials_max = 36", "trials_max = 0");
        std::fs::write(folder.path().join(PROTOCOL_FILE), text).unwrap();
        let problem = StudyFolder::open(folder.path(), None).unwrap_err().to_string();
        assert!(problem.contains("protocol.toml:") && problem.contains("allowed is"), "{problem}");
    }

    #[test]
    fn a_file_is_no_folder_and_an_unknown_protocol_lists_the_known_ones() {
        let folder = folder();
        let file = folder.path().join("file");
        std::fs::write(&file, "").unwrap();
        let problem = StudyFolder::open(&file, None).unwrap_err().to_string();
        assert!(problem.contains("file") && problem.contains("allowed is a folder"), "{problem}");
        let problem = StudyFolder::open(folder.path(), Some("guess")).unwrap_err().to_string();
        assert!(problem.contains("two-alternative"), "{problem}");
        let inside = StudyFolder::open(&file.join("study"), None).and_then(|study| study.keep_protocol());
        assert!(inside.is_err());
    }

    #[test]
    fn a_folder_that_cannot_be_made_is_found_before_anybody_begins() {
        let folder = folder();
        let new = folder.path().join("new/study");
        StudyFolder::open(&new, None).unwrap().probe().unwrap();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "nothing is left behind");

        std::fs::write(folder.path().join("file"), "").unwrap();
        let inside = StudyFolder::open(&folder.path().join("file/study"), None);
        let problem = inside.and_then(|study| study.probe()).unwrap_err().to_string();
        assert!(problem.contains("file"), "{problem}");
    }
}
