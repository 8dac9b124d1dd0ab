//! From the lit part of the kernel to the 256 levels of a display.
//!
//! The value to show lies between two neighbouring levels, in light or in code values. Without a
//! seed the nearer one is taken. With one, dithering takes the upper with the probability
//! `(value - lower) / (upper - lower)`, so that the mean over pixels is the exact value, in light for
//! light and in code for code, and no contour of equal levels betrays the gradient.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::{Encoding, Transfer};

/// Chooses a whole level for each value, in the order of the calls.
pub(crate) struct Quantiser<'a> {
    transfer: &'a Transfer,
    encoding: Encoding,
    noise: Option<ChaCha8Rng>,
}

impl<'a> Quantiser<'a> {
    /// Takes the nearest level without a seed, dithers with one.
    pub(crate) fn new(transfer: &'a Transfer, encoding: Encoding, dither_seed: Option<u64>) -> Self {
        Quantiser { transfer, encoding, noise: dither_seed.map(ChaCha8Rng::seed_from_u64) }
    }

    /// The level of a value of 0 to 1. Exact levels stay themselves under dithering.
    pub(crate) fn level(&mut self, value: f64) -> u8 {
        let (lower, share) = match self.encoding {
            Encoding::CodeValues => {
                let code = (255.0 * value).clamp(0.0, 255.0);
                (code.floor() as u8, code - code.floor())
            }
            Encoding::LinearLight => {
                let lower = self.transfer.level_below(value);
                let [below, above] = [lower, lower.saturating_add(1)].map(|level| self.transfer.light(level));
                (lower, if lower == 255 { 0.0 } else { (value - below).max(0.0) / (above - below) })
            }
        };
        // 53 bits.
        let threshold = self.noise.as_mut().map_or(0.5, |noise| (noise.next_u64() >> 11) as f64 / (1_u64 << 53) as f64);
        lower.saturating_add(u8::from(share > threshold))
    }
}
