//! From the radii of all fragments in a penumbra to the one that sizes the map.
//!
//! * [`Statistic::Minimum`]: the narrowest filter decides, no fragment shows its texels (Kreuzer 2017, Eq. 5.12).
//! * [`Statistic::Quantile`]: a share of the fragments may show theirs, so that one contact on screen does not ask for a map
//!   of its own.
//!
//! The GPU counts for both at once, over the bits of positive floats, which keep their order as u32: their minimum, and a
//! histogram of them without the lowest 20. That leaves the exponent and 3 bits of the mantissa, 8 bins an octave; the lower
//! edge of a bin is at most 1/9 below what is in it. The 128 bins end with the extent of the map and reach 16 octaves below
//! it. What is narrower is counted in the lowest bin, whose edge already asks for c 65,536 texels a side, more than any map
//! has.

use crate::error::{Error, check};
use crate::policy::Demand;

/// Which of the radii on screen sizes the map.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Statistic {
    /// The smallest.
    #[default]
    Minimum,
    /// The largest that no more than this share of the fragments in a penumbra is below, 0 to below 1; to an eighth of an
    /// octave, on the smaller side.
    Quantile(f64),
}

impl Statistic {
    /// Refuses a share that is none.
    ///
    /// # Errors
    /// Names the share and what is allowed.
    pub fn checked(&self) -> Result<Self, Error> {
        if let Self::Quantile(share) = *self {
            check("the share of Statistic::Quantile", share, (0.0..1.0).contains(&share), "a share from 0 to below 1")?;
        }
        Ok(*self)
    }

    /// What the fragments ask for, of the bits of their smallest radius and the histogram of all.
    #[must_use]
    pub fn demand(&self, minimum_bits: u32, histogram: &RadiusHistogram<'_>) -> Demand {
        match *self {
            Self::Minimum => Demand::from_minimum_bits(minimum_bits),
            Self::Quantile(share) => histogram.quantile(share).map_or(Demand::Nothing, Demand::Radius),
        }
    }
}

/// Fragments in a penumbra by their radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadiusHistogram<'a> {
    first_bin: u32,
    counts: &'a [u32],
}

impl<'a> RadiusHistogram<'a> {
    /// Bins of one map.
    pub const BINS: u32 = 128;
    /// Bits that do not count.
    const SHIFT: u32 = 20;

    /// A histogram whose first bin is `first_bin`, in the sense of [`RadiusHistogram::first_bin`].
    #[must_use]
    pub fn new(first_bin: u32, counts: &'a [u32]) -> Self {
        Self { first_bin, counts }
    }

    /// The bin, counted from a radius of 0, that is the first of a map which measures `extent_world` metres at the
    /// reference plane.
    #[must_use]
    pub fn first_bin(extent_world: f64) -> u32 {
        let last = (extent_world.clamp(0.0, f64::from(f32::MAX)) as f32).to_bits() >> Self::SHIFT;
        last.saturating_sub(Self::BINS - 1)
    }

    /// The bin of a radius in metres, of `BINS`; CPU twin of `bin_of` in the demand pass.
    #[must_use]
    pub fn bin_of(first_bin: u32, radius_world: f32) -> u32 {
        (radius_world.to_bits() >> Self::SHIFT).saturating_sub(first_bin).min(Self::BINS - 1)
    }

    /// The lower edge, in metres, of the bin that holds the fragment which a share of the others is below; `None` of no
    /// fragments.
    #[must_use]
    pub fn quantile(&self, share: f64) -> Option<f64> {
        let total: u64 = self.counts.iter().map(|&count| u64::from(count)).sum();
        let below = (share * total as f64).floor() as u64;
        let mut counted = 0;
        let bin = self.counts.iter().position(|&count| {
            counted += u64::from(count);
            counted > below
        })?;
        Some(f64::from(f32::from_bits((self.first_bin + bin as u32) << Self::SHIFT)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Counts of radii under a map of this extent, and their first bin.
    fn counted(extent_world: f64, radii: &[f32]) -> (u32, Vec<u32>) {
        let first = RadiusHistogram::first_bin(extent_world);
        let mut counts = vec![0; RadiusHistogram::BINS as usize];
        for &radius in radii {
            counts[RadiusHistogram::bin_of(first, radius) as usize] += 1;
        }
        (first, counts)
    }

    fn quantile(radii: &[f32], share: f64) -> Option<f64> {
        let (first, counts) = counted(10.0, radii);
        RadiusHistogram::new(first, &counts).quantile(share)
    }

    #[test]
    fn a_thousand_radii_have_their_quantiles_to_an_eighth_of_an_octave() {
        let radii: Vec<f32> = (1..=1000).map(|i| 0.001 * i as f32).collect();
        for share in [0.001, 0.01, 0.1, 0.5, 0.9] {
            let exact = f64::from(radii[(share * 1000.0) as usize]);
            let found = quantile(&radii, share).unwrap();
            assert!(found <= exact && found > exact * 8.0 / 9.0, "{share}: {found} for {exact}");
        }
    }

    #[test]
    fn one_contact_among_many_decides_the_minimum_and_not_the_quantile() {
        let mut radii = vec![0.5; 9_999];
        radii.push(0.001);
        let (first, counts) = counted(10.0, &radii);
        let histogram = RadiusHistogram::new(first, &counts);
        let bits = 0.001_f32.to_bits();
        assert_eq!(Statistic::Minimum.demand(bits, &histogram), Demand::Radius(f64::from(0.001_f32)));
        assert_eq!(Statistic::Quantile(0.001).demand(bits, &histogram), Demand::Radius(0.5));
        let Demand::Radius(all) = Statistic::Quantile(0.0).demand(bits, &histogram) else { panic!("a radius") };
        assert!(all <= 0.001 && all > 0.001 * 8.0 / 9.0, "{all}");
    }

    #[test]
    fn no_fragments_ask_for_nothing() {
        assert_eq!(quantile(&[], 0.1), None);
        let (first, counts) = counted(1.0, &[]);
        let histogram = RadiusHistogram::new(first, &counts);
        for statistic in [Statistic::Minimum, Statistic::Quantile(0.001)] {
            assert_eq!(statistic.demand(f32::INFINITY.to_bits(), &histogram), Demand::Nothing);
        }
    }

    #[test]
    fn what_lies_outside_of_the_bins_is_counted_in_the_outermost() {
        for extent in [1e-30, 1e-3, 1.0, 1e36] {
            let first = RadiusHistogram::first_bin(extent);
            let at = |share: f64| RadiusHistogram::bin_of(first, (extent * share) as f32);
            assert_eq!([at(1.0), at(2.0)], [127, 127], "{extent}");
            assert_eq!([at(0.5), at(0.0), at(1e-6)], [119, 0, 0], "{extent}");
        }
        assert_eq!(RadiusHistogram::first_bin(f64::INFINITY), RadiusHistogram::first_bin(3.4e38));
    }

    #[test]
    fn the_lowest_bin_asks_for_more_than_any_cap() {
        let least = f64::from(f32::from_bits((RadiusHistogram::first_bin(1.0) + 1) << RadiusHistogram::SHIFT));
        assert!(3.47 / least > f64::from(crate::Settings::CAP_MAX), "{least}");
    }

    #[test]
    fn a_share_that_is_none_is_refused() {
        for share in [-0.1, 1.0, f64::NAN] {
            assert!(Statistic::Quantile(share).checked().unwrap_err().to_string().contains("Statistic::Quantile"));
        }
        assert!(Statistic::Quantile(0.0).checked().is_ok() && Statistic::Minimum.checked().is_ok());
    }

    proptest! {
        #[test]
        fn no_more_than_the_share_is_below_the_quantile(
            radii in prop::collection::vec(1e-3..9.0_f32, 1..300),
            share in 0.0..0.999_f64,
        ) {
            let found = quantile(&radii, share).unwrap();
            let below = radii.iter().filter(|&&radius| f64::from(radius) < found).count();
            prop_assert!(below as f64 <= share * radii.len() as f64);
        }
    }
}
