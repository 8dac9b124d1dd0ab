//! A picture of where two pictures differ: red too bright, blue too dark, near white equal, grey outside of the mask.
//!
//! The colours are ColorBrewer's diverging scale RdBu (Harrower and Brewer 2003): lightness falls alike to both sides,
//! hue tells the sign, and it is safe for the common forms of colour blindness.

use crate::{Error, check};

/// sRGB of a pixel outside of the mask: darker than the scale's middle, without a hue.
const OUTSIDE: [u8; 3] = [176; 3];

/// Rows of 8-bit sRGB, three bytes a pixel, of `found - truth`. A difference of `full_scale` or more has the scale's
/// end colour, so that maps with one scale can be compared.
///
/// # Errors
/// Different numbers of pixels, and values inside the mask that are not finite.
pub fn error_map(found: &[f32], truth: &[f32], mask: &[bool], full_scale: f32) -> Result<Vec<u8>, Error> {
    check::pictures(found, truth, mask)?;
    let mut rgb = Vec::with_capacity(3 * found.len());
    for ((&found, &truth), &inside) in found.iter().zip(truth).zip(mask) {
        rgb.extend(if inside { color((found - truth) / full_scale) } else { OUTSIDE });
    }
    Ok(rgb)
}

/// Of a difference in shares of the full scale.
fn color(share: f32) -> [u8; 3] {
    // The scale runs from red at 0 to blue at 1.
    let place = 0.5 - 0.5 * f64::from(share.clamp(-1.0, 1.0));
    colorous::RED_BLUE.eval_continuous(place).into_array()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance of an sRGB colour, approximated with a gamma of 2.2.
    fn luminance(rgb: [u8; 3]) -> f32 {
        let [r, g, b] = rgb.map(|code| (f32::from(code) / 255.0).powf(2.2));
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    #[test]
    fn too_bright_is_red_too_dark_is_blue_equal_is_near_white() {
        let map = error_map(&[1.0, 0.0, 0.5, 0.0], &[0.0, 1.0, 0.5, 1.0], &[true, true, true, false], 0.25).unwrap();
        let [r, _, b] = [map[0], map[1], map[2]];
        assert!(r > 2 * b, "{map:?}");
        let [r, _, b] = [map[3], map[4], map[5]];
        assert!(b > 2 * r, "{map:?}");
        assert!(map[6..9].iter().all(|&code| code > 235), "{map:?}");
        assert_eq!(map[9..], OUTSIDE);
    }

    #[test]
    fn a_larger_difference_is_never_lighter() {
        for sign in [-1.0, 1.0] {
            let steps: Vec<f32> = (0..=20).map(|i| luminance(color(sign * i as f32 / 20.0))).collect();
            assert!(steps.is_sorted_by(|a, b| a >= b), "{steps:?}");
            assert_eq!(color(sign * 3.0), color(sign));
        }
    }

    #[test]
    fn a_map_of_nonsense_is_refused() {
        assert!(error_map(&[f32::NAN], &[0.0], &[true], 0.25).is_err());
        assert!(error_map(&[0.0], &[0.0, 0.0], &[true], 0.25).is_err());
    }
}
