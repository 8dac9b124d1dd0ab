//! What the relation `r = c a` leaves: each person's radius at a texel size over the radius that the person's own ratio
//! gives, one panel a series. Proportional thresholds lie about 1 at every size.

use plotters::prelude::*;

use crate::{
    Error,
    analysis::Analysis,
    estimate::MeanOverPeople,
    figure::{DrawError, GREY, GRID, INK, pattern_color, svg, text},
    panels::{Area, draw_foot, page_px, split},
    series::Series,
};

/// File name of the figure.
pub const RESIDUAL_FIGURE: &str = "residuals.svg";

/// Ends of the axis: a factor either way.
const FACTORS: [f64; 2] = [0.4, 2.5];

/// Draws the figure as SVG.
///
/// # Errors
/// Only the plotting library's own.
pub fn residual_figure(analysis: &Analysis) -> Result<String, Error> {
    let count = analysis.series.len();
    svg(RESIDUAL_FIGURE, "Residuals of the relation", page_px(count), |page| {
        let (panels, foot) = split(page, count);
        for (panel, series) in panels.iter().zip(&analysis.series) {
            draw_panel(panel, series)?;
        }
        let lines = [
            "dots: people · ring: geometric mean over people with its 95 % interval",
            "at 1 a person's radius is the person's ratio times the texel size, as r = c a says; a slope speaks against it",
        ];
        draw_foot(&foot, &lines)
    })
}

/// log10 of each person's radius at a size over the person's ratio times the size.
pub(crate) fn residuals_log10(series: &Series, texel_px: f64) -> Vec<f64> {
    let of_person = |person: &crate::series::PersonInSeries| {
        let point = person.points.iter().find(|point| point.texel_px == texel_px)?;
        Some((point.radius_px / texel_px).log10() - person.log10_ratio)
    };
    series.people.iter().filter_map(of_person).collect()
}

fn draw_panel(panel: &Area<'_>, series: &Series) -> Result<(), DrawError> {
    let color = pattern_color(series.round.pattern);
    let (first, last) =
        (series.texels_px.first().copied().unwrap_or(1.0), series.texels_px.last().copied().unwrap_or(1.0));
    let [low, high] = FACTORS;
    let ends = (first / 1.5)..(last * 1.5);
    let mut chart = ChartBuilder::on(panel)
        .margin(12)
        .caption(&series.name, text(17, INK))
        .x_label_area_size(42)
        .y_label_area_size(56)
        .build_cartesian_2d(
            ends.clone().log_scale().with_key_points(series.texels_px.clone()),
            (low..high).log_scale().with_key_points(vec![0.4, 0.5, 0.7, 1.0, 1.4, 2.0, 2.5]),
        )?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(GREY)
        .x_desc("texel size, pixels of the screen")
        .y_desc("radius / (own ratio x size)")
        .x_label_formatter(&|x| format!("{x}"))
        .y_label_formatter(&|y| format!("{y}"))
        .label_style(text(14, INK))
        .axis_desc_style(text(15, INK))
        .draw()?;
    chart.draw_series(LineSeries::new([(ends.start, 1.0), (ends.end, 1.0)], GREY.stroke_width(1)))?;
    for &texel_px in &series.texels_px {
        let residuals = residuals_log10(series, texel_px);
        for (index, residual) in residuals.iter().enumerate() {
            // People side by side, over 12 % of the size either way.
            let aside = 1.0 + 0.24 * ((index as f64 + 0.5) / residuals.len() as f64 - 0.5);
            let place = (texel_px * aside, 10_f64.powf(*residual).clamp(low, high));
            chart.draw_series([Circle::new(place, 2, color.mix(0.35).filled())])?;
        }
        let Ok(mean) = MeanOverPeople::of(&residuals) else { continue };
        let bar = mean.ci95.map(|limit| (texel_px, 10_f64.powf(limit).clamp(low, high)));
        let place = (texel_px, 10_f64.powf(mean.mean).clamp(low, high));
        chart.draw_series([PathElement::new(bar, INK.stroke_width(2))])?;
        chart.draw_series([Circle::new(place, 5, WHITE.filled())])?;
        chart.draw_series([Circle::new(place, 5, INK.stroke_width(2))])?;
    }
    Ok(())
}
