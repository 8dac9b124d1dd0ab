//! The part of a picture's row that a filtered edge crosses; the rest is dark or lit.
//!
//! Every silhouette stays near a straight middle line, so a pixel farther behind it or before it than
//! the kernel reaches needs no kernel. The depth behind a line is linear in column and row.

use std::f64::consts::FRAC_1_SQRT_2;
use std::ops::Range;

use crate::Silhouette;
use crate::edge::Edge;

/// Depth behind an edge's middle line, in texels, and how near the edge is to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Band {
    /// Outward unit normal of the middle line.
    pub(crate) normal: [f64; 2],
    depth_of_first: f64,
    depth_per_column: f64,
    depth_per_row: f64,
    half_width: f64,
}

impl Band {
    /// The band of an edge.
    pub(crate) fn new(edge: &Edge) -> Self {
        let (slope, corner) = match edge.silhouette {
            // No corner of a stair is farther from its diagonal.
            Silhouette::Stair | Silhouette::DoubleStep => (1.0, FRAC_1_SQRT_2),
            Silhouette::Step => (0.0, 0.5),
            Silhouette::Line { slope } => (slope, 0.0),
        };
        let length = (slope * slope + 1.0_f64).sqrt();
        let normal = [-slope / length, 1.0 / length];
        let depth = |column, row| {
            let [x, y] = edge.place(column, row);
            -(normal[0] * x + normal[1] * y)
        };
        let [width_px, height_px] = edge.size_px;
        let slope_over = |to: f64, steps: u32| (to - depth(0, 0)) / f64::from(steps.max(1));
        Self {
            normal,
            depth_of_first: depth(0, 0),
            depth_per_column: slope_over(depth(width_px - 1, 0), width_px - 1),
            depth_per_row: slope_over(depth(0, height_px - 1), height_px - 1),
            half_width: edge.filter.reach() + corner,
        }
    }

    /// Depth of a pixel's centre.
    pub(crate) fn depth(&self, column: u32, row: u32) -> f64 {
        self.depth_of_first + f64::from(column) * self.depth_per_column + f64::from(row) * self.depth_per_row
    }

    /// Columns of a row that the kernel may cross; fills the others with 1 for dark and 0 for lit.
    pub(crate) fn columns(&self, row: u32, coverage: &mut [f64]) -> Range<usize> {
        let width = coverage.len();
        let at_depth = |depth: f64| (depth - self.depth(0, row)) / self.depth_per_column;
        let ends = [at_depth(-self.half_width), at_depth(self.half_width)];
        // A pixel more on either side for rounding; a level band is in or out as a whole.
        let crossed = if ends.iter().all(|end| end.is_finite()) {
            let begin = (ends[0].min(ends[1]) - 1.0).clamp(0.0, width as f64) as usize;
            let end = (ends[0].max(ends[1]) + 2.0).clamp(0.0, width as f64) as usize;
            begin..end.max(begin)
        } else if self.depth(0, row).abs() <= self.half_width {
            0..width
        } else {
            0..0
        };
        let dark = |column: usize| if self.depth(column as u32, row) > 0.0 { 1.0 } else { 0.0 };
        coverage[..crossed.start].fill(dark(0));
        coverage[crossed.end..].fill(dark(width - 1));
        crossed
    }
}
