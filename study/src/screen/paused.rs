//! A pause, and the first screen of a session that is taken up again.

use eframe::egui::Ui;
use scumble_psychophysics::Progress;

use super::page;
use crate::screen::Action;
use crate::words::participant::ParticipantWords;

/// The screen that hides the pictures; the trial under way begins anew afterwards.
pub(crate) fn paused(ui: &mut Ui, progress: Progress, words: &ParticipantWords) -> Option<Action> {
    page::page(ui, 300.0, words.paused, |ui| {
        ui.label((words.saved)(progress.answered));
        ui.label(words.can_go_on);
        let go_on = page::go_on(ui, words.go_on, words.or_space, Action::Continue);
        let close = ui.button(words.close_window).clicked();
        if close { Some(Action::Close) } else { go_on }
    })
}
