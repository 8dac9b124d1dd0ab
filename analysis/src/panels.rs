//! Panels of a figure side by side, with the axes that all our figures have.

use plotters::{coord::Shift, prelude::*};

use crate::figure::{DrawError, GREY, text};

/// Size of a panel.
pub(crate) const PANEL_PX: (u32, u32) = (460, 340);

/// Height of the lines below the panels, each of 22 pixels.
pub(crate) const FOOT_PX: u32 = 60;

/// A part of a page.
pub(crate) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Rows and columns of `count` panels: two in a row fill a page of text; many stand in threes.
fn rows_and_columns(count: usize) -> (usize, usize) {
    let columns = if count > 4 { 3 } else { 2 };
    (count.div_ceil(columns).max(1), columns)
}

/// Size of the page of `count` panels.
pub(crate) fn page_px(count: usize) -> (u32, u32) {
    let (rows, columns) = rows_and_columns(count);
    (PANEL_PX.0 * columns as u32, PANEL_PX.1 * rows as u32 + FOOT_PX)
}

/// The panels of a page, and its foot.
pub(crate) fn split<'a>(page: &Area<'a>, count: usize) -> (Vec<Area<'a>>, Area<'a>) {
    let (rows, columns) = rows_and_columns(count);
    let (panels, foot) = page.split_vertically(PANEL_PX.1 * rows as u32);
    (panels.split_evenly((rows, columns)), foot)
}

/// What the marks mean, below the panels: at most two lines.
pub(crate) fn draw_foot(foot: &Area<'_>, lines: &[&str]) -> Result<(), DrawError> {
    for (line, y) in lines.iter().zip([4, 26]) {
        foot.draw(&Text::new((*line).to_owned(), (22, y), text(14, GREY)))?;
    }
    Ok(())
}
