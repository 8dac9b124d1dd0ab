//! Exact pictures of filtered shadow-map artifacts.

mod error;
mod stimulus;

pub use error::Error;
pub use stimulus::{Pattern, Shape, Stimulus};

/// Longest side of a picture that is rendered: the largest texture of common devices.
pub const MAX_SIDE_PX: u32 = 16_384;
