//! A chart of convergence, drawn.
//!
//! The plot's y is log10 of the radius in pixels, since the staircase works in log10 of the ratio: equal steps on the
//! chart are equal steps of the staircase. All charts of a round show the same range of ratios.

use eframe::egui;
use egui::{Color32, Pos2, RichText, Ui, Vec2b};
use egui_plot::{FilledArea, GridInput, GridMark, HLine, Line, LineStyle, MarkerShape, Plot, PlotPoints, Points};
use scumble_psychophysics::Answer;

use super::look::Look;
use super::{Chart, Point};
use crate::words::desk::DeskWords;

/// Points of the screen within which the pointer means a mark.
const REACH: f32 = 12.0;

/// What all charts of a round have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Axes {
    pub(super) trials: f64,
    pub(super) ratio_min: f64,
    pub(super) ratio_max: f64,
}

impl Axes {
    /// Axes that hold every mark and every present interval; a staircase without trials shows its prior's.
    pub(super) fn of(charts: &[Chart]) -> Self {
        let marks = charts.iter().flat_map(|chart| chart.points.iter().map(|point| point.ratio));
        let intervals = charts.iter().map(|chart| chart.estimate.ratio_interval90).flat_map(|(low, high)| [low, high]);
        let (low, high) = marks
            .chain(intervals)
            .fold((f64::INFINITY, 0.0_f64), |(low, high), ratio| (low.min(ratio), high.max(ratio)));
        let trials = charts.iter().map(|chart| chart.trials().max(chart.trials_min)).max().unwrap_or(1);
        // Air around the outermost marks, and below half of a decade a chart would magnify nothing but noise.
        let middle = (low * high).sqrt();
        let half = ((high / low).sqrt() * 1.15).max(1.8);
        Self { trials: f64::from(trials), ratio_min: middle / half, ratio_max: middle * half }
    }
}

/// The plot; gives the trial under the pointer.
pub(super) fn plot(
    ui: &mut Ui,
    chart: &Chart,
    index: usize,
    axes: Axes,
    height: f32,
    look: Look,
    words: &DeskWords,
) -> Option<Point> {
    let log_px = |ratio: f64| (ratio * chart.texel_px).log10();
    let (bottom, top) = (log_px(axes.ratio_min), log_px(axes.ratio_max));
    let label = |text: &'static str| RichText::new(text).small().color(look.palette.faint_ink);
    // Tick labels take the size of Body.
    let style = ui.style_mut();
    if let Some(small) = style.text_styles.get(&egui::TextStyle::Small).cloned() {
        style.text_styles.insert(egui::TextStyle::Body, small);
    }
    let axis = |axis: egui_plot::AxisHints<'static>| axis.tick_label_color(look.palette.faint_ink);
    // The spacers see to it that labels have room; nothing is to fade.
    let every = egui::Rangef::new(4.0, 5.0);
    let whole = |mark: GridMark, _: &std::ops::RangeInclusive<f64>| format!("{:.0}", mark.value);
    let px = |mark: GridMark, _: &std::ops::RangeInclusive<f64>| pixels(mark.value);
    let plot = Plot::new(("chart of convergence", index))
        .height(height)
        .allow_zoom(false)
        .allow_drag(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_double_click_reset(false)
        .allow_axis_zoom_drag(false)
        .sense(egui::Sense::hover())
        .show_crosshair(false)
        .label_formatter(|_| None)
        .auto_bounds(Vec2b::FALSE)
        .set_margin_fraction(egui::Vec2::ZERO)
        .grid_color(look.palette.line)
        .grid_fade(0.0)
        .x_grid_spacer(trial_marks)
        .y_grid_spacer(radius_marks)
        .custom_x_axes(vec![
            axis(egui_plot::AxisHints::new_x()).formatter(whole).label(label(words.x_axis)).label_spacing(every),
        ])
        .custom_y_axes(vec![
            axis(egui_plot::AxisHints::new_y()).formatter(px).label(label(words.y_axis)).label_spacing(every),
        ])
        .default_x_bounds(-0.4, axes.trials + 0.8)
        .default_y_bounds(bottom, top);
    let response = plot.show(ui, |plot| {
        // The bounds move with the session, and those of a plot are remembered.
        plot.set_plot_bounds_x(-0.4..=axes.trials + 0.8);
        plot.set_plot_bounds_y(bottom..=top);
        let (lows, highs): (Vec<f64>, Vec<f64>) =
            chart.ratio_intervals90.iter().map(|(low, high)| (log_px(*low), log_px(*high))).unzip();
        let xs: Vec<f64> = (0..lows.len()).map(|trials| trials as f64).collect();
        plot.add(FilledArea::new("", &xs, &lows, &highs).fill_color(look.palette.band));
        plot.hline(
            HLine::new("", log_px(chart.estimate.ratio))
                .color(look.palette.ink)
                .width(1.5 * look.scale)
                .style(LineStyle::Dashed { length: 6.0 * look.scale }),
        );
        let path: PlotPoints<'_> = chart.points.iter().map(position).collect();
        plot.line(Line::new("", path).color(look.palette.faint_ink.gamma_multiply(0.6)).width(look.scale));
        chart.points.iter().for_each(|point| plot.points(mark(point, look)));
    });
    let pointer = response.response.hover_pos()?;
    let at = |point: &Point| {
        let [x, y] = position(point);
        response.transform.position_from_point(&egui_plot::PlotPoint::new(x, y))
    };
    nearest(&chart.points, at, pointer, REACH * look.scale)
}

fn nearest(points: &[Point], at: impl Fn(&Point) -> Pos2, pointer: Pos2, reach: f32) -> Option<Point> {
    let distance = |point: &&Point| at(point).distance(pointer);
    let closest = points.iter().min_by(|one, other| distance(one).total_cmp(&distance(other)))?;
    (distance(&closest) <= reach).then_some(*closest)
}

fn position(point: &Point) -> [f64; 2] {
    [f64::from(point.number), point.radius_px.log10()]
}

/// What was answered is the shape, whether it was right is the fill; the colour only repeats it.
fn mark(point: &Point, look: Look) -> Points<'static> {
    let shape = match point.answer {
        Answer::Left => MarkerShape::Left,
        Answer::Right => MarkerShape::Right,
        Answer::No => MarkerShape::Circle,
        Answer::Yes => MarkerShape::Square,
    };
    let color: Color32 = if point.is_right { look.palette.right } else { look.palette.wrong };
    Points::new("", vec![position(point)]).shape(shape).filled(point.is_right).radius(6.5 * look.scale).color(color)
}

/// Whole trials, in steps of 1, 2, 5, 10, 20, so that at most a dozen stand on the axis.
fn trial_marks(input: GridInput) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    let step = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0].into_iter().find(|step| (high - low) / step <= 13.0);
    let step = step.unwrap_or(1000.0);
    let marks = (low / step).ceil() as i64..=(high / step).floor() as i64;
    marks.map(|mark| GridMark { value: mark as f64 * step, step_size: step }).collect()
}

/// Radii of 1, 2 and 5 times a power of ten, at their logarithms; 3 and 7 as well where there is room.
fn radius_marks(input: GridInput) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    let decades = low.floor() as i32..=high.ceil() as i32;
    let firsts: &[f64] = if high - low < 1.3 { &[1.0, 2.0, 3.0, 5.0, 7.0] } else { &[1.0, 2.0, 5.0] };
    let marks = decades.flat_map(|decade| firsts.iter().map(move |first| first.log10() + f64::from(decade)));
    // About the distance to the next mark.
    marks.filter(|mark| (low..=high).contains(mark)).map(|value| GridMark { value, step_size: 0.15 }).collect()
}

/// A radius in pixels from its logarithm, as short as it goes.
fn pixels(log_px: f64) -> String {
    let px = 10.0_f64.powf(log_px);
    if px < 0.95 { format!("{px:.1}") } else { format!("{px:.0}") }
}
