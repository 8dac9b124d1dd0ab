//! The light in the room, in the researcher's words.

use eframe::egui;
use egui::{TextEdit, Ui, Vec2};

use super::widgets;
use crate::setup::Setup;
use crate::words::setup::SetupWords;

/// Inside the field to type into, in points of a screen of usual height.
const MARGIN: f32 = 10.0;

/// See the module.
pub(super) fn room(ui: &mut Ui, setup: &mut Setup, words: &SetupWords, is_new: bool) {
    ui.label(words.room_text);
    let field = TextEdit::multiline(&mut setup.room).hint_text(words.room_hint).desired_rows(6);
    let response = ui
        .add(field.desired_width(f32::INFINITY).margin(widgets::margin(Vec2::splat(MARGIN) * widgets::scale(ui))))
        .accessible_name(words.room);
    if is_new {
        response.request_focus();
    }
    widgets::small(ui, words.room_note);
    ui.add_space(18.0);
    ui.label(words.room_next);
}
