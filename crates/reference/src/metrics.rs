//! How far a picture of visibility is from the truth, over a mask of pixels.
//!
//! With `e_i = found_i - truth_i` over the n pixels of the mask:
//! ```text
//! max = max |e_i|      rms = sqrt(mean e_i^2)      bias = mean e_i
//! p99 = the smallest |e_i| that at least 99 % of the |e_j| do not exceed (nearest rank, no interpolation)
//! ```
//! A value that is not finite is an error, not a difference: a NaN would vanish from a maximum.

use crate::percentile::p99;
use crate::{Error, check};

/// Differences of visibility, in shares of full light.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Differences {
    /// Pixels of the mask.
    pub pixels: usize,
    /// Largest absolute difference.
    pub max: f64,
    /// 99th percentile of the absolute differences.
    pub p99: f64,
    /// Root of the mean square.
    pub rms: f64,
    /// Mean signed difference; positive where the picture is brighter than the truth.
    pub bias: f64,
}

/// Compares a picture with the truth where the mask is set; all zeros under an empty mask.
///
/// # Errors
/// Different numbers of pixels, and values inside the mask that are not finite.
pub fn differences(found: &[f32], truth: &[f32], mask: &[bool]) -> Result<Differences, Error> {
    check::pictures(found, truth, mask)?;
    let inside = found.iter().zip(truth).zip(mask).filter(|(_, inside)| **inside);
    let signed: Vec<f64> = inside.map(|((&found, &truth), _)| f64::from(found) - f64::from(truth)).collect();
    Ok(summary(&signed))
}

/// The mask of the pixels in which a silhouette shows: inside `mask`, and neither fully lit nor fully dark in the
/// truth.
///
/// # Errors
/// Different numbers of pixels.
pub fn penumbra(truth: &[f32], mask: &[bool]) -> Result<Vec<bool>, Error> {
    check::lengths(truth, truth, mask)?;
    Ok(truth.iter().zip(mask).map(|(&visibility, &inside)| inside && visibility > 0.0 && visibility < 1.0).collect())
}

fn summary(signed: &[f64]) -> Differences {
    if signed.is_empty() {
        return Differences { pixels: 0, max: 0.0, p99: 0.0, rms: 0.0, bias: 0.0 };
    }
    let count = signed.len() as f64;
    let mut sizes: Vec<f64> = signed.iter().map(|error| error.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    Differences {
        pixels: signed.len(),
        max: sizes[sizes.len() - 1],
        p99: p99(&sizes).unwrap_or(0.0),
        rms: (signed.iter().map(|error| error * error).sum::<f64>() / count).sqrt(),
        bias: signed.iter().sum::<f64>() / count,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_pictures_have_no_differences() {
        let picture = [0.0, 0.25, 1.0];
        let found = differences(&picture, &picture, &[true; 3]).unwrap();
        assert_eq!(found, Differences { pixels: 3, max: 0.0, p99: 0.0, rms: 0.0, bias: 0.0 });
    }

    #[test]
    fn four_pixels_have_the_differences_that_a_hand_computes() {
        let found = differences(&[0.5, 0.0, 1.0, 0.25], &[0.0, 0.5, 1.0, 0.0], &[true; 4]).unwrap();
        assert_eq!(found, Differences { pixels: 4, max: 0.5, p99: 0.5, rms: 0.375, bias: 0.0625 });
    }

    #[test]
    fn one_pixel_of_a_hundred_is_beyond_the_99th_percentile_and_two_are_not() {
        let mut picture = [0.0; 100];
        picture[17] = 1.0;
        let one = differences(&picture, &[0.0; 100], &[true; 100]).unwrap();
        assert_eq!((one.max, one.p99, one.rms), (1.0, 0.0, 0.1));
        picture[3] = -1.0;
        let two = differences(&picture, &[0.0; 100], &[true; 100]).unwrap();
        assert_eq!((two.p99, two.bias), (1.0, 0.0));
    }

    #[test]
    fn a_wrong_picture_is_far_from_the_truth() {
        let truth: Vec<f32> = (0..1000).map(|i| f32::from(u8::from(i % 100 < 50))).collect();
        let inverted: Vec<f32> = truth.iter().map(|v| 1.0 - v).collect();
        let shifted: Vec<f32> = (0..1000).map(|i| f32::from(u8::from((i + 1) % 100 < 50))).collect();
        let mask = [true; 1000];
        assert_eq!(differences(&inverted, &truth, &mask).unwrap().rms, 1.0);
        let one_pixel_off = differences(&shifted, &truth, &mask).unwrap();
        assert_eq!((one_pixel_off.max, one_pixel_off.p99), (1.0, 1.0));
        assert!((one_pixel_off.rms - 0.02f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn pixels_outside_of_the_mask_do_not_count() {
        let found = differences(&[f32::NAN, 0.5], &[0.0, 0.25], &[false, true]).unwrap();
        assert_eq!((found.pixels, found.max, found.bias), (1, 0.25, 0.25));
        assert_eq!(differences(&[0.0], &[1.0], &[false]).unwrap().pixels, 0);
        assert_eq!(penumbra(&[0.0, 0.5, 1.0, 0.5], &[true, true, true, false]).unwrap(), [false, true, false, false]);
    }

    #[test]
    fn pictures_that_cannot_be_compared_are_refused() {
        let lengths = differences(&[0.0; 2], &[0.0; 3], &[true; 3]).unwrap_err();
        assert!(matches!(lengths, Error::Lengths { found: 2, truth: 3, mask: 3 }));
        let nan = differences(&[0.0, f32::NAN], &[0.0; 2], &[true; 2]).unwrap_err();
        assert!(nan.to_string().starts_with("pixel 1 is NaN"), "{nan}");
        assert!(penumbra(&[0.5; 2], &[true]).is_err());
    }
}
