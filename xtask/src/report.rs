//! `report.html`: what the demonstration did, for people who would rather look than read.
//!
//! Pictures stay files of their own beside the page, at full size; the page scales them to its width.

use crate::summary::{Row, Spread, Summary, TRUE_RATIO};
use anyhow::{Context, Result};
use std::fmt::Write;
use std::path::Path;

const STYLE: &str = include_str!("report.css");

/// Measured: 25 bilinear taps take 52 ms from 64 x 64 texels and 63 ms from 4096 x 4096 at 1280 x 720.
const SOFTWARE_RENDERER: &str = " This is a software renderer: a tap costs nearly the same at every map size, so \
    evaluation gains less than on a graphics card.";

/// The page, for a demonstration in `folder`.
pub fn html(folder: &Path, summary: &Summary) -> Result<String> {
    for part in ["stimuli.png", "study/report.html"] {
        let path = folder.join(part);
        path.metadata().with_context(|| format!("a part of the report is missing: {}", path.display()))?;
    }
    let mut page = format!(
        "<!doctype html><html lang=en><meta charset=utf-8><meta name=viewport content='width=device-width'>\
         <title>Scumble: a demonstration</title><style>{STYLE}</style><main>"
    );
    page += &study(summary);
    page += &table(summary)?;
    page += &pictures(summary);
    page += &footer(summary);
    page += "</main></html>\n";
    Ok(page)
}

fn study(summary: &Summary) -> String {
    let relation = &summary.relation;
    let ratio = &relation.ratio;
    let savings = || summary.pairs().into_iter().map(|(fixed, adaptive)| saving(fixed, adaptive));
    let (least, most) = (savings().fold(f64::INFINITY, f64::min), savings().fold(0.0, f64::max));
    let [low, high] = ratio.ci95;
    format!(
        "<h1>How small may a soft shadow's map be?</h1>\
         <p class=lead>{people} simulated people judged {trials} pairs of filtered edges. A filter hides a texel for them \
         when its radius is <b>{value:.2} texels</b> (95 % interval {low:.2} to {high:.2}; the people were made with a \
         median of {TRUE_RATIO}). Sized by that number, the shadow maps below have <b>{least:.0} to {most:.0} times fewer texels</b> \
         than 2048 x 2048.</p>\
         <h2>1. What they saw</h2>\
         <p>A straight silhouette, and the same silhouette as a shadow map stores it (a stair at 45 degrees, or one \
         step), both softened by the same filter. Which one was the line? Columns: stair and its line, step and its line; radii from \
         the top 0.5, 1, 2, 3.47 and 6 texels.</p>\
         <a href=stimuli.png><img class=sheet src=stimuli.png alt='Filtered lines, stairs and steps'></a>\
         <h2>2. What they answered</h2>\
         <p>A QUEST staircase chooses each next radius. <a href=study/report.html>The whole analysis</a> has the numbers.</p>\
         <div class=pair><figure><img src=study/staircases.svg alt='Staircases of one person'></figure>\
         <figure><img src=study/fit.svg alt='Threshold radius against texel size'></figure></div>",
        people = relation.people,
        trials = relation.trials,
        value = ratio.value,
    )
}

fn table(summary: &Summary) -> Result<String> {
    let bench = &summary.bench;
    let mut html = format!(
        "<h2>3. What it buys</h2>\
         <p>The same filter and softness, from a fixed map of 2048 x 2048 and from one sized by the fitted ratio. \
         Milliseconds are medians (quartiles) of {} frames that took turns, {} x {} pixels, on {}. The error is that of \
         the shadow fraction against the same filter over the exact hard shadow, by rays, with neither texels nor bias.</p>\
         <table><thead><tr><th>Scene<th>Filter<th>Map<th>Texels<th>Depth map, ms<th>Demand, ms<th>Evaluation, ms\
         <th>RMS error, penumbra<th>99 %<th>RMS, all lit sides<th>Violation</thead><tbody>",
        bench.options.frames, bench.options.width, bench.options.height, bench.machine.device
    );
    for row in &bench.rows {
        let Row { scene, triangles, method, times_ms: times, comparison, .. } = row;
        write!(
            html,
            "<tr class='{kind}'><td>{scene} <small>{triangles} triangles</small><td>{method}<td>{size} <small>{note}</small>\
             <td>{texels}<td>{depth}<td>{demand}<td>{evaluation}<td>{rms:.4}<td>{p99:.3}<td>{all:.4}<td>{seen}",
            kind = kind(row),
            note = if row.is_capped() { "at the cap" } else { kind(row) },
            size = row.size_texels(),
            texels = row.texels,
            depth = time(&times.depth),
            demand = time(&times.demand),
            evaluation = time(&times.evaluation),
            rms = comparison.penumbra.rms,
            p99 = comparison.penumbra.p99,
            all = comparison.lit_facing.rms,
            seen = comparison.violation_share.map_or("-".into(), |share| format!("{:.0} %", 100.0 * share)),
        )?;
    }
    html += "</tbody></table>";
    html += "<p><i>Violation</i>: share of the penumbra whose filter is narrower than the fitted ratio asks for. \
             <i>At the cap</i>: something on screen, mostly a contact, asks for more texels than allowed; soft shadows \
             narrower than the map can hide are widened instead, as Kreuzer does (2017, 5.1.3).</p>";
    Ok(html)
}

fn kind(row: &Row) -> &'static str {
    match (row.is_adaptive(), row.is_capped()) {
        (false, _) => "fixed",
        (true, false) => "adaptive",
        (true, true) => "adaptive capped",
    }
}

fn time(spread: &Option<Spread>) -> String {
    match spread {
        Some(s) => format!("{:.1} <small>({:.1} to {:.1})</small>", s.median, s.lower_quartile, s.upper_quartile),
        None => "-".into(),
    }
}

fn pictures(summary: &Summary) -> String {
    let mut html = String::from(
        "<h2>4. What it looks like</h2>\
         <p>Left the fixed map, right the adaptive one; below each, where it differs from the truth, on one scale that \
         ends at an error of 0.25. Click a picture for its full size.</p>",
    );
    for (fixed, adaptive) in summary.pairs() {
        html += &format!(
            "<h3>{} under {}: {:.0} times fewer texels</h3><div class=pair>{}{}{}{}</div>\
             <details><summary>The truth</summary>{}</details>",
            fixed.scene,
            fixed.method.to_uppercase(),
            saving(fixed, adaptive),
            figure(&fixed.pictures.picture, &format!("fixed, {}", fixed.size_texels())),
            figure(&adaptive.pictures.picture, &format!("adaptive, {}", adaptive.size_texels())),
            figure(&fixed.pictures.error_map, &errors(fixed)),
            figure(&adaptive.pictures.error_map, &errors(adaptive)),
            figure(&fixed.pictures.truth, "the same filter over the exact hard shadow"),
        );
    }
    html
}

fn figure(picture: &str, caption: &str) -> String {
    format!(
        "<figure><a href='bench/{picture}'><img loading=lazy src='bench/{picture}' alt='{caption}'></a>\
         <figcaption>{caption}</figcaption></figure>"
    )
}

fn errors(row: &Row) -> String {
    let error = &row.comparison.penumbra;
    format!("error in the penumbra: RMS {:.4}, 99 % below {:.3}, largest {:.2}", error.rms, error.p99, error.max)
}

/// How many times fewer texels.
fn saving(fixed: &Row, adaptive: &Row) -> f64 {
    fixed.texels as f64 / adaptive.texels as f64
}

fn footer(summary: &Summary) -> String {
    let machine = &summary.bench.machine;
    format!(
        "<footer>{}, {}. Numbers: <a href=relation.json>relation.json</a>, <a href=bench/bench.csv>bench.csv</a>, \
         <a href=bench/bench.json>bench.json</a>. The trade in figures: <a href=bench/report.html>bench/report.html</a>. Method: F. Kreuzer, <i>Using Perception-Based Filtering to Hide Shadow \
         Artifacts</i>, TU Wien 2017.{}</footer>",
        machine.device,
        machine.driver,
        if machine.device.contains("llvmpipe") { SOFTWARE_RENDERER } else { "" }
    )
}
