//! Ground truth for shadow maps, on the CPU: what the shadow would be without texels, and how far a picture is from it.
//!
//! * [`Rays`]: the nearest hit on a ray, and whether a segment is free, exact to `f64` on a scene's triangles.
//! * [`KernelTruth`]: the filter of [`scumble_core::filter`] with a ray in place of every map lookup. Taps, rotation
//!   and radii are those of the shader. A tap asks whether light reaches the surface around the receiver, where a map
//!   compares with the tangent plane. So what differs is the texel, its bias, and what the map calls shaded where a lit
//!   surface is folded.
//! * [`Differences`] and [`error_map`]: maximum, 99th percentile, RMS and bias over a mask of pixels, and their
//!   picture.
//!
//! Checked against closed forms: the half plane and the slit under a disc kernel (`tests/closed_forms.rs`).
//! Not goals: an area light's own shadow (a filter approximates it, and this is the truth of the filter), other filters
//! than the renderer's.

mod error;
mod error_map;
mod kernel_truth;
mod metrics;
mod rays;
mod tap;

pub use error::Error;
pub use error_map::error_map;
pub use kernel_truth::{KernelTruth, Receiver};
pub use metrics::{Differences, differences, penumbra};
pub use rays::{Hit, Rays};
