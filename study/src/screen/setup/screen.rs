//! Viewing distance, and the size of a pixel by a bank card held against the screen.

use eframe::egui;
use egui::{Color32, CursorIcon, Rect, Sense, Ui, Vec2};

use super::{focus, widgets};
use crate::setup::{Setup, arcmin};
use crate::words::setup::SetupWords;
use crate::{pixels, theme};

/// Width of the column of text, in points of a screen of usual height.
const TEXT: f32 = 380.0;
/// Between the text and the card.
const GAP: f32 = 24.0;
/// Pixels by which an arrow key changes the outline; 1 with Shift.
const STEP_PX: i32 = 5;
/// Width of the line for the distance.
const DISTANCE: f32 = 90.0;
/// The card's face and the contacts on it: lighter and darker than the ground.
const FACE: Color32 = Color32::from_gray(212);
const CONTACTS: Color32 = Color32::from_gray(150);

/// See the module.
pub(super) fn screen(ui: &mut Ui, setup: &mut Setup, words: &SetupWords, is_new: bool) {
    let scale_factor = f64::from(ui.pixels_per_point());
    ui.horizontal_top(|ui| {
        let has_distance = ui.vertical(|ui| {
            ui.set_width(TEXT * widgets::scale(ui));
            ui.label(words.distance_text);
            let entered = ui.horizontal(|ui| {
                let distance_cm = &setup.calibration.distance_cm;
                let typed = widgets::line(ui, words.distance_text, distance_cm, "", DISTANCE, is_new);
                if let Some(distance_cm) = typed.text {
                    setup.calibration.distance_cm = distance_cm;
                }
                ui.label("cm");
                typed.entered
            });
            ui.label(words.card_text);
            let offered = [(true, words.card_matches), (false, words.not_measured)];
            if let Some(matched) = widgets::choice(ui, setup.calibration.matched, &offered) {
                setup.calibration.set_matched(matched, scale_factor);
            }
            results(ui, setup, words);
            entered.inner
        });
        ui.add_space(GAP * widgets::scale(ui));
        card(ui, setup, words, scale_factor, has_distance.inner);
    });
}

/// What follows from the entries: of what is not measured, that it is not.
fn results(ui: &mut Ui, setup: &Setup, words: &SetupWords) {
    let calibration = &setup.calibration;
    let row = |ui: &mut Ui, name: &str, value: String| ui.label(format!("{name}:  {value}"));
    row(ui, words.pixel_size, (words.pixel_size_value)(calibration.px_per_mm()));
    row(ui, words.pixel_angle, (words.pixel_angle_value)(calibration.px_per_degree()));
    let texels_px = setup.study().opened().map(|opened| &opened.study.protocol().conditions.texels_px);
    if let Some((texels_px, px_per_degree)) = texels_px.zip(calibration.px_per_degree()) {
        let sizes: Vec<(f64, f64)> = texels_px.iter().map(|texel| (*texel, arcmin(*texel, px_per_degree))).collect();
        row(ui, words.texels, (words.texels_value)(&sizes));
    }
}

/// The outline, to be made as large as the card: its left edge stays, so that the card can lie against it.
fn card(ui: &mut Ui, setup: &mut Setup, words: &SetupWords, scale_factor: f64, takes_keyboard: bool) {
    let calibration = &mut setup.calibration;
    let room = ui.available_rect_before_wrap();
    let [width_px, height_px] = calibration.card_px(scale_factor).map(|side| side as f32 / ui.pixels_per_point());
    let rect =
        pixels::to_whole_pixels(Rect::from_min_size(room.min, Vec2::new(width_px, height_px)), ui.pixels_per_point());
    let response = ui.allocate_rect(rect, Sense::drag()).on_hover_cursor(CursorIcon::ResizeHorizontal);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Slider, true, words.card));
    paint(ui, rect);

    if takes_keyboard || response.drag_started() {
        response.request_focus();
    }
    let dragged_px = (response.drag_delta().x * ui.pixels_per_point()).round() as i32;
    let by_px = focus::arrow_steps(ui, &response, STEP_PX) + dragged_px;
    if by_px != 0 {
        let most = room.width().min(room.height() * rect.aspect_ratio()) * ui.pixels_per_point();
        calibration.widen(by_px, scale_factor, most as u32);
    }
    if focus::confirmed(ui, &response) {
        calibration.confirm();
    }
}

/// A card with sharp edges, and contacts that tell which way it lies.
fn paint(ui: &Ui, rect: Rect) {
    pixels::fill(ui.painter(), rect, FACE);
    let contacts = Rect::from_min_size(rect.lerp_inside(Vec2::new(0.12, 0.35)), rect.size() * Vec2::new(0.14, 0.2));
    ui.painter().rect_filled(contacts, 4.0, CONTACTS);
    let stripe = Rect::from_min_max(rect.lerp_inside(Vec2::new(0.12, 0.76)), rect.lerp_inside(Vec2::new(0.7, 0.82)));
    ui.painter().rect_filled(stripe, 2.0, CONTACTS);
    let arrow = 0.08 * rect.width();
    let tail = rect.right_center() - Vec2::new(1.3 * arrow, 0.0);
    ui.painter().arrow(tail, Vec2::new(arrow, 0.0), egui::Stroke::new(2.0, theme::INK));
}
