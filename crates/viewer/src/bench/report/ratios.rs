//! Which ratio c? Error, violations and texels of adaptive maps over the texels per filter radius that they are chosen by.
//! The band is the interval of the run's ratio, the line in it the ratio. A hollow point had fewer texels than its ratio asks
//! for, because of the cap.

use std::ops::Range;

use anyhow::Result;
use plotters::coord::ranged1d::{AsRangedCoord, Ranged, ValueFormatter};
use plotters::prelude::*;

use crate::bench::report::figure::{
    Area, DrawError, GREY, GRID, INK, color, log_range, log_ticks, panels, short, text,
};
use crate::bench::sweep::SweepPoint;
use crate::record::RatioRecord;

/// Behind the interval of the ratio.
const BAND: RGBColor = RGBColor(244, 238, 226);
/// Labels of the ratio's axis, the published one among them.
const RATIO_TICKS: [f64; 6] = [0.5, 1.0, 2.0, 3.47, 5.0, 10.0];

/// What a panel shows of a point.
struct Quantity {
    title: &'static str,
    axis: &'static str,
    is_share: bool,
    of: fn(&SweepPoint) -> Option<f64>,
}

/// Panels in a row.
const COLUMNS: usize = 3;

const QUANTITIES: [Quantity; 5] = [
    Quantity { title: "error", axis: "RMS error, penumbra", is_share: false, of: |point| Some(point.rms) },
    Quantity {
        title: "error against the light",
        axis: "RMS error, penumbra",
        is_share: false,
        of: |point| point.light_rms,
    },
    Quantity {
        title: "tilted edges",
        axis: "share that observers see, %",
        is_share: true,
        of: |point| point.tilt_visible_share.map(|share| 100.0 * share),
    },
    Quantity {
        title: "violations",
        axis: "share of the penumbra, %",
        is_share: true,
        of: |point| point.violation_share.map(|share| 100.0 * share),
    },
    Quantity { title: "texels", axis: "texels", is_share: false, of: |point| Some(point.texels as f64) },
];

/// Draws a figure for each of `methods`, a colour for each of `scenes`.
pub fn ratios(sweep: &[SweepPoint], scenes: &[String], methods: &[String], ratio: &RatioRecord) -> Result<String> {
    let mut figures = String::new();
    for method in methods {
        let of_method: Vec<&SweepPoint> = sweep.iter().filter(|point| point.method == *method).collect();
        let shown: Vec<&Quantity> =
            QUANTITIES.iter().filter(|it| of_method.iter().any(|point| (it.of)(point).is_some())).collect();
        if !shown.is_empty() {
            figures += &panels("Which ratio", shown.len(), COLUMNS, |index, panel| {
                draw_panel(panel, method, shown[index], &of_method, scenes, ratio)
            })?;
        }
    }
    Ok(figures)
}

/// Shares stand on a linear axis, the others on a logarithmic one.
fn draw_panel(
    panel: &Area<'_>,
    method: &str,
    quantity: &Quantity,
    points: &[&SweepPoint],
    scenes: &[String],
    ratio: &RatioRecord,
) -> Result<(), DrawError> {
    let title = format!("{method}: {}", quantity.title);
    if quantity.is_share {
        let range = -2.0..102.0;
        return draw_chart(panel, &title, quantity, points, scenes, ratio, range.clone(), range);
    }
    let range = log_range(points.iter().filter_map(|point| (quantity.of)(point)), 0.1);
    let axis = range.clone().log_scale().with_key_points(log_ticks(&range));
    draw_chart(panel, &title, quantity, points, scenes, ratio, axis, range)
}

#[allow(clippy::too_many_arguments, reason = "one call each for the two kinds of axis")]
fn draw_chart<Axis: AsRangedCoord<Value = f64>>(
    panel: &Area<'_>,
    title: &str,
    quantity: &Quantity,
    points: &[&SweepPoint],
    scenes: &[String],
    ratio: &RatioRecord,
    axis: Axis,
    range: Range<f64>,
) -> Result<(), DrawError>
where
    Axis::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    let across = log_range(points.iter().map(|point| point.ratio), 0.02);
    let mut chart = ChartBuilder::on(panel)
        .margin(12)
        .caption(title, text(18, INK))
        .x_label_area_size(44)
        .y_label_area_size(64)
        .build_cartesian_2d(across.clone().log_scale().with_key_points(RATIO_TICKS.to_vec()), axis)?;
    let [low, high] = ratio.ci95.map(|end| end.clamp(across.start, across.end));
    chart.draw_series([Rectangle::new([(low, range.start), (high, range.end)], BAND.filled())])?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(GREY)
        .x_desc("texels per filter radius, c")
        .y_desc(quantity.axis)
        .x_label_formatter(&|x| short(*x))
        .y_label_formatter(&|y| short(*y))
        .label_style(text(13, INK))
        .axis_desc_style(text(14, INK))
        .draw()?;
    chart.draw_series([PathElement::new(
        [(ratio.value, range.start), (ratio.value, range.end)],
        GREY.stroke_width(1),
    )])?;
    for (index, scene) in scenes.iter().enumerate() {
        let hue = color(index);
        let of_scene = points.iter().filter(|point| point.scene == *scene);
        let places: Vec<_> =
            of_scene.filter_map(|point| Some(((point.ratio, (quantity.of)(point)?), point.capped))).collect();
        chart.draw_series(LineSeries::new(places.iter().map(|(at, _)| *at), hue.stroke_width(2)))?;
        for (at, capped) in places {
            let inside = if capped { WHITE } else { hue };
            chart.draw_series([Circle::new(at, 3, inside.filled())])?;
            chart.draw_series([Circle::new(at, 3, hue.stroke_width(1))])?;
        }
    }
    Ok(())
}
