//! Exact coverage of a filtered shadow edge: the stair, the single step and the true line.
//!
//! Coordinates are in texels of the shadow map (`a = 1`), y up; the shadow is below the edge.
//!
//! ```text
//! stair  y < floor(x) + 1/2      steps at every whole x; the true edge is y = x
//! step   y < sign(x) / 2         one step at x = 0; the true edge is y = slope x
//! line   y < slope x
//! ```
//!
//! The origin is the middle of a riser and lies on the line. A stair is a row of columns of width 1;
//! the weight of the kernel in a column below its top is a difference of two quadrants, so
//! `F = sum over k of Q(k + 1 - x, top - y) - Q(k - x, top - y)` over the few columns that the kernel
//! reaches. No sampling, no error but rounding.

use crate::Kernel;

/// An edge of a shadow in units of the texel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Silhouette {
    /// The 45-degree edge as a shadow map stores it.
    Stair,
    /// One step of one texel.
    Step,
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
    /// point on it gets the mean of what surrounds it.
    pub fn coverage(self, kernel: Kernel, radius: f64, x: f64, y: f64) -> f64 {
        let in_radii = |length: f64| if length == 0.0 { 0.0 } else { length / radius };
        let quadrant = |left_of: f64, below: f64| kernel.quadrant(in_radii(left_of - x), in_radii(below - y));
        match self {
            Silhouette::Line { slope } => {
                let length = slope.hypot(1.0);
                kernel.half_plane(in_radii((slope * x - y) / length), [-slope / length, 1.0 / length])
            }
            Silhouette::Step => {
                let left_column_cut = quadrant(0.0, -0.5) - quadrant(0.0, 0.5);
                left_column_cut + quadrant(f64::INFINITY, 0.5)
            }
            Silhouette::Stair => {
                let reach = kernel.reach() * radius;
                // The stair's corners are 0.354 texels from its line: further in, all is dark.
                let depth = (x - y) * std::f64::consts::FRAC_1_SQRT_2;
                if depth.abs() > reach + 0.5 {
                    return if depth > 0.0 { 1.0 } else { 0.0 };
                }
                let first = (x - reach).floor();
                let columns = ((x + reach).floor() - first) as usize + 1;
                (0..columns)
                    .map(|index| first + index as f64)
                    .map(|left| quadrant(left + 1.0, left + 0.5) - quadrant(left, left + 0.5))
                    .sum()
            }
        }
    }
}
