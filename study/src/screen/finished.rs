//! The end.

use eframe::egui::Ui;

use super::page;
use crate::screen::Action;
use crate::words::participant::ParticipantWords;

/// The last screen.
pub(crate) fn finished(ui: &mut Ui, words: &ParticipantWords) -> Option<Action> {
    page::page(ui, 180.0, words.thanks, |ui| {
        ui.label(words.all_saved);
        page::go_on(ui, words.close, words.or_space, Action::Close)
    })
}
