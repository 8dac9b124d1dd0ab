//! A pause, and the first screen of a session that is taken up again.

use eframe::egui::Ui;
use scumble_psychophysics::Progress;

use super::page;
use crate::screen::Action;

/// The screen that hides the pictures; the trial under way begins anew afterwards.
pub(crate) fn paused(ui: &mut Ui, progress: Progress) -> Option<Action> {
    page::page(ui, 300.0, "Paused", |ui| {
        ui.label(match progress.answered {
            0 => "Your answers are saved.".to_owned(),
            1 => "One trial is answered and saved.".to_owned(),
            trials => format!("{trials} trials are answered and saved."),
        });
        ui.label("You can go on, or close the window and continue on another day.");
        let go_on = page::go_on(ui, "Go on", Action::Continue);
        let close = ui.button("Close the window").clicked();
        if close { Some(Action::Close) } else { go_on }
    })
}
