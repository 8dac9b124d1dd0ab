//! `scumble-study`: the window in which a person tells blurred straight edges from blurred steps.
//!
//! The program is a thin shell. [`scumble_psychophysics`] decides what comes next and
//! [`scumble_stimuli`] draws it; the shell shows pictures texel for pixel, measures response times,
//! and puts every answer on disk before the next picture.

mod administrator;
mod arguments;
mod clock;
mod desk;
mod display;
mod keys;
mod outcome;
mod pixels;
mod presentation;
mod program;
mod recorder;
mod rehearsal;
mod screen;
mod session_folder;
mod session_view;
mod setup;
mod sitting;
mod software;
mod theme;
mod words;

use std::cell::RefCell;
use std::path::Path;
use std::process::ExitCode;
use std::rc::Rc;

use anyhow::Context;
use clap::Parser;
use eframe::egui;
use scumble_psychophysics::{Error, Protocol};

use crate::arguments::{Arguments, ResumePolicy};
use crate::outcome::Outcome;
use crate::program::Program;
use crate::session_folder::{Found, find};
use crate::setup::{MeasuredDisplay, StudyFolder};
use crate::sitting::Sitting;

fn main() -> ExitCode {
    match run(Arguments::parse()) {
        Ok(last_words) => {
            println!("{last_words}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("scumble-study: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// Runs one session; success means that it is complete, or was ended on purpose, and on disk, and says where.
fn run(arguments: Arguments) -> anyhow::Result<String> {
    let outcome = Rc::new(RefCell::new(Outcome::default()));
    let options = window_options(&arguments);
    // What is wrong is found here, and not in front of the participant.
    let program = if arguments.skips_setup() {
        let (sitting, measured) = session(&arguments)?;
        Program::with_session(arguments, sitting, measured, Rc::clone(&outcome))?
    } else {
        check_given(&arguments)?;
        Program::with_setup(arguments, Rc::clone(&outcome))
    };
    let create = move |context: &eframe::CreationContext<'_>| {
        theme::apply(&context.egui_ctx);
        Ok(Box::new(program) as Box<dyn eframe::App>)
    };
    eframe::run_native("Scumble study", options, Box::new(create))
        .map_err(|error| anyhow::anyhow!("no window: {error}"))?;
    outcome.take().into_result()
}

/// Refuses what the set-up would be given: another study's protocol, a name for a code, a complete session.
fn check_given(arguments: &Arguments) -> anyhow::Result<()> {
    let code = arguments.participant_code();
    let Some(folder) = &arguments.data else {
        let protocol = arguments.protocol.as_deref().map_or_else(|| Ok(Protocol::two_alternative()), Protocol::open)?;
        return arguments.header(&code, protocol).map(drop);
    };
    let study = StudyFolder::open(folder, arguments.protocol.as_deref())?;
    arguments.header(&code, study.protocol().clone())?;
    match found(arguments)? {
        Found::Complete(directory) => Err(complete(&directory)),
        Found::Free(_) | Found::Interrupted(_) => Ok(()),
    }
}

/// The session that the command line asks for, and what is known of its display.
fn session(arguments: &Arguments) -> anyhow::Result<(Sitting, MeasuredDisplay)> {
    let mut found_now = found(arguments)?;
    let mut number = arguments.participant_number;
    if let (Found::Interrupted(interrupted), Some(policy)) = (&found_now, arguments.resume) {
        if policy != ResumePolicy::Discard {
            return Ok((Sitting::resume(&interrupted.directory, policy)?, MeasuredDisplay::default()));
        }
        number = Some(sitting::discard(&interrupted.directory)?);
        found_now = found(arguments)?;
    } else if let (Found::Free(directory), Some(_)) = (&found_now, arguments.resume) {
        let directory = directory.display();
        anyhow::bail!("{directory}: no session to continue; without --resume one begins there");
    }
    match found_now {
        Found::Free(directory) => {
            let study = StudyFolder::open(&arguments.study_folder(), arguments.protocol.as_deref())?;
            let mut header = arguments.header(&arguments.participant_code(), study.protocol().clone())?;
            header.participant_number = number.unwrap_or(header.participant_number);
            let measured = MeasuredDisplay::of_study(&study, arguments.px_per_degree)?;
            Ok((Sitting::fresh(study, &directory, header)?, measured))
        }
        Found::Interrupted(found) => anyhow::bail!(
            "{} holds a session already, interrupted after {} trials; --resume continues it, --resume discard \
             begins another",
            found.directory.display(),
            found.trials
        ),
        Found::Complete(directory) => Err(complete(&directory)),
    }
}

/// What the study's folder holds of the participant.
fn found(arguments: &Arguments) -> anyhow::Result<Found> {
    let (folder, code) = (arguments.study_folder(), arguments.participant_code());
    match find(&folder, &code) {
        Err(in_use @ Error::SessionInUse(_)) => Err(in_use.into()),
        other => other.with_context(|| {
            let folder = folder.display();
            format!("{folder} holds a session of {code} already that cannot be read; another --participant begins one")
        }),
    }
}

fn complete(directory: &Path) -> anyhow::Error {
    let directory = directory.display();
    anyhow::anyhow!("{directory} holds a session already, and it is complete; allowed is another --participant")
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
