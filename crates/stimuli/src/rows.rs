//! The coverage of a picture row by row, by the quickest way that is exact.

use crate::Silhouette;
use crate::band::Band;
use crate::edge::Edge;
use crate::step_table::StepTable;

/// Most numbers in the tables of a picture, 128 MiB; a picture that needs more is drawn point by point.
const TABLE_LIMIT: f64 = (1_u32 << 24) as f64;

/// How coverage is found.
pub(crate) enum Rows {
    /// Upright steps: tables, one a tap, with how far the tap is above its pixel.
    Steps(Vec<(StepTable, f64)>),
    /// An upright line at 45 degrees: coverage by the sum of column and row.
    Diagonal(Vec<f64>),
    /// Another line: a half plane at every pixel of the band.
    Line(Band),
    /// All else: the closed form at every pixel of the band.
    Points(Band),
}

impl Rows {
    /// The quickest way for an edge.
    pub(crate) fn new(edge: &Edge) -> Self {
        let [width_px, height_px] = edge.size_px;
        match edge.silhouette {
            _ if !edge.has_one_kernel() => Rows::Points(Band::new(edge)),
            Silhouette::Line { slope: 1.0 } if edge.is_upright() => {
                let along_top = (0..width_px).map(|column| edge.coverage(column, 0));
                let along_right = (1..height_px).map(|row| edge.coverage(width_px - 1, row));
                Rows::Diagonal(along_top.chain(along_right).collect())
            }
            Silhouette::Line { .. } => Rows::Line(Band::new(edge)),
            _ if !edge.is_upright() || table_size(edge) > TABLE_LIMIT => Rows::Points(Band::new(edge)),
            steps => {
                let table = |[dx, dy]: [f64; 2]| {
                    let x: Vec<f64> = (0..width_px).map(|column| edge.x(column) + dx).collect();
                    let rows = edge.y(height_px - 1) + dy..edge.y(0) + dy;
                    (StepTable::new(steps, edge.filter.density, &x, rows), dy)
                };
                Rows::Steps(edge.filter.offsets().map(table).collect())
            }
        }
    }

    /// The coverage of a row's pixels.
    pub(crate) fn fill(&self, edge: &Edge, row: u32, coverage: &mut [f64]) {
        match self {
            Rows::Steps(tables) => {
                coverage.fill(0.0);
                for (table, dy) in tables {
                    table.add_row(edge.y(row) + dy, 1.0 / tables.len() as f64, coverage);
                }
            }
            Rows::Diagonal(by_sum) => coverage.copy_from_slice(&by_sum[row as usize..][..coverage.len()]),
            Rows::Line(band) => {
                for column in band.columns(row, coverage) {
                    coverage[column] = edge.filter.half_plane(band.depth(column as u32, row), band.normal);
                }
            }
            Rows::Points(band) => {
                for column in band.columns(row, coverage) {
                    coverage[column] = edge.coverage(column as u32, row);
                }
            }
        }
    }
}

/// Upper bound of the numbers in the tables of an edge: risers times columns that each crosses.
fn table_size(edge: &Edge) -> f64 {
    let [width_px, height_px] = edge.size_px;
    let kernel = 2.0 * edge.filter.density.half_width() + 2.0;
    let risers = (edge.x(width_px - 1) - edge.x(0)).min(edge.y(0) - edge.y(height_px - 1)) + kernel;
    let columns = f64::from(width_px).min(kernel * edge.texel_px);
    2.0 * edge.filter.offsets().len() as f64 * risers * columns
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Encoding, Kernel, Pattern, Shape, Stimulus};

    const SIZE_PX: [u32; 2] = [97, 70];

    fn stimulus(pattern: Pattern, shape: Shape, kernel: Kernel, texel_px: f64, ratio: f64) -> Stimulus {
        Stimulus {
            pattern,
            shape,
            kernel,
            texel_px,
            radius_px: ratio * texel_px,
            contrast: 1.0,
            encoding: Encoding::LinearLight,
            phase: 0.3,
            mirrored: false,
            inverted: false,
            tilt_rad: 0.0,
            dither_seed: None,
        }
    }

    /// Largest difference of rows from the closed form at the pixels of another edge.
    fn largest_difference(rows: &Rows, of: &Edge, from: &Edge) -> f64 {
        let mut coverage = vec![0.0; SIZE_PX[0] as usize];
        let mut largest = 0.0_f64;
        for row in 0..SIZE_PX[1] {
            rows.fill(of, row, &mut coverage);
            for (column, covered) in (0..).zip(&coverage) {
                largest = largest.max((covered - from.coverage(column, row)).abs());
            }
        }
        largest
    }

    #[test]
    fn tables_hold_the_closed_form_at_every_pixel() {
        for pattern in [Pattern::Stair, Pattern::Step, Pattern::DoubleStep] {
            for shape in [Shape::Artifact, Shape::Line] {
                for (_, kernel) in Kernel::NAMED {
                    for (texel_px, ratio) in
                        [(7.3, 0.0), (7.3, 0.4), (10.0, 0.0), (10.0, 3.47), (4.0, 9.0), (48.0, 1.0)]
                    {
                        let what = stimulus(pattern, shape, kernel, texel_px, ratio);
                        let edge = Edge::new(&what, SIZE_PX).unwrap();
                        let rows = Rows::new(&edge);
                        let difference = largest_difference(&rows, &edge, &edge);
                        assert!(difference < 1e-12, "{what:?}: {difference:e}");
                        let point_by_point = kernel == Kernel::Poisson25Rotated;
                        assert_eq!(matches!(rows, Rows::Points(_)), point_by_point, "{what:?}");
                        let tilted = Edge::new(&Stimulus { tilt_rad: 0.6, ..what }, SIZE_PX).unwrap();
                        let difference = largest_difference(&Rows::new(&tilted), &tilted, &tilted);
                        assert!(difference < 1e-12, "tilted {what:?}: {difference:e}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_comparison_sees_a_stair_that_is_moved_by_a_billionth_of_its_period() {
        let what = stimulus(Pattern::Stair, Shape::Artifact, Kernel::Disc, 10.0, 3.47);
        let edge = Edge::new(&what, SIZE_PX).unwrap();
        let moved = Edge::new(&Stimulus { phase: what.phase + 1e-9, ..what }, SIZE_PX).unwrap();
        assert!(largest_difference(&Rows::new(&edge), &edge, &moved) > 1e-11);
    }

    #[test]
    fn a_table_too_large_is_not_made() {
        let what = stimulus(Pattern::Stair, Shape::Artifact, Kernel::GaussianHalf, 1.0, 4096.0);
        assert!(matches!(Rows::new(&Edge::new(&what, SIZE_PX).unwrap()), Rows::Steps(_)));
        assert!(matches!(Rows::new(&Edge::new(&what, [16384, 16384]).unwrap()), Rows::Points(_)));
    }
}
