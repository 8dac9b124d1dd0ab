//! FLIP: how different two pictures look when one flips between them on a screen.
//!
//! Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild, *FLIP: A Difference Evaluator for Alternating
//! Images* (2020), as NVIDIA's own program computes it (crate `nv-flip`). Per pixel, with the pictures blurred by the
//! contrast sensitivity of the eye at the given pixels per degree:
//! ```text
//! FLIP = dE_c ^ (1 - dE_f)     dE_c: difference of colour, dE_f: of edges and points, all from 0 to 1
//! ```
//! What is shown is a white surface under the light alone: visibility is its luminance as a share of full light, encoded
//! as sRGB (IEC 61966-2-1) in 8 bits. Pixels outside of the mask are black in both pictures. So a difference of less
//! than a code is none, and a shadow on a dark or textured surface is less visible than this says.

use crate::percentile::p99;
use crate::{Error, check};

/// Viewing conditions of the paper: a screen 3840 pixels and 0.7 m wide at a distance of 0.7 m.
pub const FLIP_PIXELS_PER_DEGREE: f64 = 67.0;

/// Below, the eye's blur is less than a pixel of any picture; above, pixels are eight times finer than the eye resolves
/// (60 cycles per degree), and the filters grow without use.
const PIXELS_PER_DEGREE: std::ops::RangeInclusive<f64> = 1.0..=1000.0;

/// Visible differences over a mask.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Flip {
    /// Pixels of the mask.
    pub pixels: usize,
    /// Viewing condition: distance in pixels times pi / 180.
    pub pixels_per_degree: f64,
    /// Mean, 0 (equal) to 1, the number that the authors recommend; 0 under an empty mask.
    pub mean: f64,
    /// 99th percentile (nearest rank), 0 to 1.
    pub p99: f64,
}

/// Compares two pictures of visibility with rows of `width` pixels, as seen where a degree of vision spans
/// `pixels_per_degree` pixels. Visibilities below 0 and above 1 are shown as 0 and 1.
///
/// # Errors
/// Different numbers of pixels, rows that do not fill the picture, values inside the mask that are not finite, and
/// pixels per degree outside of 1 to 1000.
pub fn flip(found: &[f32], truth: &[f32], mask: &[bool], width: usize, pixels_per_degree: f64) -> Result<Flip, Error> {
    check::rows(found, truth, mask, width)?;
    if !PIXELS_PER_DEGREE.contains(&pixels_per_degree) {
        return Err(Error::PixelsPerDegree { found: pixels_per_degree, allowed: PIXELS_PER_DEGREE });
    }
    let size = [width, mask.len() / width];
    let [found, truth] = [found, truth].map(|picture| shown(picture, mask, size));
    let map =
        if mask.contains(&true) { nv_flip::flip(truth, found, pixels_per_degree as f32).to_vec() } else { Vec::new() };
    let mut values: Vec<f64> =
        map.into_iter().zip(mask).filter(|(_, inside)| **inside).map(|(v, _)| f64::from(v)).collect();
    values.sort_by(f64::total_cmp);
    let mean = values.iter().fold(0.0, |sum, value| sum + value) / values.len().max(1) as f64;
    Ok(Flip { pixels: values.len(), pixels_per_degree, mean, p99: p99(&values).unwrap_or(0.0) })
}

/// The picture as a screen gets it.
fn shown(picture: &[f32], mask: &[bool], [width, height]: [usize; 2]) -> nv_flip::FlipImageRgb8 {
    let codes = picture.iter().zip(mask).map(|(&visibility, &inside)| if inside { code(visibility) } else { 0 });
    let rgb: Vec<u8> = codes.flat_map(|code| [code; 3]).collect();
    nv_flip::FlipImageRgb8::with_data(width as u32, height as u32, &rgb)
}

/// sRGB code of a share of full light.
fn code(visibility: f32) -> u8 {
    let linear = visibility.clamp(0.0, 1.0);
    let encoded = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    (encoded * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: usize = 64;
    const PIXELS: usize = WIDTH * WIDTH;

    fn compare(found: &[f32], truth: &[f32]) -> Flip {
        flip(found, truth, &[true; PIXELS], WIDTH, FLIP_PIXELS_PER_DEGREE).unwrap()
    }

    /// An edge across the columns, lit from `place_px` on.
    fn edge(place_px: f32) -> Vec<f32> {
        (0..PIXELS).map(|i| (0.5 + ((i % WIDTH) as f32 - place_px) / 8.0).clamp(0.0, 1.0)).collect()
    }

    /// The formula for pictures of one grey each, where blur and edges have no part: section 4 of the paper.
    fn flip_of_greys(codes: [u8; 2]) -> f64 {
        let linear = |code: u8| ((f64::from(code) / 255.0 + 0.055) / 1.055).powf(2.4);
        let root = |t: f64| if t > (6.0f64 / 29.0).powi(3) { t.cbrt() } else { t * 841.0 / 108.0 + 4.0 / 29.0 };
        let lightness = |luminance: f64| 116.0 * root(luminance) - 16.0;
        // Columns of the matrix from linear sRGB to XYZ, over the white point.
        let lab = |[x, y, z]: [f64; 3]| {
            let [x, y, z] = [x / 0.950_456, y, z / 1.089_058].map(root);
            let lightness = 116.0 * y - 16.0;
            [lightness, 0.01 * lightness * 500.0 * (x - y), 0.01 * lightness * 200.0 * (y - z)]
        };
        let [green, blue] = [lab([0.357_576, 0.715_152, 0.119_192]), lab([0.180_437, 0.072_175, 0.950_304])];
        let chroma = (green[1] - blue[1]).hypot(green[2] - blue[2]);
        let largest = ((green[0] - blue[0]).abs() + chroma).powf(0.7);
        let knee = 0.4 * largest;
        let [a, b] = codes.map(|code| if code == 0 { 0.0 } else { lightness(linear(code)) });
        let difference = (a - b).abs().powf(0.7);
        if difference < knee { 0.95 * difference / knee } else { 0.95 + 0.05 * (difference - knee) / (largest - knee) }
    }

    #[test]
    fn greys_differ_as_the_formula_of_the_paper_says() {
        for [found, truth] in [[0.0, 1.0], [0.5, 0.25], [0.8, 0.7], [0.5, 0.5]] {
            let known = flip_of_greys([code(found), code(truth)]);
            let result = compare(&[found; PIXELS], &[truth; PIXELS]);
            assert!((result.mean - known).abs() < 1e-3 && (result.p99 - known).abs() < 1e-3, "{known}: {result:?}");
        }
    }

    #[test]
    fn visibility_is_shown_as_srgb() {
        // 21.4 % of light has the middle code; the linear part ends below code 11.
        assert_eq!([-1.0, 0.0, 0.003, 0.214, 1.0, 2.0].map(code), [0, 0, 10, 127, 255, 255]);
    }

    #[test]
    fn the_further_an_edge_is_off_the_more_it_is_seen() {
        let truth = edge(32.0);
        assert_eq!(compare(&truth, &truth).p99, 0.0);
        let means = [0.3, 1.0, 4.0].map(|shift| compare(&edge(32.0 + shift), &truth).mean);
        assert!(means[0] > 1e-3 && means.is_sorted(), "{means:?}");
        let inverted: Vec<f32> = truth.iter().map(|v| 1.0 - v).collect();
        let wrong = compare(&inverted, &truth);
        assert!(wrong.mean > 0.8 && wrong.p99 > 0.95, "{wrong:?}");
    }

    #[test]
    fn fine_grain_is_seen_less_from_afar() {
        let grain: Vec<f32> =
            (0..PIXELS).map(|i| if (i / WIDTH + i).is_multiple_of(2) { 0.45 } else { 0.55 }).collect();
        let near = flip(&grain, &[0.5; PIXELS], &[true; PIXELS], WIDTH, 20.0).unwrap();
        let far = flip(&grain, &[0.5; PIXELS], &[true; PIXELS], WIDTH, 120.0).unwrap();
        assert!(near.mean > 2.0 * far.mean, "{near:?} {far:?}");
    }

    #[test]
    fn only_what_is_inside_of_the_mask_counts() {
        let truth = vec![0.5; PIXELS];
        let mut found = truth.clone();
        found[..PIXELS / 2].fill(f32::NAN);
        let mask: Vec<bool> = found.iter().map(|v| v.is_finite()).collect();
        let half = flip(&found, &truth, &mask, WIDTH, FLIP_PIXELS_PER_DEGREE).unwrap();
        assert_eq!((half.pixels, half.mean), (PIXELS / 2, 0.0));
        let none = flip(&found, &truth, &[false; PIXELS], WIDTH, FLIP_PIXELS_PER_DEGREE).unwrap();
        assert_eq!((none.pixels, none.mean, none.p99), (0, 0.0, 0.0));
        let nan = flip(&found, &truth, &[true; PIXELS], WIDTH, FLIP_PIXELS_PER_DEGREE).unwrap_err();
        assert!(nan.to_string().starts_with("pixel 0 is NaN"), "{nan}");
    }

    #[test]
    fn small_pictures_have_a_result_and_absurd_viewing_conditions_an_error() {
        assert_eq!(flip(&[0.5], &[0.5], &[true], 1, 1.0).unwrap().mean, 0.0);
        for pixels_per_degree in [0.0, -67.0, 1e6, f64::NAN, f64::INFINITY] {
            let error = flip(&[0.5], &[0.5], &[true], 1, pixels_per_degree).unwrap_err();
            assert!(error.to_string().ends_with("allowed are 1 to 1000"), "{error}");
        }
    }
}
