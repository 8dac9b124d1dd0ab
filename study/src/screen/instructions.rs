//! What the participant is asked to do, with examples.

use eframe::egui;
use egui::{Sense, Ui, Vec2};
use image::GrayImage;
use scumble_psychophysics::{Protocol, Task};
use scumble_stimuli::{Encoding, Kernel, Pattern, Shape, Stimulus, Transfer};

use super::{page, question};
use crate::pixels::{self, Picture, draw};
use crate::screen::Action;
use crate::words::participant::ParticipantWords;

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
    rows: Vec<Vec<Picture>>,
    pixels_per_point: f32,
}

/// The first screen.
pub(crate) fn instructions(
    ui: &mut Ui,
    examples: &mut Examples,
    protocol: &Protocol,
    words: &ParticipantWords,
) -> anyhow::Result<Option<Action>> {
    let patterns = &protocol.conditions.patterns;
    examples.prepare(ui.ctx(), patterns)?;
    let height = HEIGHT + ROW * patterns.len() as f32;
    let [what, how, keys] = texts(protocol, words);
    let action = page::page(ui, height, question(protocol.task, words), |ui| {
        ui.label(what);
        for row in &examples.rows {
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 24.0;
                for (picture, caption) in row.iter().zip([words.example_line, words.example_steps]) {
                    show(ui, picture, caption);
                }
            });
        }
        ui.label(how);
        ui.label(keys);
        ui.label((words.practice_follows)(protocol.practice.ratios.len()));
        page::go_on(ui, words.start, words.or_space, Action::Proceed)
    });
    Ok(action)
}

/// What is shown, what to do, and the keys. That some pictures are lines is said where the protocol
/// holds lines among the measured trials, and nowhere else.
fn texts(protocol: &Protocol, words: &ParticipantWords) -> [String; 3] {
    match protocol.task {
        Task::TwoAlternative => [words.what_two, words.how_two, words.keys_two].map(String::from),
        Task::YesNo => {
            let lines = if protocol.line_trials.is_some() { words.lines_among } else { "" };
            [format!("{}{lines}", words.what_one), words.how_one.into(), words.keys_one.into()]
        }
    }
}

impl Examples {
    fn prepare(&mut self, context: &egui::Context, patterns: &[Pattern]) -> Result<(), scumble_stimuli::Error> {
        let scale = context.pixels_per_point();
        if self.rows.is_empty() || self.pixels_per_point != scale {
            let size_px = [SIZE.x, SIZE.y].map(|side| (side * scale).round() as u32);
            let row = |&pattern: &Pattern| {
                let [line, steps] = [Shape::Line, Shape::Artifact].map(|shape| example(pattern, shape, scale));
                draw(&[&line, &steps], size_px, &Transfer::srgb())
            };
            let drawn: Vec<_> = patterns.iter().map(row).collect::<Result<_, _>>()?;
            let upload = |images: Vec<GrayImage>| images.iter().map(|image| Picture::new(context, image)).collect();
            self.rows = drawn.into_iter().map(upload).collect();
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
