//! One person's QUEST tracks: the ratio shown on each trial, the answers, and the thresholds that the
//! maximum-likelihood fit makes of them. One panel per pattern, contrast and
//! kernel; staircases of one condition share its colour.

use plotters::{coord::Shift, prelude::*};
use scumble_psychophysics::Protocol;

use crate::{
    Error,
    figure::{DrawError, GREY, GRID, INK, SIZES, svg, text},
    people::{Person, Track},
    series::{round_of, series_name},
    thresholds::ConditionThreshold,
};

/// File name of the figure.
pub const STAIRCASE_FIGURE: &str = "staircases.svg";

const PANEL_PX: (u32, u32) = (500, 310);
const HEAD_PX: u32 = 64;

/// Draws the tracks of `person` as SVG; `thresholds` are the person's, one per track.
///
/// # Errors
/// Only the plotting library's own.
pub fn staircase_figure(
    person: &Person,
    protocol: &Protocol,
    thresholds: &[ConditionThreshold],
) -> Result<String, Error> {
    let rounds = protocol.rounds();
    let columns = (protocol.conditions.contrasts.len() * protocol.conditions.kernels.len()).max(1);
    let rows = rounds.len().div_ceil(columns).max(1);
    let size_px = (PANEL_PX.0 * columns as u32, HEAD_PX + PANEL_PX.1 * rows as u32);
    let title = format!("QUEST tracks of {}", person.code);
    svg(STAIRCASE_FIGURE, &title, size_px, |page| {
        let (head, panels) = page.split_vertically(HEAD_PX);
        draw_key(&head, &title, protocol)?;
        for (panel, round) in panels.split_evenly((rows, columns)).iter().zip(rounds) {
            let tracks: Vec<(&Track, &ConditionThreshold)> =
                person.tracks.iter().zip(thresholds).filter(|(track, _)| round_of(&track.condition) == round).collect();
            draw_panel(panel, &series_name(round, protocol), &tracks, person)?;
        }
        Ok(())
    })
}

/// Smallest and largest ratio of a person's trials, widened to the next power of two, and the number
/// of trials of the longest track: the axes that all panels share.
fn limits(person: &Person) -> ((f64, f64), f64) {
    let exponents = person.tracks.iter().flat_map(Track::responses).map(|(x, _)| -x / std::f64::consts::LOG10_2);
    let (low, high) = exponents.fold((0.0_f64, 3.0_f64), |(low, high), e| (low.min(e), high.max(e)));
    let runs = person.tracks.iter().flat_map(|track| &track.runs);
    let longest = runs.map(|run| run.responses.len()).max().unwrap_or(0);
    ((low.floor().exp2(), high.ceil().exp2()), longest as f64)
}

fn draw_panel(
    panel: &DrawingArea<SVGBackend<'_>, Shift>,
    title: &str,
    tracks: &[(&Track, &ConditionThreshold)],
    person: &Person,
) -> Result<(), DrawError> {
    let ((low, high), longest) = limits(person);
    let right = longest + 2.0 + tracks.len() as f64;
    let mut chart = ChartBuilder::on(panel)
        .margin(12)
        .caption(title, text(17, INK))
        .x_label_area_size(40)
        .y_label_area_size(54)
        .build_cartesian_2d(0.0..right, (low..high).log_scale().base(2.0))?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(GREY)
        .x_desc("trial of the track")
        .y_desc("radius in texels")
        .y_labels(6)
        .x_label_formatter(&|x| format!("{x:.0}"))
        .y_label_formatter(&|y| format!("{y}"))
        .label_style(text(14, INK))
        .axis_desc_style(text(15, INK))
        .draw()?;

    for (index, (track, threshold)) in tracks.iter().enumerate() {
        let color = SIZES[index % SIZES.len()];
        for run in &track.runs {
            let shown = run.responses.iter().zip(1..);
            let places: Vec<((f64, f64), bool)> =
                shown.map(|(&(x, correct), trial)| ((f64::from(trial), 10_f64.powf(-x)), correct)).collect();
            let path = places.iter().map(|(place, _)| *place);
            chart.draw_series(LineSeries::new(path, color.mix(0.6).stroke_width(1)))?;
            for (place, correct) in places {
                let fill = if correct { color } else { WHITE };
                chart.draw_series([Circle::new(place, 4, fill.filled())])?;
                chart.draw_series([Circle::new(place, 4, color.stroke_width(2))])?;
            }
        }
        // The threshold with one standard error, right of the track.
        let Ok(threshold) = threshold.threshold else { continue };
        let x = longest + 1.5 + index as f64;
        let end = |sign: f64| 10_f64.powf(threshold.log10_ratio + sign * threshold.standard_error_log10);
        let bar = [(x, end(-1.0).clamp(low, high)), (x, end(1.0).clamp(low, high))];
        chart.draw_series([PathElement::new(bar, color.stroke_width(2))])?;
        let place = (x, threshold.ratio().clamp(low, high));
        chart.draw_series([TriangleMarker::new(place, 7, color.filled())])?;
    }
    Ok(())
}

/// Title, texel sizes and marks above the panels.
fn draw_key(head: &DrawingArea<SVGBackend<'_>, Shift>, title: &str, protocol: &Protocol) -> Result<(), DrawError> {
    head.draw(&Text::new(title.to_owned(), (22, 10), text(20, INK)))?;
    let mut x = 28;
    for (texel_px, color) in protocol.conditions.texels_px.iter().zip(SIZES) {
        head.draw(&Circle::new((x, 50), 5, color.filled()))?;
        head.draw(&Text::new(format!("texel {texel_px} px"), (x + 11, 43), text(14, INK)))?;
        x += 105;
    }
    let marks = "filled: correct · hollow: wrong · triangle: threshold with one standard error";
    head.draw(&Text::new(marks, (x + 10, 43), text(14, GREY)))?;
    Ok(())
}
