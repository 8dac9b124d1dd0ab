//! `scumble-study`: the window in which a person tells blurred straight edges from blurred steps.
//!
//! The program is a thin shell. [`scumble_psychophysics`] decides what comes next and
//! [`scumble_stimuli`] draws it; the shell shows pictures texel for pixel, measures response times,
//! and puts every answer on disk before the next picture.

mod arguments;
mod keys;
mod pixels;
mod presentation;
mod recorder;
mod screen;
mod setup;
mod study;
mod theme;
mod words;

use std::cell::RefCell;
use std::process::ExitCode;
use std::rc::Rc;

use clap::Parser;
use eframe::egui;
use scumble_psychophysics::Experiment;

use crate::arguments::Arguments;
use crate::recorder::Recorder;
use crate::study::{Outcome, Start, Study};

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("scumble-study: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// Runs one session; success means that it is complete and on disk.
fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let directory = arguments.session_directory();
    let (recorder, experiment, start) = if arguments.resume {
        let (recorder, experiment, notices) = Recorder::reopen(&directory)?;
        (recorder, experiment, Start::Resumed { notices })
    } else {
        let header = arguments.header()?;
        let experiment = Experiment::new(header.protocol.clone(), header.seed, header.participant_number)?;
        let recorder = Recorder::plan(&directory, header, arguments.px_per_degree)?;
        (recorder, experiment, Start::Fresh)
    };

    let outcome = Rc::new(RefCell::new(Outcome::Interrupted));
    let study = Study::new(experiment, recorder, start, Rc::clone(&outcome));
    let create = move |context: &eframe::CreationContext<'_>| {
        theme::apply(&context.egui_ctx);
        Ok(Box::new(study) as Box<dyn eframe::App>)
    };
    eframe::run_native("Scumble study", window_options(arguments.windowed), Box::new(create))
        .map_err(|error| anyhow::anyhow!("no window: {error}"))?;

    match &*outcome.borrow() {
        Outcome::Complete => Ok(()),
        Outcome::Interrupted => anyhow::bail!("not complete; {}", arguments.how_to_resume()),
        Outcome::Stopped(problem) => anyhow::bail!("{problem}; {}", arguments.how_to_resume()),
    }
}

fn window_options(windowed: bool) -> eframe::NativeOptions {
    let viewport = egui::ViewportBuilder::default()
        .with_app_id("scumble-study")
        .with_title("Scumble study")
        .with_inner_size([1280.0, 800.0])
        .with_fullscreen(!windowed);
    eframe::NativeOptions {
        viewport,
        // The stimuli are exact levels; noise on top of them would not be.
        dithering: false,
        ..Default::default()
    }
}
