//! Promises of the closed forms: an independent table, brute force, symmetry, limits.

use proptest::prelude::*;
use scumble_stimuli::{Kernel, Silhouette};

const EDGES: [Silhouette; 4] =
    [Silhouette::Stair, Silhouette::Step, Silhouette::Line { slope: 1.0 }, Silhouette::DoubleStep];
const KERNELS: [Kernel; 4] = [Kernel::Disc, Kernel::Box, Kernel::GaussianHalf, Kernel::GaussianThird];

#[test]
fn every_row_of_the_reference_table_is_met() {
    let table = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/filtered_edge_coverage.csv");
    let mut rows = 0;
    for record in csv::Reader::from_path(table).unwrap().records() {
        let record = record.unwrap();
        let kernel = Kernel::from_name(&record[0]).unwrap();
        let number = |column: usize| record[column].parse::<f64>().unwrap();
        let tolerance = if matches!(kernel, Kernel::Disc | Kernel::Box) { 1e-12 } else { 1e-9 };
        let columns = [(Silhouette::Stair, 4), (Silhouette::Line { slope: 1.0 }, 5), (Silhouette::Step, 6)];
        for (edge, column) in columns {
            let found = edge.coverage(kernel, number(1), number(2), number(3));
            let difference = (found - number(column)).abs();
            assert!(difference <= tolerance, "{edge:?} {record:?}: {found}, off by {difference:e}");
        }
        rows += 1;
    }
    assert_eq!(rows, 60);
}

/// Whether a point lies in the hard shadow, written anew from the definitions.
fn in_shadow(edge: Silhouette, x: f64, y: f64) -> bool {
    match edge {
        Silhouette::Stair => y < x.floor() + 0.5,
        Silhouette::DoubleStep => y < x.floor() + if x < 0.0 { 1.0 } else { 0.0 },
        Silhouette::Step => y < if x < 0.0 { -0.5 } else { 0.5 },
        Silhouette::Line { slope } => y < slope * x,
    }
}

#[test]
fn disc_and_box_agree_with_brute_force() {
    const SIDE: i32 = 800;
    let edges = [EDGES[0], EDGES[1], EDGES[2], EDGES[3], Silhouette::Line { slope: 0.3 }];
    for (kernel, radius, x, y) in
        [(Kernel::Disc, 1.3, 0.31, 0.87), (Kernel::Disc, 3.47, -0.45, 0.2), (Kernel::Box, 2.2, 0.7, 0.1)]
    {
        for edge in edges {
            let (mut inside, mut dark) = (0, 0);
            for (i, j) in (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (i, j))) {
                let [u, v] = [i, j].map(|k| (2.0 * f64::from(k) + 1.0) / f64::from(SIDE) - 1.0);
                if kernel == Kernel::Box || u * u + v * v < 1.0 {
                    inside += 1;
                    dark += i32::from(in_shadow(edge, x + radius * u, y + radius * v));
                }
            }
            let brute = f64::from(dark) / f64::from(inside);
            let exact = edge.coverage(kernel, radius, x, y);
            // An edge of length 2 crosses some 2 * SIDE of the SIDE^2 samples at random.
            assert!((brute - exact).abs() < 2e-3, "{kernel:?} {edge:?}: {exact} against {brute}");
        }
    }
}

#[test]
fn a_radius_of_zero_leaves_the_hard_edge() {
    for kernel in KERNELS {
        for edge in EDGES {
            for (x, y) in [(0.3, 0.1), (-0.3, 0.1), (0.2, 0.6), (2.4, 1.9), (-1.7, -1.4)] {
                let expected = if in_shadow(edge, x, y) { 1.0 } else { 0.0 };
                assert_eq!(edge.coverage(kernel, 0.0, x, y), expected, "{kernel:?} {edge:?} at {x}, {y}");
                assert_eq!(edge.coverage(kernel, 1e-9, x, y), expected, "{kernel:?} {edge:?} at {x}, {y}");
            }
            assert_eq!(edge.coverage(kernel, 0.0, 0.0, 0.0), 0.5, "{kernel:?} {edge:?} on the edge");
        }
    }
}

#[test]
fn the_mean_over_a_period_of_the_stair_is_the_lines() {
    // Filtering keeps the mean; stair and line hide the same area per period.
    const STEPS: i32 = 4000;
    for kernel in [Kernel::Disc, Kernel::Box, Kernel::GaussianHalf] {
        let mean = |edge: Silhouette| {
            let along = (0..STEPS).map(|k| (f64::from(k) + 0.5) / f64::from(STEPS));
            // A cut parallel to x through one whole period of the partial zone.
            along.map(|t| edge.coverage(kernel, 2.0, 20.0 * t - 10.0, 0.0)).sum::<f64>() / f64::from(STEPS)
        };
        let difference = (mean(EDGES[0]) - mean(EDGES[2])).abs();
        assert!(difference < 1e-6, "{kernel:?}: {difference:e}");
    }
}

#[test]
fn the_largest_difference_of_box_stair_and_line_follows_its_closed_form() {
    // 1 / (32 q^2) of the full contrast for whole and half q = r / a.
    for q in [1.0, 1.5, 2.0, 3.0] {
        let mut largest = 0.0_f64;
        for (i, j) in (0..200).flat_map(|i| (-400..400).map(move |j| (i, j))) {
            let (x, y) = (f64::from(i) / 200.0, f64::from(j) / 100.0);
            let difference = EDGES[0].coverage(Kernel::Box, q, x, y) - EDGES[2].coverage(Kernel::Box, q, x, y);
            largest = largest.max(difference.abs());
        }
        let expected = 1.0 / (32.0 * q * q);
        assert!((largest - expected).abs() < 0.02 * expected, "q = {q}: {largest} against {expected}");
    }
}

proptest! {
    #[test]
    fn a_point_reflection_swaps_light_and_shadow(
        kernel in proptest::sample::select(KERNELS.to_vec()), radius in 0.0..8.0_f64,
        x in -6.0..6.0_f64, y in -6.0..6.0_f64,
    ) {
        for edge in EDGES {
            let sum = edge.coverage(kernel, radius, x, y) + edge.coverage(kernel, radius, -x, -y);
            prop_assert!((sum - 1.0).abs() < 1e-12, "{:?}: {}", edge, sum);
        }
    }

    #[test]
    fn the_stair_repeats_along_its_line(
        kernel in proptest::sample::select(KERNELS.to_vec()), radius in 0.0..8.0_f64,
        x in -6.0..6.0_f64, y in -6.0..6.0_f64,
    ) {
        let here = Silhouette::Stair.coverage(kernel, radius, x, y);
        let there = Silhouette::Stair.coverage(kernel, radius, x + 1.0, y + 1.0);
        prop_assert!((here - there).abs() < 1e-12);
    }

    #[test]
    fn coverage_stays_between_light_and_shadow(
        kernel in proptest::sample::select(KERNELS.to_vec()), radius in 0.0..20.0_f64,
        x in -30.0..30.0_f64, y in -30.0..30.0_f64, slope in -3.0..3.0_f64,
    ) {
        for edge in [EDGES[0], EDGES[1], EDGES[3], Silhouette::Line { slope }] {
            let covered = edge.coverage(kernel, radius, x, y);
            prop_assert!((-1e-12..=1.0 + 1e-12).contains(&covered), "{:?}: {}", edge, covered);
        }
    }
}
