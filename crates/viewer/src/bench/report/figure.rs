//! What the figures share: colours, axes, and the way from a drawing to an SVG text. Colours are those of Okabe and Ito
//! (2008), which people with any common colour blindness tell apart; shape or label tells the same.

use anyhow::{Result, anyhow};
use plotters::coord::Shift;
use plotters::prelude::*;

/// Axis text.
pub const INK: RGBColor = RGBColor(40, 40, 40);
/// Grid lines.
pub const GRID: RGBColor = RGBColor(232, 232, 232);
/// Secondary text and lines.
pub const GREY: RGBColor = RGBColor(120, 120, 120);
/// Blue, vermilion, green, orange, purple, sky, black: filters, scenes or paths in their order.
pub const SERIES: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(230, 159, 0),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(40, 40, 40),
];

/// A panel of a figure.
pub const PANEL_PX: (u32, u32) = (470, 350);

/// A part of a page.
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// Error of a drawing call.
pub type DrawError = Box<dyn std::error::Error>;

/// The colour of a series.
pub fn color(index: usize) -> RGBColor {
    SERIES[index % SERIES.len()]
}

/// Text of a size in pixels and a colour.
pub fn text(size_px: u32, color: RGBColor) -> TextStyle<'static> {
    ("sans-serif", size_px).into_font().color(&color)
}

/// `count` panels, `columns` in a row, each drawn by its index, as SVG.
pub fn panels(
    title: &str,
    count: usize,
    columns: usize,
    draw: impl Fn(usize, &Area<'_>) -> Result<(), DrawError>,
) -> Result<String> {
    let columns = columns.min(count).max(1);
    let rows = count.div_ceil(columns).max(1);
    let size = (PANEL_PX.0 * columns as u32, PANEL_PX.1 * rows as u32);
    let refuse = |error: DrawError| anyhow!("the figure {title} cannot be drawn: {error}");
    let mut page = String::new();
    {
        let area = SVGBackend::with_string(&mut page, size).into_drawing_area();
        area.fill(&WHITE).map_err(|error| refuse(error.into()))?;
        for (index, panel) in area.split_evenly((rows, columns)).iter().take(count).enumerate() {
            draw(index, panel).map_err(refuse)?;
        }
        area.present().map_err(|error| refuse(error.into()))?;
    }
    let head = page.find('>').map_or(0, |end| end + 1);
    page.insert_str(head, &format!("<title>{title}</title>"));
    // A size that follows the page, up to the one in pixels.
    let fixed = format!("width=\"{}\" height=\"{}\"", size.0, size.1);
    Ok(page.replacen(&fixed, &format!("class=\"figure\" style=\"max-width:{}px\"", size.0), 1))
}

/// Ends of a logarithmic axis around positive values, with `share` of their span as room, at least a factor of 1.5 apart.
pub fn log_range(values: impl Iterator<Item = f64>, share: f64) -> std::ops::Range<f64> {
    let (least, most) = values
        .filter(|value| *value > 0.0 && value.is_finite())
        .fold((f64::MAX, 0.0_f64), |(a, b), value| (a.min(value), b.max(value)));
    if most == 0.0 {
        return 0.1..1.0;
    }
    let span = (most / least).max(1.5);
    let middle = (most * least).sqrt();
    let reach = span.powf(0.5 + share);
    middle / reach..middle * reach
}

/// Round numbers on a logarithmic axis: 1, 2, 5 and their decades; on an axis that is too short for three of them, more.
pub fn log_ticks(range: &std::ops::Range<f64>) -> Vec<f64> {
    let ticks = |digits: &[f64]| -> Vec<f64> {
        let decades = range.start.log10().floor() as i32..=range.end.log10().ceil() as i32;
        let all = decades.flat_map(|decade| digits.iter().map(move |digit| digit * 10_f64.powi(decade)));
        all.filter(|tick| range.contains(tick)).collect()
    };
    let few = ticks(&[1.0, 2.0, 5.0]);
    if few.len() < 3 { ticks(&[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0]) } else { few }
}

/// A number without needless digits: `0.05`, `2`, `1500`.
pub fn short(value: f64) -> String {
    let digits = if value == 0.0 { 0 } else { (1 - value.abs().log10().floor() as i32).max(0) };
    let text = format!("{value:.*}", digits as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_has_room_around_its_values_and_never_none() {
        let range = log_range([1.0, 100.0].into_iter(), 0.1);
        assert!(range.start < 1.0 && range.end > 100.0 && range.end < 200.0);
        let one = log_range([5.0].into_iter(), 0.0);
        assert!((one.end / one.start - 1.5).abs() < 1e-12);
        assert_eq!(log_range([f64::NAN, 0.0].into_iter(), 0.1), 0.1..1.0);
    }

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(log_ticks(&(0.9..6.0)), [1.0, 2.0, 5.0]);
        assert_eq!(log_ticks(&(1.2..4.5)), [1.5, 2.0, 3.0, 4.0]);
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!([0.05, 2.0, 1500.0, 0.0125, 0.0].map(short), ["0.05", "2", "1500", "0.013", "0"]);
    }
}
