//! A stimulus as a picture: physical pixels, 8 bits, sRGB.
//!
//! A pixel shows the light at its centre, as the fragment shader of a renderer would; the filter is
//! the only blur. The origin of the picture is its centre, and the true line always runs through it,
//! so neither the line's place nor its direction tells a line from an artifact.

use image::{GrayImage, Luma};

use crate::level::Quantiser;
use crate::{Error, Kernel, MAX_SIDE_PX, Pattern, Shape, Silhouette, Stimulus};

impl Stimulus {
    /// The picture, `width_px` by `height_px` physical pixels.
    ///
    /// The true line of a step rises by one texel over the width. Dithering draws one number a
    /// pixel, row by row, from ChaCha8.
    pub fn render(&self, width_px: u32, height_px: u32) -> Result<GrayImage, Error> {
        self.check()?;
        if !(1..=MAX_SIDE_PX).contains(&width_px) || !(1..=MAX_SIDE_PX).contains(&height_px) {
            return Err(Error::Size { width_px, height_px });
        }
        let edge = self.edge(f64::from(width_px));
        let radius = self.radius_px / self.texel_px;
        let mut quantiser = Quantiser::new(self.dither_seed);
        let mut picture = GrayImage::new(width_px, height_px);
        for (column, row, pixel) in picture.enumerate_pixels_mut() {
            let x_px = f64::from(column) + 0.5 - 0.5 * f64::from(width_px);
            let y_px = 0.5 * f64::from(height_px) - f64::from(row) - 0.5;
            let x = if self.mirrored { -x_px } else { x_px } / self.texel_px - edge.x;
            let y = y_px / self.texel_px - edge.y;
            let below = edge.silhouette.coverage(Kernel::Disc, radius, x, y);
            let shadow = if self.inverted { 1.0 - below } else { below };
            *pixel = Luma([quantiser.level(self.contrast * (1.0 - shadow))]);
        }
        Ok(picture)
    }

    /// The silhouette and the place of its origin from the picture's centre, in texels.
    fn edge(&self, width_px: f64) -> Edge {
        let width_texels = width_px / self.texel_px;
        let (slope, x) = match self.pattern {
            Pattern::Stair => (1.0, self.phase),
            Pattern::Step => (1.0 / width_texels, 0.5 * (self.phase - 0.5) * width_texels),
        };
        let silhouette = match (self.shape, self.pattern) {
            (Shape::Line, _) => {
                return Edge { silhouette: Silhouette::Line { slope }, x: 0.0, y: 0.0 };
            }
            (Shape::Artifact, Pattern::Stair) => Silhouette::Stair,
            (Shape::Artifact, Pattern::Step) => Silhouette::Step,
        };
        Edge { silhouette, x, y: slope * x }
    }
}

/// A silhouette and where its origin lies in the picture, in texels from the centre, y up.
struct Edge {
    silhouette: Silhouette,
    x: f64,
    y: f64,
}
