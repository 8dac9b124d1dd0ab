//! Something that the program cannot work around.

use std::path::Path;

use eframe::egui::Ui;

use super::page;
use crate::screen::Action;

/// What went wrong, where the answers are, and how to go on.
pub(crate) fn stopped(ui: &mut Ui, problem: &str, directory: &Path) -> Option<Action> {
    page::page(ui, 320.0, "The session has stopped", |ui| {
        ui.label("Please call the person who runs the study.");
        ui.label(problem);
        ui.label(format!(
            "The answers given so far are in {}. When the cause is removed, --resume goes on from there.",
            directory.display()
        ));
        page::go_on(ui, "Close", Action::Close)
    })
}
