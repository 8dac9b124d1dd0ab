//! Ground truth.

mod rays;
pub use rays::{Hit, Rays};
