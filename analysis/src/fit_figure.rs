//! Thresholds against texel size, as in Kreuzer 2017, Fig. 4.6: one panel per contrast and kernel, with people,
//! their geometric means, our line with its interval and the published line through the origin.

use plotters::{coord::Shift, prelude::*};
use scumble_psychophysics::Round;
use scumble_stimuli::{Kernel, Pattern};

use crate::{
    Error,
    analysis::Analysis,
    estimate::MeanOverPeople,
    figure::{DrawError, GREY, GRID, INK, pattern_color, svg, text},
    series::{Series, kernel_name, pattern_name},
};

/// File name of the figure.
pub const FIT_FIGURE: &str = "fit.svg";

const PANEL_PX: (u32, u32) = (500, 460);
const FOOT_PX: u32 = 64;

type Area<'a, 'b> = DrawingArea<SVGBackend<'a>, Shift>;

/// Draws the figure as SVG.
///
/// # Errors
/// Only the plotting library's own.
pub fn fit_figure(analysis: &Analysis) -> Result<String, Error> {
    let mut panels: Vec<Vec<&Series>> = Vec::new();
    for series in &analysis.series {
        let alike =
            |panel: &&mut Vec<&Series>| panel.iter().all(|other| panel_of(&other.round) == panel_of(&series.round));
        match panels.iter_mut().find(alike) {
            Some(panel) => panel.push(series),
            None => panels.push(vec![series]),
        }
    }
    panels.sort_by(|a, b| b[0].round.contrast.total_cmp(&a[0].round.contrast));
    let size_px = (PANEL_PX.0 * panels.len() as u32, PANEL_PX.1 + FOOT_PX);
    svg(FIT_FIGURE, "Radius at threshold against texel size", size_px, |page| {
        let (area, foot) = page.split_vertically(PANEL_PX.1);
        let limits = limits(analysis);
        for (area, series) in area.split_evenly((1, panels.len())).iter().zip(&panels) {
            draw_panel(area, series, limits)?;
        }
        draw_key(&foot)
    })
}

/// What the series of one panel have in common.
fn panel_of(round: &Round) -> (f64, Kernel) {
    (round.contrast, round.kernel)
}

/// Right and upper end of the axes: shared by the panels, with room for the labels of the lines.
fn limits(analysis: &Analysis) -> (f64, f64) {
    let sizes = analysis.series.iter().flat_map(|series| &series.texels_px);
    let largest_px = sizes.copied().fold(0.0, f64::max);
    let radii = analysis.series.iter().flat_map(|s| &s.people).flat_map(|p| &p.points);
    let ratios = analysis.series.iter().map(|series| series.ratio_ci95()[1].min(64.0));
    let top_px = ratios.map(|ratio| ratio * largest_px * 1.08).fold(0.0, f64::max);
    let top_px = radii.map(|point| point.radius_px).fold(top_px, f64::max);
    (largest_px * 1.42, top_px * 1.05)
}

fn draw_panel(panel: &Area<'_, '_>, series: &[&Series], (right_px, top_px): (f64, f64)) -> Result<(), DrawError> {
    let (contrast, kernel) = panel_of(&series[0].round);
    let title = format!("{:.0} % contrast, {}", contrast * 100.0, kernel_name(kernel));
    let mut chart = ChartBuilder::on(panel)
        .margin(14)
        .caption(title, text(19, INK))
        .x_label_area_size(46)
        .y_label_area_size(58)
        .build_cartesian_2d(0.0..right_px, 0.0..top_px)?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(GREY)
        .x_desc("texel size, pixels of the screen")
        .y_desc("filter radius at threshold, pixels")
        .x_labels(8)
        .y_labels(7)
        .x_label_formatter(&|x| format!("{x:.0}"))
        .y_label_formatter(&|y| format!("{y:.0}"))
        .label_style(text(14, INK))
        .axis_desc_style(text(15, INK))
        .draw()?;

    for series in series {
        let color = pattern_color(series.round.pattern);
        let end_px = series.texels_px.last().copied().unwrap_or(right_px) * 1.08;
        let [low, high] = series.ratio_ci95();

        // Our line with its interval, and the published one.
        let band = vec![(0.0, 0.0), (end_px, low * end_px), (end_px, high.min(64.0) * end_px)];
        chart.draw_series([Polygon::new(band, color.mix(0.13))])?;
        let line = |slope: f64| [(0.0, 0.0), (end_px, slope * end_px)];
        chart.draw_series(LineSeries::new(line(series.ratio()), color.stroke_width(2)))?;
        if let Some(published) = series.origin_line {
            chart.draw_series(DashedLineSeries::new(line(published.slope), 6, 5, color.stroke_width(1)))?;
        }

        // People, side by side; then their geometric mean with its interval. The patterns stand left
        // and right of their texel size.
        let people = series.people.len() as f64;
        let spread_px = series.texels_px.first().copied().unwrap_or(0.0) * 0.09;
        let aside_px = match series.round.pattern {
            Pattern::Stair => -spread_px,
            Pattern::Step => spread_px,
            Pattern::DoubleStep => 3.0 * spread_px,
        };
        for (index, person) in series.people.iter().enumerate() {
            let shift = aside_px + spread_px * (2.0 * (index as f64 + 0.5) / people - 1.0);
            chart.draw_series(person.points.iter().map(|point| {
                let place = (point.texel_px + shift, point.radius_px);
                Circle::new(place, 2, color.mix(0.35).filled())
            }))?;
        }
        for &texel_px in &series.texels_px {
            let Some((mean, ends)) = radius_over_people(series, texel_px) else { continue };
            let x = texel_px + aside_px;
            let bar = [(x, ends[0]), (x, ends[1])];
            chart.draw_series([PathElement::new(bar, color.stroke_width(2))])?;
            chart.draw_series([Circle::new((x, mean), 5, WHITE.filled())])?;
            chart.draw_series([Circle::new((x, mean), 5, color.stroke_width(2))])?;
        }
        let label = format!("{} {:.2}", pattern_name(series.round.pattern), series.ratio());
        let published = series.origin_line.map_or(String::new(), |line| format!("line {:.2}", line.slope));
        let place = chart.backend_coord(&(end_px * 1.01, series.ratio() * end_px));
        let root = panel.strip_coord_spec();
        let base = root.get_base_pixel();
        let at = (place.0 - base.0, place.1 - base.1);
        root.draw(&Text::new(label, (at.0, at.1 - 9), text(15, color)))?;
        root.draw(&Text::new(published, (at.0, at.1 + 8), text(13, GREY)))?;
    }
    Ok(())
}

/// Geometric mean of the radii of one texel size and its 95 % interval, pixels.
fn radius_over_people(series: &Series, texel_px: f64) -> Option<(f64, [f64; 2])> {
    let logs: Vec<f64> = series
        .people
        .iter()
        .flat_map(|person| &person.points)
        .filter(|point| point.texel_px == texel_px)
        .map(|point| point.radius_px.log10())
        .collect();
    let mean = MeanOverPeople::of(&logs).ok()?;
    Some((10_f64.powf(mean.mean), mean.ci95.map(|limit| 10_f64.powf(limit))))
}

/// What the marks mean, below the panels.
fn draw_key(foot: &Area<'_, '_>) -> Result<(), DrawError> {
    let lines = [
        "solid: ratio of the median person with 95 % interval · dashed: line through the origin \
         of the mean radii (Kreuzer 2017)",
        "ring: geometric mean over people with 95 % interval · dots: people · above a line its \
         texels are hidden",
    ];
    for (line, y) in lines.iter().zip([6, 28]) {
        foot.draw(&Text::new(*line, (22, y), text(14, GREY)))?;
    }
    Ok(())
}
