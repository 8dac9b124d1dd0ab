//! Whether an answer in practice was right.

use eframe::egui::Ui;

use super::page;
use crate::screen::Action;

/// The screen after each practice trial.
pub(crate) fn feedback(ui: &mut Ui, correct: bool) -> Option<Action> {
    let (heading, text) =
        if correct { ("Correct", "That was the line.") } else { ("Not this time", "The line was the other one.") };
    page::page(ui, 180.0, heading, |ui| {
        ui.label(text);
        page::go_on(ui, "Next", Action::Proceed)
    })
}
