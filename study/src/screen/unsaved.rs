//! An answer that the disk has not taken yet.

use eframe::egui::Ui;

use super::page;
use crate::screen::Action;
use crate::words::participant::ParticipantWords;

/// What the disk says, and that nothing is lost; the program tries again by itself.
pub(crate) fn unsaved(ui: &mut Ui, problem: &str, words: &ParticipantWords) -> Option<Action> {
    page::page(ui, 360.0, words.cannot_save, |ui| {
        ui.label(words.kept_in_memory);
        ui.small(problem);
        ui.label(words.tries_again);
        page::go_on(ui, words.try_again, words.or_space, Action::Retry)
    })
}
