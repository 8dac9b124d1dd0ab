//! From the lit part of the kernel to the 256 levels of a display.
//!
//! The value to show lies between two neighbouring levels, in light or in code values. Without a
//! seed the nearer one is taken. With one, dithering takes the upper with the probability
//! `(value - lower) / (upper - lower)`, so that the mean over pixels is the exact value, in light for
//! light and in code for code, and no contour of equal levels betrays the gradient.
//!
//! A pixel compares 16 random bits with the probability rounded to 16 bits, so its mean is wrong by
//! 2^-17 of a level at most. The noise of dithering hides that: the mean of N pixels has a standard
//! error of up to 1 / (2 sqrt N) levels, which is 2^-15 for the largest picture, 2^28 pixels, and 110
//! times the error for 600 x 600. Eight bits would be wrong by twice the standard error there.
//!
//! The bits are ChaCha8's, the seed its key, a row its stream and a column its place in the stream:
//! they depend on the place of the pixel alone, and pixels at an exact level need none.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::{Encoding, Transfer};

/// Parts into which the range of light is divided to find a level; sRGB's smallest step is a third of
/// one.
const PARTS: usize = 1024;

/// A probability of 1 in 16 bits.
const ALWAYS: u32 = 1 << 16;

/// Chooses whole levels for a row of values.
pub(crate) struct Quantiser {
    transfer: Transfer,
    /// One over the light between a level and the next.
    per_light: [f64; 256],
    /// The highest level at the beginning of each part of the range or below.
    level_of_part: Vec<u8>,
    noise: Option<ChaCha8Rng>,
    /// Of a row: probability of the upper level, and random bytes.
    upper: Vec<u32>,
    bytes: Vec<u8>,
}

impl Quantiser {
    /// Takes the nearest level without a seed, dithers with one.
    pub(crate) fn new(transfer: &Transfer, encoding: Encoding, dither_seed: Option<u64>) -> Self {
        let transfer = match encoding {
            Encoding::LinearLight => transfer.clone(),
            Encoding::CodeValues => Transfer::proportional(),
        };
        let light = |level: usize| transfer.light(level as u8);
        let per_light =
            std::array::from_fn(|level| if level < 255 { 1.0 / (light(level + 1) - light(level)) } else { 0.0 });
        let level_at = |value: f64| (1..256).take_while(|&level| light(level) <= value).count() as u8;
        let level_of_part = (0..=PARTS).map(|part| level_at(part as f64 / PARTS as f64)).collect();
        let noise = dither_seed.map(|seed| {
            let mut key = [0; 32];
            key[..8].copy_from_slice(&seed.to_le_bytes());
            ChaCha8Rng::from_seed(key)
        });
        Self { transfer, per_light, level_of_part, noise, upper: Vec::new(), bytes: Vec::new() }
    }

    /// The levels of a row of values of 0 to 1. Exact levels stay themselves under dithering.
    pub(crate) fn row(&mut self, row: u32, values: impl Iterator<Item = f64>, levels: &mut [u8]) {
        self.upper.resize(levels.len(), 0);
        let mut dithered = levels.len()..0;
        // Runs of equal values are common: all that the kernel does not reach.
        let mut last = (f64::NAN, 0, 0);
        for (column, value) in values.enumerate() {
            if value != last.0 {
                let (level, upper) = self.between(value);
                last = (value, level, upper);
            }
            (levels[column], self.upper[column]) = (last.1, last.2);
            if last.2 > 0 {
                dithered = dithered.start.min(column)..column + 1;
            }
        }
        if let Some(noise) = self.noise.as_mut().filter(|_| !dithered.is_empty()) {
            // Two pixels share a word.
            let begin = dithered.start & !1;
            self.bytes.resize(2 * (dithered.end - begin), 0);
            noise.set_stream(row.into());
            noise.set_word_pos(begin as u128 / 2);
            noise.fill_bytes(&mut self.bytes);
            let (pairs, _) = self.bytes.as_chunks::<2>();
            for ((level, upper), bits) in levels[begin..].iter_mut().zip(&self.upper[begin..]).zip(pairs) {
                *level += u8::from(u32::from(u16::from_le_bytes(*bits)) < *upper);
            }
        }
    }

    /// The level at a value or below, and the probability of the next, below 1, in 2^-16; without
    /// noise the nearer level and 0.
    fn between(&self, value: f64) -> (u8, u32) {
        let value = value.clamp(0.0, 1.0);
        let mut level = self.level_of_part[(value * PARTS as f64) as usize];
        while level < 255 && self.transfer.light(level + 1) <= value {
            level += 1;
        }
        let share = (value - self.transfer.light(level)) * self.per_light[usize::from(level)];
        let upper = match self.noise {
            Some(_) => (share * f64::from(ALWAYS) + 0.5) as u32,
            None if share >= 0.5 => ALWAYS,
            None => 0,
        };
        if upper >= ALWAYS { (level + 1, 0) } else { (level, upper) }
    }
}
