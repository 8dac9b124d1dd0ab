//! What is shown: one filtered silhouette, described by numbers that a log can hold.
//!
//! The geometry is Kreuzer 2017, section 4.1.3: a shadow edge sampled by a shadow map whose texel is
//! `texel_px` wide on the screen, filtered by a kernel of radius `radius_px`, black shadow on a white
//! surface. A [`Shape::Artifact`] is the sampled edge, a [`Shape::Line`] is the true edge under the
//! same filter. [`Pattern::DoubleStep`], the other kernels, the code values and the tilt are not in
//! the paper.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::{Error, Kernel, MAX_SIDE_PX, MIN_TEXEL_PX};

/// No length is longer than a picture.
const LONGEST_PX: f64 = MAX_SIDE_PX as f64;

/// How the silhouette lies on the texels of the shadow map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Pattern {
    /// A 45-degree silhouette: one step per texel, a regular stair.
    Stair,
    /// An almost axis-aligned silhouette: a single step of one texel across the whole image.
    Step,
    /// A silhouette of slope `1 - a / W` over a picture of width W (44.5 degrees for a = 10, W = 600):
    /// a stair with one tread two texels wide, as hard to hide as the step.
    DoubleStep,
}

/// What was filtered: the sampled silhouette or the true one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// The silhouette as the shadow map stores it, with its steps.
    Artifact,
    /// The straight silhouette through the middle of the steps.
    Line,
}

/// What the lit part of the kernel is proportional to on the screen, and what `contrast` scales.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Encoding {
    /// The light of the display above its black: what a shadow does.
    LinearLight,
    /// The display's code value, 0 to 255: what a program without gamma correction draws.
    CodeValues,
}

/// One picture of the experiment. Equal values, sizes and transfers give equal bytes on every
/// platform.
///
/// Lengths are physical pixels of the display.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stimulus {
    /// How the silhouette lies on the texels.
    pub pattern: Pattern,
    /// Whether the steps are there.
    pub shape: Shape,
    /// What blurs it.
    pub kernel: Kernel,
    /// Side of one shadow-map texel, 1 to 16384: below a pixel nobody sees a step.
    pub texel_px: f64,
    /// Radius of the kernel, 0 to 16384.
    pub radius_px: f64,
    /// The lit side in the units of `encoding`, as a part of the display's brightest, 0 to 1; the
    /// shadow is black.
    pub contrast: f64,
    /// What coverage is proportional to.
    pub encoding: Encoding,
    /// Place of the steps, 0 to 1; does not move a line.
    ///
    /// A stair slides along the line by this part of its period. A step, whose period is the width
    /// of the image, moves along the line inside the middle half of the image: 0 a quarter left of
    /// the centre, 0.5 at the centre, 1 a quarter right of it. So does the wide tread of a double
    /// step, in an image wider than high by quarters of the height.
    pub phase: f64,
    /// Left and right swapped.
    pub mirrored: bool,
    /// The shadow lies above the edge instead of below it.
    pub inverted: bool,
    /// The whole picture, shadow map and kernel together, turned about its centre, counter-clockwise,
    /// -pi to pi.
    ///
    /// Far from its riser a step is level, while its line is tilted by `a / W`: a cue that no blur
    /// removes. A protocol takes it away by turning each picture by a small random angle of its own.
    pub tilt_rad: f64,
    /// Seed of the dithering; `None` takes the nearest of the 256 levels.
    pub dither_seed: Option<u64>,
}

impl Stimulus {
    /// Refuses numbers outside the ranges that the fields state; the error names the field.
    pub fn check(&self) -> Result<(), Error> {
        let in_range = |field, value: f64, allowed, good: bool| {
            if value.is_finite() && good { Ok(()) } else { Err(Error::Field { field, value, allowed }) }
        };
        in_range("texel_px", self.texel_px, "1 to 16384", (MIN_TEXEL_PX..=LONGEST_PX).contains(&self.texel_px))?;
        in_range("radius_px", self.radius_px, "0 to 16384", (0.0..=LONGEST_PX).contains(&self.radius_px))?;
        in_range("contrast", self.contrast, "0 to 1", (0.0..=1.0).contains(&self.contrast))?;
        in_range("phase", self.phase, "0 to 1", (0.0..=1.0).contains(&self.phase))?;
        in_range("tilt_rad", self.tilt_rad, "-pi to pi", self.tilt_rad.abs() <= PI)
    }
}
