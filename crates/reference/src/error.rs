//! What can be wrong with pictures that are to be compared.

/// Why two pictures cannot be compared.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
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
}
