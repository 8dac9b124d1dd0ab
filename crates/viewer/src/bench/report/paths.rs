//! The size along the way: texels of the adaptive maps while camera or light moves, one panel a scene and filter. A hollow
//! point is a frame at the cap.

use anyhow::Result;
use plotters::prelude::*;

use crate::bench::report::figure::{Area, DrawError, GREY, GRID, INK, color, panels, text};
use crate::bench::walk::Walk;

/// Panels in a row.
const COLUMNS: usize = 3;
/// Of the frames at the cap one in so many has its point, so that the line stays visible.
const CAPPED_STRIDE: usize = 6;

/// Draws the figure: a colour for each of `paths`; `cap` is the most texels a side of each map.
pub fn paths(walks: &[Walk], paths: &[String], cap: u32) -> Result<String> {
    let mut shown: Vec<(String, String)> = Vec::new();
    for walk in walks {
        let panel = (walk.key.scene.clone(), walk.key.filter());
        if !shown.contains(&panel) {
            shown.push(panel);
        }
    }
    panels("Size along the way", shown.len(), COLUMNS, |index, panel| {
        let (scene, filter) = &shown[index];
        let of_panel: Vec<&Walk> =
            walks.iter().filter(|walk| walk.key.scene == *scene && walk.key.filter() == *filter).collect();
        draw_panel(panel, &format!("{scene} {filter}"), &of_panel, paths, cap)
    })
}

/// Side of a square of as many texels.
fn side(texels: u64) -> f64 {
    (texels as f64).sqrt()
}

fn draw_panel(panel: &Area<'_>, title: &str, walks: &[&Walk], paths: &[String], cap: u32) -> Result<(), DrawError> {
    let most = walks.iter().flat_map(|walk| &walk.frames).map(|frame| side(frame.texels)).fold(1.0, f64::max);
    let count = walks.iter().map(|walk| walk.frames.len()).max().unwrap_or(1);
    let mut chart = ChartBuilder::on(panel)
        .margin(12)
        .caption(title, text(18, INK))
        .x_label_area_size(44)
        .y_label_area_size(64)
        .build_cartesian_2d(0.0..count as f64, 0.0..1.15 * most)?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(GREY)
        .x_desc("frame")
        .y_desc("texels a side, as a square")
        .x_label_formatter(&|x| format!("{x:.0}"))
        .y_label_formatter(&|y| format!("{y:.0}"))
        .label_style(text(13, INK))
        .axis_desc_style(text(14, INK))
        .draw()?;
    let maps = walks.iter().flat_map(|walk| &walk.frames).map(|frame| frame.texels_world.len()).max().unwrap_or(1);
    let cap = side(maps as u64 * u64::from(cap).pow(2));
    if cap < 1.15 * most {
        let line = [(0.0, cap), (count as f64, cap)];
        chart.draw_series(DashedLineSeries::new(line, 4, 4, GREY.into()))?;
        chart.draw_series([EmptyElement::at(line[0]) + Text::new("cap", (4, -15), text(12, GREY))])?;
    }
    for walk in walks {
        let hue = color(paths.iter().position(|path| *path == walk.path).unwrap_or(0));
        let places =
            || walk.frames.iter().enumerate().map(|(at, frame)| ((at as f64, side(frame.texels)), frame.capped));
        chart.draw_series(LineSeries::new(places().map(|(at, _)| at), hue.stroke_width(2)))?;
        let capped = places().filter(|(_, capped)| *capped).step_by(CAPPED_STRIDE);
        chart.draw_series(capped.map(|(at, _)| Circle::new(at, 3, hue.stroke_width(1))))?;
    }
    Ok(())
}
