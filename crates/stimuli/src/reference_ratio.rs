//! The reference filter: the smallest ratio from which nobody can see the steps, whatever their eyes.
//!
//! "If the rasterization of two filtered solutions, one with and one without artifacts [...] produces
//! the same image (assuming a typical 8-bit representation for intensities), even a perfect user will
//! not be able to spot any artifacts" (Kreuzer 2017, section 4.4). Equality of two rounded pictures
//! comes and goes as the radius grows, so here it is a tolerance: with
//!
//! ```text
//! G(q) = largest difference of the filtered artifact and the filtered line at the ratio q = r / a,
//!        in levels of 255, over all places at least r from the left and right border of the picture
//!        and all phases of the pattern
//! c_ref(D) = the smallest ratio beyond which G never exceeds D
//! ```
//!
//! Levels are code values: `255 * contrast * |F_artifact - F_line|` for
//! [`Encoding::CodeValues`], the difference of two sRGB signals of `contrast * (1 - F)` for
//! [`Encoding::LinearLight`]. Neither is rounded.
//!
//! A stair is infinite. A step and a double step belong to a picture of `W` texels, as high as need
//! be; their phase ([`Stimulus::phase`](crate::Stimulus::phase)) moves them inside its middle half,
//! so that places from `-(3 W / 4 - q)` to `3 W / 4 - q` around the riser occur, and none at all from
//! `q = W / 2` on. The difference of lowest order in `1 / q` at a place `x`, `y` from the riser under
//! a disc, with `c = sqrt(q^2 - y^2)`, is `min(x, c) (1 - 2 max(x, c) / W) / (pi q^2)`, and so
//!
//! ```text
//! G(q) = 255 contrast (1 - 2 q / W) / (pi q)    for q <= W / 4
//! G(q) = 255 contrast W / (8 pi q^2)            for W / 4 <= q < W / 2
//! ```
//!
//! Derived for this project; the largest differences are searched with the exact coverage.

use std::f64::consts::{PI, SQRT_2};

use crate::search::{falling_root, larger, peak};
use crate::{Encoding, Error, Kernel, Pattern, Silhouette};

/// Largest ratio that is searched: the largest that a relation may state.
const LARGEST_RATIO: f64 = 64.0;

/// Standard deviations of a Gaussian within which a difference can reach the smallest tolerance: 2e-8
/// of it lies beyond, 6e-5 levels at the steepest part of sRGB.
const GAUSSIAN_REACH: f64 = 5.5;

/// Step of the scan over ratios: the pattern of stair and kernel repeats after `1 / sqrt 2` or more.
const RATIO_STEP: f64 = 0.1;

/// Step of the scan over ratios where nothing repeats, as a part of the ratio.
const RELATIVE_STEP: f64 = 0.1;

/// A peak of the scan at which the difference is nearer to the tolerance than this may hide a higher
/// one: a cosine sampled seven times in its period is seen at 0.9 of its height or more.
const NEAR_PEAK: f64 = 0.8;

/// Below this ratio the steps are as good as hard, and a smaller one changes nothing.
const SMALLEST_RATIO: f64 = 0.2;

/// A silhouette is no further than this from its line, in texels.
const LARGEST_OFFSET: f64 = 0.75;

/// The scan over the ratios of a stair starts where the difference is this part of the tolerance all
/// over one repetition, sought in steps of this factor: peaks fall with the ratio, under the disc as
/// its power -3/2, under the box as its power -2, under a Gaussian faster than any power.
const CALM: f64 = 0.6;
const LADDER: f64 = 1.2;

/// Width of the interval in which the ratio is known at the end.
const PRECISION: f64 = 1e-7;

/// A climb ends when its ring is this part of the distance of the scan's places, or after this many
/// rounds.
const SMALLEST_RING: f64 = 1e-4;
const ROUNDS: u32 = 100;

/// Places on the ring of a climb.
const DIRECTIONS: u32 = 12;

/// Multiples of this angle never come back to the same direction: `pi (3 - sqrt 5)`.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// Highest places of the scan from which a search goes on.
const CLIMBS: usize = 3;

/// What is compared: a filtered artifact with the filtered line that it stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// The artifact.
    pub pattern: Pattern,
    /// The filter: one without taps, whose difference vanishes as it grows.
    pub kernel: Kernel,
    /// The lit side in the units of `encoding`, above 0 to 1.
    pub contrast: f64,
    /// What coverage is proportional to.
    pub encoding: Encoding,
    /// Texels across the picture, W / a, 4 to 4096. Not used by a stair.
    pub width_texels: f64,
}

/// `c_ref(D)`: the smallest ratio r / a beyond which the difference never exceeds
/// `tolerance_levels`, 0.5 to 128 of 255; 0 if it never does.
///
/// For a step it is at most `W / 2`, and that value says that the step is hidden by the border only:
/// no place of the picture is further from it. The search finds peaks from below: code values to
/// 1e-3 of the ratio, light to 1e-2, because sRGB magnifies thin features at the dark foot of the
/// penumbra. An error if the difference is larger at the ratio 64 still.
pub fn reference_ratio(comparison: &Comparison, tolerance_levels: f64) -> Result<f64, Error> {
    comparison.check()?;
    // Below half a level it is rounding that decides whether two pictures differ.
    in_range("tolerance_levels", tolerance_levels, "0.5 to 128", (0.5..=128.0).contains(&tolerance_levels))?;
    comparison.scan_down(tolerance_levels)
}

/// A place of the picture: `x` texels right of the riser, and an angle, 0 to pi, that gives how far
/// it is above the line, `-cos angle` of the reach. Equal angles are close together where the kernel
/// ends, as equal steps of its chord are.
#[derive(Clone, Copy, Debug)]
struct Place {
    x: f64,
    angle: f64,
}

impl Comparison {
    /// `G(q)`: the largest difference in levels of 255 at a ratio of 0.25 to 64.
    pub fn largest_difference(&self, ratio: f64) -> Result<f64, Error> {
        self.check()?;
        in_range("ratio", ratio, "0.25 to 64", (0.25..=LARGEST_RATIO).contains(&ratio))?;
        Ok(self.largest(ratio).1)
    }

    fn check(&self) -> Result<(), Error> {
        in_range("contrast", self.contrast, "above 0 to 1", self.contrast > 0.0 && self.contrast <= 1.0)?;
        in_range("width_texels", self.width_texels, "4 to 4096", (4.0..=4096.0).contains(&self.width_texels))?;
        match self.kernel {
            Kernel::Disc | Kernel::Box | Kernel::GaussianHalf | Kernel::GaussianThird => Ok(()),
            Kernel::Poisson25 | Kernel::Poisson25Rotated => Err(Error::Taps),
        }
    }

    /// Goes down from where the difference stays small to the first ratio where it is too large.
    fn scan_down(&self, tolerance: f64) -> Result<f64, Error> {
        let mut ratio = self.first_ratio(tolerance)?;
        let mut above: Vec<(f64, Place, f64)> = Vec::new();
        loop {
            let (place, levels) = self.largest(ratio);
            if levels > tolerance {
                let keeps = above.last().map_or(ratio, |&(ratio, ..)| ratio);
                return Ok(self.crossing(ratio, keeps, tolerance));
            }
            // A peak between ratios of the scan that none of them shows.
            if let [.., (high, _, at_high), (_, place, at_middle)] = above[..]
                && at_middle >= f64::max(at_high, levels)
                && at_middle > NEAR_PEAK * tolerance
            {
                let (top, at_top) = peak(|ratio| self.climb(ratio, place).1, ratio, high);
                if at_top > tolerance {
                    return Ok(self.crossing(top, high, tolerance));
                }
            }
            if ratio < SMALLEST_RATIO {
                return Ok(0.0);
            }
            above.push((ratio, place, levels));
            ratio -= self.ratio_step(ratio);
        }
    }

    /// Where the difference falls to the tolerance between two ratios.
    fn crossing(&self, exceeds: f64, keeps: f64, tolerance: f64) -> f64 {
        falling_root(|ratio| self.largest(ratio).1 - tolerance, exceeds, keeps, PRECISION)
    }

    /// A ratio beyond which the difference never exceeds the tolerance.
    fn first_ratio(&self, tolerance: f64) -> Result<f64, Error> {
        if self.pattern == Pattern::Stair {
            let mut ratio = 1.0;
            while ratio < LARGEST_RATIO {
                let mut repetition = (0..8).map(|step| ratio + RATIO_STEP * f64::from(step));
                if repetition.all(|ratio| self.largest(ratio).1 < CALM * tolerance) {
                    return Ok(ratio);
                }
                ratio *= LADDER;
            }
        } else if 0.5 * self.width_texels <= LARGEST_RATIO {
            // Half the width itself leaves no place to look at.
            return Ok(0.5 * self.width_texels * (1.0 - 1e-9));
        }
        let levels = self.largest(LARGEST_RATIO).1;
        if levels <= tolerance { Ok(LARGEST_RATIO) } else { Err(Error::Reference { tolerance, levels }) }
    }

    /// Step of the scan.
    fn ratio_step(&self, ratio: f64) -> f64 {
        match self.pattern {
            Pattern::Stair => RATIO_STEP,
            Pattern::Step | Pattern::DoubleStep => (RELATIVE_STEP * ratio).max(RATIO_STEP),
        }
    }

    /// The largest difference at a ratio and where it is: a scan, then a search around its peaks.
    fn largest(&self, ratio: f64) -> (Place, f64) {
        let (xs, angles) = self.scanned(ratio);
        let levels: Vec<Vec<f64>> = xs
            .iter()
            .map(|&x| angles.iter().map(|&angle| self.difference(ratio, Place { x, angle })).collect())
            .collect();
        let mut peaks = Vec::new();
        for (i, j) in (0..xs.len()).flat_map(|i| (0..angles.len()).map(move |j| (i, j))) {
            let around = |i: usize| levels.get(i).into_iter().flat_map(|row| row[j.saturating_sub(1)..].iter().take(3));
            let neighbours = around(i.wrapping_sub(1)).chain(around(i)).chain(around(i + 1));
            if neighbours.fold(0.0, |most: f64, &other| most.max(other)) <= levels[i][j] {
                peaks.push((Place { x: xs[i], angle: angles[j] }, levels[i][j]));
            }
        }
        peaks.sort_by(|first, second| second.1.total_cmp(&first.1));
        peaks.truncate(CLIMBS);
        let climbed = peaks.into_iter().map(|(place, _)| self.climb(ratio, place));
        climbed.reduce(larger).unwrap_or((Place { x: 0.0, angle: 0.0 }, 0.0))
    }

    /// Goes up from a place of the scan: to the best of a ring of places around it; where that is no
    /// better, the ring shrinks. It turns all the time, because the difference has sharp ridges (a
    /// chord of the kernel that ends at a riser) which a fixed set of directions does not follow.
    fn climb(&self, ratio: f64, from: Place) -> (Place, f64) {
        let [x_step, angle_step] = self.spacing(ratio);
        let limit = self.limit(ratio);
        let mut best = (from, self.difference(ratio, from));
        let (mut radius, mut turn) = (1.0, 0.0);
        for _ in 0..ROUNDS {
            let centre = best;
            for direction in 0..DIRECTIONS {
                let direction = turn + f64::from(direction) * (2.0 * PI / f64::from(DIRECTIONS));
                let x = centre.0.x + radius * x_step * libm::cos(direction);
                let angle = centre.0.angle + radius * angle_step * libm::sin(direction);
                let place = Place { x: x.clamp(-limit, limit), angle };
                best = larger(best, (place, self.difference(ratio, place)));
            }
            turn += GOLDEN_ANGLE;
            if best.1 <= centre.1 {
                radius *= 0.5;
            }
            if radius < SMALLEST_RING {
                break;
            }
        }
        best
    }

    /// Places of the scan: along the line, and across it.
    fn scanned(&self, ratio: f64) -> (Vec<f64>, Vec<f64>) {
        let [x_step, angle_step] = self.spacing(ratio);
        let limit = self.limit(ratio);
        let steps = |length: f64, step: f64| (0..=(length / step) as usize).map(move |k| k as f64 * step);
        let xs = match self.pattern {
            Pattern::Stair => steps(1.0 - x_step, x_step).collect(),
            Pattern::Step | Pattern::DoubleStep => steps(2.0 * limit, x_step).map(|x| x - limit).collect(),
        };
        // A point reflection in the origin swaps light and shadow, which code values do not notice.
        let half = if self.encoding == Encoding::CodeValues { 0.5 * PI } else { PI };
        (xs, steps(half, angle_step).collect())
    }

    /// Distances between the places of a scan.
    fn spacing(&self, ratio: f64) -> [f64; 2] {
        let across_border = 2.0 * self.limit(ratio);
        let [x_step, angles] = match (self.pattern, self.kernel) {
            (Pattern::Stair, Kernel::GaussianHalf | Kernel::GaussianThird) => [1.0 / 6.0, 32.0],
            // The places repeat after a texel, and wherever the kernel's chord is a texel longer.
            (Pattern::Stair, _) => [1.0 / 6.0, f64::max(64.0, 6.0 * ratio)],
            (Pattern::Step, _) => [across_border / 64.0, 128.0],
            (Pattern::DoubleStep, Kernel::GaussianHalf | Kernel::GaussianThird) => [across_border / 24.0, 32.0],
            (Pattern::DoubleStep, _) => [f64::min(1.0 / 3.0, across_border / 64.0), 64.0],
        };
        [x_step, PI / angles]
    }

    /// How far from the riser places go, in texels.
    fn limit(&self, ratio: f64) -> f64 {
        match self.pattern {
            Pattern::Stair => f64::INFINITY,
            Pattern::Step | Pattern::DoubleStep => 0.75 * self.width_texels - ratio,
        }
    }

    /// How far from the line places go, in texels.
    fn reach(&self, ratio: f64) -> f64 {
        match self.kernel {
            Kernel::GaussianHalf => GAUSSIAN_REACH * ratio / 2.0,
            Kernel::GaussianThird => GAUSSIAN_REACH * ratio / 3.0,
            // A level edge meets the side of the square, the others its corner.
            Kernel::Box if self.pattern != Pattern::Step => SQRT_2 * ratio,
            _ => ratio,
        }
    }

    /// Difference of artifact and line at a place, in levels of 255.
    fn difference(&self, ratio: f64, place: Place) -> f64 {
        let (artifact, slope) = match self.pattern {
            Pattern::Stair => (Silhouette::Stair, 1.0),
            Pattern::Step => (Silhouette::Step, 1.0 / self.width_texels),
            Pattern::DoubleStep => (Silhouette::DoubleStep, 1.0 - 1.0 / self.width_texels),
        };
        let above = -libm::cos(place.angle) * (self.reach(ratio) + LARGEST_OFFSET) * (1.0 + slope * slope).sqrt();
        let y = slope * place.x + above;
        let [first, second] = [artifact, Silhouette::Line { slope }]
            .map(|silhouette| self.signal(1.0 - silhouette.coverage(self.kernel, ratio, place.x, y)));
        255.0 * (first - second).abs()
    }

    /// The display's signal, 0 to 1, of a place of which `lit` is in light.
    fn signal(&self, lit: f64) -> f64 {
        let value = self.contrast * lit.clamp(0.0, 1.0);
        match self.encoding {
            Encoding::CodeValues => value,
            Encoding::LinearLight => srgb_from_linear(value),
        }
    }
}

/// sRGB signal, 0 to 1, of linear light, 0 to 1 (IEC 61966-2-1).
fn srgb_from_linear(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055 }
}

/// Refuses a value outside its range.
fn in_range(field: &'static str, value: f64, allowed: &'static str, good: bool) -> Result<(), Error> {
    if good { Ok(()) } else { Err(Error::Field { field, value, allowed }) }
}
