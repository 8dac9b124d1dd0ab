//! Whether an answer in practice was right.

use eframe::egui::Ui;
use scumble_psychophysics::Answer;

use super::page;
use crate::screen::Action;

/// The screen after each practice trial.
pub(crate) fn feedback(ui: &mut Ui, correct: bool, right_answer: Answer) -> Option<Action> {
    let heading = if correct { "Correct" } else { "Not this time" };
    let text = match right_answer {
        Answer::Left | Answer::Right if correct => "That was the line.",
        Answer::Left | Answer::Right => "The line was the other one.",
        Answer::Yes => "It was a line.",
        Answer::No => "It was not a line: it was made of steps.",
    };
    page::page(ui, 180.0, heading, |ui| {
        ui.label(text);
        page::go_on(ui, "Next", Action::Proceed)
    })
}
