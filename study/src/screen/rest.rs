//! The rest before each round and within long ones.

use eframe::egui::Ui;
use scumble_psychophysics::Task;

use super::page;
use crate::screen::Action;
use crate::words::participant::ParticipantWords;

/// The screen before round `round` of `rounds`, or in the middle of it.
pub(crate) fn rest(
    ui: &mut Ui,
    task: Task,
    [round, rounds]: [u32; 2],
    within_round: bool,
    words: &ParticipantWords,
) -> Option<Action> {
    let heading = if within_round { words.rest_in_round } else { words.round_of };
    let text = match (round, within_round, task) {
        (1, false, Task::TwoAlternative) => words.it_counts_two,
        (1, false, Task::YesNo) => words.it_counts_one,
        _ => words.rest,
    };
    page::page(ui, 240.0, &heading(round, rounds), |ui| {
        ui.label(text);
        page::go_on(ui, words.go_on, words.or_space, Action::Proceed)
    })
}
