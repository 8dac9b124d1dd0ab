//! One or two pictures and the question.
//!
//! The pictures stand on physical pixels around the middle of the screen; everything else takes its
//! place from them. Nothing on the screen depends on the right answer or on the trial's role.

use eframe::egui;
use egui::{Align2, Button, Pos2, Rect, TextStyle, Ui, Vec2};
use scumble_psychophysics::{Answer, Experiment, Protocol, Stage, Task};

use super::{page, question};
use crate::presentation::{Presentation, Screen};
use crate::screen::Action;
use crate::words::participant::ParticipantWords;
use crate::{pixels, theme};

/// Between two pictures, in physical pixels.
const GAP_PX: f32 = 32.0;
/// Room above the pictures for the question, and below for buttons, keys and progress, in points: with
/// pictures 480 px high a screen of 720 holds them all.
const ABOVE: f32 = 76.0;
const BELOW: f32 = 160.0;
/// Between a picture and the question above it or the button below it.
const MARGIN: f32 = 18.0;
const BUTTON: Vec2 = Vec2::new(240.0, 56.0);

/// A trial, in practice or not, and the answer that was clicked.
pub(crate) fn trial(
    ui: &mut Ui,
    presentation: &mut Presentation,
    experiment: &Experiment,
    display: &Screen,
    words: &ParticipantWords,
) -> anyhow::Result<Option<Action>> {
    let screen = ui.max_rect();
    ui.painter().rect_filled(screen, 0.0, theme::GROUND);
    let pictures = presentation.trial().pictures;
    let places = Places::new(screen, display.size_px, pictures.all().len(), ui.pixels_per_point());

    let was_shown = presentation.pictures().is_some();
    let answers = pictures.answers();
    presentation.advance(ui.ctx(), display)?;

    let top = Pos2::new(screen.center().x, places.pictures[0].top() - MARGIN * places.scale);
    text(ui, top, Align2::CENTER_BOTTOM, TextStyle::Heading, question(experiment.protocol().task, words));
    match presentation.pictures() {
        Some(pictures) => {
            for (picture, place) in pictures.iter().zip(&places.pictures) {
                pixels::paint(ui.painter(), picture, place.center());
            }
        }
        None => {
            let centre = Pos2::new(screen.center().x, places.pictures[0].center().y);
            text(ui, centre, Align2::CENTER_CENTER, TextStyle::Heading, "+");
        }
    }
    let mut clicked = None;
    for (answer, place) in answers.into_iter().zip(places.buttons) {
        if button(ui, place, answer, words) && was_shown {
            clicked = Some(Action::Answer(answer));
        }
    }
    progress(ui, screen, experiment, words);
    Ok(clicked)
}

/// In place of pictures that would be cut off: whether they would be, and the page that says so.
pub(crate) fn too_small(ui: &mut Ui, protocol: &Protocol, words: &ParticipantWords) -> bool {
    let missing = pixels_missing(ui.max_rect(), ui.pixels_per_point(), protocol);
    if let Some([needed, given]) = missing {
        page::page(ui, 200.0, words.too_small, |ui| ui.label((words.pixels_needed)(needed, given)));
    }
    missing.is_some()
}

/// Width and height in physical pixels that the pictures of a protocol need with everything around them, and those of
/// the screen; `None` where they fit.
pub(crate) fn pixels_missing(screen: Rect, pixels_per_point: f32, protocol: &Protocol) -> Option<[[f32; 2]; 2]> {
    let rules = protocol.pictures;
    let count = match protocol.task {
        Task::TwoAlternative => 2,
        Task::YesNo => 1,
    };
    let needed = Places::new(screen, [rules.width_px, rules.height_px], count, pixels_per_point).needed;
    let pixels = |rect: Rect| [rect.width(), rect.height()].map(|side| side * pixels_per_point);
    (!screen.contains_rect(needed)).then(|| [pixels(needed), pixels(screen)])
}

/// Where the pictures and the buttons go, in points.
struct Places {
    /// From left to right.
    pictures: Vec<Rect>,
    buttons: [Rect; 2],
    /// Everything, with the room that the words take.
    needed: Rect,
    /// How much larger than life the words and buttons are.
    scale: f32,
}

impl Places {
    fn new(screen: Rect, size_px: [u32; 2], count: usize, pixels_per_point: f32) -> Self {
        let scale = theme::scale(screen);
        let size = Vec2::new(size_px[0] as f32, size_px[1] as f32) / pixels_per_point;
        let centre = screen.center() + Vec2::new(0.0, 0.5 * scale * (ABOVE - BELOW));
        let step = size.x + GAP_PX / pixels_per_point;
        let place = |index: usize| {
            let aside = (index as f32 - 0.5 * (count as f32 - 1.0)) * step;
            Rect::from_center_size(centre + Vec2::new(aside, 0.0), size)
        };
        let pictures: Vec<Rect> = (0..count).map(place).collect();

        // Below the middles of two pictures, or of the halves of one.
        let of_pictures = if count == 1 { 0.25 * size.x } else { 0.5 * step };
        let (button, margin) = (BUTTON * scale, MARGIN * scale);
        let aside = of_pictures.max(0.5 * (button.x + margin));
        let below = centre + Vec2::new(0.0, 0.5 * (size.y + button.y) + margin);
        let buttons = [-aside, aside].map(|x| Rect::from_center_size(below + Vec2::new(x, 0.0), button));

        let mut needed = pictures.iter().fold(buttons[0].union(buttons[1]), |all, picture| all.union(*picture));
        needed.min.y = centre.y - 0.5 * size.y - scale * ABOVE;
        needed.max.y = centre.y + 0.5 * size.y + scale * BELOW;
        Self { pictures, buttons, needed, scale }
    }
}

/// An answer to click, with its keys below.
fn button(ui: &mut Ui, place: Rect, answer: Answer, words: &ParticipantWords) -> bool {
    let (label, keys) = match answer {
        Answer::Left => (words.left, words.left_keys),
        Answer::Right => (words.right, words.right_keys),
        Answer::Yes => (words.yes, words.yes_keys),
        Answer::No => (words.no, words.no_keys),
    };
    let below = place.center_bottom() + Vec2::new(0.0, 8.0);
    text(ui, below, Align2::CENTER_TOP, TextStyle::Small, keys);
    // Always drawn alike, with an identity of its own from the first frame, so that nothing flickers
    // beside the pictures.
    let builder = egui::UiBuilder::new().id_salt(label).max_rect(place);
    ui.scope_builder(builder, |ui| ui.put(place, Button::new(label))).inner.clicked()
}

/// How far the session is, counted in answers of every role alike.
fn progress(ui: &Ui, screen: Rect, experiment: &Experiment, words: &ParticipantWords) {
    let scale = theme::scale(screen);
    let centre = Pos2::new(screen.center().x, screen.bottom() - 26.0 * scale);
    let protocol = experiment.protocol();
    if let Stage::Practice(trial) = experiment.stage() {
        // Practice that is repeated goes on counting.
        let count = protocol.practice.ratios.len();
        let number = (trial.number - 1) % count as u32 + 1;
        text(ui, centre, Align2::CENTER_CENTER, TextStyle::Small, &(words.practice_of)(number, count));
        return;
    }
    let progress = experiment.progress();
    let above = centre - Vec2::new(0.0, 8.0 * scale);
    text(ui, above, Align2::CENTER_BOTTOM, TextStyle::Small, &(words.round_of)(progress.round, progress.rounds));

    // Of the answers to come, these are for staircases. Their greatest number only shrinks, so the bar only grows.
    let at_most = f64::from(progress.trials_at_most) / protocol.measured_share();
    let done = (f64::from(progress.answered) / at_most).min(1.0) as f32;
    let track = Rect::from_center_size(centre, Vec2::new(240.0, 4.0) * scale);
    let filled = Rect::from_min_size(track.min, Vec2::new(track.width() * done, track.height()));
    ui.painter().rect_filled(track, 2.0, theme::TRACK);
    ui.painter().rect_filled(filled, 2.0, theme::FAINT_INK);
}

fn text(ui: &Ui, place: Pos2, anchor: Align2, style: TextStyle, words: &str) {
    ui.painter().text(place, anchor, words, style.resolve(ui.style()), theme::INK);
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;
    use crate::presentation::FIXATION;
    use crate::screen;
    use crate::words::words;
    use scumble_psychophysics::Language;
    use scumble_stimuli::Transfer;

    /// Fills of everything as large as a button that a frame draws.
    fn buttons(context: &egui::Context, show: impl FnMut(&mut Ui)) -> Vec<egui::Color32> {
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, Vec2::new(1280.0, 800.0)));
        let mut output = context.run_ui(egui::RawInput { screen_rect, ..Default::default() }, show);
        output.textures_delta.clear(); // Nothing uploads them.
        let fill = |clipped: &egui::epaint::ClippedShape| match &clipped.shape {
            egui::Shape::Rect(shape) if shape.rect.size() == BUTTON => Some(shape.fill),
            _ => None,
        };
        output.shapes.iter().filter_map(fill).collect()
    }

    #[test]
    fn both_buttons_look_alike_from_the_first_frame_on() {
        let words = &words(Language::English).participant;
        for name in ["two-alternative", "yes-no", "published"] {
            let context = egui::Context::default();
            theme::apply(&context);
            let mut experiment = Experiment::new(Protocol::named(name).unwrap(), 1, 1).unwrap();
            experiment.proceed().unwrap();
            let trial = *experiment.stage().trial().unwrap();
            let answer = trial.pictures.right_answer();
            let display = Screen { size_px: [60, 48], transfer: Transfer::srgb(), refresh_hz: None };

            for _ in 0..2 {
                buttons(&context, |ui| _ = screen::feedback(ui, true, answer, words));
            }
            let mut shown = Presentation::new(trial, FIXATION);
            let mut frame =
                || buttons(&context, |ui| _ = super::trial(ui, &mut shown, &experiment, &display, words).unwrap());
            let first = frame();
            assert_eq!(first.len(), 2, "{name}");
            assert_eq!(first[0], first[1], "{name}");
            for _ in 0..3 {
                assert_eq!(frame(), first, "{name}");
            }
        }
    }
}
