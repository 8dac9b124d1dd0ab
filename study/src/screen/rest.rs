//! The rest before each round.

use eframe::egui::Ui;

use super::page;
use crate::screen::Action;

/// The screen before round `round` of `rounds`.
pub(crate) fn rest(ui: &mut Ui, round: u32, rounds: u32) -> Option<Action> {
    page::page(ui, 240.0, &format!("Round {round} of {rounds}"), |ui| {
        ui.label(if round == 1 {
            "From here on your answers count, and you are not told whether they were right. \
             Pairs that look alike are part of it: guess."
        } else {
            "Rest your eyes for a moment: look up and into the distance. \
             Go on when you are ready."
        });
        page::go_on(ui, "Go on", Action::Proceed)
    })
}
