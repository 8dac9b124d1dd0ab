//! What the figures share: colours, sizes of text, and the way from a drawing to an SVG text.
//!
//! Colours are those of Okabe and Ito (2008), which people with any common colour blindness tell
//! apart; every distinction is also made by shape or label.

use plotters::prelude::*;
use scumble_stimuli::Pattern;

use crate::Error;

/// A comment in every figure, by which a re-run knows its own files.
pub(crate) const FIGURE_MARK: &str = "<!-- figure of scumble-analysis -->";

/// Axis lines and text.
pub(crate) const INK: RGBColor = RGBColor(40, 40, 40);
/// Grid lines.
pub(crate) const GRID: RGBColor = RGBColor(232, 232, 232);
/// Secondary text.
pub(crate) const GREY: RGBColor = RGBColor(105, 105, 105);
/// Texel sizes in order: blue, orange, green, purple, vermilion, sky.
pub(crate) const SIZES: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(230, 159, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(213, 94, 0),
    RGBColor(86, 180, 233),
];

/// Vermilion for the step, blue for the stair, green for the double step.
pub(crate) fn pattern_color(pattern: Pattern) -> RGBColor {
    match pattern {
        Pattern::Stair => RGBColor(0, 114, 178),
        Pattern::Step => RGBColor(213, 94, 0),
        Pattern::DoubleStep => RGBColor(0, 158, 115),
    }
}

/// Text of a size in pixels and a colour.
pub(crate) fn text(size_px: u32, color: RGBColor) -> TextStyle<'static> {
    ("sans-serif", size_px).into_font().color(&color)
}

/// Error of a drawing call.
pub(crate) type DrawError = Box<dyn std::error::Error>;

/// Lets `draw` paint on a white page and returns it as SVG.
pub(crate) fn svg(
    file: &'static str,
    title: &str,
    size_px: (u32, u32),
    draw: impl FnOnce(&DrawingArea<SVGBackend<'_>, plotters::coord::Shift>) -> Result<(), DrawError>,
) -> Result<String, Error> {
    let refuse = |error: DrawError| Error::Figure { figure: file, reason: error.to_string() };
    let mut page = String::new();
    {
        let area = SVGBackend::with_string(&mut page, size_px).into_drawing_area();
        area.fill(&WHITE).map_err(|error| refuse(error.into()))?;
        draw(&area).map_err(refuse)?;
        area.present().map_err(|error| refuse(error.into()))?;
    }
    // A title for screen readers and the mark go behind the opening tag.
    let head = page.find('>').map_or(0, |end| end + 1);
    page.insert_str(head, &format!("\n<title>{title}</title>\n{FIGURE_MARK}"));
    Ok(page)
}
