//! A contact sheet of stimuli: how the steps vanish as the filter grows.
//!
//! `cargo run --release -p scumble-stimuli --example sheet -- OUT.png` draws one row per ratio
//! (radius in texels) 0, 1, 2, 3.47 (the published relation) and 6 from top to bottom, and a pair of
//! columns per pattern, the filtered artifact and its line: stair, step, double step. The texel is 12
//! pixels. In cells this narrow the line of a step is two to four times as steep as in the experiment.

use std::process::ExitCode;

use image::{GrayImage, Luma, imageops};
use scumble_stimuli::{Encoding, Kernel, Pattern, Shape, Stimulus, Transfer};

const RATIOS: [f64; 5] = [0.0, 1.0, 2.0, 3.47, 6.0];
const TEXEL_PX: f64 = 12.0;
const CELL_PX: u32 = 200;
/// Between an artifact and its line, and around every cell.
const GAP_PX: u32 = 8;
/// Between one pattern and the next, in addition.
const PATTERN_GAP_PX: u32 = 20;
const PATTERNS: [Pattern; 3] = [Pattern::Stair, Pattern::Step, Pattern::DoubleStep];
/// Mid grey to the eye: 50 % of the sRGB signal.
const GROUND: u8 = 128;

fn main() -> ExitCode {
    let Some(path) = std::env::args().nth(1) else {
        eprintln!("sheet: one argument is needed, the PNG file to write");
        return ExitCode::FAILURE;
    };
    match draw().and_then(|sheet| sheet.save(&path).map_err(|error| format!("{path}: {error}"))) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("sheet: {message}");
            ExitCode::FAILURE
        }
    }
}

/// The whole sheet.
fn draw() -> Result<GrayImage, String> {
    let place = |index: u32| GAP_PX + index * (CELL_PX + GAP_PX);
    let pairs = PATTERNS.len() as u32;
    let size = (place(2 * pairs) + (pairs - 1) * PATTERN_GAP_PX, place(RATIOS.len() as u32));
    let mut sheet = GrayImage::from_pixel(size.0, size.1, Luma([GROUND]));
    for (pair, pattern) in (0..).zip(PATTERNS) {
        for (half, shape) in (0..).zip([Shape::Artifact, Shape::Line]) {
            for (row, ratio) in (0..).zip(RATIOS) {
                let picture = cell(pattern, shape, ratio).map_err(|error| error.to_string())?;
                let left = place(2 * pair + half) + pair * PATTERN_GAP_PX;
                imageops::replace(&mut sheet, &picture, left.into(), place(row).into());
            }
        }
    }
    Ok(sheet)
}

/// One stimulus of the sheet.
fn cell(pattern: Pattern, shape: Shape, ratio: f64) -> Result<GrayImage, scumble_stimuli::Error> {
    let stimulus = Stimulus {
        pattern,
        shape,
        kernel: Kernel::Disc,
        texel_px: TEXEL_PX,
        radius_px: ratio * TEXEL_PX,
        contrast: 1.0,
        encoding: Encoding::LinearLight,
        phase: 0.5,
        mirrored: false,
        inverted: false,
        tilt_rad: 0.0,
        dither_seed: Some(1),
    };
    stimulus.render(CELL_PX, CELL_PX, &Transfer::srgb())
}
