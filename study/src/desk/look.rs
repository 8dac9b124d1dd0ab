//! The look of the administrator's window, dark and light.
//!
//! It is set on the [`Ui`] that is drawn into and nowhere else: the participant's screen, in the same process and
//! perhaps in the same window, has a grey of its own.

use eframe::egui;
use egui::{Color32, CornerRadius, FontFamily, FontId, Stroke, StrokeKind, TextStyle, Ui, Vec2, Visuals};

use crate::theme;

/// Colours with a meaning. Type has a contrast of at least 4.5 to 1 on both grounds.
#[derive(Clone, Copy)]
pub(super) struct Palette {
    pub(super) ground: Color32,
    /// Of charts and fields.
    pub(super) card: Color32,
    pub(super) ink: Color32,
    pub(super) faint_ink: Color32,
    pub(super) line: Color32,
    button: Color32,
    button_hovered: Color32,
    /// Blue and orange of Okabe and Ito, "Color Universal Design" (2008): told apart with every kind of colour
    /// vision. The shape of the mark says the same.
    pub(super) right: Color32,
    pub(super) wrong: Color32,
    pub(super) band: Color32,
}

const DARK: Palette = Palette {
    ground: Color32::from_rgb(24, 26, 30),
    card: Color32::from_rgb(33, 36, 41),
    ink: Color32::from_rgb(230, 232, 235),
    faint_ink: Color32::from_rgb(168, 174, 183),
    line: Color32::from_rgb(66, 71, 80),
    button: Color32::from_rgb(52, 57, 65),
    button_hovered: Color32::from_rgb(68, 74, 84),
    right: Color32::from_rgb(86, 180, 233),
    wrong: Color32::from_rgb(230, 159, 0),
    band: Color32::from_rgb(52, 70, 84),
};

const LIGHT: Palette = Palette {
    ground: Color32::from_rgb(240, 241, 243),
    card: Color32::from_rgb(255, 255, 255),
    ink: Color32::from_rgb(22, 24, 28),
    faint_ink: Color32::from_rgb(84, 91, 101),
    line: Color32::from_rgb(196, 201, 208),
    button: Color32::from_rgb(221, 225, 230),
    button_hovered: Color32::from_rgb(206, 212, 219),
    right: Color32::from_rgb(0, 114, 178),
    // Darker than the vermilion of the set, for type on the light ground.
    wrong: Color32::from_rgb(176, 72, 0),
    band: Color32::from_rgb(210, 227, 239),
};

/// Sizes and colours of one frame.
#[derive(Clone, Copy)]
pub(super) struct Look {
    pub(super) palette: Palette,
    /// How much larger than life everything is; see [`theme::scale`].
    pub(super) scale: f32,
}

/// Sets type and colours for what is drawn into `ui`, and paints its ground.
pub(super) fn dress(ui: &mut Ui, is_dark: bool) -> Look {
    let screen = ui.max_rect();
    let look = Look { palette: if is_dark { DARK } else { LIGHT }, scale: theme::scale(screen) };
    let sizes =
        [(TextStyle::Heading, 22.0), (TextStyle::Body, 14.0), (TextStyle::Button, 14.0), (TextStyle::Small, 12.5)];
    let style = ui.style_mut();
    let font = |size: f32| FontId::new(size * look.scale, FontFamily::Proportional);
    style.text_styles.extend(sizes.map(|(name, size)| (name, font(size))));
    style.spacing.button_padding = Vec2::new(12.0, 5.0) * look.scale;
    style.spacing.item_spacing = Vec2::new(10.0, 4.0) * look.scale;
    style.spacing.interact_size.y = 26.0 * look.scale;
    style.interaction.selectable_labels = false;
    style.visuals = look.visuals(is_dark);
    ui.painter().rect_filled(screen, 0.0, look.palette.ground);
    look
}

impl Look {
    fn visuals(&self, is_dark: bool) -> Visuals {
        let palette = &self.palette;
        let mut visuals = if is_dark { Visuals::dark() } else { Visuals::light() };
        visuals.override_text_color = Some(palette.ink);
        visuals.panel_fill = palette.ground;
        visuals.window_fill = palette.ground;
        visuals.extreme_bg_color = palette.card;
        visuals.weak_text_color = Some(palette.faint_ink);
        visuals.disabled_alpha = 0.55;
        visuals.selection.bg_fill = palette.band;
        visuals.selection.stroke = Stroke::new(1.0, palette.ink);
        let widgets = &mut visuals.widgets;
        widgets.noninteractive.bg_stroke = Stroke::new(1.0, palette.line);
        for (state, fill) in [
            (&mut widgets.inactive, palette.button),
            (&mut widgets.hovered, palette.button_hovered),
            (&mut widgets.active, palette.button_hovered),
        ] {
            state.weak_bg_fill = fill;
            state.bg_fill = fill;
            state.bg_stroke = Stroke::new(1.0, palette.line);
            state.corner_radius = CornerRadius::same(5);
            state.expansion = 0.0;
        }
        visuals
    }

    /// A ring around the widget that has the keyboard.
    pub(super) fn ring(&self, ui: &Ui) {
        let focused = ui.memory(|memory| memory.focused()).and_then(|id| ui.ctx().read_response(id));
        if let Some(response) = focused {
            let rect = response.rect.expand(2.0 * self.scale);
            let stroke = Stroke::new(2.0 * self.scale, self.palette.right);
            ui.painter().rect_stroke(rect, 6.0 * self.scale, stroke, StrokeKind::Outside);
        }
    }
}
