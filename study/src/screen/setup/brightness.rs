//! The display's tone curve: measured with a photometer, else checked by eye.

use eframe::egui;
use egui::{Align2, Color32, Pos2, Rect, Sense, Stroke, TextStyle, Ui, Vec2};
use scumble_stimuli::Transfer;

use super::{focus, widgets};
use crate::setup::{LuminanceTable, Setup};
use crate::words::setup::SetupWords;
use crate::{pixels, theme};

/// Side of each of the two fields, in points of a screen of usual height.
const FIELD: f32 = 290.0;
/// Levels by which an arrow key changes the grey; 1 with Shift.
const STEP: i32 = 4;
/// Size of the curve, and the room for its axes.
const CURVE: Vec2 = Vec2::new(440.0, 340.0);
const AXES: f32 = 30.0;
/// Between the fields or the curve and the text.
const GAP: f32 = 24.0;

/// See the module.
pub(super) fn brightness(ui: &mut Ui, setup: &mut Setup, words: &SetupWords, is_new: bool) {
    ui.horizontal_top(|ui| {
        if let Some(table) = setup.luminance() {
            curve(ui, table, words);
            ui.add_space(GAP * widgets::scale(ui));
            ui.vertical(|ui| ui.label((words.table_text)(&table.rows)));
            return;
        }
        fields(ui, setup, words, is_new);
        ui.add_space(GAP * widgets::scale(ui));
        ui.vertical(|ui| {
            ui.label(words.gamma_text);
            let offered = [(true, words.gamma_alike), (false, words.not_checked)];
            if let Some(matched) = widgets::choice(ui, setup.gamma.matched, &offered) {
                setup.gamma.matched = matched;
            }
            ui.label((words.gamma_result)(setup.gamma.matched_level()));
        });
    });
}

/// Rows of black and white, and the grey beside them without a gap.
fn fields(ui: &mut Ui, setup: &mut Setup, words: &SetupWords, takes_keyboard: bool) {
    let side = FIELD * widgets::scale(ui);
    let (rect, response) = ui.allocate_exact_size(Vec2::new(2.0 * side, side), Sense::click());
    let level = setup.gamma.level();
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Slider, true, words.grey));
    let rows = pixels::to_whole_pixels(Rect::from_min_size(rect.min, Vec2::splat(side)), ui.pixels_per_point());
    let grey = Rect::from_min_size(rows.right_top(), rows.size());
    pixels::fill_rows(ui.painter(), rows, [Color32::BLACK, Color32::WHITE]);
    pixels::fill(ui.painter(), grey, Color32::from_gray(level));

    if takes_keyboard || response.clicked() {
        response.request_focus();
    }
    let by = focus::arrow_steps(ui, &response, STEP);
    if by != 0 {
        setup.gamma.lighten(by.clamp(i8::MIN.into(), i8::MAX.into()) as i8);
    }
    if focus::confirmed(ui, &response) {
        setup.gamma.confirm();
    }
}

/// The measured light of every level over the levels, its rows as dots, and sRGB's in faint.
fn curve(ui: &mut Ui, table: &LuminanceTable, words: &SetupWords) {
    let scale = widgets::scale(ui);
    let (rect, _) = ui.allocate_exact_size(CURVE * scale, Sense::empty());
    ui.painter().rect_filled(rect, 6.0, theme::FIELD);
    let plot = rect.shrink(AXES * scale);
    let place = |level: f32, light: f32| {
        Pos2::new(egui::lerp(plot.x_range(), level / 255.0), egui::lerp(plot.bottom()..=plot.top(), light))
    };
    let line = |transfer: &Transfer| {
        (0..=255u8).map(|level| place(level.into(), transfer.light(level) as f32)).collect::<Vec<_>>()
    };
    ui.painter().line(line(&Transfer::srgb()), Stroke::new(6.0 * scale, theme::GROUND));
    ui.painter().line(line(&table.transfer), Stroke::new(2.0 * scale, theme::INK));
    for (level, _) in &table.rows {
        ui.painter().circle_filled(
            place((*level).into(), table.transfer.light(*level) as f32),
            4.0 * scale,
            theme::INK,
        );
    }
    let text = |place: Pos2, anchor: Align2, words: &str| {
        ui.painter().text(place, anchor, words, TextStyle::Small.resolve(ui.style()), theme::INK)
    };
    let white = table.rows.last().map_or(0.0, |row| row.1);
    text(rect.left_top() + Vec2::splat(8.0 * scale), Align2::LEFT_TOP, &(words.luminance)(white));
    for level in [0u8, 128, 255] {
        let foot = Pos2::new(place(level.into(), 0.0).x, rect.bottom() - 4.0 * scale);
        text(foot, Align2::CENTER_BOTTOM, &level.to_string());
    }
}
