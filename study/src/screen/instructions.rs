//! What the participant is asked to do, with two examples.

use eframe::egui;
use egui::{Sense, TextureHandle, Ui, Vec2};
use scumble_psychophysics::Protocol;
use scumble_stimuli::{Encoding, Kernel, Pattern, Shape, Stimulus};

use super::page;
use crate::pixels;
use crate::screen::Action;

/// Size of an example, in points.
const SIZE: Vec2 = Vec2::new(308.0, 130.0);
/// Texel of an example, in points: coarse, so that nobody misses the steps.
const TEXEL: f32 = 14.0;
/// Radius of an example's filter in texels: little blur.
const RATIO: f64 = 0.5;

/// The examples as textures, made for one scale factor.
#[derive(Default)]
pub(crate) struct Examples {
    pictures: Vec<TextureHandle>,
    pixels_per_point: f32,
}

/// The first screen.
pub(crate) fn instructions(
    ui: &mut Ui,
    examples: &mut Examples,
    protocol: &Protocol,
) -> anyhow::Result<Option<Action>> {
    examples.prepare(ui.ctx())?;
    let practice = match protocol.practice.ratios.len() {
        0 => "There are no trials to practise with.".to_owned(),
        1 => "The first trial is for practice: you will be told whether you were right.".to_owned(),
        count => format!("The first {count} trials are for practice: you will be told whether you were right."),
    };
    let action = page::page(ui, 600.0, "Which one was the line?", |ui| {
        ui.label(
            "You will see two pictures of a shadow's edge, both blurred by the same amount. \
             Before the blur, one edge was a straight line. The other was made of steps.",
        );
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 24.0;
            examples.show(ui, 0, "A line");
            examples.show(ui, 1, "Not a line: steps");
        });
        ui.label(
            "Say each time which one was the line. Take the time you need. Many pairs are too \
             blurred to be sure; then guess, a guess helps as much as any other answer.",
        );
        ui.label("Left: the left arrow key or F.   Right: the right arrow key or J.   Pause: Escape.");
        ui.label(practice);
        page::go_on(ui, "Start", Action::Proceed)
    });
    Ok(action)
}

impl Examples {
    fn prepare(&mut self, context: &egui::Context) -> Result<(), scumble_stimuli::Error> {
        let scale = context.pixels_per_point();
        if self.pictures.is_empty() || self.pixels_per_point != scale {
            let size_px = [SIZE.x, SIZE.y].map(|side| (side * scale).round() as u32);
            self.pictures = [Shape::Line, Shape::Artifact]
                .into_iter()
                .map(|shape| pixels::upload(context, &example(shape, scale), size_px))
                .collect::<Result<_, _>>()?;
            self.pixels_per_point = scale;
        }
        Ok(())
    }

    fn show(&self, ui: &mut Ui, index: usize, caption: &str) {
        ui.vertical(|ui| {
            ui.spacing_mut().item_spacing.y = 6.0;
            let (place, _) = ui.allocate_exact_size(SIZE, Sense::empty());
            if let Some(picture) = self.pictures.get(index) {
                pixels::paint(ui.painter(), picture, place.center());
            }
            ui.small(caption);
        });
    }
}

fn example(shape: Shape, scale: f32) -> Stimulus {
    let texel_px = f64::from(TEXEL * scale);
    Stimulus {
        pattern: Pattern::Stair,
        shape,
        kernel: Kernel::Disc,
        texel_px,
        radius_px: RATIO * texel_px,
        contrast: 1.0,
        encoding: Encoding::LinearLight,
        phase: 0.5,
        mirrored: false,
        inverted: false,
        tilt_rad: 0.0,
        dither_seed: None,
    }
}
