//! From linear light to the 256 levels of a display.
//!
//! The sRGB transfer function of IEC 61966-2-1, and two ways to reach a whole level: the nearest, or
//! dithering, which adds uniform noise of one level's width before the value is cut, so that the
//! mean over many pixels is the exact value and no contour of equal levels betrays the gradient.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// sRGB signal, 0 to 1, of linear light, 0 to 1.
pub fn srgb_from_linear(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Linear light, 0 to 1, of an sRGB signal, 0 to 1; inverse of [`srgb_from_linear`].
pub fn linear_from_srgb(srgb: f64) -> f64 {
    if srgb <= 0.040_45 { srgb / 12.92 } else { ((srgb + 0.055) / 1.055).powf(2.4) }
}

/// Chooses a whole level for each value, in the order of the calls.
pub(crate) struct Quantiser {
    noise: Option<ChaCha8Rng>,
}

impl Quantiser {
    /// Rounds to the nearest level without a seed, dithers with one.
    pub(crate) fn new(dither_seed: Option<u64>) -> Self {
        Quantiser { noise: dither_seed.map(ChaCha8Rng::seed_from_u64) }
    }

    /// The level, 0 to 255, of linear light. Exact levels stay themselves under dithering.
    pub(crate) fn level(&mut self, linear: f64) -> u8 {
        let value = 255.0 * srgb_from_linear(linear);
        let offset = self.noise.as_mut().map_or(0.5, |noise| noise.random::<f64>());
        (value + offset).floor().clamp(0.0, 255.0) as u8
    }
}
