//! Whether pictures can be compared at all: sizes that agree, and numbers where the mask is set.

use crate::Error;

/// Refuses different numbers of pixels.
pub(crate) fn lengths(found: &[f32], truth: &[f32], mask: &[bool]) -> Result<(), Error> {
    if found.len() == truth.len() && found.len() == mask.len() {
        Ok(())
    } else {
        Err(Error::Lengths { found: found.len(), truth: truth.len(), mask: mask.len() })
    }
}

/// Refuses different numbers of pixels, and values that are not finite where the mask is set.
pub(crate) fn pictures(found: &[f32], truth: &[f32], mask: &[bool]) -> Result<(), Error> {
    lengths(found, truth, mask)?;
    let is_broken = |&pixel: &usize| mask[pixel] && !(found[pixel].is_finite() && truth[pixel].is_finite());
    match (0..mask.len()).find(is_broken) {
        Some(pixel) => Err(Error::NotFinite { pixel, found: found[pixel], truth: truth[pixel] }),
        None => Ok(()),
    }
}

/// As [`pictures`], for rows of `width` pixels.
pub(crate) fn rows(found: &[f32], truth: &[f32], mask: &[bool], width: usize) -> Result<(), Error> {
    pictures(found, truth, mask)?;
    if width > 0 && mask.len().is_multiple_of(width) { Ok(()) } else { Err(Error::Width { width, pixels: mask.len() }) }
}
