//! The program as eframe sees it: shows the stage, passes on what the participant did, and sees to
//! it that the answer is on disk before the next stage is drawn.

use std::cell::RefCell;
use std::rc::Rc;

use eframe::egui;
use scumble_psychophysics::{Answer, Display, Event, Experiment, Stage};

use crate::keys;
use crate::presentation::Presentation;
use crate::recorder::{Recorder, moment};
use crate::screen::{self, Action};

/// How a session ended, for the exit status.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// Every trial is answered and on disk.
    Complete,
    /// The window was closed before.
    Interrupted,
    /// The disk or the experiment refused; in words.
    Stopped(String),
}

/// Whether the session is a fresh one.
pub(crate) enum Start {
    Fresh,
    /// Taken up again; what the reader noticed goes into the record.
    Resumed {
        notices: Vec<String>,
    },
}

/// What lies over the stage.
enum Overlay {
    None,
    /// The pictures are hidden until the participant goes on.
    Paused {
        notes: Vec<String>,
    },
    Stopped(String),
}

/// The running study.
pub(crate) struct Study {
    experiment: Experiment,
    recorder: Recorder,
    presentation: Option<Presentation>,
    examples: screen::Examples,
    overlay: Overlay,
    outcome: Rc<RefCell<Outcome>>,
}

impl Study {
    /// A session before its first frame. `outcome` is told how it ends.
    pub(crate) fn new(experiment: Experiment, recorder: Recorder, start: Start, outcome: Rc<RefCell<Outcome>>) -> Self {
        let overlay = match start {
            Start::Fresh => Overlay::None,
            Start::Resumed { notices } => Overlay::Paused { notes: notices },
        };
        let examples = screen::Examples::default();
        Self { experiment, recorder, presentation: None, examples, overlay, outcome }
    }

    /// Draws what is to be shown and collects what the participant did.
    fn show(&mut self, ui: &mut egui::Ui) -> anyhow::Result<Option<Action>> {
        match &self.overlay {
            Overlay::Stopped(problem) => {
                return Ok(screen::stopped(ui, problem, self.recorder.directory()));
            }
            Overlay::Paused { .. } => return Ok(screen::paused(ui, self.experiment.progress())),
            Overlay::None => {}
        }
        let asked_to_pause = keys::pause(ui.ctx()) && *self.experiment.stage() != Stage::Finished;
        let action = match *self.experiment.stage() {
            Stage::Instructions => screen::instructions(ui, &mut self.examples, self.experiment.protocol())?,
            Stage::Practice(trial) | Stage::Trial(trial) => {
                let presentation = match self.presentation.take() {
                    Some(presentation) if *presentation.trial() == trial => presentation,
                    _ => Presentation::new(trial),
                };
                let presentation = self.presentation.insert(presentation);
                screen::trial(ui, presentation, &self.experiment)?
            }
            Stage::Feedback { correct, right_answer } => screen::feedback(ui, correct, right_answer),
            Stage::Rest { round, rounds, within_round } => {
                screen::rest(ui, self.experiment.protocol().task, round, rounds, within_round)
            }
            Stage::Finished => screen::finished(ui),
        };
        Ok(if asked_to_pause { Some(Action::Pause) } else { action })
    }

    /// Does what the participant asked for.
    fn act(&mut self, action: Action, ui: &egui::Ui, frame: &eframe::Frame) -> anyhow::Result<()> {
        match action {
            Action::Proceed => {
                self.recorder.begin(display(frame))?;
                self.experiment.proceed()?;
            }
            Action::Answer(answer) => self.answer(answer)?,
            Action::Pause => {
                self.recorder.append(&Event::Pause(moment(Vec::new())))?;
                self.presentation = None;
                self.overlay = Overlay::Paused { notes: Vec::new() };
            }
            Action::Continue => {
                if let Overlay::Paused { notes } = &mut self.overlay {
                    self.recorder.append(&Event::Resume(moment(std::mem::take(notes))))?;
                }
                self.overlay = Overlay::None;
            }
            Action::Close => ui.send_viewport_cmd(egui::ViewportCommand::Close),
        }
        let ends = *self.experiment.stage() == Stage::Finished && !self.recorder.is_complete();
        if ends && matches!(self.overlay, Overlay::None) {
            self.recorder.append(&Event::End(moment(Vec::new())))?;
            *self.outcome.borrow_mut() = Outcome::Complete;
        }
        Ok(())
    }

    fn answer(&mut self, answer: Answer) -> anyhow::Result<()> {
        if let Some(reply) = self.presentation.take().and_then(|shown| shown.reply(answer)) {
            let event = self.experiment.answer(reply)?;
            self.recorder.append(&event)?;
        }
        Ok(())
    }

    fn stop(&mut self, error: &anyhow::Error) {
        let problem = format!("{error:#}");
        *self.outcome.borrow_mut() = Outcome::Stopped(problem.clone());
        self.overlay = Overlay::Stopped(problem);
    }
}

impl eframe::App for Study {
    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        let acted = match self.show(ui) {
            Ok(None) => return,
            Ok(Some(action)) => self.act(action, ui, frame),
            Err(error) => Err(error),
        };
        if let Err(error) = acted {
            self.stop(&error);
        }
        ui.request_repaint();
    }

    fn on_exit(&mut self) {
        if matches!(self.overlay, Overlay::None)
            && let Err(error) = self.recorder.append(&Event::Pause(moment(Vec::new())))
        {
            self.stop(&error.into());
        }
    }
}

/// The display that the window is on, as far as the system tells.
fn display(frame: &eframe::Frame) -> Option<Display> {
    let window = frame.winit_window()?;
    let monitor = window.current_monitor()?;
    Some(Display {
        monitor: monitor.name(),
        width_px: monitor.size().width,
        height_px: monitor.size().height,
        scale_factor: window.scale_factor(),
        px_per_degree: None,
        luminance: None,
    })
}
