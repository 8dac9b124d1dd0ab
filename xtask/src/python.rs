//! The script for pandas in `docs`, where Python is there to run it.
//!
//! Its libraries come into an environment of their own below the target folder; nothing of the system's changes.

use crate::{packages, run};
use anyhow::{Result, bail};

/// What the script imports, in the versions that it was written with.
const LIBRARIES: [&str; 2] = ["pandas==3.1.1", "matplotlib==3.11.2"];
/// Python is `python` on Windows.
const PYTHON: &str = if cfg!(windows) { "python" } else { "python3" };

/// Runs the tests that need pandas; says in one line why not, where it cannot be had.
pub fn test() -> Result<()> {
    if let Err(reason) = provide() {
        println!("LEFT OUT: the script for pandas, whose libraries could not be installed: {reason:#}");
        return Ok(());
    }
    run::cargo(&["test", "--locked", "-p", "scumble-analysis", "--test", "python", "--", "--ignored"])
}

/// Makes `tools/python` in the target folder, where the test looks for it.
fn provide() -> Result<()> {
    if !packages::on_path(if cfg!(windows) { "python.exe" } else { PYTHON }) {
        bail!("{PYTHON} is not on the path");
    }
    let folder = run::target_directory().join("tools").join("python");
    let python = folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    if run::output(run::text(&python)?, &["-c", "import pandas, matplotlib"]).is_ok() {
        return Ok(());
    }
    println!("Installing {} into {}", LIBRARIES.join(" and "), folder.display());
    run::output(PYTHON, &["-m", "venv", "--clear", run::text(&folder)?])?;
    run::output(
        run::text(&python)?,
        &[&["-m", "pip", "install", "--quiet", "--only-binary=:all:"], &LIBRARIES[..]].concat(),
    )?;
    Ok(())
}
