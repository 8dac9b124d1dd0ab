//! The program as eframe sees it: the set-up, then a session.

use std::cell::RefCell;
use std::rc::Rc;

use eframe::egui;
use scumble_psychophysics::Observer;

use crate::arguments::{Arguments, ResumePolicy};
use crate::display::monitors;
use crate::outcome::Outcome;
use crate::rehearsal::Rehearsal;
use crate::screen;
use crate::session_folder::{Found, find};
use crate::session_view::SessionView;
use crate::setup::{Given, MeasuredDisplay, Page, Ready, RecentFolders, Setup, SetupAction};
use crate::sitting::{self, Sitting};
use crate::software::software;
use crate::theme;
use crate::words::words;

/// What is on the participant's screen.
enum Part {
    /// Nothing yet: the first frame knows the monitors that the set-up offers.
    Opening,
    Setup(Box<Setup>),
    Session(Box<SessionView>),
    /// A session that cannot begin or go on, in words.
    Refused(String),
}

/// The running program.
pub(crate) struct Program {
    arguments: Arguments,
    part: Part,
    outcome: Rc<RefCell<Outcome>>,
}

impl Program {
    /// A program that begins with the set-up. `outcome` is told how it ends.
    pub(crate) fn with_setup(arguments: Arguments, outcome: Rc<RefCell<Outcome>>) -> Self {
        Self { arguments, part: Part::Opening, outcome }
    }

    /// A program that begins with a session.
    pub(crate) fn with_session(
        arguments: Arguments,
        sitting: Sitting,
        measured: MeasuredDisplay,
        outcome: Rc<RefCell<Outcome>>,
    ) -> anyhow::Result<Self> {
        let recorded = sitting.recorder().header().simulated_observer;
        anyhow::ensure!(
            arguments.rehearse == recorded,
            "{}: its answers are {}; allowed are answers of one person alone, with or without --rehearse",
            sitting.recorder().directory().display(),
            recorded.map_or_else(|| "a person's".to_owned(), |model| format!("those of --rehearse {}", model.name()))
        );
        let rehearsal = match arguments.rehearse {
            Some(model) => Some(Observer::new(model, sitting.recorder().header().seed)?),
            None => None,
        };
        let rehearsal = rehearsal.map(|observer| Rehearsal::new(observer, arguments.speed));
        let part = Part::Session(Box::new(SessionView::new(sitting, rehearsal, measured)));
        Ok(Self { arguments, part, outcome })
    }

    /// The set-up before its first page.
    fn open_setup(&self, frame: &eframe::Frame) -> Setup {
        let arguments = &self.arguments;
        // A window is put on another monitor by hand.
        let (monitors, monitor) = if arguments.windowed { (Vec::new(), None) } else { monitors(frame) };
        Setup::new(Given {
            folder: arguments.data.as_ref().map_or_else(String::new, |folder| folder.display().to_string()),
            protocol: arguments.protocol.clone(),
            participant: arguments.participant.clone().unwrap_or_default(),
            participant_number: arguments.participant_number,
            language: arguments.language,
            monitors,
            monitor: monitor.unwrap_or(0),
            px_per_degree: arguments.px_per_degree,
            recent: RecentFolders::of_user(),
            find: Box::new(find),
        })
    }

    /// Does what the set-up cannot do itself.
    fn act(&mut self, action: SetupAction, context: &egui::Context) {
        let Part::Setup(setup) = &mut self.part else { return };
        let next = match action {
            SetupAction::Monitor(index) => {
                context.send_viewport_cmd(egui::ViewportCommand::SetMonitor(index));
                return;
            }
            SetupAction::Quit => {
                context.send_viewport_cmd(egui::ViewportCommand::Close);
                return;
            }
            SetupAction::Done(ready) => self.begin(*ready),
            SetupAction::Interrupted(directory, ResumePolicy::Discard) => match sitting::discard(&directory) {
                Ok(participant_number) => {
                    setup.discarded(participant_number);
                    return;
                }
                Err(error) => Err(error),
            },
            SetupAction::Interrupted(directory, policy) => Sitting::resume(&directory, policy)
                .map(|sitting| SessionView::new(sitting, None, MeasuredDisplay::default())),
        };
        self.part = match next {
            Ok(view) => Part::Session(Box::new(view)),
            Err(error) => Part::Refused(format!("{error:#}")),
        };
    }

    /// The session that the set-up leads to.
    fn begin(&self, ready: Ready) -> anyhow::Result<SessionView> {
        let folder = ready.study.directory();
        let Found::Free(directory) = find(folder, &ready.participant)? else {
            anyhow::bail!("{} holds a session of {} by now", folder.display(), ready.participant);
        };
        let header = ready.header(self.arguments.seed(), self.arguments.started_at, software());
        RecentFolders::of_user().remember(folder);
        let sitting = Sitting::fresh(ready.study.clone(), &directory, header)?;
        Ok(SessionView::new(sitting, None, ready.measured))
    }
}

impl eframe::App for Program {
    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        theme::dress_screen(ui);
        match &mut self.part {
            Part::Opening => {
                self.part = Part::Setup(Box::new(self.open_setup(frame)));
                ui.request_repaint();
            }
            Part::Setup(setup) => {
                // Where it is said and nowhere else: to ask the system in every frame holds up what is typed.
                if setup.page() == Page::Summary {
                    let (mut monitors, index) = monitors(frame);
                    setup.find_on(index.map(|index| monitors.swap_remove(index)));
                }
                if let Some(action) = screen::setup(ui, setup) {
                    self.act(action, ui.ctx());
                    ui.request_repaint();
                }
            }
            Part::Session(view) => view.ui(ui, frame),
            Part::Refused(problem) => {
                let words = &words(self.arguments.language).participant;
                if screen::refused(ui, problem, words).is_some() {
                    ui.send_viewport_cmd(egui::ViewportCommand::Close);
                }
            }
        }
    }

    fn raw_input_hook(&mut self, _context: &egui::Context, raw_input: &mut egui::RawInput) {
        if let Part::Session(view) = &mut self.part {
            view.rehearse(raw_input);
        }
    }

    fn on_exit(&mut self) {
        if let Part::Session(view) = &mut self.part {
            *self.outcome.borrow_mut() = view.leave();
        }
    }
}
