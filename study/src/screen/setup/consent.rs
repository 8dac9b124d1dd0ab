//! The text that the participant agrees to.

use eframe::egui;
use egui::{Frame, Key, ScrollArea, Ui, Vec2};

use super::{focus, widgets};
use crate::setup::Setup;
use crate::theme;
use crate::words::setup::SetupWords;

/// Part of the visible text by which a page key moves it, so that two lines stay to read on from.
const PAGE_SHARE: f32 = 0.85;
/// Points by which an arrow key moves the text, on a screen of usual height: two lines.
const LINES: f32 = 48.0;
/// Room for the line below the text, and around the text.
const BELOW: f32 = 40.0;
const AROUND: f32 = 16.0;

/// See the module.
pub(super) fn consent(ui: &mut Ui, setup: &Setup, words: &SetupWords) {
    let Some(consent) = setup.consent_text() else { return };
    ui.label(words.consent_text);
    let scale = widgets::scale(ui);
    let height = ui.available_height() - (BELOW + 2.0 * AROUND) * scale;
    let margin = widgets::margin(Vec2::splat(AROUND) * scale);
    Frame::new().fill(theme::FIELD).corner_radius(6.0).inner_margin(margin).show(ui, |ui| {
        ScrollArea::vertical().auto_shrink(false).max_height(height).show(ui, |ui| {
            ui.label(&consent.text);
            let page = PAGE_SHARE * height;
            let lines = LINES * scale;
            let moves = [(Key::PageDown, page), (Key::PageUp, -page), (Key::ArrowDown, lines), (Key::ArrowUp, -lines)];
            for (_, points) in moves.into_iter().filter(|(key, _)| focus::pressed(ui, *key)) {
                ui.scroll_with_delta(Vec2::new(0.0, -points));
            }
        });
    });
    if setup.has_agreed() {
        ui.label(words.has_agreed);
    }
}
