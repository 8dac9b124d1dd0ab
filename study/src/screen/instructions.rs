//! What the participant is asked to do, with examples.

use eframe::egui;
use egui::{Sense, Ui, Vec2};
use scumble_psychophysics::{Protocol, Task};
use scumble_stimuli::{Encoding, Kernel, Pattern, Shape, Stimulus};

use super::{page, question};
use crate::pixels::{self, Picture};
use crate::screen::Action;

/// Size of an example, in points.
const SIZE: Vec2 = Vec2::new(308.0, 88.0);
/// Texel of an example, in points: coarse, so that nobody misses the steps.
const TEXEL: f32 = 14.0;
/// Turn of the example of a step: as much as its line rises, so that slant does not look like the answer.
const STEP_TILT_RAD: f64 = 0.05;
/// Radius of an example's filter in texels: little blur.
const RATIO: f64 = 0.5;
/// Height of the page without and with one row of examples, in points.
const HEIGHT: f32 = 390.0;
const ROW: f32 = 124.0;

/// The examples as textures, made for one scale factor: a line and an artifact of each pattern.
#[derive(Default)]
pub(crate) struct Examples {
    rows: Vec<[Picture; 2]>,
    pixels_per_point: f32,
}

/// The first screen.
pub(crate) fn instructions(
    ui: &mut Ui,
    examples: &mut Examples,
    protocol: &Protocol,
) -> anyhow::Result<Option<Action>> {
    let patterns = &protocol.conditions.patterns;
    examples.prepare(ui.ctx(), patterns)?;
    let height = HEIGHT + ROW * patterns.len() as f32;
    let [what, how, keys] = words(protocol);
    let action = page::page(ui, height, question(protocol.task), |ui| {
        ui.label(what);
        for [line, steps] in &examples.rows {
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 24.0;
                show(ui, line, "A line");
                show(ui, steps, "Not a line: steps");
            });
        }
        ui.label(how);
        ui.label(keys);
        ui.label(practice(protocol));
        page::go_on(ui, "Start", Action::Proceed)
    });
    Ok(action)
}

/// What is shown, what to do, and the keys. How many pictures are lines is said where the protocol
/// holds lines among the measured trials, and nowhere else.
fn words(protocol: &Protocol) -> [String; 3] {
    match protocol.task {
        Task::TwoAlternative => [
            "You will see two pictures of a shadow's edge, both blurred by the same amount. \
             Before the blur, one edge was a straight line. The other was made of steps."
                .to_owned(),
            "Say each time which one was the line. Take the time you need. Many pairs are too \
             blurred to be sure; then guess, a guess helps as much as any other answer."
                .to_owned(),
            "Left: the left arrow key or F.   Right: the right arrow key or J.   Pause: Escape.".to_owned(),
        ],
        Task::YesNo => {
            let lines = match protocol.line_trials {
                Some(_) => " Many of the pictures are lines.",
                None => "",
            };
            [
                format!(
                    "You will see one picture of a shadow's edge at a time, and it is blurred. Was the edge \
                     a straight line before the blur, or was it made of steps?{lines}"
                ),
                "Say each time whether it was a line. Take the time you need. Many pictures are too \
                 blurred to be sure; then say what seems more likely, that helps as much as any other answer."
                    .to_owned(),
                "Yes: left arrow key, F or Y.   No: right arrow key, J or N.   Pause: Escape.".to_owned(),
            ]
        }
    }
}

fn practice(protocol: &Protocol) -> String {
    match protocol.practice.ratios.len() {
        0 => "There are no trials to practise with.".to_owned(),
        1 => "The first trial is for practice: you will be told whether you were right.".to_owned(),
        count => format!("The first {count} trials are for practice: you will be told whether you were right."),
    }
}

impl Examples {
    fn prepare(&mut self, context: &egui::Context, patterns: &[Pattern]) -> Result<(), scumble_stimuli::Error> {
        let scale = context.pixels_per_point();
        if self.rows.is_empty() || self.pixels_per_point != scale {
            let size_px = [SIZE.x, SIZE.y].map(|side| (side * scale).round() as u32);
            let draw = |pattern, shape| Picture::new(context, &example(pattern, shape, scale), size_px);
            let row = |&pattern| Ok([draw(pattern, Shape::Line)?, draw(pattern, Shape::Artifact)?]);
            self.rows = patterns.iter().map(row).collect::<Result<_, _>>()?;
            self.pixels_per_point = scale;
        }
        Ok(())
    }
}

fn show(ui: &mut Ui, picture: &Picture, caption: &str) {
    ui.vertical(|ui| {
        ui.spacing_mut().item_spacing.y = 6.0;
        let (place, _) = ui.allocate_exact_size(SIZE, Sense::empty());
        pixels::paint(ui.painter(), picture, place.center());
        ui.small(caption);
    });
}

fn example(pattern: Pattern, shape: Shape, scale: f32) -> Stimulus {
    let texel_px = f64::from(TEXEL * scale);
    Stimulus {
        pattern,
        shape,
        kernel: Kernel::Disc,
        texel_px,
        radius_px: RATIO * texel_px,
        contrast: 1.0,
        encoding: Encoding::LinearLight,
        phase: 0.5,
        mirrored: false,
        inverted: false,
        tilt_rad: if pattern == Pattern::Step && shape == Shape::Artifact { STEP_TILT_RAD } else { 0.0 },
        dither_seed: None,
    }
}
