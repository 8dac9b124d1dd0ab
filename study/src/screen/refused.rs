//! A session that cannot begin or go on.

use eframe::egui::Ui;

use super::page;
use crate::screen::Action;
use crate::words::participant::ParticipantWords;

/// Why.
pub(crate) fn refused(ui: &mut Ui, problem: &str, words: &ParticipantWords) -> Option<Action> {
    page::page(ui, 260.0, words.refused, |ui| {
        ui.label(problem);
        page::go_on(ui, words.close, words.or_space, Action::Close)
    })
}
