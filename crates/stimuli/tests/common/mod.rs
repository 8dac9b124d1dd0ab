//! A plain stimulus, and how the tests draw and compare pictures.

use image::GrayImage;
use scumble_stimuli::{Encoding, Kernel, Pattern, Shape, Stimulus, Transfer};

pub const PATTERNS: [Pattern; 3] = [Pattern::Stair, Pattern::Step, Pattern::DoubleStep];

/// Upright, full contrast, texel 10, ratio 1.5, not dithered.
pub fn stimulus(pattern: Pattern, shape: Shape) -> Stimulus {
    Stimulus {
        pattern,
        shape,
        kernel: Kernel::Disc,
        texel_px: 10.0,
        radius_px: 15.0,
        contrast: 1.0,
        encoding: Encoding::LinearLight,
        phase: 0.3,
        mirrored: false,
        inverted: false,
        tilt_rad: 0.0,
        dither_seed: None,
    }
}

/// The picture on an sRGB display.
pub fn draw(what: &Stimulus, width_px: u32, height_px: u32) -> GrayImage {
    what.render(width_px, height_px, &Transfer::srgb()).expect("a valid stimulus")
}

/// The picture in code values, which tests read as 255 times the lit part.
#[allow(dead_code, reason = "not every test file compares code values")]
pub fn draw_codes(what: &Stimulus, width_px: u32, height_px: u32) -> GrayImage {
    draw(&Stimulus { encoding: Encoding::CodeValues, ..*what }, width_px, height_px)
}

/// Largest difference of two pictures, in levels.
#[allow(dead_code, reason = "not every test file compares pictures")]
pub fn largest_difference(a: &GrayImage, b: &GrayImage) -> u8 {
    assert_eq!(a.dimensions(), b.dimensions());
    a.iter().zip(b.iter()).map(|(x, y)| x.abs_diff(*y)).max().unwrap_or(0)
}
