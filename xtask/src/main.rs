//! `cargo xtask`: everything a fresh machine needs, by one command each.
//!
//! `demo` runs the whole chain and ends in a report; `test` runs every test and then checks the promises of a
//! quick demo; `setup` only installs. On Debian and Ubuntu missing packages are installed and named first;
//! elsewhere the list of what to install is printed and nothing is changed.

mod bench;
mod bids;
mod demo;
mod packages;
mod python;
mod report;
mod run;
mod summary;
mod test;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Set-up, tests and the demonstration of Scumble.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Run a simulated study, fit it, render real scenes with the fitted relation, compare with ground truth
    ///
    /// Installs a software Vulkan driver where none is found. Writes target/demo/report.html and
    /// target/demo/relation.json; a former demo in that folder is replaced.
    Demo {
        /// Fewer pixels and frames: under two minutes after the build
        #[arg(long)]
        quick: bool,
    },
    /// Measure the trade of time and accuracy on every scene, what ratio and statistic choose, and the headline of the thesis
    ///
    /// Writes target/bench/trade, choices and headline, each with report.html, bench.csv, bench.json and bench.md. Takes an
    /// hour or two on a software renderer; a run that was killed goes on.
    Bench {
        /// A quarter of the pixels, fewer rays: minutes
        #[arg(long)]
        quick: bool,
    },
    /// Install what the tests need, run them all, then a quick demo whose numbers are checked
    ///
    /// Where npm is on the path, exported datasets are put before the BIDS validator too.
    Test,
    /// Install what demo and test need, and nothing else
    Setup,
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().task {
        Task::Demo { quick } => demo::run(quick).map(drop),
        Task::Bench { quick } => bench::run(quick),
        Task::Test => test::run(),
        Task::Setup => packages::provide(&[packages::COMPILER, packages::VULKAN, packages::WINDOWS]),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}
