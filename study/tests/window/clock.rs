//! A wall clock that a test sets, for one program alone.

use std::path::{Path, PathBuf};

use jiff::{SignedDuration, Timestamp};

use crate::programs;

/// The library below `/usr` that answers in the system's place when the program asks for the time.
const LIBRARY: &str = "faketime/libfaketime.so.1";

/// A program's clock: the system's, set forward or back. The clock that measures intervals goes on as ever,
/// as it does when someone sets a computer's clock.
pub struct Clock {
    offset: PathBuf,
    environment: Vec<(String, String)>,
}

impl Clock {
    /// A clock that agrees with the system's; its setting lies in `folder`.
    pub fn new(folder: &Path) -> Self {
        let offset = folder.join("clock");
        // Debian's `/usr/lib/x86_64-linux-gnu`, others' `/usr/lib64`.
        let libraries = ["/usr/lib", "/usr/lib64"].iter().flat_map(std::fs::read_dir).flatten().flatten();
        let folders = libraries.map(|entry| entry.path()).chain(["/usr/lib".into(), "/usr/lib64".into()]);
        let library = programs::file(folders.map(|folder| folder.join(LIBRARY)), LIBRARY, "libfaketime");
        let environment = [
            ("LD_PRELOAD", library.to_str().unwrap()),
            ("FAKETIME_TIMESTAMP_FILE", offset.to_str().unwrap()),
            ("FAKETIME_NO_CACHE", "1"),
            ("FAKETIME_DONT_FAKE_MONOTONIC", "1"),
            ("NO_FAKE_STAT", "1"),
        ];
        let environment = environment.map(|(name, value)| (name.to_owned(), value.to_owned())).to_vec();
        let clock = Self { offset, environment };
        clock.set(SignedDuration::ZERO);
        clock
    }

    /// Sets the clock to the system's time and `offset`; below zero is back.
    pub fn set(&self, offset: SignedDuration) {
        // Replaced as a whole: the program may read it at any time.
        let written = self.offset.with_extension("new");
        std::fs::write(&written, format!("{:+}\n", offset.as_secs())).unwrap();
        std::fs::rename(written, &self.offset).unwrap();
    }

    /// What a program that follows the clock is started with.
    pub fn environment(&self) -> Vec<(&str, &str)> {
        self.environment.iter().map(|(name, value)| (name.as_str(), value.as_str())).collect()
    }
}

#[test]
fn a_program_follows_the_clock_that_is_set_for_it() {
    let folder = tempfile::tempdir().unwrap();
    let clock = Clock::new(folder.path());
    let told = || {
        let output = programs::program("date", "coreutils").arg("+%s").envs(clock.environment()).output().unwrap();
        let secs: i64 = String::from_utf8(output.stdout).unwrap().trim().parse().unwrap();
        secs - Timestamp::now().as_second()
    };
    let hour = SignedDuration::from_hours(1);
    for offset in [SignedDuration::ZERO, -hour, hour * 24] {
        clock.set(offset);
        // A second may begin and a busy machine may take its time, but no hour passes.
        assert!((told() - offset.as_secs()).abs() < 600, "{offset}");
    }
}
