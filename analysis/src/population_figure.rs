//! Which ratio hides the texels from which share of the viewers.

use plotters::prelude::*;
use statrs::distribution::{ContinuousCDF, Normal};

use crate::{
    Error,
    analysis::Analysis,
    figure::{DrawError, GREY, GRID, INK, SIZES, svg, text},
    panels::{Area, FOOT_PX, draw_foot},
    population::{DETECTIONS, PopulationPoint, VIEWERS},
};

/// File name of the figure.
pub const POPULATION_FIGURE: &str = "population.svg";

const SIZE_PX: (u32, u32) = (880, 420);

/// Draws the figure as SVG.
///
/// # Errors
/// Only the plotting library's own.
pub fn population_figure(analysis: &Analysis) -> Result<String, Error> {
    svg(POPULATION_FIGURE, "Ratio and share of viewers", (SIZE_PX.0, SIZE_PX.1 + FOOT_PX), |page| {
        let (panel, foot) = page.split_vertically(SIZE_PX.1);
        draw_panel(&panel, analysis)?;
        let lines = [
            "line: ratio that hides the texels from that share of viewers · band: 95 % interval, at each point by itself",
            "the axis of viewers is that of a normal distribution; thresholds are taken for log-normal",
        ];
        draw_foot(&foot, &lines)
    })
}

fn draw_panel(panel: &Area<'_>, analysis: &Analysis) -> Result<(), DrawError> {
    let curve = &analysis.population.curve;
    let z = |viewers: f64| Normal::standard().inverse_cdf(viewers);
    let right = z(VIEWERS[VIEWERS.len() - 1]) + 0.35;
    let top = curve.iter().map(|point| point.ci95[1].min(64.0)).fold(0.0, f64::max) * 1.05;
    let mut chart = ChartBuilder::on(panel)
        .margin(14)
        .caption(format!("{}: hidden from whom?", analysis.worst().name), text(19, INK))
        .x_label_area_size(46)
        .y_label_area_size(58)
        .build_cartesian_2d(-0.15..right, 0.0..top)?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(GREY)
        .x_desc("share of viewers")
        .y_desc("radius in texels")
        .y_labels(7)
        .x_labels(0)
        .y_label_formatter(&|y| format!("{y:.0}"))
        .label_style(text(14, INK))
        .axis_desc_style(text(15, INK))
        .draw()?;
    // The shares stand where the normal distribution has them.
    for viewers in VIEWERS {
        let (x, y) = chart.backend_coord(&(z(viewers), 0.0));
        let base = panel.get_base_pixel();
        let label = format!("{:.0} %", 100.0 * viewers);
        panel.draw(&Text::new(label, (x - base.0 - 14, y - base.1 + 7), text(14, INK)))?;
    }
    for (detection, color) in DETECTIONS.into_iter().zip([SIZES[4], SIZES[0]]) {
        let points: Vec<&PopulationPoint> = curve.iter().filter(|point| point.detection == detection).collect();
        let side = |end: usize| points.iter().map(move |point| (z(point.viewers), point.ci95[end].min(64.0)));
        let band: Vec<(f64, f64)> = side(0).chain(side(1).rev()).collect();
        chart.draw_series([Polygon::new(band, color.mix(0.15))])?;
        let line = points.iter().map(|point| (z(point.viewers), point.ratio));
        chart.draw_series(LineSeries::new(line.clone(), color.stroke_width(2)))?;
        for (place, point) in line.zip(&points) {
            chart.draw_series([Circle::new(place, 4, color.filled())])?;
            let at = chart.backend_coord(&place);
            let base = panel.get_base_pixel();
            let label = format!("{:.1}", point.ratio);
            panel.draw(&Text::new(label, (at.0 - base.0 - 10, at.1 - base.1 - 22), text(14, color)))?;
        }
        if let Some(first) = points.first() {
            let at = chart.backend_coord(&(z(first.viewers), first.ratio));
            let base = panel.get_base_pixel();
            let label = format!("seen on {:.0} % of the trials", 100.0 * detection);
            panel.draw(&Text::new(label, (at.0 - base.0 + 22, at.1 - base.1 + 12), text(15, color)))?;
        }
    }
    Ok(())
}
