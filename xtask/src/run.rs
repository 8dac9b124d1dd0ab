//! Child processes: their commands are shown, their failure is an error that repeats the command.

use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Without it Mesa complains of a missing `XDG_RUNTIME_DIR` wherever there is no desktop.
pub const QUIET: [(&str, &str); 1] = [("NODEVICE_SELECT", "1")];

/// Runs a program with its output on this terminal.
pub fn visibly(program: &str, arguments: &[&str]) -> Result<()> {
    let line = format!("{program} {}", arguments.join(" "));
    println!("$ {line}");
    let status = Command::new(program)
        .args(arguments)
        .current_dir(workspace())
        .env("DEBIAN_FRONTEND", "noninteractive")
        .envs(QUIET)
        .status()
        .with_context(|| format!("could not start `{line}`"))?;
    if !status.success() {
        bail!("`{line}` ended with {status}");
    }
    Ok(())
}

/// What a program prints, as text.
pub fn output(program: &str, arguments: &[&str]) -> Result<String> {
    let line = format!("{program} {}", arguments.join(" "));
    let output = Command::new(program)
        .args(arguments)
        .current_dir(workspace())
        .output()
        .with_context(|| format!("could not start `{line}`"))?;
    if !output.status.success() {
        bail!("`{line}` ended with {}", output.status);
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Runs the cargo that runs this program.
pub fn cargo(arguments: &[&str]) -> Result<()> {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".into());
    visibly(&cargo, arguments)
}

/// Runs a program of this workspace's release build.
pub fn program(name: &str, arguments: &[&str]) -> Result<()> {
    let mut file = target_directory().join("release").join(name);
    file.set_extension(std::env::consts::EXE_EXTENSION);
    let status = Command::new(&file)
        .args(arguments)
        .current_dir(workspace())
        .envs(QUIET)
        .status()
        .with_context(|| format!("could not start {}", file.display()))?;
    anyhow::ensure!(status.success(), "`{name} {}` ended with {status}", arguments.join(" "));
    Ok(())
}

/// A path as an argument of a program.
pub fn text(path: &Path) -> Result<&str> {
    path.to_str().with_context(|| format!("{} is not valid Unicode", path.display()))
}

/// The workspace's root folder.
pub fn workspace() -> PathBuf {
    let xtask = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    xtask.parent().map_or(xtask.clone(), PathBuf::from)
}

/// The folder that cargo builds into.
pub fn target_directory() -> PathBuf {
    match std::env::var_os("CARGO_TARGET_DIR") {
        Some(folder) => workspace().join(folder),
        None => workspace().join("target"),
    }
}

/// Where ground truth is kept, which takes longest to compute and depends on the scene alone.
pub fn truth_cache() -> PathBuf {
    target_directory().join("truth")
}
