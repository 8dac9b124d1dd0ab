//! Keys and what they mean.

use eframe::egui;
use egui::Key;
use scumble_psychophysics::Answer;

use crate::screen::Action;

/// The one of the two answers, left and right on the screen, that a key pressed in this frame gives;
/// a key that is held down counts once.
pub(crate) fn answer(context: &egui::Context, answers: [Answer; 2]) -> Option<Answer> {
    pressed(context).into_iter().find_map(|key| answer_of(key, answers))
}

/// `action` if the space bar or the return key was pressed in this frame.
pub(crate) fn go_on(context: &egui::Context, action: Action) -> Option<Action> {
    pressed(context).iter().any(|key| matches!(key, Key::Space | Key::Enter)).then_some(action)
}

/// Whether the participant asked for a pause in this frame.
pub(crate) fn pause(context: &egui::Context) -> bool {
    pressed(context).contains(&Key::Escape)
}

/// Whether somebody asked for the administrator's panel in this frame.
pub(crate) fn administrator(context: &egui::Context) -> bool {
    pressed(context).contains(&Key::F10)
}

/// Where somebody goes from the page before the administrator's panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Passage {
    /// To the panel.
    On,
    /// To the participant's screen.
    Back,
}

/// Where return and escape lead, if one was pressed in this frame.
pub(crate) fn passage(context: &egui::Context) -> Option<Passage> {
    pressed(context).into_iter().find_map(|key| match key {
        Key::Enter => Some(Passage::On),
        Key::Escape => Some(Passage::Back),
        _ => None,
    })
}

/// What a key answers: the arrows by the place of the answer; of two pictures, F and J too; yes and no by their
/// first letters, of which J is the German one and so can have no place.
fn answer_of(key: Key, answers: [Answer; 2]) -> Option<Answer> {
    let letter = match (key, answers) {
        (Key::F, [Answer::Left, _]) => Some(Answer::Left),
        (Key::J, [_, Answer::Right]) => Some(Answer::Right),
        (Key::Y | Key::J, [Answer::Yes, _]) => Some(Answer::Yes),
        (Key::N, [_, Answer::No]) => Some(Answer::No),
        _ => None,
    };
    match key {
        Key::ArrowLeft => Some(answers[0]),
        Key::ArrowRight => Some(answers[1]),
        _ => letter,
    }
}

/// Keys that went down in this frame, in order.
fn pressed(context: &egui::Context) -> Vec<Key> {
    let down = |event: &egui::Event| match event {
        egui::Event::Key { key, pressed: true, repeat: false, .. } => Some(*key),
        _ => None,
    };
    context.input(|input| input.events.iter().filter_map(down).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrows_name_a_place_f_and_j_a_picture_and_y_j_and_n_a_word() {
        let given = |answers: [Answer; 2]| {
            [Key::ArrowLeft, Key::F, Key::Y, Key::ArrowRight, Key::J, Key::N, Key::Space].map(|k| answer_of(k, answers))
        };
        let [left, right, yes, no] = [Answer::Left, Answer::Right, Answer::Yes, Answer::No].map(Some);
        assert_eq!(given([Answer::Left, Answer::Right]), [left, left, None, right, right, None, None]);
        assert_eq!(given([Answer::Yes, Answer::No]), [yes, None, yes, no, yes, no, None]);
    }
}
