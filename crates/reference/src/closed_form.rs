//! Shadows whose value is known: the share of a disc or a rectangle that lies in a simple shape.
//!
//! The disc is a filter's kernel, or a light as its receiver sees it. Where the shape is an opening, its share is the
//! visibility; where it is an occluder, one minus its share is. Everything is exact up to rounding; what is measured
//! against it carries all of the error.
//!
//! From a scene to a share. Let the occluder lie in a plane parallel to the light, at distance `h` from the receiver,
//! the light's at distance `H`. A ray from the receiver to the point `p` of the light, sideways from the receiver, meets
//! the occluder's plane at `p h / H`. So an occluder's outline, its coordinates multiplied by `H / h` and relative to
//! the light's middle, is its outline on the light. A disc light of radius R gives the unit disc after division by R. A
//! sun of half angle `a` is the disc of radius `h tan a` in the occluder's plane, and so is the kernel of PCSS. A
//! receiver that is tilted, or a light that is, changes nothing: only their distances along the planes' normal count.
//!
//! | shape | under the unit disc | under a rectangle |
//! |---|---|---|
//! | half plane | [`scumble_core::half_plane_under_disc`] | [`half_plane_under_rectangle`] |
//! | slit | [`slit_under_disc`] | two half planes |
//! | disc | [`disc_under_disc`] | [`polygon_under_disc`] of the light's corners, times pi over its area in disc radii |
//! | rectangle, polygon | [`polygon_under_disc`] | [`rectangle_under_rectangle`] |

mod under_disc;
mod under_rectangle;

pub use under_disc::{disc_under_disc, polygon_under_disc, slit_under_disc};
pub use under_rectangle::{Rectangle, half_plane_under_rectangle, rectangle_under_rectangle};

#[cfg(test)]
mod counting {
    //! Shares by counting random points, with their standard error.

    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::{Rng, SeedableRng};

    /// Points of one count.
    const POINTS: u32 = 40_000;

    /// Uniform in 0..1.
    pub struct Uniform(ChaCha8Rng);

    impl Uniform {
        pub fn new(seed: u64) -> Self {
            Self(ChaCha8Rng::seed_from_u64(seed))
        }

        pub fn next(&mut self) -> f64 {
            (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
        }

        pub fn between(&mut self, low: f64, high: f64) -> f64 {
            low + (high - low) * self.next()
        }
    }

    /// The distance between an exact share and the counted one, in standard errors of the exact share's count.
    pub fn z_score(exact: f64, mut inside: impl FnMut() -> bool) -> f64 {
        let counted = (0..POINTS).filter(|_| inside()).count() as f64 / f64::from(POINTS);
        let standard_error = (exact * (1.0 - exact) / f64::from(POINTS)).sqrt();
        if standard_error > 0.0 { (counted - exact) / standard_error } else { (counted - exact) / f64::EPSILON }
    }

    /// Every z-score is within 3, and together they spread as standard errors do.
    pub fn assert_standard(scores: &[f64]) {
        assert!(scores.iter().all(|z| z.abs() < 3.0), "{scores:?}");
        let mean_square = scores.iter().map(|z| z * z).sum::<f64>() / scores.len() as f64;
        // The mean of n squares has the standard deviation sqrt(2 / n).
        let allowed = 1.0 + 3.0 * (2.0 / scores.len() as f64).sqrt();
        assert!(mean_square < allowed, "{mean_square}");
    }
}
