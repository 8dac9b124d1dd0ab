//! A contact sheet of stimuli: how the steps vanish as the filter grows.
//!
//! `cargo run --release -p scumble-stimuli --example sheet -- OUT.png` draws one row per ratio
//! (radius in texels) 0.5, 1, 2, 3.47 and 6 from top to bottom, and four columns: filtered stair, its
//! line, filtered step, its line. The texel is 12 pixels.

use std::process::ExitCode;

use image::{GrayImage, Luma, imageops};
use scumble_stimuli::{Encoding, Kernel, Pattern, Shape, Stimulus, Transfer};

const RATIOS: [f64; 5] = [0.5, 1.0, 2.0, 3.47, 6.0];
const TEXEL_PX: f64 = 12.0;
const CELL_WIDTH_PX: u32 = 240;
const CELL_HEIGHT_PX: u32 = 180;
const GAP_PX: u32 = 12;
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
    let columns = [Pattern::Stair, Pattern::Step]
        .into_iter()
        .flat_map(|pattern| [Shape::Artifact, Shape::Line].map(|shape| (pattern, shape)));
    let side = |cells: u32, cell_px: u32| cells * (cell_px + GAP_PX) + GAP_PX;
    let size = (side(4, CELL_WIDTH_PX), side(RATIOS.len() as u32, CELL_HEIGHT_PX));
    let mut sheet = GrayImage::from_pixel(size.0, size.1, Luma([GROUND]));
    for (column, (pattern, shape)) in columns.enumerate() {
        for (row, ratio) in RATIOS.into_iter().enumerate() {
            let picture = cell(pattern, shape, ratio).map_err(|error| error.to_string())?;
            let place = |index: usize, cell_px: u32| i64::from(side(index as u32, cell_px));
            imageops::replace(&mut sheet, &picture, place(column, CELL_WIDTH_PX), place(row, CELL_HEIGHT_PX));
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
    stimulus.render(CELL_WIDTH_PX, CELL_HEIGHT_PX, &Transfer::srgb())
}
