//! `report.html`: the trade for people who would rather look than read. One file without references to others.

mod demands;
mod figure;
mod numbers;
mod pareto;
mod paths;
mod pictures;
mod ratios;
mod summary;
mod walks;

use std::path::Path;

use anyhow::Result;
use scumble_reference::HIDDEN_TILT_DEG;

use crate::bench::edges::PENUMBRA_PX;
use crate::bench::pair::pairs;
use crate::bench::record::BenchRecord;
use crate::bench::report::figure::color;
use crate::bench::row::Row;
use crate::bench::trade::trades;

/// By this a run knows the report of a former one.
pub const REPORT_MARK: &str = "<meta name=\"generator\" content=\"scumble-viewer bench\">";

const STYLE: &str = include_str!("report/report.css");

/// The whole page; `out` is the results folder, where the pictures are.
pub fn report(record: &BenchRecord, out: &Path) -> Result<String> {
    let (rows, scenes) = (&record.rows, &record.options.scenes);
    let pairs = pairs(rows);
    let mut page = format!(
        "<!doctype html>\n<html lang=en><head><meta charset=utf-8>\n\
         <meta name=viewport content='width=device-width, initial-scale=1'>\n{REPORT_MARK}\n\
         <title>What accuracy each millisecond buys</title>\n<style>{STYLE}</style></head>\n<body><main>\n{}",
        head(record)
    );
    page += &summary::summary(rows, &pairs, &trades(rows), record.options.at_cap);
    let [filters, of_light] = [Row::error, Row::light_error].map(|error| filters_with(rows, error));
    // A filter has one colour on the page.
    let all = distinct(filters.iter().chain(&of_light).cloned());
    if !filters.is_empty() {
        page += &section(
            "Time against error",
            &format!(
                "{} Left and below is better. The error is that of the shadow fraction in the penumbra against the same filter \
                 over the exact hard shadow, by rays.",
                pareto::marks(rows)
            ),
            &(legend(&all, &filters) + &pareto::pareto(rows, scenes, &all, "RMS error, penumbra", Row::error)?),
        );
    }
    if !of_light.is_empty() {
        let axis = "RMS error against the light, penumbra";
        page += &section(
            "Against the light itself",
            &against_the_light(record),
            &(legend(&all, &of_light) + &pareto::pareto(rows, scenes, &all, axis, Row::light_error)?),
        );
    }
    if !pairs.is_empty() {
        let words = "Choose a label: the pictures lie over one another.";
        page += &section("What it looks like", words, &pictures::pictures(&pairs, out)?);
    }
    if record.demand.iter().any(|histogram| !histogram.bins.is_empty()) {
        page += &section(
            "What the screen asks for",
            "For every pixel of the penumbra the largest texel that its filter hides, or that a pixel covers, as a length where \
             the light measures it (for a lamp its near plane); lines are the texels of the maps. Pixels left of a line see \
             texels of that map, unless it is at its cap and pcss widens their filters.",
            &demands::demands(&record.demand, rows)?,
        );
    }
    if !record.walks.is_empty() {
        let figure = paths::paths(&record.walks, &record.options.paths, record.options.cap)?;
        page += &section(
            "On the way",
            "Size of the adaptive maps while camera or light moves.",
            &(legend(&record.options.paths, &record.options.paths) + &figure + &walks::table(&record.walks)),
        );
    }
    if !record.sweep.is_empty() {
        let figure = ratios::ratios(&record.sweep, scenes, &record.options.methods, &record.ratio)?;
        page += &section("Which ratio", &which_ratio(record), &(legend(scenes, scenes) + &figure));
    }
    page += &section("All numbers", "", &numbers::table(rows));
    page += &foot(record);
    Ok(page + "</main></body></html>\n")
}

/// The filters that have a time and an error, which a figure of both can show.
fn filters_with(rows: &[Row], error: fn(&Row) -> Option<f64>) -> Vec<String> {
    let shown = rows.iter().filter(|row| row.total_ms().is_some() && error(row).is_some());
    distinct(shown.map(|row| row.key.filter()))
}

fn head(record: &BenchRecord) -> String {
    let options = &record.options;
    let has_times = record.rows.iter().any(|row| row.total_ms().is_some());
    format!(
        "<h1>What accuracy each millisecond buys</h1><p class=lead>Shadow maps of fixed sizes against maps sized by what a viewer \
         can see: a filter hides texels when its radius is {:.2} of them ({}). {} x {} pixels, {} on {}.</p>",
        record.ratio.value,
        if record.ratio.source == "published" { "Kreuzer 2017".into() } else { escaped(&record.ratio.source) },
        options.width,
        options.height,
        if has_times { format!("medians of {} frames that took turns,", options.frames) } else { "no times:".into() },
        escaped(&record.machine.device),
    )
}

fn against_the_light(record: &BenchRecord) -> String {
    let is_left_out = |row: &&Row| row.comparison.light.is_none();
    let left_out = distinct(record.rows.iter().filter(is_left_out).map(|row| row.key.method.clone()));
    let words = match &left_out[..] {
        [] => String::new(),
        methods => format!(" Left out: {}, whose radius is that of no light.", methods.join(", ")),
    };
    format!(
        "The same times; the error is that against the share of the light's area that a point sees, by {} rays a pixel, so that \
         it holds what the filter does beside what the texels do.{words}",
        record.options.light_samples
    )
}

fn which_ratio(record: &BenchRecord) -> String {
    let is_capped = record.sweep.iter().any(|point| point.capped);
    format!(
        "Adaptive maps chosen by other ratios. A violation is a pixel of the penumbra whose filter is narrower than {} texels, the \
         ratio of this run, shown with its interval. An edge is tilted visibly above {HIDDEN_TILT_DEG} degrees, on even surfaces \
         and in penumbrae of {PENUMBRA_PX} pixels and more.{}",
        record.ratio.value,
        if is_capped { " Hollow points had fewer texels than their ratio asks for: they are at the cap." } else { "" }
    )
}

fn section(title: &str, words: &str, body: &str) -> String {
    let words = if words.is_empty() { String::new() } else { format!("<p>{words}</p>") };
    format!("<section><h2>{title}</h2>{words}{body}</section>\n")
}

/// The names that are `shown`, in the colours that the figures give them by their place in `names`.
fn legend(names: &[String], shown: &[String]) -> String {
    let entry = |(index, name): (usize, &String)| {
        let plotters::style::RGBColor(red, green, blue) = color(index);
        format!("<span style='--hue:rgb({red} {green} {blue})'>{}</span>", escaped(name))
    };
    format!(
        "<p class=legend>{}</p>",
        names.iter().enumerate().filter(|(_, name)| shown.contains(name)).map(entry).collect::<String>()
    )
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
    use crate::bench::comparison::LightComparison;
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
        assert!(page.contains("Dashed: the time of a hard shadow") && !page.contains("Squares"), "{page}");
    }

    #[test]
    fn what_was_not_measured_has_no_figure() {
        let mut rows = vec![examples::row("yard", "pcf", "2048", 9.0, 0.1)];
        rows[0].times_ms.clear();
        for rows in [rows, vec![]] {
            let page = report(&examples::record(rows), Path::new("nowhere")).unwrap();
            assert!(
                page.contains("no times: on a device") && !page.contains("<svg") && page.contains("All numbers"),
                "{page}"
            );
        }
    }

    #[test]
    fn filters_whose_radius_is_no_lights_are_named_where_they_are_left_out() {
        let mut rows = Vec::from(["none", "pcf", "pcss"].map(|method| examples::row("yard", method, "2048", 9.0, 0.1)));
        let penumbra = rows[0].comparison.penumbra;
        for row in [0, 2] {
            let light = LightComparison { lit_facing: penumbra, penumbra, standard_error: 0.01 };
            rows[row].comparison.light = Some(light);
        }
        let words = |rows: &[Row]| against_the_light(&examples::record(rows.to_vec()));
        assert!(words(&rows).contains("Left out: pcf, whose radius is that of no light."), "{}", words(&rows));
        rows.remove(1);
        assert!(!words(&rows).contains("Left out"));
    }
}
