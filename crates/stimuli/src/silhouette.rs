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
//! Where the kernel ends on the right, all below the top is dark; each riser that it reaches takes a
//! strip away, the part left of the riser between its bottom and its top. So
//! `F = below(top of the last column - y) - sum over risers of strip`. No sampling, no error but
//! rounding.

use crate::Kernel;
use crate::density::Density;
use crate::filter::Filter;

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
        match self {
            Silhouette::Line { slope } => {
                let length = (slope * slope + 1.0).sqrt();
                filter.half_plane((slope * x - y) / length, [-slope / length, 1.0 / length])
            }
            steps => filter.mean(|[dx, dy]| steps.under(filter.density, x + dx, y + dy)),
        }
    }

    /// Part of `density` around (`x`, `y`) that lies below the steps.
    fn under(self, density: Density, x: f64, y: f64) -> f64 {
        let half_width = density.half_width();
        let hidden: f64 = self
            .risers(x - half_width, x + half_width)
            .map(|riser| density.strip(riser.x - x, riser.bottom - y, riser.top - y))
            .sum();
        density.below(self.top((x + half_width).floor()) - y) - hidden
    }

    /// Top of column `k`, which spans `k` to `k + 1`; of a line where it crosses the column's middle.
    pub(crate) fn top(self, k: f64) -> f64 {
        match self {
            Silhouette::Stair => k + 0.5,
            Silhouette::Step => {
                if k < 0.0 {
                    -0.5
                } else {
                    0.5
                }
            }
            Silhouette::DoubleStep if k < 0.0 => k + 1.0,
            Silhouette::DoubleStep => k,
            Silhouette::Line { slope } => slope * (k + 0.5),
        }
    }

    /// Risers of a silhouette of steps from `from` to `to`, both included, left to right.
    pub(crate) fn risers(self, from: f64, to: f64) -> impl Iterator<Item = Riser> {
        let first = from.ceil();
        let count = (to.floor() - first + 1.0).max(0.0) as usize;
        (0..count)
            .map(move |index| first + index as f64)
            .map(move |x| Riser { x, bottom: self.top(x - 1.0), top: self.top(x) })
            .filter(|riser| riser.bottom < riser.top)
    }
}

/// Where a silhouette of steps rises.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Riser {
    pub(crate) x: f64,
    pub(crate) bottom: f64,
    pub(crate) top: f64,
}
