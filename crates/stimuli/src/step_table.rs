//! The steps of an upright picture, with all that depends on the column alone looked up.
//!
//! `F = below(top - y) - sum over risers of strip(riser - x, bottom - y, top - y)` (see
//! [`Silhouette`]). The strip of a square or a Gaussian is a product of a number a column and a number
//! a row. The strip of a disc is a difference of two `C(u, v) + S(v)`, where C is, for one v,
//! `v u` inside the disc and `S(u)` and a constant on either side of it: three runs of columns, each
//! a number a column times one a row and another added. No arc sine and no branch is left a pixel.

use std::f64::consts::{FRAC_PI_4, PI};
use std::ops::Range;

use crate::Silhouette;
use crate::density::{Density, DiscCut};

/// A silhouette of steps under one density, over columns from left to right.
pub(crate) struct StepTable {
    density: Density,
    /// Left to right, bottom to top.
    risers: Vec<RiserTable>,
    /// Tops of the columns of texels before, between and after the risers.
    tops: Vec<f64>,
}

/// A riser and the pixels whose kernel it crosses.
struct RiserTable {
    /// Columns of pixels.
    columns: Range<usize>,
    /// For each of them, what the density asks for.
    cuts: Cuts,
}

enum Cuts {
    /// Of a disc: places in radii, falling, and S there.
    Disc { at: Vec<f64>, antiderivative: Vec<f64> },
    /// Of a product: the weight left of the riser.
    Product { below: Vec<f64> },
}

impl StepTable {
    /// The table for pixels at `x`, increasing, in rows within `rows`, in texels.
    pub(crate) fn new(silhouette: Silhouette, density: Density, x: &[f64], rows: Range<f64>) -> Self {
        let half_width = density.half_width();
        let [from, to] = [x.first(), x.last()].map(|end| end.copied().unwrap_or(0.0));
        let (from, to) = (from - half_width, to + half_width);
        let crossed = silhouette
            .risers(from, to)
            .filter(|riser| riser.top >= rows.start - half_width && riser.bottom <= rows.end + half_width);
        let (mut risers, mut tops) = (Vec::new(), Vec::new());
        for riser in crossed {
            let begin = x.partition_point(|x| x + half_width < riser.x);
            let columns = begin..begin.max(x.partition_point(|x| x - half_width <= riser.x));
            let cuts = Cuts::new(density, x[columns.clone()].iter().map(|x| riser.x - x));
            if tops.is_empty() {
                tops.push(riser.bottom);
            }
            tops.push(riser.top);
            risers.push(RiserTable { columns, cuts });
        }
        if tops.is_empty() {
            tops.push(silhouette.top(to.floor()));
        }
        Self { density, risers, tops }
    }

    /// Adds `share` of the coverage of the row at `y` to `row`, one number a column.
    pub(crate) fn add_row(&self, y: f64, share: f64, row: &mut [f64]) {
        let half_width = self.density.half_width();
        // Risers below and above the kernel take nothing away.
        let begin = self.tops[1..].partition_point(|&top| top < y - half_width);
        let end = self.tops[..self.risers.len()].partition_point(|&bottom| bottom <= y + half_width);

        // All that is below the top of the last column that the kernel reaches.
        let mut from = 0;
        for index in begin..=end {
            let to = if index < end { self.risers[index].columns.start } else { row.len() };
            let below = share * self.density.below(self.tops[index] - y);
            row[from..to].iter_mut().for_each(|value| *value += below);
            from = to;
        }

        // Less the strip of each riser.
        for (index, RiserTable { columns, cuts }) in self.risers[..end].iter().enumerate().skip(begin) {
            let [bottom, top] = [self.tops[index] - y, self.tops[index + 1] - y];
            cuts.add_strip(self.density, bottom, top, -share, &mut row[columns.clone()]);
        }
    }
}

impl Cuts {
    fn new(density: Density, u: impl Iterator<Item = f64>) -> Self {
        match density {
            Density::Disc { .. } => {
                let (at, antiderivative) =
                    u.map(|u| density.disc_cut(u)).map(|cut| (cut.at, cut.antiderivative)).unzip();
                Cuts::Disc { at, antiderivative }
            }
            Density::Box { .. } | Density::Gaussian { .. } => {
                Cuts::Product { below: u.map(|u| density.below(u)).collect() }
            }
        }
    }

    /// Adds `share` of the strip from `bottom` to `top` to each column.
    fn add_strip(&self, density: Density, bottom: f64, top: f64, share: f64, row: &mut [f64]) {
        match self {
            Cuts::Product { below } => {
                let height = share * (density.below(top) - density.below(bottom));
                add(row, below, height, 0.0);
            }
            Cuts::Disc { at, antiderivative } => {
                for (edge, share) in [(top, share / PI), (bottom, -share / PI)] {
                    add_below(row, at, antiderivative, density.disc_cut(edge), share);
                }
            }
        }
    }
}

/// Adds `share` of `C(u, v) + S(v)` to each column.
fn add_below(row: &mut [f64], at: &[f64], antiderivative: &[f64], v: DiscCut, share: f64) {
    let half_chord = ((1.0 - v.at) * (1.0 + v.at)).sqrt();
    let inside = at.partition_point(|&u| u > half_chord)..at.partition_point(|&u| u >= -half_chord);
    let outside = share.copysign(share * v.at);
    let rest = FRAC_PI_4 - v.antiderivative.abs();
    let constant = share * v.antiderivative;
    let runs = [
        (0..inside.start, antiderivative, outside, constant - outside * rest),
        (inside.clone(), at, share * v.at, constant),
        (inside.end..at.len(), antiderivative, outside, constant + outside * rest),
    ];
    for (columns, of_column, factor, constant) in runs {
        add(&mut row[columns.clone()], &of_column[columns], factor, constant);
    }
}

/// `row += factor * of_column + constant`.
fn add(row: &mut [f64], of_column: &[f64], factor: f64, constant: f64) {
    for (value, of_column) in row.iter_mut().zip(of_column) {
        *value += factor * of_column + constant;
    }
}
