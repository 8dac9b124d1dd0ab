//! The likelihood of a response on the table of thresholds.
//!
//! With intensities rounded to the table, `p(x - T)` takes `4 half + 1` values for one psychometric
//! function. They are stored from the largest `x - T` to the smallest, so that the likelihoods of
//! all thresholds at one intensity are a window of the table, in the order of the thresholds.
//!
//! `x_threshold` is the linear interpolation of the tabulated psychometric function at the threshold
//! probability, as Psychtoolbox computes it (4e-6 above the closed form at a step of 0.01).

use crate::error::Error;
use crate::grid::Grid;
use crate::psychometric::Psychometric;

/// `p(x - T)` of one psychometric function.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Likelihood {
    /// Probability of a response 1 at `x - T = (2 half - j) step`, `j = 0 ..= 4 half`.
    success: Vec<f64>,
    step: f64,
    /// Shift of the psychometric function that puts its threshold probability at 0.
    pub(crate) x_threshold: f64,
}

impl Likelihood {
    /// Tabulates `psychometric`, whose parameters are checked, for the thresholds of `grid`.
    ///
    /// A table that does not reach the threshold probability is an error.
    pub(crate) fn new(psychometric: &Psychometric, grid: &Grid) -> Result<Self, Error> {
        let x_threshold = tabulated_x_threshold(psychometric, grid)?;
        Ok(Self::shifted(psychometric, x_threshold, grid))
    }

    /// The same with a shift of the caller's choice.
    pub(crate) fn shifted(psychometric: &Psychometric, x_threshold: f64, grid: &Grid) -> Self {
        let ends = 2 * grid.half as isize;
        let offsets = (-ends..=ends).rev().map(|i| i as f64 * grid.step);
        let success = offsets.map(|offset| psychometric.unshifted(offset + x_threshold)).collect();
        Self { success, step: grid.step, x_threshold }
    }

    /// Probability of a response 1 at table point `intensity`, for each threshold.
    pub(crate) fn at(&self, intensity: usize) -> &[f64] {
        window(&self.success, intensity)
    }

    /// Every value, from the largest `x - T` to the smallest.
    pub(crate) fn values(&self) -> &[f64] {
        &self.success
    }

    /// Probability of a response 1 at `offset = x - T`, interpolated linearly and constant beyond the
    /// table's ends; NaN for NaN.
    pub(crate) fn probability(&self, offset: f64) -> f64 {
        let last = self.success.len() - 1;
        let j = (last as f64 / 2.0 - offset / self.step).clamp(0.0, last as f64);
        let below = (j as usize).min(last - 1);
        let part = j - below as f64;
        self.success[below] + part * (self.success[below + 1] - self.success[below])
    }
}

/// The part of a table over `x - T` that belongs to table point `intensity`.
pub(crate) fn window(table: &[f64], intensity: usize) -> &[f64] {
    let half = (table.len() - 1) / 4;
    let first = 2 * half - intensity;
    &table[first..=first + 2 * half]
}

/// Linear interpolation of the tabulated psychometric function at the threshold probability.
fn tabulated_x_threshold(psychometric: &Psychometric, grid: &Grid) -> Result<f64, Error> {
    let wanted = psychometric.threshold_probability;
    let ends = 2 * grid.half as isize;
    let value = |i: isize| psychometric.unshifted(i as f64 * grid.step);
    if value(-ends) >= wanted || value(ends) < wanted {
        return Err(Error::parameter(
            "range",
            2.0 * ends as f64 * grid.step,
            "a table that reaches the threshold probability",
        ));
    }
    // The first point at which the rising function reaches the wanted value, by bisection.
    let (mut below, mut above) = (-ends, ends);
    while above - below > 1 {
        let middle = below.midpoint(above);
        if value(middle) < wanted { below = middle } else { above = middle }
    }
    let (low, high) = (value(below), value(above));
    let x = |i: isize| i as f64 * grid.step;
    Ok(x(below) + (wanted - low) / (high - low) * (x(above) - x(below)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const CURVE: Psychometric = Psychometric { beta: 3.5, delta: 0.01, gamma: 0.5, threshold_probability: 0.82 };

    #[test]
    fn a_window_holds_the_curve_at_one_intensity_for_every_threshold() {
        let grid = Grid::new(0.3, 0.1, 2.0);
        let likelihood = Likelihood::new(&CURVE, &grid).unwrap();
        for intensity in 0..grid.len() {
            let window = likelihood.at(intensity);
            assert_eq!(window.len(), grid.len());
            for (threshold, found) in window.iter().enumerate() {
                let offset = grid.offset(intensity) - grid.offset(threshold);
                let expected = CURVE.unshifted(offset + likelihood.x_threshold);
                assert!((found - expected).abs() < 1e-14);
                assert!((likelihood.probability(offset) - expected).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn off_the_table_the_probability_is_that_of_its_end() {
        let grid = Grid::new(0.3, 0.1, 2.0);
        let likelihood = Likelihood::new(&CURVE, &grid).unwrap();
        let (highest, lowest) = (likelihood.values()[0], likelihood.values()[40]);
        assert!(highest > 0.99 && lowest < 0.51);
        for beyond in [2.0, 2.1, 1e300, f64::INFINITY] {
            assert_eq!(likelihood.probability(beyond), highest);
            assert_eq!(likelihood.probability(-beyond), lowest);
        }
        assert!(likelihood.probability(f64::NAN).is_nan());
    }

    #[test]
    fn between_two_points_the_probability_is_halfway() {
        let grid = Grid::new(0.0, 0.1, 2.0);
        let likelihood = Likelihood::new(&CURVE, &grid).unwrap();
        let ends = [likelihood.probability(0.1), likelihood.probability(0.2)];
        assert!((likelihood.probability(0.15) - ends[0].midpoint(ends[1])).abs() < 1e-14);
    }
}
