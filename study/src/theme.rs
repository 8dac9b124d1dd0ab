//! The look of the participant's screen: one neutral grey, dark type, nothing that competes with the pictures.
//!
//! Pictures are texel for pixel, type is not: it grows with the screen, so that it reads on a display of
//! 3840 x 2160 whose system leaves the scale factor at 1.

use eframe::egui;
use egui::{Color32, CornerRadius, FontFamily, FontId, Rect, Stroke, Style, TextStyle, Ui, Vec2, Visuals};

/// Ground of every screen: half of the signal, so about a fifth of white's light, between the light
/// of both sides of every edge.
pub(crate) const GROUND: Color32 = Color32::from_gray(128);
/// Type.
pub(crate) const INK: Color32 = Color32::from_gray(12);
/// Type that may be overlooked; 4.5 to 1 against the ground.
pub(crate) const FAINT_INK: Color32 = Color32::from_gray(24);
/// Buttons at rest.
pub(crate) const RAISED: Color32 = Color32::from_gray(146);
const HOVERED: Color32 = Color32::from_gray(160);
const PRESSED: Color32 = Color32::from_gray(112);
/// Where somebody types, and text to read closely.
pub(crate) const FIELD: Color32 = Color32::from_gray(190);
/// Empty part of the progress bar.
pub(crate) const TRACK: Color32 = Color32::from_gray(112);

/// Height, in points, of the screen that the sizes below are made for.
const HEIGHT: f32 = 800.0;

/// Sets what no single viewport has for itself.
pub(crate) fn apply(context: &egui::Context) {
    // A participant must not change the scale by a slip of the fingers.
    context.options_mut(|options| options.zoom_with_keyboard = false);
    context.set_theme(egui::Theme::Light);
    context.all_styles_mut(|style| dress(style, 1.0));
}

/// Sets type and colours for what is drawn into `ui`, and gives the factor by which they grew.
pub(crate) fn dress_screen(ui: &mut Ui) -> f32 {
    let scale = scale(ui.max_rect());
    dress(ui.style_mut(), scale);
    scale
}

/// How much larger than life everything but the pictures is, in steps of a half.
pub(crate) fn scale(screen: Rect) -> f32 {
    ((screen.height() / HEIGHT * 2.0).floor() / 2.0).clamp(1.0, 4.0)
}

fn dress(style: &mut Style, scale: f32) {
    let sizes =
        [(TextStyle::Heading, 32.0), (TextStyle::Body, 19.0), (TextStyle::Button, 19.0), (TextStyle::Small, 15.0)];
    let font = |size: f32| FontId::new(size * scale, FontFamily::Proportional);
    style.text_styles.extend(sizes.map(|(name, size)| (name, font(size))));
    style.spacing.button_padding = Vec2::new(22.0, 11.0) * scale;
    style.spacing.item_spacing = Vec2::new(12.0, 14.0) * scale;
    style.interaction.selectable_labels = false;
    style.visuals = visuals();
}

fn visuals() -> Visuals {
    let mut visuals = Visuals::light();
    visuals.panel_fill = GROUND;
    visuals.window_fill = GROUND;
    visuals.override_text_color = Some(INK);
    visuals.extreme_bg_color = FIELD;
    // What a line is for, before anything is typed: 4.5 to 1 against the field.
    visuals.weak_text_color = Some(Color32::from_gray(68));
    visuals.selection.bg_fill = HOVERED;
    visuals.selection.stroke.color = INK;
    visuals.text_cursor.stroke.color = INK;
    let widgets = &mut visuals.widgets;
    for (state, fill) in
        [(&mut widgets.inactive, RAISED), (&mut widgets.hovered, HOVERED), (&mut widgets.active, PRESSED)]
    {
        state.weak_bg_fill = fill;
        state.bg_fill = fill;
        state.bg_stroke = Stroke::NONE;
        state.corner_radius = CornerRadius::same(6);
        state.expansion = 0.0;
    }
    visuals
}
