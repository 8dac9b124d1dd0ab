//! Parts that several pages are made of. Sizes are in points of a screen of usual height; see [`scale`].

use eframe::egui;
use egui::{Frame, Key, Label, Margin, RichText, TextEdit, TextStyle, Ui, Vec2};

use super::focus;
use crate::theme;

/// Around the text of a notice, and inside a line to type into.
const NOTICE: f32 = 10.0;
const LINE: Vec2 = Vec2::new(8.0, 5.0);
/// Width of the names of fields: the longest German one.
const NAME_WIDTH: f32 = 190.0;
/// Height of a row of a form: a line to type into.
const ROW: f32 = 32.0;
/// Side of the ring of a choice, and of the dot in it.
const RADIO: [f32; 2] = [20.0, 10.0];

/// How much larger than life the type of this screen is; every size on a page grows with it.
pub(super) fn scale(ui: &Ui) -> f32 {
    theme::scale(ui.ctx().content_rect())
}

/// Something that somebody has to read: dark type on a lighter field.
pub(super) fn notice(ui: &mut Ui, text: &str) {
    let margin = margin(Vec2::splat(NOTICE) * scale(ui));
    Frame::new().fill(theme::RAISED).corner_radius(6.0).inner_margin(margin).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.label(text);
    });
}

/// Height that a notice of this width takes, with the space around it.
pub(super) fn notice_height(ui: &Ui, text: &str, width: f32) -> f32 {
    let around = 2.0 * NOTICE * scale(ui);
    let font = TextStyle::Body.resolve(ui.style());
    let galley = ui.painter().layout(text.to_owned(), font, theme::INK, width - around);
    galley.size().y + around + ui.spacing().item_spacing.y
}

/// A row of a form: a name, and what belongs to it in a column beside.
pub(super) fn named<R>(ui: &mut Ui, name: &str, content: impl FnOnce(&mut Ui) -> R) -> R {
    let scale = scale(ui);
    let row = |ui: &mut Ui| {
        ui.allocate_ui(Vec2::new(NAME_WIDTH, ROW) * scale, |ui| {
            ui.set_min_size(Vec2::new(NAME_WIDTH, ROW) * scale);
            ui.horizontal_centered(|ui| ui.label(name));
        });
        ui.vertical(|ui| {
            // The first line of the column is as high as the name, so that both stand on one line.
            ui.spacing_mut().interact_size.y = ROW * scale;
            content(ui)
        })
        .inner
    };
    ui.horizontal_top(row).inner
}

/// A row of a list: a name and a value. What is missing stands out.
pub(super) fn fact(ui: &mut Ui, name: &str, value: &str, is_missing: bool) {
    let width = NAME_WIDTH * scale(ui);
    ui.horizontal_top(|ui| {
        let left = ui.cursor().left();
        ui.label(name);
        ui.add_space(left + width - ui.cursor().left());
        let value = RichText::new(value);
        let value = if is_missing { value.background_color(theme::FIELD) } else { value };
        ui.add(Label::new(value).wrap());
    });
}

/// What was done to a line in this frame.
pub(super) struct Typed {
    /// What it holds, where that changed.
    pub(super) text: Option<String>,
    /// Whether it was left by the return key.
    pub(super) entered: bool,
}

/// A line to type into.
pub(super) fn line(ui: &mut Ui, name: &str, text: &str, hint: &str, width: f32, takes_keyboard: bool) -> Typed {
    let mut text = text.to_owned();
    let scale = scale(ui);
    let edit = TextEdit::singleline(&mut text).hint_text(hint).desired_width(width * scale);
    // Named by what it asks for and not by its place: the keyboard stays with it when rows above it come or go.
    let response = ui.add(edit.id_salt(name).margin(margin(LINE * scale))).accessible_name(name);
    if takes_keyboard {
        response.request_focus();
    }
    let entered = response.lost_focus() && focus::pressed(ui, Key::Enter);
    Typed { text: response.changed().then_some(text), entered }
}

/// One of several, side by side. Gives the one that was picked in this frame.
pub(super) fn choice<T: Copy + PartialEq>(ui: &mut Ui, chosen: T, offered: &[(T, &str)]) -> Option<T> {
    let row = |ui: &mut Ui| {
        ui.spacing_mut().item_spacing.x *= 2.0;
        offered.iter().filter_map(|(value, name)| radio(ui, *value == chosen, name).then_some(*value)).last()
    };
    ui.horizontal_wrapped(row).inner
}

/// One of several; whether it was picked in this frame.
pub(super) fn radio(ui: &mut Ui, is_chosen: bool, name: &str) -> bool {
    let [ring, dot] = RADIO.map(|side| side * scale(ui));
    let draw = |ui: &mut Ui| {
        let spacing = ui.spacing_mut();
        (spacing.icon_width, spacing.icon_width_inner, spacing.icon_spacing) = (ring, dot, dot);
        ui.radio(is_chosen, name).clicked()
    };
    ui.scope(draw).inner
}

/// Small type below something.
pub(super) fn small(ui: &mut Ui, text: impl Into<String>) {
    ui.add(Label::new(RichText::new(text).small().color(theme::FAINT_INK)).wrap());
}

/// A margin of whole points, which is what egui has.
pub(super) fn margin(size: Vec2) -> Margin {
    Margin::symmetric(size.x as i8, size.y as i8)
}
