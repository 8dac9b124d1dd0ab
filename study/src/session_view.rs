//! A session on the participant's screen: shows the stage, passes on what the participant did, and sees to
//! it that the answer is on disk before the next stage is drawn.

mod obey;
mod rehearse;

use std::time::{Duration, Instant};

use eframe::egui;
use scumble_psychophysics::{Answer, Language, Stage};

use crate::administrator::Administrator;
use crate::desk::Order;
use crate::display::display;
use crate::keys;
use crate::outcome::Outcome;
use crate::presentation::{FIXATION, Presentation, Screen};
use crate::rehearsal::{Rehearsal, Scene};
use crate::screen::{self, Action};
use crate::setup::MeasuredDisplay;
use crate::sitting::Sitting;
use crate::words::{Words, words};

/// Between two attempts to write what the disk has refused.
const RETRY: Duration = Duration::from_secs(2);

/// The session as it is shown.
pub(crate) struct SessionView {
    sitting: Sitting,
    words: &'static Words,
    rehearsal: Option<Rehearsal>,
    /// When the simulated person looks again; asked for within the frame, because a frame forgets what was asked
    /// for before it.
    wake_after: Option<Duration>,
    measured: MeasuredDisplay,
    /// What the pictures are shown on, once there is one to show.
    screen: Option<Screen>,
    presentation: Option<Presentation>,
    examples: screen::Examples,
    /// Something that the program cannot work around.
    fatal: Option<String>,
    retry_at: Instant,
    administrator: Administrator,
}

impl SessionView {
    /// A session before its first frame, on a display of which this was measured.
    pub(crate) fn new(sitting: Sitting, rehearsal: Option<Rehearsal>, measured: MeasuredDisplay) -> Self {
        let language = sitting.recorder().header().language.unwrap_or(Language::English);
        Self {
            sitting,
            words: words(language),
            rehearsal,
            wake_after: None,
            measured,
            screen: None,
            presentation: None,
            examples: screen::Examples::default(),
            fatal: None,
            retry_at: Instant::now(),
            administrator: Administrator::new(&words(language).desk),
        }
    }

    /// Draws what is to be shown and collects what the participant did.
    fn show(&mut self, ui: &mut egui::Ui, frame: &eframe::Frame) -> anyhow::Result<Option<Action>> {
        let words = &self.words.participant;
        let sitting = &self.sitting;
        if let Some(problem) = &self.fatal {
            return Ok(screen::stopped(ui, problem, sitting.recorder().directory(), words));
        }
        if let Some(problem) = sitting.recorder().problem() {
            ui.ctx().request_repaint_after(RETRY);
            let action = screen::unsaved(ui, problem, words);
            return Ok(if self.retry_at <= Instant::now() { Some(Action::Retry) } else { action });
        }
        let experiment = sitting.experiment();
        if sitting.is_paused() {
            return Ok(screen::paused(ui, experiment.progress(), words));
        }
        if screen::too_small(ui, experiment.protocol(), words) {
            self.presentation = None;
            return Ok(None);
        }
        let asked_to_pause = sitting.is_open() && keys::pause(ui.ctx());
        let action = match *experiment.stage() {
            Stage::Instructions => screen::instructions(ui, &mut self.examples, experiment.protocol(), words)?,
            Stage::Practice(trial) | Stage::Trial(trial) => {
                let fixation = self.rehearsal.as_ref().map_or(FIXATION, |person| person.scaled(FIXATION));
                let presentation = match self.presentation.take() {
                    Some(presentation) if *presentation.trial() == trial => presentation,
                    _ => Presentation::new(trial, fixation),
                };
                let screen = match self.screen.take() {
                    Some(screen) => screen,
                    None => screen_of(sitting, frame)?,
                };
                let (screen, presentation) = (self.screen.insert(screen), self.presentation.insert(presentation));
                screen::trial(ui, presentation, experiment, screen, words)?
            }
            Stage::Feedback { correct, right_answer } => screen::feedback(ui, correct, right_answer, words),
            Stage::Rest { round, rounds, within_round } => {
                screen::rest(ui, experiment.protocol().task, [round, rounds], within_round, words)
            }
            Stage::Finished => screen::finished(ui, words),
        };
        Ok(if asked_to_pause { Some(Action::Pause) } else { action })
    }

    /// Does what the participant asked for.
    fn act(&mut self, action: Action, ui: &egui::Ui, frame: &eframe::Frame) -> anyhow::Result<()> {
        let sitting = &mut self.sitting;
        match action {
            Action::Proceed => {
                sitting.proceed(|| display(frame).map(|display| self.measured.clone().complete(display)))?;
            }
            Action::Answer(answer) => self.answer(answer)?,
            Action::Pause => self.hide_pictures(),
            Action::Continue => sitting.go_on(),
            Action::Retry => {
                self.retry_at = Instant::now() + RETRY;
                sitting.retry();
            }
            Action::Close => ui.send_viewport_cmd(egui::ViewportCommand::Close),
        }
        Ok(())
    }

    /// What a key pressed in this frame answers to the pictures on the screen; a key that was pressed before
    /// they were there is no answer to them.
    fn answer_by_key(&self, context: &egui::Context) -> Option<Answer> {
        match self.scene() {
            Scene::Pictures { trial, .. } => keys::answer(context, trial.pictures.answers()),
            Scene::Page(_) | Scene::Waiting => None,
        }
    }

    fn answer(&mut self, answer: Answer) -> anyhow::Result<()> {
        let shown = self.presentation.take();
        match shown.and_then(|shown| shown.reply(answer, self.sitting.clock())) {
            Some(reply) => self.sitting.answer(reply),
            None => Ok(()),
        }
    }

    /// Cannot go on. What the administrator is told of it cannot be the cause of telling it again.
    fn stop(&mut self, error: &anyhow::Error) {
        if self.fatal.is_none() {
            self.administrator.note_news();
        }
        self.fatal = Some(format!("{error:#}"));
    }

    /// The window closes: an open session is interrupted, and this is how it stands.
    pub(crate) fn leave(&mut self) -> Outcome {
        self.sitting.leave();
        let recorder = self.sitting.recorder();
        let directory = recorder.directory().to_path_buf();
        if let Some(problem) = recorder.problem() {
            let line = |event| serde_json::to_string(event).unwrap_or_else(|error| error.to_string());
            let lines = recorder.unsaved().iter().map(line).collect();
            let rescued_to = recorder.rescue().ok();
            return Outcome::Unsaved { problem: problem.into(), lines, directory, rescued_to };
        }
        match &self.fatal {
            Some(problem) => Outcome::Stopped { problem: problem.clone(), directory },
            None if recorder.is_closed() => Outcome::Complete { directory },
            None if recorder.has_begun() => Outcome::Interrupted { directory },
            None => Outcome::NotBegun,
        }
    }

    /// One frame.
    pub(crate) fn ui(&mut self, ui: &mut egui::Ui, frame: &eframe::Frame) {
        if let Some(wait) = self.wake_after.take() {
            ui.ctx().request_repaint_after(wait);
        }
        if let Err(error) = self.turn(ui, frame) {
            self.stop(&error);
            ui.request_repaint();
        }
    }

    /// Does what the administrator ordered, then shows the participant what is to be seen and does what they
    /// asked for.
    fn turn(&mut self, ui: &mut egui::Ui, frame: &eframe::Frame) -> anyhow::Result<()> {
        // Not while pictures are up: to ask the system takes time.
        if self.presentation.is_none()
            && let Some(display) = display(frame)
            && self.sitting.watch_display(&display)
        {
            self.administrator.note_news();
        }
        let mut orders = self.administrator.attend(ui.ctx(), frame);
        if self.administrator.covers_screen() {
            if !self.sitting.is_paused() {
                self.obey(Order::Pause);
            }
            self.administrator.tell(ui.ctx(), &self.sitting, self.fatal.as_deref())?;
            orders.extend(self.administrator.show(ui));
        } else {
            // Before anything is painted, so that the next cross is in this frame and not in the one after it.
            if let Some(answer) = self.answer_by_key(ui.ctx()) {
                self.act(Action::Answer(answer), ui, frame)?;
                self.administrator.note_news();
            }
            if let Some(action) = self.show(ui, frame)? {
                self.act(action, ui, frame)?;
                self.administrator.note_news();
                ui.request_repaint();
            }
        }
        let is_ordered = !orders.is_empty();
        for order in orders {
            self.obey(order);
            ui.request_repaint();
        }
        // Whoever ordered something in the other window has the keyboard there; the participant needs it to answer.
        if is_ordered && !self.sitting.is_paused() {
            ui.ctx().send_viewport_cmd_to(egui::ViewportId::ROOT, egui::ViewportCommand::Focus);
        }
        self.administrator.tell(ui.ctx(), &self.sitting, self.fatal.as_deref())
    }
}

/// What the pictures of a session are shown on.
fn screen_of(sitting: &Sitting, frame: &eframe::Frame) -> anyhow::Result<Screen> {
    let header = sitting.recorder().header();
    let rules = header.protocol.pictures;
    let refresh_hz = display(frame).and_then(|display| display.refresh_hz);
    Ok(Screen { size_px: [rules.width_px, rules.height_px], transfer: header.transfer()?, refresh_hz })
}
