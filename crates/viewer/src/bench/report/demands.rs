//! What the screen asks for: the largest texel that each pixel of the penumbra allows, one panel a scene and filter, with
//! the texels that the maps have.

use anyhow::Result;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::bench::demand::DemandHistogram;
use crate::bench::pair::fixed_beside;
use crate::bench::report::figure::{
    Area, DrawError, GREY, GRID, INK, color, log_range, log_ticks, panels, short, text,
};
use crate::bench::row::Row;

/// Panels in a row.
const COLUMNS: usize = 3;
/// Millimetres of a metre.
const MILLI: f64 = 1000.0;

/// Draws the figure; `rows` tell which texels the maps have: those of adaptive sizes, and of the fixed one beside them.
pub fn demands(histograms: &[DemandHistogram], rows: &[Row]) -> Result<String> {
    let histograms: Vec<&DemandHistogram> = histograms.iter().filter(|histogram| !histogram.bins.is_empty()).collect();
    panels("What the screen asks for", histograms.len(), COLUMNS, |index, panel| {
        let histogram = histograms[index];
        let adaptive = rows.iter().filter(|row| row.key.is_adaptive() && row.key.is_beside(&histogram.key));
        let fixed = fixed_beside(rows, &histogram.key).map(|row| (row, GREY));
        let drawn: Vec<_> = fixed.into_iter().chain(adaptive.map(|row| (row, color(1)))).collect();
        draw_panel(panel, histogram, &drawn)
    })
}

fn draw_panel(panel: &Area<'_>, histogram: &DemandHistogram, rows: &[(&Row, RGBColor)]) -> Result<(), DrawError> {
    let total: u64 = histogram.bins.iter().map(|(_, count)| count).sum();
    let edges = |bin: i32| [bin, bin + 1].map(|bin| MILLI * DemandHistogram::texel_world(bin));
    let share = |count: u64| 100.0 * count as f64 / total.max(1) as f64;
    let texels: Vec<(f64, &Row, RGBColor)> = rows
        .iter()
        .flat_map(|&(row, hue)| row.maps.iter().map(move |map| (MILLI * map.texel_world(), row, hue)))
        .collect();
    let ends = histogram.bins.iter().flat_map(|&(bin, _)| edges(bin)).chain(texels.iter().map(|(texel, ..)| *texel));
    let across = log_range(ends, 0.06);
    let most = histogram.bins.iter().map(|&(_, count)| share(count)).fold(1.0, f64::max);
    let mut chart = ChartBuilder::on(panel)
        .margin(12)
        .caption(format!("{} {}", histogram.key.scene, histogram.key.filter()), text(18, INK))
        .x_label_area_size(44)
        .y_label_area_size(56)
        .build_cartesian_2d(across.clone().log_scale().with_key_points(log_ticks(&across)), 0.0..1.25 * most)?;
    // The room above is for the labels of the lines; there is no share in it.
    let percent = |share: &f64| if *share <= 100.0 { short(*share) } else { String::new() };
    chart
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(GREY)
        .x_desc("largest texel that hides, mm")
        .y_desc("% of the penumbra")
        .x_label_formatter(&|x| short(*x))
        .y_label_formatter(&percent)
        .label_style(text(13, INK))
        .axis_desc_style(text(14, INK))
        .draw()?;
    let bars = histogram.bins.iter().map(|&(bin, count)| {
        let [from, to] = edges(bin);
        Rectangle::new([(from, 0.0), (to, share(count))], color(0).mix(0.55).filled())
    });
    chart.draw_series(bars)?;
    for (index, (texel, row, hue)) in texels.into_iter().enumerate() {
        let top = (1.22 - 0.09 * (index % 2) as f64) * most;
        chart.draw_series([PathElement::new([(texel, 0.0), (texel, top)], hue.stroke_width(2))])?;
        // On the side that has room.
        let is_right = (texel / across.start).ln() > 0.7 * (across.end / across.start).ln();
        let (side, aside) = if is_right { (HPos::Right, -4) } else { (HPos::Left, 4) };
        let label = Text::new(row.key.size.clone(), (aside, -2), text(12, hue).pos(Pos::new(side, VPos::Top)));
        chart.draw_series([EmptyElement::at((texel, top)) + label])?;
    }
    Ok(())
}
