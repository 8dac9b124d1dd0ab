//! Variance shadow maps: visibility from the mean and the variance of depth under a kernel.
//!
//! A map is filtered once a frame in place of at every pixel (Donnelly and Lauritzen 2006; Kreuzer 2017, 3.3.2, whose
//! sigma is the variance). Of the depths z under the kernel, mean `mu` and variance `s`; a receiver at depth d sees at
//! most this share of the light (Chebyshev's one-sided inequality; Eisemann et al. 2009, 4.2):
//! ```text
//! d <= mu   1
//! d >  mu   p = s' / (s' + (d - mu)^2),   s' = max(s, deviation_min^2)
//! ```
//! Where one plane at height h shades the share q of a receiver parallel to it, `mu = d - q h` and `s = q (1 - q) h^2`, so
//! p = 1 - q: exact. Elsewhere it is a bound, and light *bleeds*: under two planes at heights `h_1 > h_2`, of which the
//! lower one shades all and the upper one the share q of it, p is `q (1 - q) g^2 / (q (1 - q) g^2 + (h_2 + q g)^2)` with
//! `g = h_1 - h_2`, and 0 would be right. The cut takes it away together with the darkest part of every penumbra:
//! `(p - cut) / (1 - cut)`, no less than 0 (Lauritzen 2007, GPU Gems 3, 8.4.3).
//!
//! Kernel: a square of half side r, aligned with the map, so a moving sum over x and then over y. Over texels of side a
//! its weights are the parts of texels inside of it, and values between texels are bilinear, which blurs the square by one
//! texel. 3.47 is the ratio of this kernel where it is worst, on an edge along its sides; c needs no correction.
//!
//! Cost: a radius of many texels is filtered on blocks of texels, [`block_texels`], in which it measures fewer than
//! [`BLOCK_RADIUS`] times 2. So no more than 17 blocks are added up along x and along y, whatever r.
//!
//! Deviation from the sources: mean and variance are stored, not the raw moments `E z` and `E z^2`, and are joined by their
//! differences (Chan, Golub and LeVeque 1979). `E z^2 - (E z)^2` of f32 cancels: at the far end of a range of 50 m a
//! deviation below 1 cm is rounding. Joined, the variance is as exact as the spread of depths itself, and needs neither
//! a middle of the range to count from nor a smallest variance against rounding.

use glam::DVec2;

use crate::error::{Error, check, not_negative};

/// Radius in blocks from which blocks get larger: the first whole number above the ratio 3.47, so that a block is never
/// larger than the texel that the relation allows.
pub const BLOCK_RADIUS: f64 = 4.0;

/// Guards of the bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VarianceBound {
    /// Smallest standard deviation of depth, in texels at the receiver: surfaces nearer to each other count as one.
    pub deviation_min_texels: f64,
    /// Share of the light below which the bound counts as dark, 0 to below 1; see the module.
    pub bleeding_cut: f64,
}

impl Default for VarianceBound {
    /// A tenth of a texel, as the constant part of [`Bias`](crate::Bias); and the cut of 0 to 0.3 with the least mean FLIP
    /// against the kernel without texels in each of the scenes yard, stairwell, recital and contact. Larger cuts err by more
    /// on the penumbrae than they save in bleeding.
    fn default() -> Self {
        Self { deviation_min_texels: 0.1, bleeding_cut: 0.02 }
    }
}

impl VarianceBound {
    /// Refuses what has no meaning.
    ///
    /// # Errors
    /// Names the value and what is allowed.
    pub fn checked(&self) -> Result<Self, Error> {
        not_negative("variance.deviation_min_texels", self.deviation_min_texels)?;
        let cut = self.bleeding_cut;
        check("variance.bleeding_cut", cut, (0.0..1.0).contains(&cut), "a share from 0 to below 1")?;
        Ok(*self)
    }
}

/// Mean and variance of depth under a kernel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments {
    /// Mean, in any unit of length.
    pub mean: f64,
    /// Mean square distance from the mean, in the square of this unit.
    pub variance: f64,
}

impl Moments {
    /// Of parts with their weights, of which one at least is above 0:
    /// `mean = E mean_i`, `variance = E (variance_i + (mean_i - mean)^2)`.
    pub fn of_parts(parts: impl Iterator<Item = (f64, Self)> + Clone) -> Self {
        let weight: f64 = parts.clone().map(|(weight, _)| weight).sum();
        let mean = parts.clone().map(|(weight, part)| weight * part.mean).sum::<f64>() / weight;
        let squares: f64 = parts.map(|(weight, part)| weight * (part.variance + (part.mean - mean).powi(2))).sum();
        Self { mean, variance: squares / weight }
    }

    /// Upper bound of the share of light that reaches a receiver at `depth`, less the cut: 0 to 1. `deviation_min` is in
    /// the unit of the depths.
    #[must_use]
    pub fn visibility(&self, depth: f64, deviation_min: f64, bleeding_cut: f64) -> f64 {
        let gap = depth - self.mean;
        if gap <= 0.0 {
            return 1.0;
        }
        let variance = self.variance.max(deviation_min * deviation_min);
        let bound = variance / (variance + gap * gap);
        ((bound - bleeding_cut) / (1.0 - bleeding_cut)).max(0.0)
    }
}

/// Texels along one axis of a block, for a radius in texels of that axis.
#[must_use]
pub fn block_texels(radius_texels: f64) -> u32 {
    (radius_texels / BLOCK_RADIUS).max(1.0) as u32
}

/// Weight of a block whose middle is `offset` blocks from the kernel's: the part of it that is inside, for a radius of
/// half a block and more.
#[must_use]
pub fn box_weight(radius_blocks: f64, offset: f64) -> f64 {
    (radius_blocks.max(0.5) + 0.5 - offset.abs()).clamp(0.0, 1.0)
}

/// The moments of a map, filtered.
#[derive(Clone, Debug, PartialEq)]
pub struct MomentMap {
    block: DVec2,
    size: [usize; 2],
    blocks: Vec<Moments>,
}

impl MomentMap {
    /// Filters `depths`, row by row `size_texels` of them, over a square of half side `radius_texels` in x and y. Beyond
    /// the map there is nothing: the kernel is cut off.
    #[must_use]
    pub fn new(depths: &[f64], size_texels: [u32; 2], radius_texels: DVec2) -> Self {
        let block = radius_texels.to_array().map(block_texels);
        let size = [0, 1].map(|axis| size_texels[axis].div_ceil(block[axis]) as usize);
        let map = |blocks| Self { block: DVec2::new(f64::from(block[0]), f64::from(block[1])), size, blocks };

        // Blocks of texels.
        let texel = |x: u32, y: u32| Moments { mean: depths[(y * size_texels[0] + x) as usize], variance: 0.0 };
        let inside = |axis: usize, i: usize| {
            let start = i as u32 * block[axis];
            start..(start + block[axis]).min(size_texels[axis])
        };
        let block_at = |x: usize, y: usize| {
            let texels = inside(1, y).flat_map(|y| inside(0, x).map(move |x| (x, y)));
            Moments::of_parts(texels.map(|(x, y)| (1.0, texel(x, y))))
        };
        let reduced = map(places(size).map(|(x, y)| block_at(x, y)).collect());

        // A moving mean over x, then over y.
        let radius = radius_texels / reduced.block;
        let rows = map(places(size).map(|(x, y)| reduced.moving_mean(radius.x, x, size[0], |x| (x, y))).collect());
        map(places(size).map(|(x, y)| rows.moving_mean(radius.y, y, size[1], |y| (x, y))).collect())
    }

    /// Moments at a place of the map in texels, bilinear between the middles of blocks.
    #[must_use]
    pub fn at(&self, place_texels: DVec2) -> Moments {
        let place = place_texels / self.block - 0.5;
        let corner = place.floor();
        let share = place - corner;
        let part = |dx: f64, dy: f64| {
            let weight = (1.0 - (share.x - dx).abs()) * (1.0 - (share.y - dy).abs());
            let last = DVec2::new(self.size[0] as f64, self.size[1] as f64) - 1.0;
            let block = (corner + DVec2::new(dx, dy)).clamp(DVec2::ZERO, last);
            (weight, self.get(block.x as usize, block.y as usize))
        };
        Moments::of_parts([part(0.0, 0.0), part(1.0, 0.0), part(0.0, 1.0), part(1.0, 1.0)].into_iter())
    }

    fn get(&self, x: usize, y: usize) -> Moments {
        self.blocks[y * self.size[0] + x]
    }

    fn moving_mean(&self, radius: f64, i: usize, count: usize, place: impl Fn(usize) -> (usize, usize)) -> Moments {
        let reach = (radius.max(0.5) + 0.5).ceil() as usize;
        let around = i.saturating_sub(reach)..(i + reach + 1).min(count);
        Moments::of_parts(around.map(|j| {
            let (x, y) = place(j);
            (box_weight(radius, j as f64 - i as f64), self.get(x, y))
        }))
    }
}

fn places([width, height]: [usize; 2]) -> impl Iterator<Item = (usize, usize)> {
    (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const RECEIVER: f64 = 7.0;

    /// Moments of depths with their shares.
    fn of(depths: &[(f64, f64)]) -> Moments {
        Moments::of_parts(depths.iter().map(|&(share, mean)| (share, Moments { mean, variance: 0.0 })))
    }

    #[test]
    fn one_occluder_over_a_parallel_receiver_is_exact_at_every_height() {
        for height in [1e-3, 0.5, 6.9] {
            for percent in 0..=100 {
                let shaded = f64::from(percent) / 100.0;
                let moments = of(&[(shaded, RECEIVER - height), (1.0 - shaded, RECEIVER)]);
                assert!((moments.visibility(RECEIVER, 0.0, 0.0) - (1.0 - shaded)).abs() < 1e-9, "{height} {shaded}");
            }
        }
    }

    #[test]
    fn light_bleeds_under_two_occluders_by_the_amount_that_the_bound_says() {
        let (lower, upper) = (0.5, 4.0);
        for percent in 0..=100 {
            let share = f64::from(percent) / 100.0;
            let moments = of(&[(share, RECEIVER - upper), (1.0 - share, RECEIVER - lower)]);
            let spread = share * (1.0 - share) * (upper - lower) * (upper - lower);
            let expected = spread / (spread + (lower + share * (upper - lower)).powi(2));
            let bleeding = moments.visibility(RECEIVER, 0.0, 0.0);
            assert!((bleeding - expected).abs() < 1e-12, "{share}");
            // Greatest at q = h_2 / (h_1 + h_2), where it is g^2 / (g^2 + 4 h_1 h_2), by differentiation.
            let most = (upper - lower).powi(2) / ((upper - lower).powi(2) + 4.0 * upper * lower);
            assert!(bleeding <= most + 1e-12, "{share}: {bleeding} above {most}");
            assert_eq!(moments.visibility(RECEIVER, 0.0, most + 1e-9), 0.0, "cut off");
        }
    }

    #[test]
    fn the_cut_leaves_light_and_dark_alone_and_errs_by_itself_at_most() {
        for percent in 0..=100 {
            let lit = f64::from(percent) / 100.0;
            let found = of(&[(1.0 - lit, 2.0), (lit, RECEIVER)]).visibility(RECEIVER, 0.0, 0.2);
            assert!(found <= lit + 1e-9 && found >= lit - 0.2 - 1e-9, "{lit} {found}");
        }
        assert_eq!(of(&[(1.0, RECEIVER)]).visibility(RECEIVER, 0.0, 0.2), 1.0);
        assert_eq!(of(&[(1.0, 2.0)]).visibility(RECEIVER, 0.1, 0.2), 0.0);
    }

    #[test]
    fn surfaces_nearer_than_the_smallest_deviation_count_as_one() {
        let touching = of(&[(1.0, RECEIVER - 0.001)]);
        assert!(touching.visibility(RECEIVER, 0.1, 0.0) > 0.9998);
        assert_eq!(touching.visibility(RECEIVER, 0.0, 0.0), 0.0);
    }

    #[test]
    fn guards_out_of_range_are_refused_by_name() {
        let good = VarianceBound::default();
        for (wrong, name) in [
            (VarianceBound { deviation_min_texels: -1.0, ..good }, "deviation_min_texels"),
            (VarianceBound { deviation_min_texels: f64::NAN, ..good }, "deviation_min_texels"),
            (VarianceBound { bleeding_cut: 1.0, ..good }, "bleeding_cut"),
            (VarianceBound { bleeding_cut: f64::NAN, ..good }, "bleeding_cut"),
        ] {
            assert!(wrong.checked().unwrap_err().to_string().contains(name));
        }
        assert!(good.checked().is_ok());
    }

    #[test]
    fn no_radius_is_wider_than_eight_blocks_nor_a_block_wider_than_the_relation_allows() {
        for i in 1..=200_000 {
            let radius = f64::from(i) * 0.05;
            let block = f64::from(block_texels(radius));
            assert!(radius / block < 2.0 * BLOCK_RADIUS, "{radius}");
            assert!(block == 1.0 || radius / block >= BLOCK_RADIUS, "{radius}");
        }
        assert_eq!(block_texels(0.0), 1);
    }

    #[test]
    fn a_plane_is_as_deep_as_it_was_and_varies_as_a_square_does() {
        let slope = DVec2::new(0.03, -0.05);
        for radius in [DVec2::new(0.3, 2.0), DVec2::new(3.47, 5.0), DVec2::new(9.0, 14.5)] {
            let size = [70, 90];
            let plane = |place: DVec2| 3.0 + slope.dot(place);
            let depths: Vec<f64> =
                places([70, 90]).map(|(x, y)| plane(DVec2::new(x as f64 + 0.5, y as f64 + 0.5))).collect();
            let map = MomentMap::new(&depths, size, radius);
            for place in [DVec2::new(33.3, 41.7), DVec2::new(40.0, 50.5), DVec2::new(35.01, 44.4)] {
                let found = map.at(place);
                assert!((found.mean - plane(place)).abs() < 1e-9, "{radius} at {place}");
                // A square of half side r varies by r^2 / 3 along each axis; texels and bilinear weights by less than a
                // block's square more.
                let square = (slope * slope).dot(radius.max(DVec2::splat(0.5)).powf(2.0)) / 3.0;
                let more = (slope * slope).dot(map.block.powf(2.0));
                assert!(
                    found.variance > square - 0.1 * more && found.variance < square + 0.6 * more,
                    "{radius} {place}"
                );
            }
        }
    }

    #[test]
    fn an_edge_along_the_texels_fades_as_the_square_does() {
        // Depth 2 left of x = 64, depth 7 right of it: on the receiver at 7 the share of a square, from its middle.
        for radius in [3.47, 4.0, 6.3, 12.0, 25.0] {
            let depths: Vec<f64> = places([128, 96]).map(|(x, _)| if x < 64 { 2.0 } else { RECEIVER }).collect();
            let map = MomentMap::new(&depths, [128, 96], DVec2::splat(radius));
            let mut largest = 0.0f64;
            for i in -400..=400 {
                let t = f64::from(i) / 300.0;
                let found = map.at(DVec2::new(64.0 + t * radius, 40.3)).visibility(RECEIVER, 1e-6, 0.0);
                largest = largest.max((found - (0.5 + 0.5 * t).clamp(0.0, 1.0)).abs());
            }
            println!("{radius}: {largest:.4}");
            // The ramp is straight, so bilinear values err only at its ends: by an eighth of a block's share, 1 / (2 r).
            let block = f64::from(block_texels(radius));
            assert!(largest <= 0.15 * block / radius, "{radius}: {largest}");
        }
    }

    proptest! {
        #[test]
        fn parts_join_to_the_mean_and_variance_of_all(depths in prop::collection::vec(-1e3..1e3_f64, 2..40), split in 1_usize..39) {
            let split = split.min(depths.len() - 1);
            let direct = |depths: &[f64]| of(&depths.iter().map(|&d| (1.0, d)).collect::<Vec<_>>());
            let (left, right) = depths.split_at(split);
            let parts = [(left.len() as f64, direct(left)), (right.len() as f64, direct(right))];
            let joined = Moments::of_parts(parts.into_iter());
            let all = direct(&depths);
            prop_assert!((joined.mean - all.mean).abs() < 1e-9);
            prop_assert!((joined.variance - all.variance).abs() < 1e-6);
        }

        #[test]
        fn the_bound_is_never_below_the_share_that_is_lit(depths in prop::collection::vec(0.0..10.0_f64, 1..30), receiver in 0.0..10.0_f64) {
            let moments = of(&depths.iter().map(|&d| (1.0, d)).collect::<Vec<_>>());
            let lit = depths.iter().filter(|&&d| d >= receiver).count() as f64 / depths.len() as f64;
            prop_assert!(moments.visibility(receiver, 0.0, 0.0) >= lit - 1e-9);
        }
    }
}
