//! Ground truth for shadow maps, on the CPU: what the shadow would be without texels, and how far a picture is from it.
//!
//! * [`Rays`]: the nearest hit on a ray, and whether a segment is free, exact to `f64` on a scene's triangles;
//!   [`Skipped`] tells the triangles that are no surface.
//! * [`KernelTruth`]: the filter of [`scumble_core::filter`] with a ray in place of every map lookup. Taps, rotation
//!   and radii are those of the shader. A tap asks whether light reaches the surface around the receiver, where a map
//!   compares with the tangent plane. So what differs is the texel, its bias, and what the map calls shaded where a lit
//!   surface is folded.
//! * [`LightTruth`]: the share of the light's own area that a point sees, by stratified rays, with its standard error.
//! * [`Differences`] and [`error_map`]: maximum, 99th percentile, RMS and bias over a mask of pixels, and their
//!   picture.
//! * [`edge_displacement`]: how far a shadow's edge is from where it should be, in pixels.
//! * [`edge_tilt`]: how far it turns away from the true edge, against what observers see.
//! * [`flip`](flip()): how different two pictures look on a screen.
//! * [`error_parts`]: what part of an error is noise.
//! * [`pop`](pop()) and [`shimmer`](shimmer()): what changes when the map's size does, and when the camera creeps.
//!
//! * Closed forms: [`slit_under_disc`], [`disc_under_disc`], [`polygon_under_disc`], [`half_plane_under_rectangle`] and
//!   [`rectangle_under_rectangle`], beside [`scumble_core::half_plane_under_disc`]. A share is a visibility when an
//!   occluder's outline is multiplied by the distance of the light over its own, and divided by the light's radius.
//!
//! Rays are checked against closed forms (`tests/closed_forms.rs`), closed forms by counting and against each other.
//! Not goals: other filters than the renderer's, lights that are neither discs nor spheres.

mod check;
mod closed_form;
mod contour;
mod edge_displacement;
mod edge_tilt;
mod error;
mod error_map;
mod flip;
mod hierarchy;
mod kernel_truth;
mod light_samples;
mod light_truth;
mod metrics;
mod noise;
mod percentile;
mod pop;
mod rays;
mod shimmer;
mod tap;
mod triangle;
mod weighted;

pub use closed_form::{
    Rectangle, disc_under_disc, half_plane_under_rectangle, polygon_under_disc, rectangle_under_rectangle,
    slit_under_disc,
};
pub use edge_displacement::{EdgeDisplacement, edge_displacement};
pub use edge_tilt::{EdgeTilt, HIDDEN_TILT_DEG, edge_tilt};
pub use error::Error;
pub use error_map::error_map;
pub use flip::{FLIP_PIXELS_PER_DEGREE, Flip, flip};
pub use kernel_truth::{KernelTruth, Receiver};
pub use light_truth::{Estimate, LightTruth};
pub use metrics::{Differences, differences, penumbra};
pub use noise::{ErrorParts, error_parts};
pub use pop::{Pop, pop};
pub use rays::{Hit, Rays};
pub use shimmer::{Shimmer, shimmer};
pub use triangle::Skipped;
