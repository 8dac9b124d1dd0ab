//! The rest before each round and within long ones.

use eframe::egui::Ui;
use scumble_psychophysics::Task;

use super::page;
use crate::screen::Action;

/// The screen before round `round` of `rounds`, or in the middle of it.
pub(crate) fn rest(ui: &mut Ui, task: Task, round: u32, rounds: u32, within_round: bool) -> Option<Action> {
    let heading = match within_round {
        true => format!("A rest in round {round} of {rounds}"),
        false => format!("Round {round} of {rounds}"),
    };
    let text = match (round, within_round, task) {
        (1, false, Task::TwoAlternative) => {
            "From here on your answers count, and you are not told whether they were right. \
             Pairs that look alike are part of it: guess."
        }
        (1, false, Task::YesNo) => {
            "From here on your answers count, and you are not told whether they were right. \
             Pictures that leave you in doubt are part of it: say what seems more likely."
        }
        _ => {
            "Rest your eyes for a moment: look up and into the distance. \
             Go on when you are ready."
        }
    };
    page::page(ui, 240.0, &heading, |ui| {
        ui.label(text);
        page::go_on(ui, "Go on", Action::Proceed)
    })
}
