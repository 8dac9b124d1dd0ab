//! A stimulus as a picture: physical pixels, 8 bits.
//!
//! A pixel shows the light at its centre, as the fragment shader of a renderer would; the filter is
//! the only blur.

use image::GrayImage;

use crate::edge::Edge;
use crate::level::Quantiser;
use crate::rows::Rows;
use crate::{Error, MAX_SIDE_PX, Stimulus, Transfer};

impl Stimulus {
    /// The picture, `width_px` by `height_px` physical pixels, for a display with this transfer.
    ///
    /// The true line of a step rises by one texel over the width, that of a double step by one texel
    /// less than the width; such a picture is at least two texels wide. An untilted disc takes a few
    /// milliseconds for 600 x 600 pixels; a tilt and turned taps take several times as long.
    pub fn render(&self, width_px: u32, height_px: u32, transfer: &Transfer) -> Result<GrayImage, Error> {
        self.check()?;
        if !(1..=MAX_SIDE_PX).contains(&width_px) || !(1..=MAX_SIDE_PX).contains(&height_px) {
            return Err(Error::Size { width_px, height_px });
        }
        let edge = Edge::new(self, [width_px, height_px])?;
        let rows = Rows::new(&edge);
        let mut quantiser = Quantiser::new(transfer, self.encoding, self.dither_seed);
        let mut picture = GrayImage::new(width_px, height_px);
        let mut coverage = vec![0.0; width_px as usize];
        for (row, levels) in (0..).zip(picture.chunks_exact_mut(width_px as usize)) {
            rows.fill(&edge, row, &mut coverage);
            if self.mirrored {
                coverage.reverse();
            }
            let value = |&dark: &f64| self.contrast * if self.inverted { dark } else { 1.0 - dark };
            quantiser.row(row, coverage.iter().map(value), levels);
        }
        Ok(picture)
    }
}
