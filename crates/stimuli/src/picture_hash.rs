//! The hash by which a log names the exact picture that was on the screen.

use image::GrayImage;
use sha2::{Digest, Sha256};

/// SHA-256 of width and height (u32, little endian) and the bytes row by row, as 64 hex digits.
pub fn picture_sha256(picture: &GrayImage) -> String {
    let mut hash = Sha256::new();
    hash.update(picture.width().to_le_bytes());
    hash.update(picture.height().to_le_bytes());
    hash.update(picture.as_raw());
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}
