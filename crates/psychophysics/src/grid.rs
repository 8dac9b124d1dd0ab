//! The table of thresholds: `T_i = centre + (i - half) step`, `i = 0 ..= 2 half`, and the summaries
//! of a distribution on it, as Psychtoolbox computes them.
//!
//! Quantiles interpolate the cumulative sum linearly, and the sum at a point includes that point:
//! the median of a distribution symmetric about the centre is `centre - step / 2`.

use crate::error::{Error, require};

/// Longest table of thresholds; beyond it a typing error is likelier than a wish.
const POINTS_MAX: f64 = 1e6;

/// Equally spaced thresholds about a centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grid {
    /// The middle point.
    pub(crate) centre: f64,
    /// Distance of neighbours.
    pub(crate) step: f64,
    /// Points on either side of the centre.
    pub(crate) half: usize,
}

/// Where on the table an intensity lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// On the table.
    OnTable,
    /// Off the table; the likelihood of the table's end was used.
    OffTable,
}

impl Grid {
    /// A table of this width, rounded up to whole steps on either side.
    pub(crate) fn new(centre: f64, step: f64, width: f64) -> Self {
        // The slack ignores a quotient that rounding puts just above a whole number.
        Self { centre, step, half: (width / step / 2.0 - 1e-9).ceil() as usize }
    }

    /// Refuses what makes no table, given as name and value; the error has the name.
    pub(crate) fn check(centre: (&str, f64), step: (&str, f64), width: (&str, f64)) -> Result<(), Error> {
        require(centre.1.is_finite(), centre.0, centre.1, "a finite number")?;
        for (field, value) in [step, width] {
            require(value.is_finite() && value > 0.0, field, value, "a finite number above 0")?;
        }
        let points = width.1 / step.1;
        require(points <= POINTS_MAX, &format!("{} / {}", width.0, step.0), points, "at most 1000000 table points")
    }

    /// Number of points.
    pub(crate) fn len(&self) -> usize {
        2 * self.half + 1
    }

    /// Distance of point `i` from the centre.
    pub(crate) fn offset(&self, i: usize) -> f64 {
        (i as f64 - self.half as f64) * self.step
    }

    /// The point nearest to an intensity, half away from the centre, or the end that it lies beyond.
    pub(crate) fn nearest(&self, intensity: f64) -> (usize, Shown) {
        let half = self.half as f64;
        let steps = ((intensity - self.centre) / self.step).round();
        let clamped = steps.clamp(-half, half);
        ((clamped + half) as usize, if clamped == steps { Shown::OnTable } else { Shown::OffTable })
    }

    /// Mean of the weights, which sum to 1.
    pub(crate) fn mean(&self, weights: &[f64]) -> f64 {
        self.centre + self.mean_offset(weights)
    }

    /// Standard deviation of the weights, which sum to 1.
    pub(crate) fn sd(&self, weights: &[f64]) -> f64 {
        let mean = self.mean_offset(weights);
        sum_by_index(weights, |i, weight| {
            let deviation = self.offset(i) - mean;
            weight * deviation * deviation
        })
        .sqrt()
    }

    /// The first point of the highest weight.
    pub(crate) fn mode(&self, weights: &[f64]) -> f64 {
        let mut best = 0;
        for (i, value) in weights.iter().enumerate() {
            if *value > weights[best] {
                best = i;
            }
        }
        self.centre + self.offset(best)
    }

    /// Quantile of the weights; `order` is clamped to 0..=1, and orders beyond the first or the last
    /// point give that point.
    pub(crate) fn quantile(&self, weights: &[f64], order: f64) -> f64 {
        let wanted = order.clamp(0.0, 1.0) * sum_by_index(weights, |_, weight| weight);
        let mut sum = 0.0;
        let mut below: Option<(f64, usize)> = None;
        for (i, weight) in weights.iter().enumerate() {
            let sum_below = sum;
            sum += weight;
            // A plateau of the cumulative sum is represented by its first point.
            if sum <= sum_below {
                continue;
            }
            if sum >= wanted {
                let x = self.offset(i);
                let (sum_below, x_below) = below.map_or((0.0, x), |(sum, i)| (sum, self.offset(i)));
                return self.centre + x_below + (wanted - sum_below) / (sum - sum_below) * (x - x_below);
            }
            below = Some((sum, i));
        }
        self.centre + below.map_or(0.0, |(_, i)| self.offset(i))
    }

    fn mean_offset(&self, weights: &[f64]) -> f64 {
        sum_by_index(weights, |i, weight| weight * self.offset(i))
    }
}

/// Sum of `term(i, weights[i])` in four interleaved parts: a single running sum would wait for each
/// addition before the next.
pub(crate) fn sum_by_index(weights: &[f64], term: impl Fn(usize, f64) -> f64) -> f64 {
    let mut parts = [0.0; 4];
    let (quads, rest) = weights.as_chunks::<4>();
    for (q, quad) in quads.iter().enumerate() {
        for lane in 0..4 {
            parts[lane] += term(4 * q + lane, quad[lane]);
        }
    }
    let tail: f64 = rest.iter().enumerate().map(|(i, weight)| term(4 * quads.len() + i, *weight)).sum();
    (parts[0] + parts[1]) + (parts[2] + parts[3]) + tail
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_reaches_half_its_width_to_either_side_of_its_centre() {
        let grid = Grid::new(-0.5, 0.01, 5.0);
        assert_eq!((grid.half, grid.len()), (250, 501));
        assert!((grid.offset(0) + 2.5).abs() < 1e-12 && grid.offset(250) == 0.0);
        assert_eq!(Grid::new(0.0, 0.3, 1.0).half, 2);
    }

    #[test]
    fn an_intensity_goes_to_the_nearest_point_or_the_end_it_lies_beyond() {
        let grid = Grid::new(1.0, 0.25, 2.0);
        assert_eq!(grid.nearest(1.0), (4, Shown::OnTable));
        assert_eq!(grid.nearest(1.125), (5, Shown::OnTable));
        assert_eq!(grid.nearest(0.875), (3, Shown::OnTable));
        assert_eq!(grid.nearest(2.1), (8, Shown::OnTable));
        assert_eq!(grid.nearest(2.25), (8, Shown::OffTable));
        assert_eq!(grid.nearest(-1e300), (0, Shown::OffTable));
    }

    #[test]
    fn the_interleaved_sum_is_the_sum_for_every_length() {
        for length in 0..20 {
            let weights: Vec<f64> = (0..length).map(f64::from).collect();
            let expected: f64 = weights.iter().enumerate().map(|(i, w)| i as f64 * w).sum();
            assert_eq!(sum_by_index(&weights, |i, weight| i as f64 * weight), expected);
        }
    }

    #[test]
    fn summaries_of_a_distribution_known_by_hand() {
        let grid = Grid::new(10.0, 1.0, 4.0);
        let weights = [0.0, 0.25, 0.5, 0.0, 0.25];
        assert!((grid.mean(&weights) - 10.25).abs() < 1e-15);
        assert!((grid.sd(&weights) - 1.0897247358851685).abs() < 1e-15);
        assert_eq!(grid.mode(&weights), 10.0);
        // The cumulative sum is 0, 0.25, 0.75, 0.75, 1; its plateau counts at its first point.
        for (order, quantile) in [(0.0, 9.0), (0.25, 9.0), (0.5, 9.5), (0.75, 10.0), (0.875, 11.0), (1.0, 12.0)] {
            assert!((grid.quantile(&weights, order) - quantile).abs() < 1e-15, "{order}");
        }
    }
}
