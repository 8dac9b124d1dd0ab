//! Optional questions about the participant.

use eframe::egui::Ui;
use scumble_psychophysics::{Experience, Gender, Handedness, Vision};

use super::widgets;
use crate::setup::About;
use crate::words::setup::SetupWords;

/// Width of the line for an age.
const AGE: f32 = 90.0;

/// See the module.
pub(super) fn about(ui: &mut Ui, about: &mut About, words: &SetupWords, is_new: bool) {
    ui.label(words.about_text);
    widgets::named(ui, words.age, |ui| {
        if let Some(age) = widgets::line(ui, words.age, &about.age, "", AGE, is_new).text {
            about.age = age;
        }
    });
    let genders = [Gender::Female, Gender::Male, Gender::Other];
    question(ui, words, words.gender, &mut about.gender, genders, words.genders);
    let hands = [Handedness::Left, Handedness::Right, Handedness::Both];
    question(ui, words, words.hand, &mut about.handedness, hands, words.hands);
    let visions = [Vision::Normal, Vision::Corrected, Vision::Impaired];
    question(ui, words, words.vision, &mut about.vision, visions, words.visions);
    let experiences = [Experience::None, Experience::Some, Experience::Expert];
    question(ui, words, words.experience, &mut about.graphics_experience, experiences, words.experiences);
}

/// A question with three answers, and none.
fn question<T: Copy + PartialEq>(
    ui: &mut Ui,
    words: &SetupWords,
    name: &str,
    answer: &mut Option<T>,
    answers: [T; 3],
    names: [&str; 3],
) {
    widgets::named(ui, name, |ui| {
        let [first, second, third] = std::array::from_fn(|index| (Some(answers[index]), names[index]));
        let offered = [(None, words.no_answer), first, second, third];
        if let Some(picked) = widgets::choice(ui, *answer, &offered) {
            *answer = picked;
        }
    });
}
