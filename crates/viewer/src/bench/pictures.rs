//! The pictures of a scene under one method: every size, the truth, and what differs, all on one scale.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use image::RgbImage;
use scumble_reference::error_map;

use crate::gbuffer::{GBuffer, Surface};
use crate::output::{Kind, claim, write_png};
use crate::stage::Stage;
use crate::truth::spread;
use crate::variant::Variant;

/// Error of the shadow fraction that has the full colour in the error maps.
pub const ERROR_FULL_SCALE: f32 = 0.25;

/// Names and paths of pictures.
pub type Files = Vec<(&'static str, PathBuf)>;

/// Where the pictures of a method go, and the receivers that they show.
pub struct Pictures<'a> {
    stage: &'a Stage,
    directory: PathBuf,
    size_px: [u32; 2],
    samples_per_side: u32,
    samples: GBuffer,
}

impl<'a> Pictures<'a> {
    /// Draws the receivers with as many samples as the pictures average.
    pub fn new(stage: &'a Stage, directory: &Path, size_px: [u32; 2], samples_per_side: u32) -> Result<Self> {
        let samples = stage.receivers(size_px, samples_per_side)?;
        Ok(Self { stage, directory: directory.to_owned(), size_px, samples_per_side, samples })
    }

    /// The picture of the truth; `visibility` is that of the surfaces in the middle of the pixels.
    pub fn truth(&self, visibility: &[f32], surfaces: &[Option<Surface>]) -> Result<PathBuf> {
        let path = claim(&self.directory.join("truth.png"), Kind::Png)?;
        let samples = self.samples.read_surfaces(&self.stage.gpu)?;
        let finer = spread(visibility, surfaces, self.size_px[0], &samples, self.samples_per_side);
        let texture = self.stage.upload_visibility(&self.samples, &finer);
        write_png(&path, &self.stage.picture(&self.samples, &texture, self.samples_per_side)?)?;
        Ok(path)
    }

    /// The picture of a variant and its error map; the list names them and the truth.
    pub fn variant(
        &self,
        variant: &mut Variant,
        label: &str,
        visibility: &[f32],
        truth: &[f32],
        lit_facing: &[bool],
        truth_picture: &Path,
    ) -> Result<Files> {
        let picture = claim(&self.directory.join(format!("{label}.png")), Kind::Png)?;
        let error = claim(&self.directory.join(format!("{label}-error.png")), Kind::Png)?;
        let texture = variant.evaluate(self.stage, &self.samples)?;
        write_png(&picture, &self.stage.picture(&self.samples, &texture, self.samples_per_side)?)?;
        let [width, height] = self.size_px;
        let map = RgbImage::from_raw(width, height, error_map(visibility, truth, lit_facing, ERROR_FULL_SCALE)?);
        write_png(&error, &map.context("the error map has another size than its pixels")?)?;
        Ok(vec![("picture", picture), ("error_map", error), ("truth", truth_picture.to_owned())])
    }
}
