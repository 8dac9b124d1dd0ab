//! Whether an answer in practice was right.

use eframe::egui::Ui;
use scumble_psychophysics::Answer;

use super::page;
use crate::screen::Action;
use crate::words::participant::ParticipantWords;

/// The screen after each practice trial.
pub(crate) fn feedback(ui: &mut Ui, correct: bool, right_answer: Answer, words: &ParticipantWords) -> Option<Action> {
    let heading = if correct { words.correct } else { words.wrong };
    let text = match right_answer {
        Answer::Left | Answer::Right if correct => words.that_was_the_line,
        Answer::Left | Answer::Right => words.the_other_was,
        Answer::Yes => words.was_line,
        Answer::No => words.was_steps,
    };
    page::page(ui, 180.0, heading, |ui| {
        ui.label(text);
        page::go_on(ui, words.next, words.or_space, Action::Proceed)
    })
}
