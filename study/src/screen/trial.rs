//! Two pictures and the question.
//!
//! The pictures stand on physical pixels around the middle of the screen; everything else takes its
//! place from them. Nothing on the screen depends on which picture is the line.

use eframe::egui;
use egui::{Align2, Button, Pos2, Rect, TextStyle, Ui, Vec2};
use scumble_psychophysics::{Experiment, Progress, Side, Stage};

use super::page;
use crate::presentation::Presentation;
use crate::screen::Action;
use crate::{keys, pixels, theme};

/// Between the pictures, in physical pixels.
const GAP_PX: f32 = 32.0;
/// Room above the pictures for the question, and below for buttons and progress, in points.
const ABOVE: f32 = 96.0;
const BELOW: f32 = 128.0;
const BUTTON: Vec2 = Vec2::new(180.0, 44.0);

/// A trial, in practice or not.
pub(crate) fn trial(
    ui: &mut Ui,
    presentation: &mut Presentation,
    experiment: &Experiment,
) -> anyhow::Result<Option<Action>> {
    let screen = ui.max_rect();
    ui.painter().rect_filled(screen, 0.0, theme::GROUND);
    let protocol = experiment.protocol();
    let size_px = [protocol.picture_width_px, protocol.picture_height_px];
    let places = Places::new(screen, size_px, ui.pixels_per_point());
    if !screen.contains_rect(places.needed) {
        too_small(ui, screen, places.needed);
        return Ok(None);
    }

    // A key that was pressed before the pictures were there is not an answer to them.
    let was_shown = presentation.pictures().is_some();
    let key = keys::side(ui.ctx()).filter(|_| was_shown).map(Action::Answer);
    presentation.advance(ui.ctx(), size_px)?;

    let top = Pos2::new(screen.center().x, places.left.top() - 30.0);
    text(ui, top, Align2::CENTER_BOTTOM, TextStyle::Heading, "Which one was the line?");
    match presentation.pictures() {
        Some([left, right]) => {
            pixels::paint(ui.painter(), left, places.left.center());
            pixels::paint(ui.painter(), right, places.right.center());
        }
        None => text(ui, screen.center(), Align2::CENTER_CENTER, TextStyle::Heading, "+"),
    }
    let clicked = [(Side::Left, places.left, "Left"), (Side::Right, places.right, "Right")]
        .into_iter()
        .filter(|(_, picture, label)| button(ui, *picture, label, was_shown))
        .map(|(side, ..)| Action::Answer(side))
        .next();
    let hint = Pos2::new(screen.center().x, places.left.bottom() + 18.0 + 0.5 * BUTTON.y);
    text(ui, hint, Align2::CENTER_CENTER, TextStyle::Small, "arrow keys, or F and J");
    let is_practice = matches!(experiment.stage(), Stage::Practice(_));
    progress(ui, screen, experiment.progress(), is_practice);
    Ok(key.or(clicked))
}

/// Where the pictures go, in points.
struct Places {
    left: Rect,
    right: Rect,
    /// The pictures with the room that the rest takes.
    needed: Rect,
}

impl Places {
    fn new(screen: Rect, size_px: [u32; 2], pixels_per_point: f32) -> Self {
        let size = Vec2::new(size_px[0] as f32, size_px[1] as f32) / pixels_per_point;
        let aside = Vec2::new(0.5 * (size.x + GAP_PX / pixels_per_point), 0.0);
        let centre = screen.center() + Vec2::new(0.0, 0.5 * (ABOVE - BELOW));
        let [left, right] = [centre - aside, centre + aside].map(|centre| Rect::from_center_size(centre, size));
        let mut needed = left.union(right);
        needed.min.y -= ABOVE;
        needed.max.y += BELOW;
        Self { left, right, needed }
    }
}

fn button(ui: &mut Ui, picture: Rect, label: &str, enabled: bool) -> bool {
    let centre = Pos2::new(picture.center().x, picture.bottom() + 18.0 + 0.5 * BUTTON.y);
    let place = Rect::from_center_size(centre, BUTTON);
    // Always drawn alike, so that nothing flickers beside the pictures.
    ui.put(place, Button::new(label)).clicked() && enabled
}

fn progress(ui: &Ui, screen: Rect, progress: Progress, is_practice: bool) {
    let centre = Pos2::new(screen.center().x, screen.bottom() - 26.0);
    if is_practice {
        text(ui, centre, Align2::CENTER_CENTER, TextStyle::Small, "Practice");
        return;
    }
    let words = format!("Round {} of {}", progress.round, progress.rounds);
    let above = centre - Vec2::new(0.0, 8.0);
    text(ui, above, Align2::CENTER_BOTTOM, TextStyle::Small, &words);
    let track = Rect::from_center_size(centre, Vec2::new(240.0, 4.0));
    // The most that may come only shrinks, so the bar only grows.
    let done = progress.trials as f32 / progress.trials_at_most.max(1) as f32;
    let filled = Rect::from_min_size(track.min, Vec2::new(track.width() * done, track.height()));
    ui.painter().rect_filled(track, 2.0, theme::TRACK);
    ui.painter().rect_filled(filled, 2.0, theme::FAINT_INK);
}

fn text(ui: &Ui, place: Pos2, anchor: Align2, style: TextStyle, words: &str) {
    ui.painter().text(place, anchor, words, style.resolve(ui.style()), theme::INK);
}

/// In place of pictures that would be cut off.
fn too_small(ui: &mut Ui, screen: Rect, needed: Rect) {
    let scale = ui.pixels_per_point();
    let pixels = |rect: Rect| format!("{:.0} x {:.0}", rect.width() * scale, rect.height() * scale);
    page::page(ui, 200.0, "The window is too small", |ui| {
        ui.label(format!(
            "The pictures need {} physical pixels, the window has {}. Make it larger, or choose a \
             display with more pixels.",
            pixels(needed),
            pixels(screen)
        ));
    });
}
