//! The iso-contours against a table that another program made, column by column.
//!
//! What the columns of `iso_contours.csv` hold was found from their numbers; see `tests/data/README.md`.

use std::f64::consts::{PI, SQRT_2};

use scumble_stimuli::{Error, IsoContour, Kernel, Silhouette};

/// Texels across the picture whose line the step of the table belongs to.
const WIDTH_TEXELS: f64 = 60.0;

struct Row {
    silhouette: Silhouette,
    kernel: Kernel,
    ratio: f64,
    level: f64,
    cells: csv::StringRecord,
}

impl Row {
    fn contour(&self) -> IsoContour {
        IsoContour::of(self.silhouette, self.kernel, self.ratio, self.level).expect("a row in range")
    }

    fn number(&self, column: usize) -> f64 {
        self.cells[column].parse().expect("a table as its README says")
    }

    fn is(&self, silhouette: Silhouette) -> bool {
        self.silhouette == silhouette
    }
}

fn table() -> Vec<Row> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/iso_contours.csv");
    let rows: Vec<Row> = csv::Reader::from_path(path)
        .expect("a table as its README says")
        .records()
        .map(|record| {
            let cells = record.expect("a table as its README says");
            let silhouette = match &cells[0] {
                "stair" => Silhouette::Stair,
                "step" => Silhouette::Step,
                other => panic!("pattern {other:?}"),
            };
            let kernel = Kernel::from_name(&cells[1]).expect("a table as its README says");
            let [ratio, level] = [2, 3].map(|column: usize| cells[column].parse().expect("a table as its README says"));
            Row { silhouette, kernel, ratio, level, cells }
        })
        .collect();
    assert_eq!(rows.len(), 312);
    rows
}

/// Asserts that the worst of a column's differences is within the tolerance, and says where it is.
fn within(column: &str, tolerance: f64, differences: impl Iterator<Item = (csv::StringRecord, f64)>) {
    let mut cells = 0;
    for (row, difference) in differences {
        assert!(difference.abs() <= tolerance, "{column} of {row:?}: off by {difference:e}");
        cells += 1;
    }
    assert!(cells > 0, "{column} has no cells");
}

/// Steps under a box: their contour has a corner, next to which the table was sampled.
fn has_corner(row: &Row) -> bool {
    row.is(Silhouette::Step) && row.kernel == Kernel::Box && row.ratio > 0.0
}

#[test]
fn every_deviation_of_the_table_is_met() {
    let smooth = table().into_iter().filter(|row| !has_corner(row));
    within(
        "max_dev_or_dev60",
        1e-5,
        smooth.map(|row| {
            let slope = if row.is(Silhouette::Stair) { 1.0 } else { 1.0 / WIDTH_TEXELS };
            (row.cells.clone(), row.contour().deviation(slope) - row.number(4))
        }),
    );
}

#[test]
fn the_deviation_of_a_step_under_a_box_is_that_of_its_corner() {
    // The contour reaches the height 1/2 at x = r with a corner; the table's nearest place is up to
    // 1.05e-4 lower.
    for row in table().iter().filter(|row| has_corner(row)) {
        let found = row.contour().deviation(1.0 / WIDTH_TEXELS);
        assert!((found - (0.5 - row.ratio / WIDTH_TEXELS)).abs() < 1e-6, "{:?}: {found}", row.cells);
        assert!((-1e-6..1.05e-4).contains(&(found - row.number(4))), "{:?}: {found}", row.cells);
    }
}

#[test]
fn every_tilt_of_the_table_is_met() {
    within(
        "tilt_deg",
        0.05,
        table().into_iter().map(|row| (row.cells.clone(), row.contour().tilt() * 180.0 / PI - row.number(7))),
    );
}

#[test]
fn half_the_swing_and_the_mean_offset_of_a_stair_are_the_tables() {
    const PLACES: u32 = 2880;
    for row in table().iter().filter(|row| row.is(Silhouette::Stair)) {
        let contour = row.contour();
        let offsets: Vec<f64> =
            (0..PLACES).map(|place| contour.offset(f64::from(place) * SQRT_2 / f64::from(PLACES))).collect();
        let [low, high] =
            [offsets.iter().copied().fold(f64::MAX, f64::min), offsets.iter().copied().fold(f64::MIN, f64::max)];
        let mean = offsets.iter().sum::<f64>() / f64::from(PLACES);
        assert!((0.5 * (high - low) - row.number(5)).abs() < 1e-5, "amp of {:?}: {}", row.cells, 0.5 * (high - low));
        assert!((mean - row.number(6)).abs() < 1e-5, "bias of {:?}: {mean}", row.cells);
    }
}

#[test]
fn a_step_rises_from_a_tenth_to_nine_tenths_over_the_tables_length() {
    for row in table().iter().filter(|row| row.is(Silhouette::Step) && row.ratio > 0.0) {
        let contour = row.contour();
        let place = |height: f64| {
            let (mut low, mut high) = (-WIDTH_TEXELS, WIDTH_TEXELS);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if contour.offset(middle) < height { low = middle } else { high = middle }
            }
            low
        };
        let length = place(0.4) - place(-0.4);
        // The table has four digits, and a box of radius 1/2 a plateau near a height asked for.
        assert!((length - row.number(8)).abs() < 3e-4, "len1090 of {:?}: {length}", row.cells);
    }
}

#[test]
fn the_line_nearest_to_the_middle_contour_of_a_step_is_as_far_as_the_table_says() {
    // Largest distance from the best of the lines with slopes of whole thousandths, 10 texels to
    // both sides, whatever its height. The cells of other levels follow another rule.
    const PLACES: i32 = 800;
    for row in table().iter().filter(|row| row.is(Silhouette::Step) && row.ratio > 0.0 && row.level == 0.5) {
        let contour = row.contour();
        let offsets: Vec<[f64; 2]> = (-PLACES..=PLACES)
            .map(|place| f64::from(place) * 10.0 / f64::from(PLACES))
            .map(|along| [along, contour.offset(along)])
            .collect();
        let distance = |slope: f64| {
            let heights = offsets.iter().map(|[along, offset]| offset - slope * along);
            let (low, high) = heights.fold((f64::MAX, f64::MIN), |(low, high), h| (low.min(h), high.max(h)));
            0.5 * (high - low)
        };
        let nearest = (0..=200).map(|k| distance(f64::from(k) / 1000.0)).fold(f64::MAX, f64::min);
        assert!((nearest - row.number(9)).abs() < 5e-4, "cheb10 of {:?}: {nearest}", row.cells);
    }
}

#[test]
#[should_panic(expected = "tilt_deg of")]
fn a_wrong_number_fails_the_comparison() {
    let row = table().swap_remove(0);
    within("tilt_deg", 0.05, std::iter::once((row.cells, 0.051)));
}

#[test]
fn a_line_is_straight() {
    for kernel in [Kernel::Disc, Kernel::Box, Kernel::GaussianHalf] {
        let contour = IsoContour::of(Silhouette::Line { slope: 0.3 }, kernel, 2.0, 0.2).unwrap();
        assert!(contour.deviation(0.3) < 1e-9 && contour.tilt() < 1e-6, "{kernel:?}");
    }
}

#[test]
fn a_double_step_shifts_a_stair_by_half_a_diagonal_to_each_side() {
    let contour = IsoContour::of(Silhouette::DoubleStep, Kernel::GaussianHalf, 4.0, 0.5).unwrap();
    let stair = IsoContour::of(Silhouette::Stair, Kernel::GaussianHalf, 4.0, 0.5).unwrap();
    let half_a_diagonal = 0.5 / SQRT_2;
    for along in [15.0 * SQRT_2, 20.3] {
        assert!((contour.offset(-along) - stair.offset(-along) - half_a_diagonal).abs() < 1e-6);
        assert!((contour.offset(along) - stair.offset(along) + half_a_diagonal).abs() < 1e-6);
    }
}

#[test]
fn numbers_outside_their_range_are_refused() {
    for (radius, level, field) in
        [(-1.0, 0.5, "radius_texels"), (f64::NAN, 0.5, "radius_texels"), (1.0, 0.0, "level"), (1.0, 1.0, "level")]
    {
        let error = IsoContour::of(Silhouette::Stair, Kernel::Disc, radius, level).unwrap_err();
        assert!(matches!(error, Error::Field { field: found, .. } if found == field), "{error}");
    }
}
