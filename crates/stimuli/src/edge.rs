//! Where the silhouette of a stimulus lies in a picture, and its coverage pixel by pixel.
//!
//! The picture's origin is its centre, y up, and the true line always runs through it, so neither the
//! line's place nor its direction tells a line from an artifact. A mirrored picture is drawn as it is
//! before mirroring: turned the other way, its columns counted from the right.

use crate::filter::Filter;
use crate::{Error, Kernel, Pattern, Shape, Silhouette, Stimulus};

/// A filtered silhouette in a picture that is not mirrored.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    pub(crate) silhouette: Silhouette,
    pub(crate) filter: Filter,
    pub(crate) size_px: [u32; 2],
    kernel: Kernel,
    pub(crate) texel_px: f64,
    /// Origin of the silhouette in texels from the picture's centre.
    origin: [f64; 2],
    tilt_rad: f64,
    /// Cosine and sine of the tilt.
    turn: [f64; 2],
}

impl Edge {
    /// The edge of a checked stimulus; refuses a step or double step in a picture of fewer than two
    /// texels, where nearest sampling of its line gives no such step.
    pub(crate) fn new(stimulus: &Stimulus, size_px: [u32; 2]) -> Result<Self, Error> {
        let Stimulus { texel_px, kernel, .. } = *stimulus;
        let [width, height] = size_px.map(|side_px| f64::from(side_px) / texel_px);
        if stimulus.pattern != Pattern::Stair && width < 2.0 {
            let allowed = "1 to half the width of the picture of a step";
            return Err(Error::Field { field: "texel_px", value: texel_px, allowed });
        }
        let along = 0.5 * (stimulus.phase - 0.5);
        let (artifact, slope, x) = match stimulus.pattern {
            Pattern::Stair => (Silhouette::Stair, 1.0, stimulus.phase),
            Pattern::Step => (Silhouette::Step, 1.0 / width, along * width),
            Pattern::DoubleStep => (Silhouette::DoubleStep, 1.0 - 1.0 / width, along * width.min(height)),
        };
        let (silhouette, origin) = match stimulus.shape {
            Shape::Artifact => (artifact, [x, slope * x]),
            Shape::Line => (Silhouette::Line { slope }, [0.0, 0.0]),
        };
        let tilt_rad = if stimulus.mirrored { -stimulus.tilt_rad } else { stimulus.tilt_rad };
        let turn = [libm::cos(tilt_rad), libm::sin(tilt_rad)];
        let filter = Filter::new(kernel, stimulus.radius_px / texel_px);
        Ok(Self { silhouette, filter, size_px, kernel, texel_px, origin, tilt_rad, turn })
    }

    /// Whether all pixels have the same kernel.
    pub(crate) fn has_one_kernel(&self) -> bool {
        self.kernel != Kernel::Poisson25Rotated
    }

    /// Whether columns and rows of the picture are columns and rows of the shadow map.
    pub(crate) fn is_upright(&self) -> bool {
        self.tilt_rad == 0.0
    }

    /// Place of an upright column's centre in texels from the silhouette's origin.
    pub(crate) fn x(&self, column: u32) -> f64 {
        self.x_px(column) / self.texel_px - self.origin[0]
    }

    /// Place of an upright row's centre in texels from the silhouette's origin.
    pub(crate) fn y(&self, row: u32) -> f64 {
        self.y_px(row) / self.texel_px - self.origin[1]
    }

    /// Place of a pixel's centre in texels from the silhouette's origin.
    pub(crate) fn place(&self, column: u32, row: u32) -> [f64; 2] {
        let (x_px, y_px) = (self.x_px(column), self.y_px(row));
        let [cos, sin] = self.turn;
        let x = (cos * x_px + sin * y_px) / self.texel_px - self.origin[0];
        let y = (cos * y_px - sin * x_px) / self.texel_px - self.origin[1];
        [x, y]
    }

    /// Part of the kernel that lies in shadow at a pixel.
    pub(crate) fn coverage(&self, column: u32, row: u32) -> f64 {
        let [x, y] = self.place(column, row);
        let filter = match self.kernel {
            Kernel::Poisson25Rotated => self.filter.turned(scumble_core::rotation_angle([column, row])),
            _ => self.filter,
        };
        self.silhouette.filtered(filter, x, y)
    }

    fn x_px(&self, column: u32) -> f64 {
        f64::from(column) + 0.5 - 0.5 * f64::from(self.size_px[0])
    }

    fn y_px(&self, row: u32) -> f64 {
        0.5 * f64::from(self.size_px[1]) - 0.5 - f64::from(row)
    }
}
