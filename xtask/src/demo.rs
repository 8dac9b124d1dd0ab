//! The demonstration: a simulated study, its fit, and real scenes rendered with the fitted relation.
//!
//! Every step is the program that a user would call; this file only puts them in a row and keeps what they wrote.

use crate::packages;
use crate::report;
use crate::run;
use crate::summary::{Summary, TRUE_RATIO};
use anyhow::{Context, Result};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Three compositions and the simplest case: what a reader of the report wants to see, in the time of a demonstration.
const SCENES: &str = "yard,stairwell,recital,contact";

/// People in the simulated study: two more than Kreuzer asked. With them the ratio has a standard error of 7 %.
const OBSERVERS: &str = "12";
/// Any other seed gives another simulated study.
const SEED: &str = "2017";

/// Where the demonstration keeps what it made.
pub fn folder() -> PathBuf {
    run::target_directory().join("demo")
}

/// Runs the whole chain into `target/demo` and prints what came out of it.
pub fn run(quick: bool) -> Result<Summary> {
    packages::provide(&[packages::COMPILER, packages::VULKAN])?;
    build()?;
    let started = Instant::now();
    let folder = folder();
    start_afresh(&folder)?;

    println!("\n1/5  Stimuli: what a participant sees");
    run::program("examples/sheet", &[run::text(&folder.join("stimuli.png"))?])?;

    println!("\n2/5  Study: {OBSERVERS} simulated observers, true ratio {TRUE_RATIO}");
    let sessions = folder.join("sessions");
    let ratio = TRUE_RATIO.to_string();
    let simulate = ["simulate", "--observers", OBSERVERS, "--seed", SEED, "--ratio", &ratio, "--out"];
    run::program("scumble-analysis", &[&simulate[..], &[run::text(&sessions)?]].concat())?;

    println!("\n3/5  Analysis: thresholds, then the relation");
    let study = folder.join("study");
    run::program("scumble-analysis", &["fit", run::text(&sessions)?, "--out", run::text(&study)?])?;
    let relation = folder.join("relation.json");
    std::fs::copy(study.join("relation.json"), &relation)
        .with_context(|| format!("cannot copy the relation to {}", relation.display()))?;

    println!("\n4/5  Renderer: real scenes, fixed 2048 x 2048 maps against adaptive ones");
    let bench = folder.join("bench");
    let mut render = vec!["bench", "--scenes", SCENES, "--sizes", "2048,adaptive"];
    let cache = run::truth_cache();
    render.extend(["--relation", run::text(&relation)?, "--out", run::text(&bench)?, "--cache", run::text(&cache)?]);
    if quick {
        render.push("--quick");
    }
    run::program("scumble-viewer", &render)?;

    println!("\n5/5  Report");
    let summary = Summary::read(&folder)?;
    let report = folder.join("report.html");
    std::fs::write(&report, report::html(&folder, &summary)?)
        .with_context(|| format!("cannot write {}", report.display()))?;
    println!("\n{summary}");
    println!("Report: {}", report.display());
    println!("Relation: {}", relation.display());
    println!("Time without the build: {:.0} s", started.elapsed().as_secs_f64());
    Ok(summary)
}

fn build() -> Result<()> {
    let programs = ["-p", "scumble-analysis", "-p", "scumble-viewer", "-p", "scumble-stimuli"];
    run::cargo(&[&["build", "--release", "--locked", "--bins", "--example", "sheet"], &programs[..]].concat())
}

/// Everything below the folder was made by a former demonstration and can be made again.
fn start_afresh(folder: &Path) -> Result<()> {
    if folder.exists() {
        std::fs::remove_dir_all(folder).with_context(|| format!("cannot clear {}", folder.display()))?;
    }
    std::fs::create_dir_all(folder).with_context(|| format!("cannot create {}", folder.display()))
}
