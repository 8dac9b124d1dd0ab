//! A page of text: a column in the middle of the screen.

use eframe::egui;
use egui::{Align, Layout, RichText, Ui, Vec2};

use crate::keys;
use crate::screen::Action;
use crate::theme;

/// Width of the column, in points: some 70 letters.
const COLUMN: f32 = 640.0;

/// A column of text below a heading, `height` points high in all, in the middle of the screen.
pub(super) fn page<R>(ui: &mut Ui, height: f32, heading: &str, content: impl FnOnce(&mut Ui) -> R) -> R {
    let screen = ui.max_rect();
    ui.painter().rect_filled(screen, 0.0, theme::GROUND);
    let scale = theme::scale(screen);
    let size = Vec2::new((COLUMN * scale).min(screen.width() - 32.0), (height * scale).min(screen.height()));
    let column = egui::Rect::from_center_size(screen.center(), size);
    // Its own identity: a widget must not look for a frame like another screen's in its place.
    let builder = egui::UiBuilder::new().id_salt(heading).max_rect(column).layout(Layout::top_down(Align::Min));
    ui.scope_builder(builder, |ui| {
        ui.heading(heading);
        ui.add_space(4.0);
        content(ui)
    })
    .inner
}

/// The button that goes on, and its keys.
pub(super) fn go_on(ui: &mut Ui, label: &str, or_space: &str, action: Action) -> Option<Action> {
    ui.add_space(10.0);
    let clicked = ui
        .horizontal(|ui| {
            let clicked = ui.button(label).clicked();
            ui.label(RichText::new(or_space).small().color(theme::FAINT_INK));
            clicked
        })
        .inner;
    if clicked { Some(action) } else { keys::go_on(ui.ctx(), action) }
}
