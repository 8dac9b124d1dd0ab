//! The folders of studies that were open before, newest first, in the user's configuration.
//!
//! A convenience: what cannot be read counts as empty, and what cannot be written is not written.

use std::path::{Path, PathBuf};

/// Most folders that are remembered: one a number key, with one to spare.
const MOST: usize = 8;

/// The list and where it is kept.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct RecentFolders {
    file: Option<PathBuf>,
    folders: Vec<PathBuf>,
}

impl RecentFolders {
    /// The list of this user: `scumble/recent-studies.json` in the folder that the system has for
    /// configurations, which on Linux `$XDG_CONFIG_HOME` names.
    pub(crate) fn of_user() -> Self {
        dirs::config_dir()
            .map_or_else(Self::default, |folder| Self::of_file(folder.join("scumble/recent-studies.json")))
    }

    /// The list in a file.
    pub(crate) fn of_file(file: PathBuf) -> Self {
        let read = std::fs::read(&file).ok().and_then(|text| serde_json::from_slice::<Vec<PathBuf>>(&text).ok());
        Self { file: Some(file), folders: read.unwrap_or_default() }
    }

    /// The folders that are there, newest first, at most 8.
    pub(crate) fn offered(&self) -> Vec<PathBuf> {
        self.folders.iter().filter(|folder| folder.is_dir()).take(MOST).cloned().collect()
    }

    /// Puts a folder first and writes the list where that is possible. To be called when a session begins.
    pub(crate) fn remember(&mut self, folder: &Path) {
        self.remember_as(&std::path::absolute(folder).unwrap_or_else(|_| folder.into()));
        if let Some(file) = &self.file {
            let _ = write(file, &self.folders);
        }
    }

    /// Puts a folder first as it is written, in memory alone.
    pub(crate) fn remember_as(&mut self, folder: &Path) {
        self.folders.retain(|known| known != folder);
        self.folders.insert(0, folder.into());
        self.folders.truncate(MOST);
    }
}

fn write(file: &Path, folders: &[PathBuf]) -> std::io::Result<()> {
    if let Some(parent) = file.parent() {
        std::fs::create_dir_all(parent)?;
    }
    std::fs::write(file, serde_json::to_vec_pretty(folders)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_comes_first_once_and_at_most_8_are_kept() {
        let home = tempfile::tempdir().unwrap();
        let file = home.path().join("config/scumble/recent-studies.json");
        let folders: Vec<PathBuf> = (0..10).map(|number| home.path().join(format!("study{number}"))).collect();
        for folder in &folders {
            std::fs::create_dir(folder).unwrap();
            RecentFolders::of_file(file.clone()).remember(folder);
        }
        RecentFolders::of_file(file.clone()).remember(&folders[5]);
        let newest_first = [5, 9, 8, 7, 6, 4, 3, 2].map(|number| folders[number].clone());
        assert_eq!(RecentFolders::of_file(file).offered(), newest_first);
    }

    #[test]
    fn a_folder_that_is_gone_is_not_offered() {
        let home = tempfile::tempdir().unwrap();
        let mut recent = RecentFolders::of_file(home.path().join("list"));
        recent.remember(&home.path().join("gone"));
        recent.remember(home.path());
        assert_eq!(recent.offered(), [home.path()]);
    }

    #[test]
    fn a_list_that_cannot_be_read_or_written_is_no_error() {
        let home = tempfile::tempdir().unwrap();
        let damaged = home.path().join("damaged");
        std::fs::write(&damaged, "[1").unwrap();
        assert_eq!(RecentFolders::of_file(damaged.clone()).offered(), Vec::<PathBuf>::new());
        let mut below_a_file = RecentFolders::of_file(damaged.join("list"));
        below_a_file.remember(home.path());
        assert_eq!(below_a_file.offered(), [home.path()]);
        assert!(RecentFolders::default().offered().is_empty());
    }
}
