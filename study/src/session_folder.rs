//! Where a participant's session goes: `DIR/CODE`, and `DIR/CODE.2` and so on behind sessions that were
//! discarded, ended early, or cut off before they had a header. A session that is complete or can be continued
//! is never passed over.

use std::path::{Path, PathBuf};

use scumble_psychophysics::{EVENTS_FILE, Error, HEADER_FILE, is_being_written, read_session};

use crate::clock::secs_between;

/// What a study's folder holds of a participant.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Found {
    /// Nothing that a fresh session could collide with; it goes here.
    Free(PathBuf),
    /// A session that can be continued.
    Interrupted(Interrupted),
    /// A complete session.
    Complete(PathBuf),
}

/// A session that can be continued.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Interrupted {
    pub(crate) directory: PathBuf,
    /// Seconds since its last event.
    pub(crate) age_secs: f64,
    /// Trials answered, and the most that the session can have, for staircases.
    pub(crate) trials: u32,
    pub(crate) trials_at_most: u32,
}

/// Looks for the sessions of a participant; errors are those of reading the last one, and that it is being written: it is
/// not interrupted then.
pub(crate) fn find(study: &Path, code: &str) -> Result<Found, Error> {
    let folder = |number: u32| match number {
        1 => study.join(code),
        _ => study.join(format!("{code}.{number}")),
    };
    let is_taken = |number: &u32| [HEADER_FILE, EVENTS_FILE].iter().any(|file| folder(*number).join(file).exists());
    let Some(last) = numbers(study, code).into_iter().filter(is_taken).max() else {
        return Ok(Found::Free(folder(1)));
    };
    let directory = folder(last);
    let session = match read_session(&directory) {
        Err(error @ Error::NeverBegan { .. }) => {
            eprintln!("scumble-study: {error}; it is left as it is");
            return Ok(Found::Free(folder(last + 1)));
        }
        read => read?,
    };
    if session.is_complete() {
        return Ok(Found::Complete(directory));
    }
    if session.is_closed() {
        return Ok(Found::Free(folder(last + 1)));
    }
    if is_being_written(&directory) {
        return Err(Error::SessionInUse(directory));
    }
    let progress = session.replay()?.progress();
    let age_secs = secs_between(session.last_known_at(), jiff::Timestamp::now());
    let (trials, trials_at_most) = (progress.trials, progress.trials_at_most);
    Ok(Found::Interrupted(Interrupted { directory, age_secs, trials, trials_at_most }))
}

/// The numbers of the folders that bear a participant's code; a gap among them hides none.
fn numbers(study: &Path, code: &str) -> Vec<u32> {
    let number = |name: &str| match name.strip_prefix(code)? {
        "" => Some(1),
        behind => behind.strip_prefix('.')?.parse().ok(),
    };
    let entries = std::fs::read_dir(study).into_iter().flatten().flatten();
    entries.filter_map(|entry| number(entry.file_name().to_str()?)).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;
    use crate::setup::StudyFolder;
    use crate::sitting::{Sitting, discard};
    use jiff::Timestamp;
    use scumble_psychophysics::{SessionHeader, Software};

    /// A session that begins in the folder that is free for it.
    fn begin(study: &Path) -> (PathBuf, Sitting) {
        let Found::Free(directory) = find(study, "p07").unwrap() else { panic!("the folder is taken") };
        let folder = StudyFolder::open(study, None).unwrap();
        let protocol = folder.protocol().clone();
        let header = SessionHeader::new("p07", protocol, 1, Timestamp::now(), Software::of("a test", "0"));
        let mut sitting = Sitting::fresh(folder, &directory, header).unwrap();
        sitting.proceed(|| None).unwrap();
        (directory, sitting)
    }

    #[test]
    fn a_fresh_session_goes_behind_discarded_and_stopped_ones_and_never_over_one_that_counts() {
        let root = tempfile::tempdir().unwrap();
        let study = root.path().join("study");
        let (first, sitting) = begin(&study);
        assert_eq!(first, study.join("p07"));
        drop(sitting);
        let Found::Interrupted(found) = find(&study, "p07").unwrap() else { panic!("it can be continued") };
        assert_eq!((found.directory.as_path(), found.trials), (first.as_path(), 0));
        assert!(found.age_secs >= 0.0 && found.trials_at_most > 100);

        discard(&first).unwrap();
        let (second, mut sitting) = begin(&study);
        assert_eq!(second, study.join("p07.2"));
        let refused = find(&study, "p07").unwrap_err();
        assert!(matches!(refused, Error::SessionInUse(_)), "nobody is told that a running session was interrupted");
        sitting.stop();
        let (third, mut sitting) = begin(&study);
        assert_eq!(third, study.join("p07.3"));
        assert!(discard(&third).is_err(), "it is being written");
        sitting.stop();
        assert_eq!(find(&study, "p08").unwrap(), Found::Free(study.join("p08")));
    }

    #[test]
    fn a_crash_before_the_first_answer_leaves_a_session_that_goes_on_or_a_header_that_is_passed_over() {
        let root = tempfile::tempdir().unwrap();
        let (directory, sitting) = begin(root.path());
        drop(sitting);
        std::fs::remove_file(directory.join(EVENTS_FILE)).unwrap();
        let Found::Interrupted(found) = find(root.path(), "p07").unwrap() else { panic!("it can be continued") };
        assert_eq!(found.trials, 0);

        let header = directory.join(HEADER_FILE);
        let whole = std::fs::read(&header).unwrap();
        for bytes in [0, 1, whole.len() / 2, whole.len() - 3] {
            std::fs::write(&header, &whole[..bytes]).unwrap();
            assert_eq!(find(root.path(), "p07").unwrap(), Found::Free(root.path().join("p07.2")), "{bytes} bytes");
            assert_eq!(std::fs::read(&header).unwrap(), &whole[..bytes]);
        }
        // Beside events it is damage, and nothing that may be passed over.
        std::fs::write(directory.join(EVENTS_FILE), "").unwrap();
        assert!(find(root.path(), "p07").is_err());
    }
}
