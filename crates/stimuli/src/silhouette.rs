//! Exact coverage of a filtered shadow edge: the stair, the steps and the true line.
//!
//! Coordinates are in texels of the shadow map (`a = 1`), y up; the shadow is below the edge.
//!
//! ```text
//! stair         y < floor(x) + 1/2                   steps at every whole x; the true edge is y = x
//! step          y < sign(x) / 2                      one step at x = 0; the true edge is y = slope x
//! double step   y < floor(x) + (x < 0 ? 1 : 0)       a stair with one tread of two texels, -1 to 1;
//!                                                    the true edge is y = slope x, slope below 1
//! line          y < slope x
//! ```
//!
//! Each is what nearest sampling at texel centres stores of its true edge: for the double step with
//! the slope `1 - 1 / W`, a column `k` has its top at `round(slope (k + 1/2))`, which is `k` for
//! `0 <= k < W` and `k + 1` for `-W <= k < 0`. The origin is the middle of a riser, of the double
//! step the middle of the wide tread, and lies on the line.
//!
//! A stair is a row of columns of width 1; the weight of the kernel in a column below its top is a
//! difference of two quadrants, so `F = sum over k of Q(k + 1 - x, top - y) - Q(k - x, top - y)` over
//! the few columns that the kernel reaches. No sampling, no error but rounding.

use crate::Kernel;
use crate::kernel::Filter;

/// An edge of a shadow in units of the texel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Silhouette {
    /// The 45-degree edge as a shadow map stores it.
    Stair,
    /// One step of one texel.
    Step,
    /// An edge of a little less than 45 degrees as a shadow map stores it: a stair with one tread of
    /// two texels.
    DoubleStep,
    /// A straight edge through the origin.
    Line {
        /// Rise over run: 1 for the stair's line.
        slope: f64,
    },
}

impl Silhouette {
    /// Part of the kernel around (`x`, `y`) that lies in shadow, 0 to 1.
    ///
    /// `radius` is in texels: it is the ratio `c = r / a`. With radius 0 the edge is hard, and a
    /// point on it gets the mean of what surrounds it; the taps of [`Kernel::Poisson25`] span a texel
    /// all the same. A point is no pixel: [`Kernel::Poisson25Rotated`] is not turned here.
    pub fn coverage(self, kernel: Kernel, radius: f64, x: f64, y: f64) -> f64 {
        self.filtered(Filter::new(kernel, radius), x, y)
    }

    /// Part of `filter` around (`x`, `y`) that lies in shadow.
    pub(crate) fn filtered(self, filter: Filter, x: f64, y: f64) -> f64 {
        let quadrant = |left_of: f64, below: f64| filter.quadrant(left_of - x, below - y);
        match self {
            Silhouette::Line { slope } => {
                let length = (slope * slope + 1.0).sqrt();
                filter.half_plane((slope * x - y) / length, [-slope / length, 1.0 / length])
            }
            Silhouette::Step => {
                let left_column_cut = quadrant(0.0, -0.5) - quadrant(0.0, 0.5);
                left_column_cut + quadrant(f64::INFINITY, 0.5)
            }
            Silhouette::Stair => stair(filter, x, y, |_| 0.5),
            Silhouette::DoubleStep => stair(filter, x, y, |left| if left < 0.0 { 1.0 } else { 0.0 }),
        }
    }
}

/// Coverage by columns of width 1; `rise(k)`, at most 1/2 from 1/2, is the top of column k above k.
fn stair(filter: Filter, x: f64, y: f64, rise: impl Fn(f64) -> f64) -> f64 {
    let reach = filter.reach();
    // The corners are at most 1 / sqrt 2 from the diagonal: further in, all is dark.
    let depth = (x - y) * std::f64::consts::FRAC_1_SQRT_2;
    if depth.abs() > reach + std::f64::consts::FRAC_1_SQRT_2 {
        return if depth > 0.0 { 1.0 } else { 0.0 };
    }
    let first = (x - reach).ceil() - 1.0;
    let columns = ((x + reach).floor() - first) as usize + 1;
    (0..columns)
        .map(|index| first + index as f64)
        .map(|left| (left, left + rise(left)))
        .map(|(left, top)| filter.quadrant(left + 1.0 - x, top - y) - filter.quadrant(left - x, top - y))
        .sum()
}
