//! The columns of bench.csv: each with its name, its meaning and the way from a row to its cell, so that the header, the
//! cells and the documentation cannot part. Numbers that were not measured are empty cells.

use anyhow::{Context, Result};
use scumble_reference::{Differences, HIDDEN_TILT_DEG};
use serde::{Deserialize, Serialize};

use crate::bench::comparison::GRAIN_RADIUS_PX;
use crate::bench::edges::{LENGTH_MIN_PX, PENUMBRA_PX};
use crate::bench::record::OptionsRecord;
use crate::bench::row::Row;
use crate::statistics::Spread;

/// The parts of a frame, as the columns name them, in words.
const PARTS: [(&str, &str); 6] = [
    ("depth", "depth pass of the shadow map"),
    ("moments", "filtering the map, vsm only"),
    ("demand", "demand pass, which a fixed size has not"),
    ("evaluation", "filter at every pixel"),
    ("total", "depth, moments, demand and evaluation together"),
    ("drawing", "receivers and shading, which no size changes"),
];

/// The way from a row to a cell.
type Cell = Box<dyn Fn(&Row) -> String>;

/// A part of a column's name, what it means, and the way to its value.
type Statistic<Of, To> = (&'static str, &'static str, fn(&Of) -> &To);

/// The pixels of an error: a part of the columns' names, words, and the way to it.
type Mask = (&'static str, &'static str, fn(&Row) -> Option<&Differences>);

/// One column.
pub struct Column {
    /// In the header.
    pub name: String,
    /// Unit, range, and when it is empty.
    pub meaning: String,
    cell: Cell,
}

/// All columns in their order.
pub fn columns(options: &OptionsRecord) -> Vec<Column> {
    let [width, height] = [options.width, options.height];
    let column = |name: &str, meaning: &str, cell: Cell| Column { name: name.into(), meaning: meaning.into(), cell };
    let mut columns = vec![
        column("scene", "name of the scene", Box::new(|row| row.key.scene.clone())),
        column("triangles", "triangles of the scene", Box::new(|row| row.triangles.to_string())),
        column("method", "filter: `none`, `pcf`, `pcss` or `vsm`", Box::new(|row| row.key.method.clone())),
        column(
            "softness",
            "times the filter radius (pcf, vsm) or light size (pcss) of the run",
            Box::new(|row| row.key.softness.to_string()),
        ),
        column(
            "size",
            "`adaptive`, with `@` and the share of the penumbra that may show texels, or the fixed side or sides in texels; with \
             `+blocks` filters are skipped as by adaptive maps",
            Box::new(|row| row.key.size.clone()),
        ),
        column("width_px", "pixels across", Box::new(move |_| width.to_string())),
        column("height_px", "pixels down", Box::new(move |_| height.to_string())),
        column(
            "maps",
            "shadow maps of the light: one, or one for each slice of the view",
            Box::new(|row| row.maps.len().to_string()),
        ),
        column("map_width", "texels across of the first map's part in use", Box::new(|row| viewport(row, 2))),
        column("map_height", "texels down of the first map's part in use", Box::new(|row| viewport(row, 3))),
        column("texels", "texels in use, all maps together", Box::new(|row| row.texels.to_string())),
        column("bytes_used", "bytes of the texels in use", Box::new(|row| row.bytes_used.to_string())),
        column("bytes_allocated", "bytes of the whole textures", Box::new(|row| row.bytes_allocated.to_string())),
        column(
            "passes",
            "depth, moment, demand and evaluation passes of a frame",
            Box::new(|row| row.passes.to_string()),
        ),
        column(
            "allocations",
            "objects of the device that frames created after the size had come to rest",
            Box::new(|row| row.allocations.to_string()),
        ),
        column("taps_per_pixel", "map lookups of a pixel at most", Box::new(|row| row.taps_per_pixel.to_string())),
        column(
            "blocks_skipped",
            "blocks of 4 x 4 pixels that one lookup a pixel is enough for, where it says what they are; empty where every pixel \
             is filtered",
            Box::new(|row| row.blocks().map(|[skip, _]| skip.to_string()).unwrap_or_default()),
        ),
        column(
            "blocks_filtered",
            "blocks with a receiver that pay the filter at every pixel; likewise",
            Box::new(|row| row.blocks().map(|[_, pay]| pay.to_string()).unwrap_or_default()),
        ),
        column(
            "maps_skipped",
            "maps of the light that nothing on screen needs: neither drawn nor read",
            Box::new(|row| row.maps_skipped.to_string()),
        ),
        column(
            "maps_resting",
            "maps that are small because nothing on screen is in their shadow",
            Box::new(|row| row.maps.iter().filter(|map| map.resting).count().to_string()),
        ),
        column(
            "c_effective",
            "radius of the demand in texels of the map that meets it least; the ratio asked for where nothing was demanded",
            Box::new(|row| number(row.c_effective())),
        ),
        column(
            "capped",
            "whether the screen asks for more texels than a map has",
            Box::new(|row| row.is_capped().to_string()),
        ),
    ];
    for (part, words) in PARTS {
        let statistics: [Statistic<Spread, f64>; 3] = [
            ("median", "median", |spread| &spread.median),
            ("q25", "lower quartile", |spread| &spread.lower_quartile),
            ("q75", "upper quartile", |spread| &spread.upper_quartile),
        ];
        for (suffix, which, value) in statistics {
            columns.push(Column {
                name: format!("{part}_ms_{suffix}"),
                meaning: format!("milliseconds, {which} over the frames: {words}; empty without timestamps"),
                cell: Box::new(move |row| number(row.times_ms.get(part).map(value).copied())),
            });
        }
    }
    let masks: [Mask; 4] = [
        ("lit_facing", "all pixels that face the light", |row| Some(&row.comparison.lit_facing)),
        ("penumbra", "the penumbra, whose true visibility is neither 0 nor 1", |row| Some(&row.comparison.penumbra)),
        ("light_lit_facing", "all pixels that face the light, against the light itself", |row| {
            row.comparison.light.as_ref().map(|light| &light.lit_facing)
        }),
        ("light_penumbra", "the pixels that see the light in part, against the light itself", |row| {
            row.comparison.light.as_ref().map(|light| &light.penumbra)
        }),
    ];
    for (mask, words, of) in masks {
        columns.push(Column {
            name: format!("{mask}_pixels"),
            meaning: format!("number of {words}"),
            cell: Box::new(move |row| of(row).map(|error| error.pixels.to_string()).unwrap_or_default()),
        });
        let errors: [Statistic<Differences, f64>; 4] = [
            ("max", "largest error", |error| &error.max),
            ("p99", "99th percentile of the error", |error| &error.p99),
            ("rms", "root of the mean square error", |error| &error.rms),
            ("bias", "mean error (above 0: brighter than the truth)", |error| &error.bias),
        ];
        for (name, which, value) in errors {
            columns.push(Column {
                name: format!("{mask}_{name}"),
                meaning: format!("{which} over {words}, share of full light; empty without such pixels"),
                cell: Box::new(move |row| number(of(row).filter(|error| error.pixels > 0).map(|error| *value(error)))),
            });
        }
    }
    columns.extend([
        column(
            "light_standard_error",
            "root mean square of the light truth's own standard error over the pixels that see the light in part",
            Box::new(|row| number(row.comparison.light.map(|light| light.standard_error))),
        ),
        column(
            "penumbra_noise_rms",
            &format!("the part of `penumbra_rms` that differs between neighbours of {0} x {0} pixels", 2 * GRAIN_RADIUS_PX + 1),
            Box::new(|row| number(some_of(row, row.comparison.parts.noise_rms))),
        ),
        column(
            "penumbra_structure_rms",
            "the part of `penumbra_rms` that neighbours share; the squares of the two add up",
            Box::new(|row| number(some_of(row, row.comparison.parts.structure_rms))),
        ),
        column(
            "flip_mean",
            "mean FLIP of the visibility as a picture against the kernel truth, 0 to 1, over pixels that face the light",
            Box::new(|row| number(Some(row.comparison.flip_mean))),
        ),
        column(
            "edge_length_px",
            &format!(
                "pixels of true edges on even surfaces in penumbrae of {PENUMBRA_PX} pixels and more; this and the next four are \
                 empty below {LENGTH_MIN_PX}"
            ),
            Box::new(|row| number(row.comparison.edges.map(|edges| edges.length_px))),
        ),
        column(
            "edge_displacement_mean_px",
            "mean distance of these edges from the true ones, pixels",
            Box::new(|row| number(row.comparison.edges.map(|edges| edges.displacement_mean_px))),
        ),
        column(
            "edge_displacement_p95_px",
            "95th percentile of that distance, pixels",
            Box::new(|row| number(row.comparison.edges.map(|edges| edges.displacement_p95_px))),
        ),
        column(
            "edge_tilt_p50_deg",
            "median angle between these edges and the true ones, degrees",
            Box::new(|row| number(row.comparison.edges.map(|edges| edges.tilt_p50_deg))),
        ),
        column(
            "edge_tilt_visible_share",
            &format!("share of their length that is tilted by more than the {HIDDEN_TILT_DEG} degrees that observers miss"),
            Box::new(|row| number(row.comparison.edges.map(|edges| edges.tilt_visible_share))),
        ),
    ]);
    columns.push(column(
        "violation_share",
        "share of the penumbra, 0 to 1, whose filter is narrower than the ratio asks for; empty without a soft filter",
        Box::new(|row| number(row.comparison.violation_share)),
    ));
    columns
}

/// A number of the penumbra, where there is one.
fn some_of(row: &Row, value: f64) -> Option<f64> {
    (row.comparison.penumbra.pixels > 0).then_some(value)
}

fn number(value: Option<f64>) -> String {
    value.map(|value| format!("{value:.6}")).unwrap_or_default()
}

fn viewport(row: &Row, place: usize) -> String {
    row.maps.first().map(|map| map.viewport[place].to_string()).unwrap_or_default()
}

/// What a column means, for bench.json.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Description {
    name: String,
    meaning: String,
}

/// The meaning of every column.
pub fn descriptions(options: &OptionsRecord) -> Vec<Description> {
    columns(options).into_iter().map(|column| Description { name: column.name, meaning: column.meaning }).collect()
}

/// bench.csv.
pub fn table(options: &OptionsRecord, rows: &[Row]) -> Result<String> {
    let columns = columns(options);
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(columns.iter().map(|column| &column.name))?;
    for row in rows {
        writer.write_record(columns.iter().map(|column| (column.cell)(row)))?;
    }
    String::from_utf8(writer.into_inner()?).context("the table is not UTF-8")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::examples;

    #[test]
    fn the_documented_columns_are_those_of_the_header_in_their_order() {
        let documentation = include_str!("../../../../docs/benchmark.md");
        let lines = columns(&examples::options()).into_iter().map(|it| format!("| `{}` | {} |\n", it.name, it.meaning));
        let expected: String = lines.collect();
        assert!(documentation.contains(&expected), "docs/benchmark.md lacks the table\n{expected}");
        let documented = documentation.lines().filter(|line| line.starts_with("| `")).count();
        assert_eq!(documented, expected.lines().count(), "docs/benchmark.md describes other columns, too");
    }

    #[test]
    fn a_row_without_times_and_penumbra_has_empty_cells() {
        let mut row = examples::row("yard", "none", "512", 1.0, 0.1);
        row.times_ms.clear();
        row.comparison.penumbra.pixels = 0;
        row.comparison.violation_share = None;
        let table = table(&examples::options(), &[row]).unwrap();
        let mut reader = csv::Reader::from_reader(table.as_bytes());
        let header = reader.headers().unwrap().clone();
        let line = reader.records().next().unwrap().unwrap();
        let cell = |name: &str| line.get(header.iter().position(|found| found == name).unwrap()).unwrap().to_owned();
        assert_eq!((cell("total_ms_median"), cell("penumbra_rms"), cell("violation_share")), Default::default());
        assert_eq!((cell("size"), cell("texels"), cell("width_px")), ("512".into(), "262144".into(), "1280".into()));
    }
}
