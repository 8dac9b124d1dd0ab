//! Edges of shadows as an eye sees them: how far they are from the true ones, and how they turn away from them.
//!
//! An edge is the 0.5 iso-contour of the visibility. It is looked at where it is a shadow's edge and nothing else:
//! * *on one surface*: a pixel and its neighbours lie in a common plane to [`EVEN_DEG`], so no border of a thing, no fold;
//! * *in a wide penumbra*: the true visibility takes at least [`PENUMBRA_PX`] pixels from light to dark. A narrower one is
//!   made of the pixels' own sides.
//!
//! The taps of a filter turn from pixel to pixel, and their grain would tilt an edge more than any texel. An eye averages it
//! and so does this: found and truth are smoothed by a Gaussian of [`SMOOTHING_PX`] over the pixels that count, which turns
//! no straight edge, and which leaves the stairs of texels that are wider than it.

use anyhow::Result;
use glam::Vec3;
use rayon::prelude::*;
use scumble_reference::{HIDDEN_TILT_DEG, edge_displacement, edge_tilt};
use serde::{Deserialize, Serialize};

use crate::bench::comparison::Screen;
use crate::gbuffer::Surface;

/// Surfaces that bend by more from pixel to pixel bend their shadows, too: the tilt that observers miss.
const EVEN_DEG: f32 = HIDDEN_TILT_DEG as f32;
/// Least width of a penumbra.
pub const PENUMBRA_PX: f32 = 8.0;
/// Standard deviation of the smoothing: a quarter of the narrowest penumbra.
const SMOOTHING_PX: f32 = PENUMBRA_PX / 4.0;
/// Where the Gaussian ends, in standard deviations.
const SMOOTHING_REACH: f32 = 2.5;
/// Shortest edge of which something is said.
pub const LENGTH_MIN_PX: f64 = 100.0;

/// Edges of a picture against the true ones.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Edges {
    /// Length of the true edges, pixels.
    pub length_px: f64,
    /// Mean distance, pixels.
    pub displacement_mean_px: f64,
    /// 95 % of the length is nearer.
    pub displacement_p95_px: f64,
    /// Median angle, degrees.
    pub tilt_p50_deg: f64,
    /// Share of the length that is tilted by more than observers miss, 0 to 1.
    pub tilt_visible_share: f64,
}

/// Where edges are looked at, and the true ones there.
pub struct EdgeTruth {
    /// Pixels of even surfaces that face the light: what is smoothed.
    even: Vec<bool>,
    /// Those of them whose penumbra is wide: where edges count.
    mask: Vec<bool>,
    smoothed: Vec<f32>,
    width: usize,
}

impl EdgeTruth {
    /// Of a true visibility.
    pub fn new(screen: &Screen, truth: &[f32]) -> Self {
        let width = screen.size_px[0] as usize;
        let is_even = |pixel: usize| screen.lit_facing[pixel] && is_even(&screen.surfaces, pixel, width);
        let even: Vec<bool> = (0..truth.len()).map(is_even).collect();
        let smoothed = smoothed(truth, &even, width);
        let is_wide = |pixel: usize| slope(&smoothed, &even, pixel, width) <= 1.0 / PENUMBRA_PX;
        let mask = (0..truth.len()).map(|pixel| even[pixel] && is_wide(pixel)).collect();
        Self { even, mask, smoothed, width }
    }

    /// Compares a picture; `None` where there is too little edge to say something.
    pub fn compare(&self, found: &[f32]) -> Result<Option<Edges>> {
        let found = smoothed(found, &self.even, self.width);
        let displacement = edge_displacement(&found, &self.smoothed, &self.mask, self.width)?;
        let tilt = edge_tilt(&found, &self.smoothed, &self.mask, self.width)?;
        let is_enough = displacement.truth_length_px >= LENGTH_MIN_PX && displacement.mean_px.is_finite();
        Ok(is_enough.then_some(Edges {
            length_px: displacement.truth_length_px,
            displacement_mean_px: displacement.mean_px,
            displacement_p95_px: displacement.p95_px,
            tilt_p50_deg: tilt.p50_deg,
            tilt_visible_share: tilt.visible_share,
        }))
    }
}

/// Whether a pixel and all that touch it lie in one plane to [`EVEN_DEG`].
fn is_even(surfaces: &[Option<Surface>], pixel: usize, width: usize) -> bool {
    let Some(here) = surfaces[pixel] else { return false };
    let (sin, cos) = EVEN_DEG.to_radians().sin_cos();
    around(pixel, surfaces.len(), width).all(|near| {
        surfaces[near].is_some_and(|there| {
            let apart = there.position - here.position;
            let [n, m] = [here.normal, there.normal].map(|normal| normal.normalize_or(Vec3::ZERO));
            n.dot(m) >= cos && n.dot(apart).abs() <= sin * apart.length()
        })
    })
}

/// The pixels that touch one.
fn around(pixel: usize, count: usize, width: usize) -> impl Iterator<Item = usize> {
    let (x, y) = (pixel % width, pixel / width);
    let columns = x.saturating_sub(1)..(x + 2).min(width);
    let rows = y.saturating_sub(1)..(y + 2).min(count / width);
    rows.flat_map(move |y| columns.clone().map(move |x| y * width + x)).filter(move |&near| near != pixel)
}

/// Steepness at a pixel, change of visibility by pixel; where a neighbour does not count, the side that does.
fn slope(picture: &[f32], mask: &[bool], pixel: usize, width: usize) -> f32 {
    let along = |step: usize, is_first: bool, is_last: bool| {
        let before = (!is_first && mask[pixel - step]).then(|| picture[pixel] - picture[pixel - step]);
        let after = (!is_last && mask[pixel + step]).then(|| picture[pixel + step] - picture[pixel]);
        match (before, after) {
            (Some(before), Some(after)) => (before + after) / 2.0,
            (one, other) => one.or(other).unwrap_or(0.0),
        }
    };
    let (x, y) = (pixel % width, pixel / width);
    let across = along(1, x == 0, x + 1 == width);
    let down = along(width, y == 0, pixel + width >= picture.len());
    across.hypot(down)
}

/// A picture under the Gaussian, of the pixels of the mask alone; 0 outside of it.
fn smoothed(picture: &[f32], mask: &[bool], width: usize) -> Vec<f32> {
    let inside: Vec<f32> = mask.iter().map(|&inside| f32::from(u8::from(inside))).collect();
    let masked: Vec<f32> = picture.iter().zip(&inside).map(|(value, inside)| value * inside).collect();
    let [sum, weight] = [masked, inside].map(|picture| blurred(&picture, width));
    let of_pixel = |pixel: usize| if mask[pixel] { sum[pixel] / weight[pixel] } else { 0.0 };
    (0..picture.len()).map(of_pixel).collect()
}

/// The Gaussian along rows, then along columns; what is beyond the picture is 0.
fn blurred(picture: &[f32], width: usize) -> Vec<f32> {
    let reach = (SMOOTHING_REACH * SMOOTHING_PX).ceil() as isize;
    let weight = |offset: isize| (-0.5 * (offset as f32 / SMOOTHING_PX).powi(2)).exp();
    let weights: Vec<f32> = (-reach..=reach).map(weight).collect();
    let along = |picture: &[f32], place: fn(usize, usize) -> usize, step: usize, count: usize| -> Vec<f32> {
        let of_pixel = |pixel: usize| {
            let here = place(pixel, width) as isize;
            let near = weights.iter().zip(here - reach..).filter(|(_, at)| (0..count as isize).contains(at));
            near.map(|(weight, at)| weight * picture[(pixel as isize + (at - here) * step as isize) as usize]).sum()
        };
        (0..picture.len()).into_par_iter().map(of_pixel).collect()
    };
    let rows = along(picture, |pixel, width| pixel % width, 1, width);
    along(&rows, |pixel, width| pixel / width, width, picture.len() / width)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [200, 150];

    /// A plane seen from above, a centimetre a pixel, with a fold at column 170.
    fn screen() -> Screen {
        let surface = |pixel: u32| {
            let (x, y) = (pixel % SIZE[0], pixel / SIZE[0]);
            let normal = if x < 170 { Vec3::Y } else { Vec3::X };
            Some(Surface { position: Vec3::new(x as f32, 0.0, y as f32) / 100.0, normal })
        };
        let count = SIZE[0] * SIZE[1];
        Screen { size_px: SIZE, surfaces: (0..count).map(surface).collect(), lit_facing: vec![true; count as usize] }
    }

    /// An edge through the middle, `tilt` degrees from upright, with a penumbra of `width_px`.
    fn edge(tilt: f32, width_px: f32) -> Vec<f32> {
        let (sin, cos) = tilt.to_radians().sin_cos();
        let at = |pixel: u32| {
            let (x, y) = ((pixel % SIZE[0]) as f32 - 80.0, (pixel / SIZE[0]) as f32 - 75.0);
            ((cos * x + sin * y) / width_px + 0.5).clamp(0.0, 1.0)
        };
        (0..SIZE[0] * SIZE[1]).map(at).collect()
    }

    #[test]
    fn an_edge_that_is_turned_has_its_angle_and_one_that_is_true_none() {
        let truth = EdgeTruth::new(&screen(), &edge(10.0, 20.0));
        let same = truth.compare(&edge(10.0, 20.0)).unwrap().unwrap();
        assert!(same.tilt_p50_deg < 0.1 && same.displacement_mean_px < 0.01 && same.tilt_visible_share == 0.0);
        assert!((same.length_px - 150.0).abs() < 10.0, "{same:?}");
        let turned = truth.compare(&edge(22.0, 20.0)).unwrap().unwrap();
        assert!((turned.tilt_p50_deg - 12.0).abs() < 0.5 && turned.tilt_visible_share > 0.95, "{turned:?}");
    }

    #[test]
    fn grain_tilts_no_edge() {
        let truth = EdgeTruth::new(&screen(), &edge(10.0, 24.0));
        // 25 taps of a filter scatter by 0.03 to 0.1 in a penumbra.
        let grain = |pixel: usize| ((pixel as u32).wrapping_mul(2_654_435_761) >> 16 & 0xff) as f32 / 255.0 - 0.5;
        let noisy: Vec<f32> = edge(10.0, 24.0)
            .into_iter()
            .enumerate()
            .map(|(pixel, value)| if value > 0.0 && value < 1.0 { value + 0.15 * grain(pixel) } else { value })
            .collect();
        let edges = truth.compare(&noisy).unwrap().unwrap();
        assert!(edges.tilt_p50_deg < 3.0 && edges.tilt_visible_share < 0.15, "{edges:?}");
    }

    #[test]
    fn narrow_penumbrae_and_folds_are_left_out() {
        assert_eq!(EdgeTruth::new(&screen(), &edge(10.0, 3.0)).compare(&edge(10.0, 3.0)).unwrap(), None);
        let fold = (0..SIZE[0] * SIZE[1]).map(|pixel| f32::from(u8::from(pixel % SIZE[0] < 170))).collect::<Vec<_>>();
        assert_eq!(EdgeTruth::new(&screen(), &fold).compare(&fold).unwrap(), None);
    }
}
