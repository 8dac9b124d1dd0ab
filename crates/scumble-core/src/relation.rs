//! The relation between the texel and the filter that hides it: `r = c a` (Kreuzer 2017, Eq. 5.1).
//!
//! `a` texel size and `r` filter radius, both lengths in one space; `c = r / a` the ratio, the radius in texels; `L` extent
//! of the light's view plane; `N` resolution, texels per side. Inverse: `N = c / r_uv` (5.3) `= c L / r_world` (5.6).
//! After fitting `L` is the fitted extent of the axis, which is the same as scaling the radius by `s` (5.1.2).
//!
//! It holds for kernels whose radius is a length. A kernel of k texels has c = k at every N: more texels change its
//! softness, not its artifacts. 3.47 belongs to a disc.

use crate::error::{Error, check, not_negative, positive};
use crate::relation_file::RelationFile;

/// Largest ratio that is accepted. Beyond 64 texels no edge is told from a straight one, and a file that says so is
/// damaged.
pub const RATIO_MAX: f64 = 64.0;

/// Relative slack of rounding up. Plain rounding up is one texel too large in 7 to 38 % of the cases that are whole
/// numbers in exact arithmetic.
pub const ROUNDING_SLACK: f64 = 1e-6;

/// Largest filter radius in UV: the kernel covers the whole map.
const RADIUS_UV_MAX: f64 = 0.5;

/// The ratio c with its uncertainty; checked, so every use of it gives a size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relation {
    ratio: f64,
    standard_error: f64,
    ci95: [f64; 2],
}

impl Default for Relation {
    fn default() -> Self {
        Self::published()
    }
}

impl Relation {
    /// Kreuzer 2017: 3.47 in the worst case of ten people (step pattern, 100 % contrast). The paper prints no interval;
    /// [2.8, 4.25] is reconstructed, and the standard error is the one that has this interval: half its width in log
    /// units, by the t quantile 2.262 of nine degrees of freedom, times 3.47.
    #[must_use]
    pub fn published() -> Self {
        Self { ratio: 3.47, standard_error: 0.32, ci95: [2.8, 4.25] }
    }

    /// A relation from its numbers.
    ///
    /// # Errors
    /// Names a ratio that is not above 0 and at most 64, a standard error that is not 0 or above, an interval that does
    /// not enclose the ratio.
    pub fn new(ratio: f64, standard_error: f64, ci95: [f64; 2]) -> Result<Self, Error> {
        check("the ratio", ratio, ratio > 0.0 && ratio <= RATIO_MAX, "a number above 0, at most 64")?;
        not_negative("the ratio's standard_error", standard_error)?;
        check(
            "the ratio's ci95[0]",
            ci95[0],
            ci95[0] > 0.0 && ci95[0] <= ratio,
            "a number above 0, at most the ratio",
        )?;
        let upper = ci95[1].is_finite() && ci95[1] >= ratio;
        check("the ratio's ci95[1]", ci95[1], upper, "a finite number, at least the ratio")?;
        Ok(Self { ratio, standard_error, ci95 })
    }

    /// A ratio taken as exact, such as one that a user chose.
    ///
    /// # Errors
    /// As [`Relation::new`].
    pub fn exact(ratio: f64) -> Result<Self, Error> {
        Self::new(ratio, 0.0, [ratio, ratio])
    }

    /// The relation of a `relation.json`.
    ///
    /// # Errors
    /// As [`RelationFile::from_json`].
    pub fn from_json(json: &str) -> Result<Self, Error> {
        RelationFile::from_json(json)?.relation()
    }

    /// A `relation.json` of this relation and no more.
    ///
    /// # Errors
    /// None for a relation that was checked; the writer's otherwise.
    pub fn to_json(&self) -> Result<String, Error> {
        RelationFile::of(self).to_json()
    }

    /// c: filter radius in texels.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.ratio
    }

    /// Standard error of c.
    #[must_use]
    pub fn standard_error(&self) -> f64 {
        self.standard_error
    }

    /// 95 % confidence interval of c.
    #[must_use]
    pub fn ci95(&self) -> [f64; 2] {
        self.ci95
    }

    /// The smallest radius that hides texels of this size; same unit.
    #[must_use]
    pub fn radius_from_texel(&self, texel: f64) -> f64 {
        self.ratio * texel
    }

    /// The largest texel that a filter of this radius hides; same unit.
    #[must_use]
    pub fn texel_from_radius(&self, radius: f64) -> f64 {
        radius / self.ratio
    }

    /// Texels across `extent_world` that a filter of `radius_world` hides; not rounded, see [`whole_texels`].
    ///
    /// Computed as c (L / r), which does not overflow where (c L) / r does. A radius of +0 gives infinity: no size
    /// hides a hard edge. A radius of half the extent or more gives 2 c: the kernel covers the map.
    ///
    /// # Errors
    /// Names an extent that is not finite and above 0, or a radius that is negative, -0, NaN or infinite.
    pub fn resolution(&self, extent_world: f64, radius_world: f64) -> Result<f64, Error> {
        positive("extent_world", extent_world)?;
        not_negative("radius_world", radius_world)?;
        Ok(self.ratio * (extent_world / radius_world).max(1.0 / RADIUS_UV_MAX))
    }

    /// Texels across a map that a filter of `radius_uv` (in widths of the map) hides; otherwise as
    /// [`Relation::resolution`].
    ///
    /// # Errors
    /// As [`Relation::resolution`].
    pub fn resolution_uv(&self, radius_uv: f64) -> Result<f64, Error> {
        not_negative("radius_uv", radius_uv)?;
        Ok(self.ratio * (1.0 / radius_uv).max(1.0 / RADIUS_UV_MAX))
    }
}

/// Rounds a resolution up to whole texels, forgiving [`ROUNDING_SLACK`], into 1..=`cap`. Infinity gives `cap`; NaN
/// cannot come from [`Relation::resolution`] and gives `cap` too, the size that is never too small.
#[must_use]
pub fn whole_texels(resolution: f64, cap: u32) -> u32 {
    let whole = (resolution * (1.0 - ROUNDING_SLACK)).ceil();
    if whole >= 1.0 && whole < f64::from(cap) {
        whole as u32
    } else if whole < 1.0 {
        1.min(cap)
    } else {
        cap
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const CAP: u32 = 4096;

    fn texels(extent_world: f64, radius_world: f64) -> u32 {
        whole_texels(Relation::published().resolution(extent_world, radius_world).unwrap(), CAP)
    }

    #[test]
    fn fitting_shrinks_237_texels_to_55_by_60() {
        // Kreuzer 2017, Fig. 5.1: L / r = 68.3, s = 4.31 and 3.95.
        let radius_world = 1.0;
        let extent_world = 237.0 / 3.47;
        assert!((extent_world / radius_world - 68.3_f64).abs() < 1e-3);
        assert_eq!(texels(extent_world, radius_world), 237);
        let fitted = [texels(extent_world / 4.31, radius_world), texels(extent_world / 3.95, radius_world)];
        assert_eq!(fitted, [55, 60]);
        let fewer = f64::from(237 * 237) / f64::from(fitted[0] * fitted[1]);
        assert_eq!(fewer.round(), 17.0);
        // In UV: r_uv = (r_world / L) s.
        let in_uv = Relation::published().resolution_uv(radius_world / extent_world * 4.31).unwrap();
        assert_eq!(whole_texels(in_uv, CAP), 55);
    }

    #[test]
    fn a_filter_of_one_texel_size_spans_c_texels_and_back() {
        let relation = Relation::published();
        assert!((relation.radius_from_texel(2.0) - 6.94).abs() < 1e-12);
        assert!((relation.texel_from_radius(relation.radius_from_texel(0.3)) - 0.3).abs() < 1e-15);
    }

    #[test]
    fn a_radius_of_nothing_asks_for_more_than_any_cap() {
        let relation = Relation::published();
        assert_eq!(relation.resolution(10.0, 0.0).unwrap(), f64::INFINITY);
        assert_eq!(texels(10.0, 0.0), CAP);
        assert_eq!(texels(10.0, f64::MIN_POSITIVE / 8.0), CAP);
        assert_eq!(texels(10.0, 5e-324), CAP);
    }

    #[test]
    fn what_makes_no_sense_is_an_error_that_names_the_value() {
        let relation = Relation::published();
        let wrong_radius = [-1.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
        for radius in wrong_radius {
            assert!(relation.resolution(1.0, radius).unwrap_err().to_string().contains("radius_world"), "{radius}");
            assert!(relation.resolution_uv(radius).unwrap_err().to_string().contains("radius_uv"), "{radius}");
        }
        for extent in [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(relation.resolution(extent, 1.0).unwrap_err().to_string().contains("extent_world"), "{extent}");
        }
        for ratio in [0.0, -3.47, 64.5, f64::NAN, f64::INFINITY] {
            assert!(Relation::exact(ratio).unwrap_err().to_string().contains("ratio"), "{ratio}");
        }
        assert!(Relation::new(3.0, f64::NAN, [2.0, 4.0]).is_err());
        assert!(Relation::new(3.0, 0.1, [3.1, 4.0]).is_err());
        assert!(Relation::new(3.0, 0.1, [2.0, f64::NAN]).is_err());
        let message = relation.resolution(1.0, -0.0).unwrap_err().to_string();
        assert_eq!(message, "radius_world is -0.0; allowed is a finite number, 0 or above, without a minus sign");
    }

    #[test]
    fn a_filter_that_covers_the_map_asks_for_twice_the_ratio() {
        for radius in [5.0, 6.0, 1e300] {
            assert_eq!(texels(10.0, radius), 7, "{radius}");
        }
        assert_eq!(Relation::published().resolution_uv(3.0).unwrap(), 6.94);
    }

    #[test]
    fn the_answer_has_no_scale_and_does_not_overflow() {
        // L / r of 1e9 asks for more than the cap, of 100 for 347, at every scale.
        assert_eq!(texels(1e6, 1e-3), CAP);
        assert_eq!(texels(1e-6, 1e-8), 347);
        assert_eq!(texels(1.5e38, 1.5e36), 347);
        assert_eq!(texels(1.5e38, 1e36), 521);
        assert_eq!(texels(1.5e308, 1.5e306), 347);
    }

    #[test]
    fn whole_numbers_are_not_rounded_up() {
        let relation = Relation::published();
        for n in 7..=CAP {
            let radius_f32 = 3.47_f32 / n as f32;
            assert_eq!(whole_texels(relation.resolution_uv(f64::from(radius_f32)).unwrap(), CAP), n);
        }
        assert_eq!(whole_texels(100.001, CAP), 101);
        assert_eq!(whole_texels(0.0, CAP), 1);
        assert_eq!(whole_texels(f64::NAN, CAP), CAP);
    }

    #[test]
    fn the_published_standard_error_is_the_one_of_its_interval() {
        let relation = Relation::published();
        let [lo, hi] = relation.ci95();
        let from_interval = relation.ratio() * (hi / lo).ln() / 2.0 / 2.262;
        assert!((from_interval - relation.standard_error()).abs() < 0.005, "{from_interval}");
    }

    proptest! {
        #[test]
        fn the_size_hides_the_texel_and_one_texel_less_does_not(extent in 1e-3..1e6_f64, share in 1e-3..0.499_f64, ratio in 0.5..64.0_f64) {
            let relation = Relation::exact(ratio).unwrap();
            let radius = extent * share;
            let n = f64::from(whole_texels(relation.resolution(extent, radius).unwrap(), u32::MAX));
            prop_assert!(relation.radius_from_texel(extent / n) <= radius * (1.0 + 2.0 * ROUNDING_SLACK));
            prop_assert!(relation.radius_from_texel(extent / (n - 1.0)) > radius);
        }
    }
}
