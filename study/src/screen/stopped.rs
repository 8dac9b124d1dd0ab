//! Something that the program cannot work around.

use std::path::Path;

use eframe::egui::Ui;

use super::page;
use crate::screen::Action;
use crate::words::participant::ParticipantWords;

/// What went wrong, where the answers are, and how to go on.
pub(crate) fn stopped(ui: &mut Ui, problem: &str, directory: &Path, words: &ParticipantWords) -> Option<Action> {
    page::page(ui, 320.0, words.stopped, |ui| {
        ui.label(words.call_someone);
        ui.label(problem);
        ui.label((words.answers_are_in)(&directory.display().to_string()));
        page::go_on(ui, words.close, words.or_space, Action::Close)
    })
}
