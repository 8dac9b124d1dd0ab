//! Pictures and benchmarks of adaptive shadow maps on real scenes.
//!
//! A frame has four steps, each a pass that is timed on its own: the G-buffer (positions and normals of what is seen),
//! the depth pass of the shadow map, the demand (which size would hide the texels), and the evaluation (the drop-in's
//! `shadow_visibility` at every pixel). A picture adds shading. The benchmark compares what was evaluated with the ground
//! truth of `scumble-reference` at the very same positions and normals.
//!
//! `scumble-viewer --help` shows the commands with examples. Exit status 0 only when the work was done; bad input gives
//! one line on standard error.

mod bench;
mod casters;
mod cli;
mod device;
mod evaluation;
mod fullscreen;
mod gbuffer;
mod geometry;
mod masks;
mod npy;
mod output;
mod pipelines;
mod progress;
mod readback;
mod record;
mod scenes;
mod setup;
mod shading;
mod shot;
mod size;
mod stage;
mod statistics;
mod timer;
mod truth;
mod variant;

use std::process::ExitCode;

use anyhow::Result;
use clap::{CommandFactory, Parser, error::ErrorKind};

use cli::{Cli, Command};

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) if matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) => {
            print!("{error}");
            return ExitCode::SUCCESS;
        }
        Err(error) => return refuse(&one_line(&error.to_string())),
    };
    // What libraries notice, such as a material that cannot be read, in the form of this program's own warnings.
    let notices = tracing_subscriber::fmt().with_max_level(tracing_subscriber::filter::LevelFilter::WARN);
    notices.with_writer(std::io::stderr).without_time().with_target(false).with_ansi(false).init();
    match run(cli) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => refuse(&format!("error: {}", format!("{error:#}").replace('\n', " "))),
    }
}

fn run(cli: Cli) -> Result<()> {
    match cli.command {
        None => Ok(Cli::command().print_long_help()?),
        Some(Command::Shot(options)) => shot::run(&options),
        Some(Command::Bench(options)) => bench::run(&options),
        Some(Command::Report { folder }) => bench::remake_report(&folder),
        Some(Command::Truth(options)) => truth::run(&options),
        Some(Command::Scenes) => {
            scenes::list();
            Ok(())
        }
    }
}

fn refuse(line: &str) -> ExitCode {
    eprintln!("{line}");
    ExitCode::FAILURE
}

/// The first paragraph of a parser's complaint, which names the option, the value and what is allowed, as one line.
fn one_line(complaint: &str) -> String {
    let paragraph = complaint.lines().take_while(|line| !line.trim().is_empty());
    paragraph.map(str::trim).collect::<Vec<_>>().join(" ")
}
