//! The end.

use eframe::egui::Ui;

use super::page;
use crate::screen::Action;

/// The last screen.
pub(crate) fn finished(ui: &mut Ui) -> Option<Action> {
    page::page(ui, 180.0, "Thank you", |ui| {
        ui.label("That was the last question. Your answers are saved.");
        page::go_on(ui, "Close", Action::Close)
    })
}
