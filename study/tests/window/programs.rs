//! Programs beside the test: what is needed, how they end, how to wait for what they do.

use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Far longer than anything takes, on a busy machine as well.
const PATIENCE: Duration = Duration::from_secs(60);

/// A program that is killed when it is dropped.
pub struct Running(pub Child);

impl Drop for Running {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

impl Running {
    /// Starts a program and gives the first line that it prints, which says that it is ready.
    pub fn until_first_line(command: &mut Command) -> (Self, String) {
        let mut running = Self(command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap());
        let mut line = String::new();
        BufReader::new(running.0.stdout.take().unwrap()).read_line(&mut line).unwrap();
        (running, line.trim().to_owned())
    }
}

/// The program `name`. Fails with the Debian `package` to install where there is none.
pub fn program(name: &str, package: &str) -> Command {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let found = std::env::split_paths(&path).any(|folder| folder.join(name).is_file());
    assert!(found, "{}", missing(name, package));
    Command::new(name)
}

/// The first of `files` that exists. Fails with the Debian `package` to install where there is none.
pub fn file(files: impl IntoIterator<Item = PathBuf>, what: &str, package: &str) -> PathBuf {
    let found = files.into_iter().find(|file| file.is_file());
    found.unwrap_or_else(|| panic!("{}", missing(what, package)))
}

fn missing(what: &str, package: &str) -> String {
    format!(
        "this test needs {what} (Debian package {package}); `cargo xtask setup` installs everything that tests need"
    )
}

/// Asks `done` again and again until it gives something; fails with `what` after a minute.
pub fn wait_for<T>(what: &str, mut done: impl FnMut() -> Option<T>) -> T {
    let began = Instant::now();
    loop {
        if let Some(value) = done() {
            return value;
        }
        assert!(began.elapsed() < PATIENCE, "waited in vain for {what}");
        std::thread::sleep(Duration::from_millis(50));
    }
}
