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

#[cfg(test)]
mod tests {
    use super::*;

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

    /// Maximum and RMS error of a filtered straight edge against the closed form, over angles, phases and distances.
    fn residual(taps: &[DVec2], ratio: f64, bilinear: bool, rotated: bool) -> (f64, f64) {
        let (mut largest, mut squares, mut count) = (0.0_f64, 0.0, 0_u32);
        for angle in 0..46_u32 {
            let normal = DVec2::from_angle(f64::from(angle).to_radians());
            for i in 0..400_u32 {
                // A point at a distance of up to r from the edge, anywhere along it (R2 sequence).
                let along = 97.0 * (f64::from(i) * 0.754_877_666).fract() - 40.0;
                let t = 2.0 * (f64::from(i) * 0.569_840_291).fract() - 1.0;
                let p = normal * (t * ratio) + normal.perp() * along;
                let turn = DVec2::from_angle(if rotated { rotation_angle([i, angle]) } else { 0.0 });
                let sum: f64 = taps.iter().map(|tap| stored(p + turn.rotate(*tap) * ratio, normal, bilinear)).sum();
                let error = sum / taps.len() as f64 - half_plane_under_disc(t);
                largest = largest.max(error.abs());
                squares += error * error;
                count += 1;
            }
        }
        (largest, (squares / f64::from(count)).sqrt())
    }

    fn dense_disc() -> Vec<DVec2> {
        let golden = PI * (3.0 - 5.0_f64.sqrt());
        (0..1500_u32).map(|i| DVec2::from_angle(f64::from(i) * golden) * ((f64::from(i) + 0.5) / 1500.0).sqrt()).collect()
    }

    #[test]
    fn print_residuals() {
        println!("dense nearest {:?}", residual(&dense_disc(), 3.47, false, true));
        println!("dense bilinear {:?}", residual(&dense_disc(), 3.47, true, true));
        let mut best = Vec::new();
        for n in [8, 16, 25, 64] {
            let mut all: Vec<_> = (0..64).map(|s| { let d = poisson_disc(n, s); let r = residual(&d, 3.47, true, true); (r.1, r.0, s) }).collect();
            all.sort_by(|a, b| a.0.total_cmp(&b.0));
            best.push((n, all[0], all[32], all[63]));
        }
        println!("{best:#?}");
    }
}
