//! Medians and quartiles of repeated measurements.

use serde::{Deserialize, Serialize};

/// The middle half of repeated measurements. Quartiles interpolate linearly between order statistics.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Half of the measurements are below.
    pub median: f64,
    /// A quarter of the measurements is below.
    pub lower_quartile: f64,
    /// A quarter of the measurements is above.
    pub upper_quartile: f64,
}

impl Spread {
    /// Of at least one measurement; `None` of none.
    pub fn of(measurements: &[f64]) -> Option<Self> {
        let mut sorted = measurements.to_vec();
        sorted.sort_by(f64::total_cmp);
        let last = sorted.len().checked_sub(1)?;
        let quantile = |share: f64| {
            let place = share * last as f64;
            let below = place.floor() as usize;
            let above = place.ceil() as usize;
            sorted[below] + (sorted[above] - sorted[below]) * place.fract()
        };
        Some(Self { median: quantile(0.5), lower_quartile: quantile(0.25), upper_quartile: quantile(0.75) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spread_of_a_known_list_is_known() {
        let spread = Spread::of(&[4.0, 1.0, 3.0, 2.0, 5.0]);
        assert_eq!(spread, Some(Spread { median: 3.0, lower_quartile: 2.0, upper_quartile: 4.0 }));
        assert_eq!(Spread::of(&[1.0, 2.0]).map(|spread| spread.median), Some(1.5));
        assert_eq!(Spread::of(&[]), None);
    }
}
