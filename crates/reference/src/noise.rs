//! What part of an error is noise, and what part is structure.
//!
//! With `e = found - truth`, and `m_i` the mean of e over the `n_i` pixels of the mask in a square window around pixel
//! i, the pixel itself among them:
//! ```text
//! noise^2 = mean over pixels with n_i > 1 of (e_i - m_i)^2 n_i / (n_i - 1)       structure^2 = rms(e)^2 - noise^2
//! ```
//! `n / (n - 1)` gives back what the mean takes along of its own pixel, so independent noise of variance s^2 has
//! `noise^2 = s^2` in expectation, whatever the mask's outline. A constant bias is structure to the last bit. A bias that
//! varies leaks: of a wave with a period of P pixels the share `(2 pi / P)^2 (w^2 - 1) / 24` of its amplitude, for a
//! window of w pixels. Steps between texels of the shadow map leak where they are sharper than the window: noise here
//! is what changes from pixel to pixel, from whatever source.

use crate::{Error, check};

/// The error of a picture in two parts whose squares add up to that of the whole, in shares of full light.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct ErrorParts {
    /// Pixels of the mask.
    pub pixels: usize,
    /// Root of the mean square of the error.
    pub rms: f64,
    /// What differs between neighbours: grain. At most `rms`.
    pub noise_rms: f64,
    /// What neighbours have in common: bias, displaced edges, texels wider than the window.
    pub structure_rms: f64,
}

/// Splits the error of a picture with rows of `width` pixels where the mask is set; all zeros under an empty mask.
///
/// The window has `2 radius_px + 1` pixels a side: a radius of 1 or 2 is usual, one of 0 sees no noise.
///
/// # Errors
/// Different numbers of pixels, rows that do not fill the picture, and values inside the mask that are not finite.
pub fn error_parts(
    found: &[f32],
    truth: &[f32],
    mask: &[bool],
    width: usize,
    radius_px: usize,
) -> Result<ErrorParts, Error> {
    check::rows(found, truth, mask, width)?;
    let error = |pixel: usize| f64::from(found[pixel]) - f64::from(truth[pixel]);
    let (mut squares, mut rough_squares) = (Mean::default(), Mean::default());
    for pixel in (0..mask.len()).filter(|&pixel| mask[pixel]) {
        squares.add(error(pixel).powi(2));
        let mut local = Mean::default();
        window(pixel, mask.len() / width, width, radius_px).filter(|&near| mask[near]).for_each(|near| {
            local.add(error(near));
        });
        if local.count > 1.0 {
            rough_squares.add((error(pixel) - local.value()).powi(2) * local.count / (local.count - 1.0));
        }
    }
    // Neighbours that differ more than chance would let them give the noise more than there is.
    let noise_square = rough_squares.value().min(squares.value());
    Ok(ErrorParts {
        pixels: squares.count as usize,
        rms: squares.value().sqrt(),
        noise_rms: noise_square.sqrt(),
        structure_rms: (squares.value() - noise_square).sqrt(),
    })
}

/// Pixels of the square around a pixel, as far as the picture goes.
fn window(pixel: usize, height: usize, width: usize, radius_px: usize) -> impl Iterator<Item = usize> {
    let around = |at: usize, size: usize| at.saturating_sub(radius_px)..(at + radius_px + 1).min(size);
    let columns = around(pixel % width, width);
    around(pixel / width, height).flat_map(move |y| columns.clone().map(move |x| y * width + x))
}

#[derive(Default)]
struct Mean {
    sum: f64,
    count: f64,
}

impl Mean {
    fn add(&mut self, value: f64) {
        self.sum += value;
        self.count += 1.0;
    }

    /// 0 of nothing.
    fn value(&self) -> f64 {
        self.sum / self.count.max(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::{Rng, SeedableRng};

    const WIDTH: usize = 120;
    const PIXELS: usize = WIDTH * WIDTH;
    /// A penumbra without a slope.
    const FLAT: f32 = 0.5;

    /// Uniform noise of this standard deviation around [`FLAT`].
    fn grain(deviation: f64) -> Vec<f32> {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let mut uniform = || f64::from(random.next_u32()) / f64::from(u32::MAX) - 0.5;
        (0..PIXELS).map(|_| FLAT + (uniform() * 12f64.sqrt() * deviation) as f32).collect()
    }

    /// A bias that is a wave along the rows.
    fn wave(amplitude: f64, period_px: f64) -> Vec<f32> {
        let phase = |pixel: usize| (pixel % WIDTH) as f64 * std::f64::consts::TAU / period_px;
        (0..PIXELS).map(|pixel| FLAT + (amplitude * phase(pixel).sin()) as f32).collect()
    }

    fn parts(found: &[f32], mask: &[bool], radius_px: usize) -> ErrorParts {
        error_parts(found, &[FLAT; PIXELS], mask, WIDTH, radius_px).unwrap()
    }

    #[test]
    fn white_noise_on_a_flat_penumbra_is_all_noise_under_every_mask() {
        let stripes: Vec<bool> = (0..PIXELS).map(|pixel| pixel % WIDTH % 5 < 2).collect();
        for (mask, radius_px) in [(vec![true; PIXELS], 1), (vec![true; PIXELS], 2), (stripes, 1)] {
            let found = parts(&grain(0.05), &mask, radius_px);
            assert!((found.noise_rms - 0.05).abs() < 0.0008, "{found:?}");
            assert!(found.structure_rms < 0.2 * found.rms, "{found:?}");
        }
    }

    #[test]
    fn a_constant_bias_has_no_noise() {
        let found = parts(&[0.75; PIXELS], &[true; PIXELS], 2);
        assert_eq!(found, ErrorParts { pixels: PIXELS, rms: 0.25, noise_rms: 0.0, structure_rms: 0.25 });
    }

    #[test]
    fn of_a_smooth_bias_no_more_leaks_into_the_noise_than_the_formula_says() {
        for (period_px, radius_px) in [(40.0f64, 1usize), (40.0, 2), (20.0, 2)] {
            let found = parts(&wave(0.1, period_px), &[true; PIXELS], radius_px);
            let side = (2 * radius_px + 1) as f64;
            let leak = (std::f64::consts::TAU / period_px).powi(2) * (side * side - 1.0) / 24.0;
            // Windows at the border of the picture lack a side, and see a slope as a difference: 3 % here.
            assert!(found.noise_rms < (1.5 * leak + 0.03) * found.rms, "{leak}: {found:?}");
            assert!((found.structure_rms - 0.1 * 0.5f64.sqrt()).abs() < 0.002, "{found:?}");
        }
    }

    #[test]
    fn the_parts_of_a_noisy_wave_are_those_of_its_noise_and_its_wave() {
        let noisy: Vec<f32> =
            grain(0.03).iter().zip(wave(0.1, 40.0)).map(|(noise, wave)| noise + wave - FLAT).collect();
        let found = parts(&noisy, &[true; PIXELS], 1);
        assert!((found.noise_rms - 0.03).abs() < 0.001, "{found:?}");
        assert!((found.structure_rms - 0.1 * 0.5f64.sqrt()).abs() < 0.002, "{found:?}");
        assert!((found.noise_rms.hypot(found.structure_rms) - found.rms).abs() < 1e-12);
    }

    #[test]
    fn a_chessboard_is_noise_and_a_shifted_edge_is_structure() {
        let board: Vec<f32> = (0..PIXELS).map(|pixel| ((pixel / WIDTH + pixel % WIDTH) % 2) as f32).collect();
        let found = parts(&board, &[true; PIXELS], 2);
        assert!(found.noise_rms > 0.95 * found.rms, "{found:?}");
        let band: Vec<f32> = (0..PIXELS).map(|i| if (40..70).contains(&(i % WIDTH)) { 1.0 } else { FLAT }).collect();
        let found = parts(&band, &[true; PIXELS], 1);
        assert!(found.structure_rms > 0.97 * found.rms, "{found:?}");
    }

    #[test]
    fn small_and_broken_pictures_have_a_result_or_an_error() {
        assert_eq!(parts(&[0.0; PIXELS], &[false; PIXELS], 1).pixels, 0);
        let lonely = error_parts(&[1.0, f32::NAN], &[0.5, 0.0], &[true, false], 2, 1).unwrap();
        assert_eq!((lonely.noise_rms, lonely.structure_rms), (0.0, 0.5));
        let nan = error_parts(&[1.0, f32::NAN], &[0.5, 0.0], &[true; 2], 2, 1).unwrap_err();
        assert!(nan.to_string().starts_with("pixel 1 is NaN"), "{nan}");
    }
}
