//! `scumble-study`: the window in which a person tells blurred straight edges from blurred steps.
//!
//! The program is a thin shell. [`scumble_psychophysics`] decides what comes next and
//! [`scumble_stimuli`] draws it; the shell shows pictures texel for pixel, measures response times,
//! and puts every answer on disk before the next picture.

mod arguments;
mod clock;
mod display;
mod keys;
mod pixels;
mod presentation;
mod recorder;
mod rehearsal;
mod screen;
mod session_folder;
mod setup;
mod sitting;
mod study;
mod theme;
mod words;

use std::cell::RefCell;
use std::process::ExitCode;
use std::rc::Rc;

use anyhow::Context;
use clap::Parser;
use eframe::egui;
use scumble_psychophysics::Observer;

use crate::arguments::{Arguments, ResumePolicy};
use crate::rehearsal::Rehearsal;
use crate::session_folder::{Found, Interrupted, find};
use crate::setup::StudyFolder;
use crate::sitting::Sitting;
use crate::study::{Outcome, Study};

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("scumble-study: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// Runs one session; success means that it is complete, or was ended on purpose, and on disk.
fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let sitting = sitting(arguments)?;
    let directory = sitting.recorder().directory().to_path_buf();
    let rehearsal = match arguments.rehearse {
        Some(model) => Some(Rehearsal::new(Observer::new(model, sitting.recorder().header().seed)?, arguments.speed)),
        None => None,
    };

    let outcome = Rc::new(RefCell::new(Outcome::default()));
    let study = Study::new(sitting, rehearsal, arguments.px_per_degree, Rc::clone(&outcome));
    let create = move |context: &eframe::CreationContext<'_>| {
        theme::apply(&context.egui_ctx);
        Ok(Box::new(study) as Box<dyn eframe::App>)
    };
    eframe::run_native("Scumble study", window_options(arguments), Box::new(create))
        .map_err(|error| anyhow::anyhow!("no window: {error}"))?;

    let how_to_resume = || {
        let [data, code] = [directory.parent(), directory.file_name().map(AsRef::as_ref)]
            .map(|part| part.map_or_else(String::new, |part| part.display().to_string()));
        format!("continue with --data {data} --participant {code} --resume")
    };
    match &*outcome.borrow() {
        Outcome::Complete => Ok(()),
        Outcome::Interrupted => anyhow::bail!("not complete; {}", how_to_resume()),
        Outcome::Stopped(problem) => anyhow::bail!("{problem}; {}", how_to_resume()),
        Outcome::Unsaved { problem, lines } => anyhow::bail!(
            "{problem}; these lines are missing at the end of {}:\n{}",
            directory.display(),
            lines.join("\n")
        ),
    }
}

/// The session that the command line asks for.
fn sitting(arguments: &Arguments) -> anyhow::Result<Sitting> {
    let (study, code) = (arguments.study_folder(), arguments.participant_code());
    let found = find(&study, &code)
        .with_context(|| format!("{} holds a session of {code} already that cannot be read", study.display()))?;
    match (found, arguments.resume) {
        (Found::Interrupted(found), Some(ResumePolicy::Discard)) => {
            sitting::discard(&found.directory)?;
            fresh(arguments)
        }
        (Found::Interrupted(found), Some(policy)) => Sitting::resume(&found.directory, policy),
        (Found::Interrupted(found), None) => anyhow::bail!(
            "{} holds a session already, interrupted after {} trials; --resume continues it, \
             --resume discard begins another",
            found.directory.display(),
            found.trials
        ),
        (Found::Complete(directory), _) => anyhow::bail!(
            "{} holds a session already, and it is complete; allowed is another --participant",
            directory.display()
        ),
        (Found::Free(directory), Some(_)) => {
            anyhow::bail!("{}: no session to continue; without --resume one begins there", directory.display())
        }
        (Found::Free(_), None) => fresh(arguments),
    }
}

fn fresh(arguments: &Arguments) -> anyhow::Result<Sitting> {
    let (folder, code) = (arguments.study_folder(), arguments.participant_code());
    let study = StudyFolder::open(&folder, arguments.protocol.as_deref())?;
    let header = arguments.header(&code, study.protocol().clone())?;
    match find(&folder, &code)? {
        Found::Free(directory) => Sitting::fresh(study, &directory, header),
        Found::Interrupted(Interrupted { directory, .. }) | Found::Complete(directory) => {
            anyhow::bail!("{} holds a session already", directory.display())
        }
    }
}

fn window_options(arguments: &Arguments) -> eframe::NativeOptions {
    let mut viewport = egui::ViewportBuilder::default()
        .with_app_id("scumble-study")
        .with_title("Scumble study")
        .with_inner_size([1280.0, 800.0])
        .with_fullscreen(!arguments.windowed);
    if let Some(number) = arguments.monitor {
        viewport = viewport.with_monitor(number as usize - 1);
    }
    eframe::NativeOptions {
        viewport,
        // The stimuli are exact levels; noise on top of them would not be.
        dithering: false,
        ..Default::default()
    }
}
