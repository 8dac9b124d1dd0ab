//! Points of a disc light for one receiver: pairs in equal areas.
//!
//! The unit square is cut into `samples / 2` cells, two points are drawn in each, and the square is mapped to the disc
//! by the concentric map of P. Shirley and K. Chiu, *A low distortion map between disk and square* (1997), which keeps
//! areas equal and neighbours near. A receiver's points depend on its pixel alone, so pictures are the same on every
//! platform and for any number of threads; those of different pixels are independent.

use std::f64::consts::FRAC_PI_4;

use glam::DVec2;

/// How often a light is sampled: pairs in a grid of cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Strata {
    across: u32,
    down: u32,
}

impl Strata {
    /// Cells for `samples`, a power of two above 1.
    pub fn of(samples: u32) -> Self {
        let doublings = (samples / 2).ilog2();
        Self { across: 1 << doublings.div_ceil(2), down: 1 << (doublings / 2) }
    }

    /// The pairs of points of `pixel`, one pair to a cell, in the unit disc.
    pub fn pairs(self, pixel: [u32; 2]) -> impl Iterator<Item = [DVec2; 2]> {
        let mut random = SplitMix(u64::from(pixel[1]) << 32 | u64::from(pixel[0]));
        let cells = DVec2::new(f64::from(self.across), f64::from(self.down));
        (0..self.across * self.down).map(move |index| {
            let cell = DVec2::new(f64::from(index % self.across), f64::from(index / self.across));
            [(); 2].map(|()| disc_from_square((cell + random.in_square()) / cells))
        })
    }
}

/// The point of the unit disc for a point of the unit square.
fn disc_from_square(square: DVec2) -> DVec2 {
    let p = 2.0 * square - 1.0;
    if p.x.abs() > p.y.abs() {
        p.x * DVec2::from_angle(FRAC_PI_4 * p.y / p.x)
    } else if p.y == 0.0 {
        DVec2::ZERO
    } else {
        let (sin, cos) = (FRAC_PI_4 * p.x / p.y).sin_cos();
        p.y * DVec2::new(sin, cos)
    }
}

/// SplitMix64 (Steele, Lea and Flood 2014): a hash of a counter, so that any two starts give unlike streams.
struct SplitMix(u64);

impl SplitMix {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in 0..1, both coordinates.
    fn in_square(&mut self) -> DVec2 {
        let mut coordinate = || (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        DVec2::new(coordinate(), coordinate())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_of_samples_has_its_cells() {
        for (samples, cells) in [(2, [1, 1]), (64, [8, 4]), (128, [8, 8]), (256, [16, 8]), (1024, [32, 16])] {
            let strata = Strata::of(samples);
            assert_eq!([strata.across, strata.down], cells);
            assert_eq!(strata.pairs([3, 4]).count() as u32 * 2, samples);
        }
    }

    #[test]
    fn the_map_keeps_areas_and_meets_the_rim_and_the_middle() {
        assert_eq!(disc_from_square(DVec2::splat(0.5)), DVec2::ZERO);
        for (square, disc) in [(DVec2::new(1.0, 0.5), DVec2::X), (DVec2::new(0.5, 0.0), DVec2::NEG_Y)] {
            assert!(disc_from_square(square).abs_diff_eq(disc, 1e-15));
        }
        // The area of a small square's image, by its diagonals, is pi / 4 times 4 of the square's.
        let step = 1e-4;
        for i in 0..400 {
            let at = DVec2::new(0.05 + 0.0471 * f64::from(i % 20), 0.03 + 0.0467 * f64::from(i / 20));
            let image = |x: f64, y: f64| disc_from_square(at + step * DVec2::new(x, y));
            let area = 0.5 * (image(1.0, 1.0) - image(0.0, 0.0)).perp_dot(image(0.0, 1.0) - image(1.0, 0.0));
            assert!((area / (step * step * std::f64::consts::PI) - 1.0).abs() < 0.01, "{at} {area}");
        }
    }

    #[test]
    fn the_points_of_all_pixels_fill_the_disc_evenly() {
        let points: Vec<DVec2> =
            (0..200).flat_map(|i| Strata::of(64).pairs([i, 7])).flatten().filter(|p| p.length() <= 1.0).collect();
        assert_eq!(points.len(), 200 * 64);
        let count = points.len() as f64;
        let mean = points.iter().sum::<DVec2>() / count;
        // A coordinate of the disc has the variance 1 / 4; cells only lower the error of its mean.
        assert!(mean.length() < 3.0 * 0.5 / count.sqrt(), "{mean}");
        let square = points.iter().map(|p| p.length_squared()).sum::<f64>() / count;
        assert!((square - 0.5).abs() < 3.0 * (1.0_f64 / 12.0).sqrt() / count.sqrt(), "{square}");
    }

    #[test]
    fn a_pixel_has_the_same_points_each_time_and_its_neighbour_others() {
        let points = |pixel| -> Vec<DVec2> { Strata::of(64).pairs(pixel).flatten().collect() };
        assert_eq!(points([5, 6]), points([5, 6]));
        for neighbour in [[6, 6], [5, 7], [6, 5]] {
            assert!(points(neighbour).iter().all(|p| !points([5, 6]).contains(p)), "{neighbour:?}");
        }
    }
}
