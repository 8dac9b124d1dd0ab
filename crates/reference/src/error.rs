//! What can be wrong with pictures that are to be compared, and with lights that are to be sampled.

use crate::LightTruth;

/// Why two pictures cannot be compared, or a light cannot be sampled.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// Picture, truth and mask have different numbers of pixels.
    #[error("{found} pixels are compared with {truth} of the truth under a mask of {mask}: allowed are equal numbers")]
    Lengths {
        /// Pixels of the picture.
        found: usize,
        /// Pixels of the truth.
        truth: usize,
        /// Pixels of the mask.
        mask: usize,
    },
    /// A pixel inside the mask is not a number.
    #[error("pixel {pixel} is {found} in the picture and {truth} in the truth: allowed are finite numbers")]
    NotFinite {
        /// Index of the pixel.
        pixel: usize,
        /// Its value in the picture.
        found: f32,
        /// Its value in the truth.
        truth: f32,
    },
    /// Rows that do not fill the picture.
    #[error("rows of {width} pixels in a picture of {pixels}: allowed is a divisor")]
    Width {
        /// Pixels of a row.
        width: usize,
        /// Pixels of the picture.
        pixels: usize,
    },
    /// An array with another number of values than there are pixels in the mask.
    #[error("{found} values under a mask of {allowed} pixels: allowed are equal numbers")]
    Count {
        /// Values of the array.
        found: usize,
        /// Pixels of the mask.
        allowed: usize,
    },
    /// A value of a series is not a number.
    #[error("pixel {pixel} of frame {frame} is {found}: allowed are finite numbers")]
    Frame {
        /// Index of the frame in the series.
        frame: usize,
        /// Index of the pixel or point.
        pixel: usize,
        /// Its value.
        found: f32,
    },
    /// A switch that is not between two frames.
    #[error("a switch at frame {found} of {frames}: allowed are frames with a frame before them")]
    Switch {
        /// Index of the frame.
        found: usize,
        /// Number of frames.
        frames: usize,
    },
    /// A viewing condition of no screen.
    #[error("{found} pixels per degree of vision: allowed are {} to {}", allowed.start(), allowed.end())]
    PixelsPerDegree {
        /// The number given.
        found: f64,
        /// The numbers that are taken.
        allowed: std::ops::RangeInclusive<f64>,
    },
    /// A number of rays that does not cut the light into equal areas.
    #[error("{found} samples of the light: allowed are {:?}", LightTruth::SAMPLES)]
    Samples {
        /// The number asked for.
        found: u32,
    },
    /// A light that is out of range.
    #[error(transparent)]
    Light(#[from] scumble_core::Error),
}
