//! Exact pictures of filtered shadow-map artifacts.
//!
//! A shadow map stores a shadow's edge in texels of size `a`; a filter of radius `r` blurs the steps.
//! At some ratio `c = r / a` nobody can tell the result from the filtered true edge. This crate draws
//! both sides of that comparison for people to judge (Kreuzer 2017, chapter 4), without sampling:
//!
//! 1. [`Kernel`]: a disc, box, Gaussian or the 25 taps of a renderer; its weight in a half plane and
//!    beside a riser in closed form.
//! 2. [`Silhouette`]: the coverage of a filtered stair, step, double step and line as a few of those,
//!    exact to 1e-12 (disc, box) and 1e-9 (Gaussian) against an independent table.
//! 3. [`Stimulus`]: one picture of the experiment as a handful of numbers, and
//!    [`Stimulus::render`], which turns it into 8 bits at physical pixels of a display whose light
//!    the [`Transfer`] knows. [`picture_sha256`] names the bytes in a log.
//! 4. [`IsoContour`] and [`reference_ratio`]: how far an artifact is from its line, as the bend of its
//!    contours and as the ratio beyond which it stays within a few levels.
//!
//! Not here: which picture to show (`scumble-psychophysics`), and how (`scumble-study`).
//!
//! ```
//! use scumble_stimuli::{Encoding, Kernel, Pattern, Shape, Stimulus, Transfer};
//!
//! let stimulus = Stimulus {
//!     pattern: Pattern::Stair,
//!     shape: Shape::Artifact,
//!     kernel: Kernel::Disc,
//!     texel_px: 10.0,
//!     radius_px: 20.0,
//!     contrast: 1.0,
//!     encoding: Encoding::LinearLight,
//!     phase: 0.0,
//!     mirrored: false,
//!     inverted: false,
//!     tilt_rad: 0.0,
//!     dither_seed: None,
//! };
//! let picture = stimulus.render(100, 100, &Transfer::srgb())?;
//! assert_eq!(picture.get_pixel(0, 0).0, [255], "lit above the edge");
//! assert_eq!(picture.get_pixel(99, 99).0, [0], "in shadow below it");
//! # Ok::<(), scumble_stimuli::Error>(())
//! ```

mod band;
mod density;
mod edge;
mod error;
mod filter;
mod iso_contour;
mod kernel;
mod level;
mod picture_hash;
mod reference_ratio;
mod render;
mod rows;
mod search;
mod silhouette;
mod step_table;
mod stimulus;
mod transfer;

pub use error::Error;
pub use iso_contour::IsoContour;
pub use kernel::Kernel;
pub use picture_hash::picture_sha256;
pub use reference_ratio::{Comparison, reference_ratio};
pub use silhouette::Silhouette;
pub use stimulus::{Encoding, Pattern, Shape, Stimulus};
pub use transfer::Transfer;

/// Longest side of a picture, in pixels: the largest texture of common devices.
pub const MAX_SIDE_PX: u32 = 16_384;

/// Smallest texel, in pixels: steps below a pixel are not on the screen.
pub const MIN_TEXEL_PX: f64 = 1.0;
