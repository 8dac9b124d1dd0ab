//! The table of all rows.

use scumble_reference::Differences;

use crate::bench::cell::{number, percent};
use crate::bench::report::escaped;
use crate::bench::row::Row;
use crate::statistics::Spread;

/// The cells of the header.
const HEADER: [&str; 18] = [
    "Scene",
    "Filter",
    "Size",
    "Maps",
    "Texels",
    "Depth, ms",
    "Moments, ms",
    "Demand, ms",
    "Evaluation, ms",
    "Total, ms",
    "RMS, penumbra",
    "99 %",
    "Largest",
    "Bias",
    "RMS, lit sides",
    "RMS, light",
    "Tilted edges",
    "Violation",
];

/// The table; adaptive rows stand out.
pub fn table(rows: &[Row]) -> String {
    let header: String = HEADER.iter().map(|cell| format!("<th>{cell}")).collect();
    let lines: String = rows.iter().map(line).collect();
    format!("<div class=wide><table><thead><tr>{header}</thead><tbody>{lines}</tbody></table></div>")
}

fn line(row: &Row) -> String {
    let class = if row.key.is_adaptive() { "adaptive" } else { "" };
    let cells: String = cells(row).iter().map(|cell| format!("<td>{cell}")).collect();
    format!("<tr class='{class}'>{cells}")
}

fn cells(row: &Row) -> [String; HEADER.len()] {
    let time = |part: &str| match row.times_ms.get(part) {
        Some(Spread { median, lower_quartile, upper_quartile }) => {
            format!("{median:.1} <small>({lower_quartile:.1} to {upper_quartile:.1})</small>")
        }
        None => "-".into(),
    };
    let penumbra = |value: fn(&Differences) -> f64, digits| number(row.penumbra().map(value), digits);
    [
        escaped(&row.key.scene),
        row.key.filter(),
        row.key.size.clone(),
        row.sizes_words(),
        row.texels.to_string(),
        time("depth"),
        time("moments"),
        time("demand"),
        time("evaluation"),
        time("total"),
        penumbra(|error| error.rms, 4),
        penumbra(|error| error.p99, 3),
        penumbra(|error| error.max, 2),
        row.penumbra().map_or("-".into(), |error| format!("{:+.4}", error.bias)),
        format!("{:.4}", row.comparison.lit_facing.rms),
        number(row.light_error(), 4),
        percent(row.comparison.edges.map(|edges| edges.tilt_visible_share)),
        percent(row.comparison.violation_share),
    ]
}
