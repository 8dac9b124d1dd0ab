//! Keys and what they mean.

use eframe::egui;
use egui::Key;
use scumble_psychophysics::Side;

use crate::screen::Action;

/// The side that a key pressed in this frame names; a key that is held down counts once.
pub(crate) fn side(context: &egui::Context) -> Option<Side> {
    pressed(context).into_iter().find_map(|key| match key {
        Key::ArrowLeft | Key::F => Some(Side::Left),
        Key::ArrowRight | Key::J => Some(Side::Right),
        _ => None,
    })
}

/// `action` if the space bar or the return key was pressed in this frame.
pub(crate) fn go_on(context: &egui::Context, action: Action) -> Option<Action> {
    pressed(context).iter().any(|key| matches!(key, Key::Space | Key::Enter)).then_some(action)
}

/// Whether the participant asked for a pause in this frame.
pub(crate) fn pause(context: &egui::Context) -> bool {
    pressed(context).contains(&Key::Escape)
}

/// Keys that went down in this frame, in order.
fn pressed(context: &egui::Context) -> Vec<Key> {
    let down = |event: &egui::Event| match event {
        egui::Event::Key { key, pressed: true, repeat: false, .. } => Some(*key),
        _ => None,
    };
    context.input(|input| input.events.iter().filter_map(down).collect())
}
