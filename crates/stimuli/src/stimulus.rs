//! What is shown: one filtered silhouette, described by numbers that a log can hold.
//!
//! The geometry is Kreuzer 2017, section 4.1.3: a shadow edge sampled by a shadow map whose texel is
//! `texel_px` wide on the screen, filtered by a disc of radius `radius_px`, black shadow on a white
//! surface. A [`Shape::Artifact`] is the sampled edge, a [`Shape::Line`] is the true edge under the
//! same filter.

use serde::{Deserialize, Serialize};

use crate::Error;

/// How the silhouette lies on the texels of the shadow map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Pattern {
    /// A 45-degree silhouette: one step per texel, a regular stair.
    Stair,
    /// An almost axis-aligned silhouette: a single step of one texel across the whole image.
    Step,
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

/// One picture of the experiment. Equal values give equal bytes in one build of the program (the arc
/// sine and the power come from the platform).
///
/// Lengths are physical pixels of the display, light is linear.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stimulus {
    /// How the silhouette lies on the texels.
    pub pattern: Pattern,
    /// Whether the steps are there.
    pub shape: Shape,
    /// Side of one shadow-map texel, greater than 0.
    pub texel_px: f64,
    /// Radius of the disc filter, at least 0; 0 leaves the silhouette hard.
    pub radius_px: f64,
    /// Linear light of the lit side, 0 to 1; the shadow is black.
    pub contrast: f64,
    /// Place of the steps, 0 to 1; does not move a line.
    ///
    /// A stair slides along the line by this part of its period. A step, whose period is the width
    /// of the image, moves inside the middle half of the image: 0 a quarter left of the centre,
    /// 0.5 at the centre, 1 a quarter right of it.
    pub phase: f64,
    /// Left and right swapped.
    pub mirrored: bool,
    /// The shadow lies above the edge instead of below it.
    pub inverted: bool,
    /// Seed of the dithering; `None` rounds to the nearest of the 256 levels.
    pub dither_seed: Option<u64>,
}

impl Stimulus {
    /// Refuses numbers outside the ranges that the fields state; the error names the field.
    pub fn check(&self) -> Result<(), Error> {
        let in_range = |field, value: f64, allowed, good: bool| {
            if value.is_finite() && good { Ok(()) } else { Err(Error::Field { field, value, allowed }) }
        };
        in_range("texel_px", self.texel_px, "a finite length above 0", self.texel_px > 0.0)?;
        in_range("radius_px", self.radius_px, "a finite length of at least 0", self.radius_px >= 0.0)?;
        in_range("contrast", self.contrast, "0 to 1", (0.0..=1.0).contains(&self.contrast))?;
        in_range("phase", self.phase, "0 to 1", (0.0..=1.0).contains(&self.phase))
    }
}
