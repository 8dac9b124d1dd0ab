//! `truth`: what the shadow would be without texels, or without a filter at all, as numbers and as a picture.
//!
//! The numbers are those of the surface in the middle of every pixel, at the very positions and normals that a shader
//! sees. The picture has several samples per pixel; each takes the number of the pixel near it whose surface is nearest,
//! so that edges of things are smooth and every ray serves the numbers.

mod cache;
mod key;
mod picture;
mod record;
mod source;
mod store;

use anyhow::Result;
use scumble_reference::Rays;

use crate::cli::Truth;
use crate::device::Gpu;
use crate::npy::npy;
use crate::output::{Kind, claim, claim_with_record, write, write_json, write_png};
use crate::setup::Setup;
use crate::stage::Stage;
use record::TruthRecord;

pub use picture::spread;
pub use source::{LIGHT_SAMPLES, Samples, Source};
pub use store::Store;

/// Samples per pixel of the picture along x and along y.
const PICTURE_SAMPLES_PER_SIDE: u32 = 2;

/// Runs the command.
pub fn run(options: &Truth) -> Result<()> {
    let conditions = &options.view.conditions;
    let samples = Samples::of(options)?;
    let (picture_path, record_path) = claim_with_record(&options.out, record::SCHEMA)?;
    let visibility_path = claim(&options.out.with_extension("npy"), Kind::Npy)?;
    let error_path = samples.of_light().map(|_| claim(&options.out.with_extension("se.npy"), Kind::Npy)).transpose()?;
    let store = Store::new(options.cache.as_deref())?;

    let setup = Setup::open(&options.view.scene, options.view.light, conditions)?;
    let stage = Stage::new(Gpu::open()?, setup)?;
    let pixels = stage.receivers([conditions.width, conditions.height], 1)?;
    let surfaces = pixels.read_surfaces(&stage.gpu)?;
    let rays = Rays::new(&stage.setup.scene);
    rays.skipped().iter().for_each(|skipped| eprintln!("warning: {skipped}"));
    let fit = match samples {
        Samples::Kernel(_) => stage.setup.fit(1.0)?,
        Samples::Light(_) => None,
    };
    let filter = stage.setup.filter(options.method, 1.0);
    let source = Source::new(&rays, &stage.setup.scene.light, fit.as_ref(), filter, samples)?;
    let message = format!("truth of {}", stage.setup.scene.name);
    let found = store.find(&message, &source, &stage.setup.scene.meshes, &surfaces, pixels.size_px)?;

    let visibility: Vec<f32> = found.estimates.iter().map(|estimate| estimate.visibility).collect();
    let finer = stage.receivers(pixels.size_px, PICTURE_SAMPLES_PER_SIDE)?;
    let finer_surfaces = finer.read_surfaces(&stage.gpu)?;
    let spread = spread(&visibility, &surfaces, conditions.width, &finer_surfaces, PICTURE_SAMPLES_PER_SIDE);
    let texture = stage.upload_visibility(&finer, &spread);
    write_png(&picture_path, &stage.picture(&finer, &texture, PICTURE_SAMPLES_PER_SIDE)?)?;
    write(&visibility_path, &npy(&visibility, pixels.size_px))?;
    if let Some(path) = &error_path {
        let errors: Vec<f32> = found.estimates.iter().map(|estimate| estimate.standard_error).collect();
        write(path, &npy(&errors, pixels.size_px))?;
    }
    let record = TruthRecord::new(&stage, options, samples, &found.estimates, found.rows_kept, found.key.to_string());
    write_json(&record_path, &record)?;

    println!("{} of {} rows from {}", found.rows_kept, conditions.height, found.folder.display());
    let paths = [Some(picture_path), Some(visibility_path), error_path, Some(record_path)];
    println!("{}", paths.iter().flatten().map(|path| path.display().to_string()).collect::<Vec<_>>().join(", "));
    Ok(())
}
