//! The trade in one look: time against error, one panel a scene. The fixed sizes of a filter are joined, adaptive ones are
//! diamonds with their quartiles, and with their share where texels may show; squares are fixed sizes that skip filters as
//! adaptive ones do; a dashed line is the time of the hard shadow. Left and below is better.

use anyhow::Result;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::bench::report::figure::{
    Area, DrawError, GREY, GRID, INK, color, log_range, log_ticks, panels, short, text,
};
use crate::bench::row::Row;
use crate::size::Size;

/// Panels in a row.
const COLUMNS: usize = 3;

/// Draws the figure: a panel for each of `scenes`, a colour for each of `filters`; `error` is on the upright axis.
pub fn pareto(
    rows: &[Row],
    scenes: &[String],
    filters: &[String],
    axis: &str,
    error: impl Fn(&Row) -> Option<f64>,
) -> Result<String> {
    let of_scene = |scene: &str| -> Vec<&Row> {
        let is_shown = |row: &&Row| row.total_ms().is_some() && error(row).is_some();
        rows.iter().filter(|row| row.key.scene == scene).filter(is_shown).collect()
    };
    let drawn: Vec<&String> = scenes.iter().filter(|scene| !of_scene(scene).is_empty()).collect();
    panels("Time against error", drawn.len(), COLUMNS, |index, panel| {
        let hard = hard_ms(rows, drawn[index]);
        draw_panel(panel, drawn[index], &of_scene(drawn[index]), filters, axis, hard, &error)
    })
}

/// What the marks of the figure are, those that it has.
pub fn marks(rows: &[Row]) -> String {
    let has = |is: fn(&Row) -> bool| rows.iter().any(is);
    let marks = [
        (has(|row| row.key.is_fixed()), "Lines join the fixed sizes of a filter."),
        (has(|row| row.key.is_adaptive()), "Diamonds are adaptive sizes with the quartiles of their time."),
        (
            has(|row| matches!(row.key.size(), Some(Size::Blocks(_)))),
            "Squares are fixed sizes that skip filters as adaptive ones do.",
        ),
        (has(|row| row.key.method == "none"), "Dashed: the time of a hard shadow, one lookup a pixel."),
    ];
    marks.iter().filter(|(is_there, _)| *is_there).map(|(_, words)| *words).collect::<Vec<_>>().join(" ")
}

/// The time of the hard shadow from the size that adaptive ones are set beside.
fn hard_ms(rows: &[Row], scene: &str) -> Option<f64> {
    let hard: Vec<&Row> = rows.iter().filter(|row| row.key.scene == scene && row.key.method == "none").collect();
    let sizes: Vec<Size> = hard.iter().filter_map(|row| row.key.size()).collect();
    let beside = Size::beside(&sizes);
    hard.into_iter().find(|row| row.key.size() == beside).and_then(Row::total_ms)
}

fn draw_panel(
    panel: &Area<'_>,
    scene: &str,
    rows: &[&Row],
    filters: &[String],
    axis: &str,
    hard_ms: Option<f64>,
    error: &impl Fn(&Row) -> Option<f64>,
) -> Result<(), DrawError> {
    let place = |row: &Row| Some((row.total_ms()?, error(row)?)).filter(|&(x, y)| x > 0.0 && y > 0.0);
    let across = log_range(rows.iter().filter_map(|row| row.total_ms()).chain(hard_ms), 0.12);
    let upright = log_range(rows.iter().filter_map(|row| error(row)), 0.12);
    let mut chart = ChartBuilder::on(panel)
        .margin(12)
        .caption(scene, text(18, INK))
        .x_label_area_size(44)
        .y_label_area_size(64)
        .build_cartesian_2d(
            across.clone().log_scale().with_key_points(log_ticks(&across)),
            upright.clone().log_scale().with_key_points(log_ticks(&upright)),
        )?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(GREY)
        .x_desc("milliseconds of the whole shadow")
        .y_desc(axis)
        .x_label_formatter(&|x| short(*x))
        .y_label_formatter(&|y| short(*y))
        .label_style(text(13, INK))
        .axis_desc_style(text(14, INK))
        .draw()?;
    if let Some(ms) = hard_ms {
        chart.draw_series(DashedLineSeries::new([(ms, upright.start), (ms, upright.end)], 4, 4, GREY.into()))?;
        let label = text(12, GREY).pos(Pos::new(HPos::Left, VPos::Bottom));
        chart.draw_series([EmptyElement::at((ms, upright.start)) + Text::new("hard, one lookup", (4, -3), label)])?;
    }
    for (index, filter) in filters.iter().enumerate() {
        let hue = color(index);
        let of_filter: Vec<&&Row> = rows.iter().filter(|row| row.key.filter() == *filter).collect();
        let mut fixed: Vec<&&Row> = of_filter.iter().copied().filter(|row| row.key.is_fixed()).collect();
        fixed.sort_by_key(|row| row.texels);
        chart.draw_series(LineSeries::new(fixed.iter().filter_map(|row| place(row)), hue.stroke_width(2)))?;
        for row in fixed {
            let Some(at) = place(row) else { continue };
            chart.draw_series([EmptyElement::at(at)
                + Circle::new((0, 0), 3, hue.filled())
                + Text::new(row.key.size.clone(), (6, -14), text(12, GREY))])?;
        }
        for row in &of_filter {
            let (Some(at), Some(Size::Blocks(sides))) = (place(row), row.key.size()) else { continue };
            chart.draw_series([EmptyElement::at(at)
                + Rectangle::new([(-4, -4), (4, 4)], hue.stroke_width(2))
                + Text::new(Size::Fixed(sides).to_string(), (8, 2), text(12, GREY))])?;
        }
        for row in of_filter.into_iter().filter(|row| row.key.is_adaptive()) {
            let (Some(at), Some(spread)) = (place(row), row.times_ms.get("total")) else { continue };
            let whisker = [(spread.lower_quartile, at.1), (spread.upper_quartile, at.1)];
            chart.draw_series([PathElement::new(whisker, hue.stroke_width(2))])?;
            let diamond = [(-8, 0), (0, -8), (8, 0), (0, 8)];
            let share = row.key.share().map_or_else(String::new, |share| format!("@{share}"));
            chart.draw_series([EmptyElement::at(at)
                + Polygon::new(diamond, hue.filled())
                + Text::new(share, (5, -20), text(12, hue))])?;
        }
    }
    Ok(())
}
