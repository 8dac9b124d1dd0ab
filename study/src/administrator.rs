//! The administrator's side of a session: where the panel is, what it is told, and what is ordered there.
//!
//! With a second monitor the panel is a window on it. With one it is a page over the participant's screen,
//! which F10 opens and closes; the session is paused under it, and the charts come after a page that says for whom
//! they are.

use eframe::egui;

use crate::desk::{self, Bands, DeskState, DeskWindow, Disk, Given, Order, Status, other_monitor};
use crate::keys::{self, Passage};
use crate::screen;
use crate::sitting::Sitting;
use crate::words::desk::DeskWords;

/// The administrator of a session.
pub(crate) struct Administrator {
    words: &'static DeskWords,
    place: Place,
    bands: Bands,
    /// Whether something has happened that the panel does not show.
    has_news: bool,
    /// Round that was over when the latest order, to repeat it, came.
    refused_round: Option<u32>,
}

enum Place {
    /// Until the first frame, when the monitors are known.
    Unknown,
    Window(DeskWindow),
    /// Over the participant's screen.
    Page {
        status: Option<Box<Status>>,
        state: DeskState,
        opened: Opened,
    },
}

/// How far the panel over the participant's screen was opened.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Opened {
    Closed,
    /// The page before it is on show.
    AskedFor,
    Open,
}

impl Administrator {
    pub(crate) fn new(words: &'static DeskWords) -> Self {
        Self { words, place: Place::Unknown, bands: Bands::default(), has_news: true, refused_round: None }
    }

    /// Keeps the window open, opens or closes the panel where somebody asked for it, and gives the orders of the
    /// window; to be called in every frame.
    pub(crate) fn attend(&mut self, context: &egui::Context, frame: &eframe::Frame) -> Vec<Order> {
        if let Place::Unknown = self.place {
            self.place = match other_monitor(frame) {
                Some(other) => Place::Window(DeskWindow::new(self.words, Some(other))),
                None => Place::Page { status: None, state: DeskState::default(), opened: Opened::Closed },
            };
        }
        let is_asked_for = keys::administrator(context);
        match &mut self.place {
            Place::Window(window) => {
                if is_asked_for {
                    window.toggle(context);
                }
                window.show(context);
                window.take_orders()
            }
            Place::Page { opened, .. } => {
                if is_asked_for {
                    *opened = if *opened == Opened::Closed { Opened::AskedFor } else { Opened::Closed };
                    context.request_repaint();
                }
                Vec::new()
            }
            Place::Unknown => Vec::new(),
        }
    }

    /// Whether the panel, or the page before it, is over the participant's screen.
    pub(crate) fn covers_screen(&self) -> bool {
        matches!(self.place, Place::Page { opened: Opened::AskedFor | Opened::Open, .. })
    }

    /// The panel over the participant's screen, or the page before it.
    pub(crate) fn show(&mut self, ui: &mut egui::Ui) -> Option<Order> {
        match &mut self.place {
            Place::Page { opened: opened @ Opened::AskedFor, .. } => {
                if let Some(passage) = screen::in_charge(ui, self.words) {
                    *opened = if passage == Passage::On { Opened::Open } else { Opened::Closed };
                    // The panel finds its place in its first frame and takes it in the second.
                    ui.request_repaint();
                }
                None
            }
            Place::Page { status: Some(status), state, .. } => desk::show(ui, status, state, self.words),
            _ => None,
        }
    }

    /// Leaves the participant's screen to the participant.
    pub(crate) fn uncover_screen(&mut self) {
        if let Place::Page { opened, .. } = &mut self.place {
            *opened = Opened::Closed;
        }
    }

    /// Something has happened.
    pub(crate) fn note_news(&mut self) {
        self.has_news = true;
    }

    /// An order was carried out, or was not: the round that it was to repeat was over.
    pub(crate) fn answer_order(&mut self, refused_round: Option<u32>) {
        self.refused_round = refused_round;
        self.has_news = true;
    }

    /// Shows the session as it is, where that is news, and why the program cannot go on, where it cannot. Errors:
    /// those of [`Status::of`].
    pub(crate) fn tell(
        &mut self,
        context: &egui::Context,
        sitting: &Sitting,
        stopped: Option<&str>,
    ) -> anyhow::Result<()> {
        if !std::mem::take(&mut self.has_news) {
            return Ok(());
        }
        let recorder = sitting.recorder();
        let disk = match recorder.problem() {
            Some(problem) => Disk::Waiting { problem: problem.into() },
            None => Disk::Saved,
        };
        let given = Given {
            experiment: sitting.experiment(),
            header: recorder.header(),
            events: recorder.events(),
            elapsed_secs: sitting.elapsed_secs(),
            has_begun: recorder.has_begun(),
            is_paused: sitting.is_paused(),
            stopped,
            refused_round: self.refused_round,
            other_display: sitting.other_display(),
            disk,
        };
        let status = Status::of(given, &mut self.bands)?;
        match &mut self.place {
            Place::Window(window) => window.publish(context, status),
            Place::Page { status: shown, .. } => *shown = Some(Box::new(status)),
            Place::Unknown => {}
        }
        Ok(())
    }
}
