//! A stimulus as a picture: physical pixels, 8 bits.
//!
//! A pixel shows the light at its centre, as the fragment shader of a renderer would; the filter is
//! the only blur. The origin of the picture is its centre, and the true line always runs through it,
//! so neither the line's place nor its direction tells a line from an artifact.

use image::{GrayImage, Luma};

use crate::kernel::Filter;
use crate::level::Quantiser;
use crate::{Error, Kernel, MAX_SIDE_PX, Pattern, Shape, Silhouette, Stimulus, Transfer};

impl Stimulus {
    /// The picture, `width_px` by `height_px` physical pixels, for a display with this transfer.
    ///
    /// The true line of a step rises by one texel over the width.
    pub fn render(&self, width_px: u32, height_px: u32, transfer: &Transfer) -> Result<GrayImage, Error> {
        self.check()?;
        if !(1..=MAX_SIDE_PX).contains(&width_px) || !(1..=MAX_SIDE_PX).contains(&height_px) {
            return Err(Error::Size { width_px, height_px });
        }
        let edge = self.edge(f64::from(width_px), f64::from(height_px));
        let filter = Filter::new(self.kernel, self.radius_px / self.texel_px);
        let (cos, sin) = (libm::cos(self.tilt_rad), libm::sin(self.tilt_rad));
        let mut quantiser = Quantiser::new(transfer, self.encoding, self.dither_seed);
        let mut picture = GrayImage::new(width_px, height_px);
        for (column, row, pixel) in picture.enumerate_pixels_mut() {
            let x_px = f64::from(column) + 0.5 - 0.5 * f64::from(width_px);
            let y_px = 0.5 * f64::from(height_px) - f64::from(row) - 0.5;
            let (x_px, y_px) = (cos * x_px + sin * y_px, cos * y_px - sin * x_px);
            let x = if self.mirrored { -x_px } else { x_px } / self.texel_px - edge.x;
            let y = y_px / self.texel_px - edge.y;
            let filter = match self.kernel {
                Kernel::Poisson25Rotated => {
                    let column = if self.mirrored { width_px - 1 - column } else { column };
                    filter.turned(scumble_core::rotation_angle([column, row]))
                }
                _ => filter,
            };
            let below = edge.silhouette.filtered(filter, x, y);
            let shadow = if self.inverted { 1.0 - below } else { below };
            *pixel = Luma([quantiser.level(self.contrast * (1.0 - shadow))]);
        }
        Ok(picture)
    }

    /// The silhouette and the place of its origin from the picture's centre, in texels.
    fn edge(&self, width_px: f64, height_px: f64) -> Edge {
        let width_texels = width_px / self.texel_px;
        let height_texels = height_px / self.texel_px;
        let along = 0.5 * (self.phase - 0.5);
        let (artifact, slope, x) = match self.pattern {
            Pattern::Stair => (Silhouette::Stair, 1.0, self.phase),
            Pattern::Step => (Silhouette::Step, 1.0 / width_texels, along * width_texels),
            Pattern::DoubleStep => {
                (Silhouette::DoubleStep, 1.0 - 1.0 / width_texels, along * width_texels.min(height_texels))
            }
        };
        match self.shape {
            Shape::Line => Edge { silhouette: Silhouette::Line { slope }, x: 0.0, y: 0.0 },
            Shape::Artifact => Edge { silhouette: artifact, x, y: slope * x },
        }
    }
}

/// A silhouette and where its origin lies in the picture, in texels from the centre, y up.
struct Edge {
    silhouette: Silhouette,
    x: f64,
    y: f64,
}
