//! Taps of a disc kernel, their rotation per pixel, and the closed form that they approximate.
//!
//! Relaxation dart throwing (McCool and Fiume 1992; Kreuzer 2017, 3.4.3): throw points at random, keep those that are
//! far from all kept ones; after many failures in a row relax "far" a little. It ends, with the number of points asked
//! for. Integer generator, no transcendental functions: the same taps on every platform.
//!
//! A half plane whose edge passes the centre at signed distance t (in radii, positive inside) covers of the disc
//! `F(t) = 1/2 + (asin t + t sqrt(1 - t^2)) / pi`.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

/// Throws that fail in a row before the distance shrinks. With the next constant: eight times as many throws and a
/// third of the step gave discs of the same residual error, a quarter of the throws and twice the step of a tenth more.
const THROWS: u32 = 400;

/// By how much it shrinks.
const RELAXATION: f64 = 0.97;

/// Radius of the disc in which points are thrown. Thrown in the unit disc alone they crowd along its rim, where no
/// neighbour keeps them away, and the filter is wider than its radius says (mean square radius 0.65 for 0.5).
const FIELD: f64 = 1.5;

/// `taps` points of the unit disc, far from each other; equal for equal arguments on every platform.
#[must_use]
pub fn poisson_disc(taps: usize, seed: u64) -> Vec<DVec2> {
    let mut generator = SplitMix(seed);
    let mut points: Vec<DVec2> = Vec::with_capacity(5 * taps);
    let mut inside = 0;
    let mut distance = 2.0;
    let mut failures = 0;
    while inside < taps {
        let p = generator.in_disc() * FIELD;
        if points.iter().all(|q| p.distance_squared(*q) >= distance * distance) {
            points.push(p);
            inside += usize::from(p.length_squared() <= 1.0);
            failures = 0;
        } else {
            failures += 1;
        }
        if failures == THROWS {
            distance *= RELAXATION;
            failures = 0;
        }
    }
    points.retain(|p| p.length_squared() <= 1.0);
    points
}

/// `taps` points of the square of half side 1, one in each of as many strips along x and along y (Hammersley 1960): equal
/// on every platform.
#[must_use]
pub fn square_taps(taps: usize) -> Vec<DVec2> {
    let point = |i: usize| {
        let along_y = f64::from((i as u32).reverse_bits()) / f64::from(u32::MAX);
        DVec2::new((i as f64 + 0.5) / taps as f64, along_y + 0.5 / taps as f64) * 2.0 - 1.0
    };
    (0..taps).map(point).collect()
}

/// Angle by which the taps of a pixel are turned, in radians, 0..2 pi: the upper 24 bits of [`pixel_hash`], which f32
/// holds exactly.
#[must_use]
pub fn rotation_angle(frag_coord: [u32; 2]) -> f64 {
    f64::from(pixel_hash(frag_coord) >> 8) / f64::from(1 << 24) * TAU
}

/// A hash of a pixel's coordinates in u32 arithmetic that wraps, bit for bit the shader's: x and y joined by an odd
/// factor, then the finaliser `lowbias32` (C. Wellons 2018).
#[must_use]
pub fn pixel_hash(frag_coord: [u32; 2]) -> u32 {
    let mut h = frag_coord[0].wrapping_add(frag_coord[1].wrapping_mul(0x9e37_79b1));
    h = (h ^ (h >> 16)).wrapping_mul(0x7feb_352d);
    h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
    h ^ (h >> 16)
}

/// Share of a disc that a half plane covers; `t` is the distance from its edge to the disc's centre in radii, positive
/// when the centre is inside.
#[must_use]
pub fn half_plane_under_disc(t: f64) -> f64 {
    let t = t.clamp(-1.0, 1.0);
    0.5 + (t.asin() + t * (1.0 - t * t).sqrt()) / PI
}

/// SplitMix64 (Steele, Lea and Flood 2014).
struct SplitMix(u64);

impl SplitMix {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in -1..1.
    fn signed(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn in_disc(&mut self) -> DVec2 {
        loop {
            let p = DVec2::new(self.signed(), self.signed());
            if p.length_squared() <= 1.0 {
                return p;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::filter::Taps;

    /// Visibility of a map of unit texels whose texel is lit when its centre is: the nearest texel, or four bilinearly.
    fn stored(p: DVec2, normal: DVec2, bilinear: bool) -> f64 {
        let texel = |x: f64, y: f64| f64::from(u8::from(normal.dot(DVec2::new(x + 0.5, y + 0.5)) > 0.0));
        if !bilinear {
            return texel(p.x.floor(), p.y.floor());
        }
        let q = p - 0.5;
        let (base, share) = (q.floor(), q - q.floor());
        let row = |y: f64| texel(base.x, y) * (1.0 - share.x) + texel(base.x + 1.0, y) * share.x;
        row(base.y) * (1.0 - share.y) + row(base.y + 1.0) * share.y
    }

    /// Maximum and RMS error of a filtered straight edge against the closed form, over angles, phases, and distances of
    /// up to twice the radius.
    fn residual(taps: &[DVec2], ratio: f64, bilinear: bool) -> (f64, f64) {
        let (mut largest, mut squares, mut count) = (0.0_f64, 0.0, 0_u32);
        for angle in 0..46_u32 {
            let normal = DVec2::from_angle(f64::from(angle).to_radians());
            for i in 0..800_u32 {
                // A point anywhere along the edge (R2 sequence).
                let along = 97.0 * (f64::from(i) * 0.754_877_666).fract() - 40.0;
                let t = 4.0 * (f64::from(i) * 0.569_840_291).fract() - 2.0;
                let p = normal * (t * ratio) + normal.perp() * along;
                let turn = DVec2::from_angle(rotation_angle([i, angle]));
                let sum: f64 = taps.iter().map(|tap| stored(p + turn.rotate(*tap) * ratio, normal, bilinear)).sum();
                let error = sum / taps.len() as f64 - half_plane_under_disc(t);
                largest = largest.max(error.abs());
                squares += error * error;
                count += 1;
            }
        }
        (largest, (squares / f64::from(count)).sqrt())
    }

    /// A disc with so many taps that only the texels err.
    fn dense_disc() -> Vec<DVec2> {
        let golden = PI * (3.0 - 5.0_f64.sqrt());
        let tap = |i: u32| DVec2::from_angle(f64::from(i) * golden) * ((f64::from(i) + 0.5) / 1500.0).sqrt();
        (0..1500).map(tap).collect()
    }

    #[test]
    fn a_dense_disc_of_3_47_texels_errs_by_a_thirteenth_at_most() {
        let (largest, rms) = residual(&dense_disc(), 3.47, false);
        assert!((largest - 0.077).abs() < 0.01, "{largest}");
        assert!((rms - 0.012).abs() < 0.001, "{rms}");
    }

    #[test]
    fn the_default_taps_err_little_more_than_a_dense_disc() {
        // A Vogel disc of 25 bilinear taps errs by 0.095 at most, RMS 0.015, one of 16 by 0.117, RMS 0.022; a Poisson
        // disc may err by a fifth more.
        let taps = Taps::default();
        for (taps, largest_allowed, rms_allowed) in [(&taps.filter, 0.115, 0.017), (&taps.blocker, 0.135, 0.022)] {
            let (largest, rms) = residual(taps, 3.47, true);
            assert!(largest < largest_allowed && rms < rms_allowed, "{} taps: {largest} {rms}", taps.len());
        }
    }

    #[test]
    fn with_eight_taps_more_texels_do_not_help() {
        let taps = poisson_disc(8, 0);
        let (_, rms) = residual(&taps, 3.47, true);
        let (_, rms_of_small_texels) = residual(&taps, 30.0, true);
        assert!(rms_of_small_texels > 0.8 * rms, "{rms} {rms_of_small_texels}");
        let dense = dense_disc();
        assert!(residual(&dense, 30.0, false).1 < 0.2 * residual(&dense, 3.47, false).1);
    }

    #[test]
    fn the_default_seeds_have_the_smallest_residual_error_of_the_first_64() {
        for (count, seed) in [Taps::BLOCKER, Taps::FILTER].into_iter().zip(Taps::SEEDS) {
            let error = |seed: &u64| residual(&poisson_disc(count, *seed), 3.47, true).1;
            let errors = (0..64).map(|seed| (error(&seed), seed));
            let best = errors.min_by(|a, b| a.0.total_cmp(&b.0));
            assert_eq!(best.map(|(_, seed)| seed), Some(seed), "{count} taps");
        }
    }

    #[test]
    fn the_taps_are_spread_over_the_disc_and_far_from_each_other() {
        for (count, distance) in [(1, 0.0), (8, 0.35), (16, 0.25), (25, 0.2), (64, 0.12)] {
            for seed in 0..16 {
                let taps = poisson_disc(count, seed);
                assert_eq!(taps.len(), count);
                for (i, p) in taps.iter().enumerate() {
                    assert!(p.length() <= 1.0);
                    assert!(taps[..i].iter().all(|q| p.distance(*q) > distance), "{count} {seed}");
                }
            }
        }
        // The mean square radius of a disc is 1/2.
        let square = |seed| poisson_disc(25, seed).iter().map(|p| p.length_squared()).sum::<f64>() / 25.0;
        let mean = (0..64).map(square).sum::<f64>() / 64.0;
        assert!((mean - 0.5).abs() < 0.02, "{mean}");
    }

    #[test]
    fn a_square_of_taps_halves_at_its_middle_and_an_edge_along_it_errs_by_half_a_tap() {
        let taps = square_taps(64);
        assert!(taps.iter().all(|tap| tap.abs().max_element() < 1.0));
        for axis in [DVec2::X, DVec2::Y] {
            for i in -100..=100 {
                let t = f64::from(i) / 100.0;
                let covered = taps.iter().filter(|tap| tap.dot(axis) > -t).count() as f64 / 64.0;
                assert!((covered - (0.5 + 0.5 * t)).abs() <= 0.5 / 64.0 + 1e-6, "{axis} {t}");
            }
        }
    }

    #[test]
    fn the_taps_and_the_hash_are_the_same_on_every_platform() {
        let taps = poisson_disc(25, 47);
        assert_eq!(taps[0].x.to_bits(), 13_810_791_171_525_907_184);
        assert_eq!(taps[24].y.to_bits(), 4_599_506_082_405_230_676);
        let hashes = [[0, 0], [1, 0], [1919, 1079]].map(pixel_hash);
        assert_eq!(hashes, [0, 0x6889_90c0, 0x8efe_d494]);
    }

    #[test]
    fn angles_of_neighbouring_pixels_are_spread_evenly() {
        let mut bins = [0_u32; 16];
        for y in 0..128 {
            for x in 0..128 {
                bins[(rotation_angle([x, y]) / TAU * 16.0) as usize] += 1;
            }
        }
        // 1024 expected in each; five standard deviations of a binomial count are 155.
        assert!(bins.iter().all(|&n| n.abs_diff(1024) < 155), "{bins:?}");
    }

    #[test]
    fn a_half_plane_covers_half_of_a_disc_at_its_centre_and_all_or_nothing_beyond() {
        assert_eq!(half_plane_under_disc(0.0), 0.5);
        assert_eq!((half_plane_under_disc(1.5), half_plane_under_disc(-1.5)), (1.0, 0.0));
        let t = 0.3;
        assert!((half_plane_under_disc(t) + half_plane_under_disc(-t) - 1.0).abs() < 1e-15);
        // Against counting.
        let inside = dense_disc().iter().filter(|p| p.x > -t).count() as f64 / 1500.0;
        assert!((half_plane_under_disc(t) - inside).abs() < 2e-3);
    }
}
