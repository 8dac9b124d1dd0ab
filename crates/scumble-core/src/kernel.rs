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

/// Throws that fail in a row before the distance shrinks.
const THROWS: u32 = 400;

/// By how much it shrinks.
const RELAXATION: f64 = 0.97;

/// `taps` points of the unit disc, far from each other; equal for equal arguments on every platform.
#[must_use]
pub fn poisson_disc(taps: usize, seed: u64) -> Vec<DVec2> {
    let mut generator = SplitMix(seed);
    let mut points: Vec<DVec2> = Vec::with_capacity(taps);
    let mut distance = 2.0;
    let mut failures = 0;
    while points.len() < taps {
        let p = generator.in_disc();
        if points
            .iter()
            .all(|q| p.distance_squared(*q) >= distance * distance)
        {
            points.push(p);
            failures = 0;
        } else {
            failures += 1;
        }
        if failures == THROWS {
            distance *= RELAXATION;
            failures = 0;
        }
    }
    points
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
