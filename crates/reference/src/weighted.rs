//! Statistics of values that stand for a length of edge each.

/// Rounding of a sum of weights that does not move a quantile to the next value.
const ROUNDING: f64 = 1e-12;

/// Values in ascending order, each with its positive weight.
pub(crate) struct Weighted(Vec<(f64, f64)>);

impl Weighted {
    /// Of pairs of value and weight; pairs without weight are left out.
    pub(crate) fn new(pairs: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let mut pairs: Vec<_> = pairs.into_iter().filter(|&(_, weight)| weight > 0.0).collect();
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self(pairs)
    }

    /// Sum of the weights.
    pub(crate) fn weight(&self) -> f64 {
        self.0.iter().fold(0.0, |sum, (_, weight)| sum + weight)
    }

    /// Weighted mean; `None` without values.
    pub(crate) fn mean(&self) -> Option<f64> {
        let sum: f64 = self.0.iter().map(|(value, weight)| value * weight).sum();
        (!self.0.is_empty()).then(|| sum / self.weight())
    }

    /// The smallest value that at least `share` of the weight does not exceed; `None` without values.
    pub(crate) fn quantile(&self, share: f64) -> Option<f64> {
        let needed = share * self.weight() * (1.0 - ROUNDING);
        let mut below = 0.0;
        let reaches = |&&(_, weight): &&(f64, f64)| {
            below += weight;
            below >= needed
        };
        self.0.iter().find(reaches).or(self.0.last()).map(|&(value, _)| value)
    }

    /// The largest value; `None` without values.
    pub(crate) fn max(&self) -> Option<f64> {
        self.0.last().map(|&(value, _)| value)
    }

    /// Weight of the values above `threshold`, as a share of all; `None` without values.
    pub(crate) fn share_above(&self, threshold: f64) -> Option<f64> {
        let above = self.0.iter().filter(|(value, _)| *value > threshold).fold(0.0, |sum, (_, weight)| sum + weight);
        (!self.0.is_empty()).then(|| above / self.weight())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_counts_as_much_as_its_weight() {
        let values = Weighted::new([(3.0, 1.0), (1.0, 2.0), (2.0, 1.0), (9.0, 0.0)]);
        assert_eq!((values.weight(), values.mean()), (4.0, Some(1.75)));
        assert_eq!([0.0, 0.5, 0.51, 0.75, 1.0].map(|share| values.quantile(share).unwrap()), [1.0, 1.0, 2.0, 2.0, 3.0]);
        assert_eq!((values.max(), values.share_above(1.0)), (Some(3.0), Some(0.5)));
    }

    #[test]
    fn nothing_has_no_statistics() {
        let nothing = Weighted::new([]);
        assert_eq!(
            (nothing.mean(), nothing.quantile(0.5), nothing.max(), nothing.share_above(0.0)),
            (None, None, None, None)
        );
    }
}
