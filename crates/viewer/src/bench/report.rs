//! `report.html`: the trade for people who would rather look than read. One file without references to others.

mod demands;
mod figure;
mod pareto;
mod paths;
mod pictures;
mod ratios;
mod summary;
mod walks;

use std::path::Path;

use anyhow::Result;

use crate::bench::record::BenchRecord;
use crate::bench::reference::pairs;
use crate::bench::report::figure::color;
use crate::bench::row::Row;
use crate::bench::trade::trades;
use crate::statistics::Spread;

/// By this a run knows the report of a former one.
pub const REPORT_MARK: &str = "<meta name=\"generator\" content=\"scumble-viewer bench\">";

const STYLE: &str = include_str!("report/report.css");

/// The whole page; `out` is the results folder, where the pictures are.
pub fn report(record: &BenchRecord, out: &Path) -> Result<String> {
    let pairs = pairs(&record.rows);
    let filters = distinct(record.rows.iter().filter(|row| row.key.method != "none").map(|row| row.key.filter()));
    let mut page = format!(
        "<!doctype html>\n<html lang=en><head><meta charset=utf-8>\n\
         <meta name=viewport content='width=device-width, initial-scale=1'>\n{REPORT_MARK}\n\
         <title>What accuracy each millisecond buys</title>\n<style>{STYLE}</style></head>\n<body><main>\n{}",
        head(record)
    );
    page += &summary::summary(&record.rows, &pairs, &trades(&record.rows));
    page += &section(
        "Time against error",
        "Lines join the fixed sizes of a filter; the diamond is the adaptive size with the quartiles of its time; dashed, the \
         time of a hard shadow, one lookup a pixel. Squares are fixed sizes that skip filters as the adaptive one does. Left and below is better. The error is that of the shadow \
         fraction in the penumbra against the same filter over the exact hard shadow, by rays.",
        &(legend(&filters)
            + &pareto::pareto(&record.rows, &record.options.scenes, &filters, "RMS error, penumbra", Row::error)?),
    );
    let of_light = distinct(record.rows.iter().filter(|row| row.light_error().is_some()).map(|row| row.key.filter()));
    if !of_light.is_empty() {
        let axis = "RMS error against the light, penumbra";
        let figure = pareto::pareto(&record.rows, &record.options.scenes, &of_light, axis, Row::light_error)?;
        page += &section(
            "Against the light itself",
            &format!(
                "The same times; the error is that against the share of the light's area that a point sees, by {} rays a pixel, \
                 so that it holds what the filter does beside what the texels do. Percentage-closer filtering with a fixed \
                 radius stands for no light and is left out.",
                record.options.light_samples
            ),
            &(legend(&of_light) + &figure),
        );
    }
    page += &section(
        "What it looks like",
        "Choose a label: the pictures lie over one another.",
        &pictures::pictures(&pairs, out)?,
    );
    page += &section(
        "What the screen asks for",
        "For every pixel of the penumbra the largest texel that its filter hides, or that a pixel covers, as a length where the \
         light measures it (for a lamp its near plane); lines are the texels \
         of the maps. Pixels left of a line see texels of that map, unless it is at its cap and pcss widens their filters.",
        &demands::demands(&record.demand, &pairs)?,
    );
    if !record.walks.is_empty() {
        let figure = paths::paths(&record.walks, &record.options.paths, record.options.cap)?;
        page += &section(
            "On the way",
            "Size of the adaptive maps while camera or light moves.",
            &(legend(&record.options.paths) + &figure + &walks::table(&record.walks)),
        );
    }
    if !record.sweep.is_empty() {
        let ratio = &record.ratio;
        let figure = ratios::ratios(&record.sweep, &record.options.scenes, &record.options.methods, ratio)?;
        page += &section(
            "Which ratio",
            &format!(
                "Adaptive maps chosen by other ratios. A violation is a pixel of the penumbra whose filter is narrower than {} \
                 texels, the ratio of this run, shown with its interval. An edge is tilted visibly above 8.2 degrees, on even \
                 surfaces and in penumbrae of 8 pixels and more. Hollow points are at the cap, where soft shadows narrower \
                 than the map can hide are widened.",
                ratio.value
            ),
            &(legend(&record.options.scenes) + &figure),
        );
    }
    page += &section("All numbers", "", &numbers(&record.rows));
    page += &foot(record);
    Ok(page + "</main></body></html>\n")
}

fn head(record: &BenchRecord) -> String {
    let options = &record.options;
    format!(
        "<h1>What accuracy each millisecond buys</h1><p class=lead>Shadow maps of fixed sizes against maps sized by what a viewer \
         can see: a filter hides texels when its radius is {:.2} of them ({}). {} pixels, medians of {} frames that took turns, \
         on {}.</p>",
        record.ratio.value,
        if record.ratio.source == "published" { "Kreuzer 2017".into() } else { escaped(&record.ratio.source) },
        format_args!("{} x {}", options.width, options.height),
        options.frames,
        escaped(&record.machine.device),
    )
}

fn section(title: &str, words: &str, body: &str) -> String {
    let words = if words.is_empty() { String::new() } else { format!("<p>{words}</p>") };
    format!("<section><h2>{title}</h2>{words}{body}</section>\n")
}

/// Names in the colours of the figures.
fn legend(names: &[String]) -> String {
    let entry = |(index, name): (usize, &String)| {
        let plotters::style::RGBColor(red, green, blue) = color(index);
        format!("<span style='--hue:rgb({red} {green} {blue})'>{}</span>", escaped(name))
    };
    format!("<p class=legend>{}</p>", names.iter().enumerate().map(entry).collect::<String>())
}

fn numbers(rows: &[Row]) -> String {
    let mut html = String::from(
        "<div class=wide><table><thead><tr><th>Scene<th>Filter<th>Size<th>Maps<th>Texels<th>Depth, ms<th>Moments, ms<th>Demand, ms\
         <th>Evaluation, ms<th>Total, ms<th>RMS, penumbra<th>99 %<th>Largest<th>Bias<th>RMS, lit sides<th>RMS, light<th>Tilted edges<th>Violation</thead><tbody>",
    );
    for row in rows {
        let time = |part: &str| match row.times_ms.get(part) {
            Some(Spread { median, lower_quartile, upper_quartile }) => {
                format!("{median:.1} <small>({lower_quartile:.1} to {upper_quartile:.1})</small>")
            }
            None => "-".into(),
        };
        let penumbra = &row.comparison.penumbra;
        let of_filter = match row.error() {
            Some(rms) => {
                format!("<td>{rms:.4}<td>{:.3}<td>{:.2}<td>{:+.4}", penumbra.p99, penumbra.max, penumbra.bias)
            }
            None => "<td>-".repeat(4),
        };
        let class = if row.key.is_adaptive() { "adaptive" } else { "" };
        html += &format!(
            "<tr class='{class}'><td>{}<td>{}<td>{}<td>{}<td>{}<td>{}<td>{}<td>{}<td>{}<td>{}{of_filter}<td>{:.4}\
             <td>{}<td>{}<td>{}",
            escaped(&row.key.scene),
            row.key.filter(),
            row.key.size,
            row.sizes_words(),
            row.texels,
            time("depth"),
            time("moments"),
            time("demand"),
            time("evaluation"),
            time("total"),
            row.comparison.lit_facing.rms,
            row.light_error().map_or("-".into(), |error| format!("{error:.4}")),
            percent(row.comparison.edges.map(|edges| edges.tilt_visible_share)),
            percent(row.comparison.violation_share),
        );
    }
    html + "</tbody></table></div>"
}

fn percent(share: Option<f64>) -> String {
    share.map_or("-".into(), |share| format!("{:.0} %", 100.0 * share))
}

fn foot(record: &BenchRecord) -> String {
    let machine = &record.machine;
    let software = " A software renderer: a tap costs nearly the same at every map size, and the ratios of its times are not \
                    those of a graphics card.";
    format!(
        "<footer>{}, {}, {}; scumble {}{}.{} The numbers are in bench.csv and bench.json, with the meaning of every column.</footer>",
        escaped(&machine.device),
        escaped(&machine.driver),
        machine.backend,
        machine.version,
        machine.git_commit.as_ref().map_or_else(String::new, |commit| format!(" ({commit})")),
        if machine.device.contains("llvmpipe") { software } else { "" },
    )
}

/// Names in the order in which they first appear.
fn distinct(names: impl Iterator<Item = String>) -> Vec<String> {
    names.fold(Vec::new(), |mut seen, name| {
        if !seen.contains(&name) {
            seen.push(name);
        }
        seen
    })
}

/// Text of files and devices, safe inside of the page.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('\'', "&#39;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::examples;

    #[test]
    fn the_page_needs_no_other_file_and_names_every_row() {
        let mut rows = vec![examples::row("yard", "none", "2048", 5.0, 0.2)];
        rows.extend(["512", "2048", "adaptive"].map(|size| examples::row("yard", "pcf", size, 9.0, 0.1)));
        let mut record = examples::record(rows);
        record.machine.device = "a <device>".into();
        let page = report(&record, Path::new("nowhere")).unwrap();
        assert!(page.contains(REPORT_MARK) && page.contains("a &lt;device&gt;"));
        assert!(!page.contains("src='http") && !page.contains("href="));
        assert_eq!(page.matches("<tr class='").count(), 4);
    }
}
