//! Where a view is cut into slices that have a shadow map each.
//!
//! The ends of m slices of the depths n to f (Kreuzer 2017, Eq. 3.8, and its practical variant by Zhang and others 2006):
//! ```text
//! C_i = share n (f / n)^(i / m) + (1 - share) (n + i / m (f - n))
//! ```
//! A slice of the logarithmic split is as wide as its pixels are, so every map needs as many texels as any other; but from a
//! near plane of centimetres it spends the first maps on what nobody stands in front of. The even split spends them on the
//! distance. n and f are the depths of the scene's box on screen, not the camera's planes, which may be infinitely far
//! apart.

use crate::error::{Error, check};

/// Least ratio of the ends of a slice, so that a scene of one depth has slices: below what separates two points on screen.
const RATIO_MIN: f64 = 1.0 + 1e-6;

/// How a light's view is split.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Splits {
    /// Number of slices, 1 to [`Splits::COUNT_MAX`].
    pub count: u32,
    /// Share of the logarithmic split, 0 to 1; the rest is even.
    pub logarithmic_share: f64,
}

impl Default for Splits {
    /// One slice: no cascades.
    fn default() -> Self {
        Self { count: 1, logarithmic_share: Self::LOGARITHMIC_SHARE }
    }
}

impl Splits {
    /// Most slices of a view. More lose to their borders what they save: each map has the filter's reach on every side.
    pub const COUNT_MAX: u32 = 4;

    /// Share of the logarithmic split if nobody chooses another: the average of both (Zhang and others 2006). On the scene
    /// `street`, four adaptive maps have the same error with 0.75 to within 3 %, fixed ones 4 to 10 % more.
    pub const LOGARITHMIC_SHARE: f64 = 0.5;

    /// Refuses what is out of range.
    ///
    /// # Errors
    /// Names the value and what is allowed.
    pub fn checked(&self) -> Result<Self, Error> {
        let share = self.logarithmic_share;
        check("cascades", f64::from(self.count), (1..=Self::COUNT_MAX).contains(&self.count), "1 to 4")?;
        check("the share of the logarithmic split", share, (0.0..=1.0).contains(&share), "a share from 0 to 1")?;
        Ok(*self)
    }

    /// The depth at which each slice ends, in the unit of `near` and `far`: `count` of them, strictly increasing, the last
    /// at `far`, or just behind `near` where `far` is not beyond it. `near` is above 0, both are finite.
    #[must_use]
    pub fn ends(&self, near: f64, far: f64) -> Vec<f64> {
        let far = far.max(near * RATIO_MIN.powi(self.count as i32));
        let mut ends: Vec<f64> = (1..self.count).map(|slice| self.end(near, far, slice)).collect();
        ends.push(far);
        ends
    }

    fn end(&self, near: f64, far: f64, slice: u32) -> f64 {
        let part = f64::from(slice) / f64::from(self.count);
        let logarithmic = near * (far / near).powf(part);
        let even = near + part * (far - near);
        self.logarithmic_share * logarithmic + (1.0 - self.logarithmic_share) * even
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn splits(count: u32, logarithmic_share: f64) -> Splits {
        Splits { count, logarithmic_share }
    }

    fn assert_near(found: &[f64], expected: &[f64]) {
        assert_eq!(found.len(), expected.len());
        assert!(found.iter().zip(expected).all(|(a, b)| (a / b - 1.0).abs() < 1e-12), "{found:?} {expected:?}");
    }

    #[test]
    fn the_logarithmic_split_has_slices_of_one_ratio_and_the_even_one_of_one_length() {
        assert_near(&splits(4, 1.0).ends(1.0, 10_000.0), &[10.0, 100.0, 1000.0, 10_000.0]);
        assert_near(&splits(4, 0.0).ends(1.0, 9.0), &[3.0, 5.0, 7.0, 9.0]);
        assert_near(&splits(2, 0.5).ends(1.0, 100.0), &[0.5 * (10.0 + 50.5), 100.0]);
    }

    #[test]
    fn one_slice_ends_at_the_far_depth_whatever_the_share() {
        for share in [0.0, 0.3, 1.0] {
            assert_eq!(splits(1, share).ends(0.1, 77.0), [77.0]);
        }
    }

    #[test]
    fn splits_out_of_range_are_refused_by_name() {
        for (wrong, name) in [
            (splits(0, 0.5), "cascades"),
            (splits(5, 0.5), "cascades"),
            (splits(2, -0.1), "share"),
            (splits(2, f64::NAN), "share"),
        ] {
            assert!(wrong.checked().unwrap_err().to_string().contains(name), "{wrong:?}");
        }
        assert!(Splits::default().checked().is_ok());
    }

    proptest! {
        #[test]
        fn slices_follow_each_other_up_to_the_far_depth(
            count in 1..=4_u32,
            share in 0.0..=1.0_f64,
            near_exponent in -6.0..6.0_f64,
            range_exponent in -12.0..9.0_f64,
        ) {
            let near = 10.0_f64.powf(near_exponent);
            let far = near * (1.0 + 10.0_f64.powf(range_exponent));
            let ends = splits(count, share).ends(near, far);
            prop_assert_eq!(ends.len(), count as usize);
            prop_assert!(ends[0] > near && ends.windows(2).all(|pair| pair[0] < pair[1]), "{:?}", ends);
            prop_assert!(*ends.last().unwrap() >= far);
        }
    }
}
