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

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use scumble::{Filter, Plan};
use scumble_reference::{Estimate, KernelTruth, Rays, Receiver};

use crate::cli::{Size, Truth};
use crate::device::Gpu;
use crate::gbuffer::Surface;
use crate::npy::npy;
use crate::output::{Kind, claim, claim_with_record, write, write_json, write_png};
use crate::progress::progress;
use crate::setup::Setup;
use crate::stage::Stage;
use crate::timer::Timer;
use crate::variant::{Case, Variant, still_settings};
use cache::{Cache, Rows};
use record::TruthRecord;
use source::Source;

/// Samples per pixel of the picture along x and along y.
const PICTURE_SAMPLES_PER_SIDE: u32 = 2;
/// Side of the map whose fit says where the reference plane is; it is never looked at.
const FIT_TEXELS: u32 = 8;
/// Rows that are kept in the cache at a time: some seconds of work, which is what a kill loses.
const ROWS_OF_BLOCK: u32 = 16;

/// Runs the command.
pub fn run(options: &Truth) -> Result<()> {
    let conditions = &options.view.conditions;
    let samples = source::Samples::of(options)?;
    let (picture_path, record_path) = claim_with_record(&options.out, record::SCHEMA)?;
    let visibility_path = claim(&options.out.with_extension("npy"), Kind::Npy)?;
    let error_path = samples.of_light().map(|_| claim(&options.out.with_extension("se.npy"), Kind::Npy)).transpose()?;
    let directory = options.cache.clone().or_else(default_cache).context(
        "--cache DIR is needed: this system names no folder for caches, and a truth that is cut off goes on from there",
    )?;

    let setup = Setup::open(&options.view.scene, conditions)?;
    let stage = Stage::new(Gpu::open()?, setup)?;
    let pixels = stage.receivers([conditions.width, conditions.height], 1)?;
    let surfaces = pixels.read_surfaces(&stage.gpu)?;
    let rays = Rays::new(&stage.setup.scene);
    rays.skipped().iter().for_each(|skipped| eprintln!("warning: {skipped}"));
    let plan = if samples.of_light().is_none() {
        let case = Case { method: options.method, size: Size::Fixed([FIT_TEXELS; 2]), softness: 1.0 };
        let mut fitted = Variant::new(&stage, &pixels, case, still_settings(&stage.setup))?;
        fitted.frame(&stage, &pixels, &mut Timer::new(&stage.gpu))?;
        Some(fitted.plan()?.clone())
    } else {
        None
    };
    let filter = stage.setup.filter(options.method, 1.0);
    let source = Source::new(&rays, &stage.setup.scene.light, plan.as_ref(), filter, samples)?;

    let key = source.key(&stage.setup.scene.meshes, &receivers(&surfaces, conditions.width));
    let cache = Cache::open(&directory, key, conditions.width)?;
    let message = format!("truth of {}", stage.setup.scene.name);
    let (estimates, rows_kept) = in_blocks(&message, &cache, &source, &surfaces, pixels.size_px)?;

    let visibility: Vec<f32> = estimates.iter().map(|estimate| estimate.visibility).collect();
    let finer = stage.receivers(pixels.size_px, PICTURE_SAMPLES_PER_SIDE)?;
    let finer_surfaces = finer.read_surfaces(&stage.gpu)?;
    let spread = picture::spread(&visibility, &surfaces, conditions.width, &finer_surfaces, PICTURE_SAMPLES_PER_SIDE);
    let texture = stage.upload_visibility(&finer, &spread);
    write_png(&picture_path, &stage.picture(&finer, &texture, PICTURE_SAMPLES_PER_SIDE)?)?;
    write(&visibility_path, &npy(&visibility, pixels.size_px))?;
    if let Some(path) = &error_path {
        let errors: Vec<f32> = estimates.iter().map(|estimate| estimate.standard_error).collect();
        write(path, &npy(&errors, pixels.size_px))?;
    }
    let record = TruthRecord::new(&stage, options, samples, &estimates, rows_kept, key.to_string());
    write_json(&record_path, &record)?;

    println!("{rows_kept} of {} rows from {}", conditions.height, directory.join(key.to_string()).display());
    let paths = [Some(picture_path), Some(visibility_path), error_path, Some(record_path)];
    println!("{}", paths.iter().flatten().map(|path| path.display().to_string()).collect::<Vec<_>>().join(", "));
    Ok(())
}

/// Where users expect what may be deleted: `~/.cache` on Linux, `~/Library/Caches` on macOS, `%LOCALAPPDATA%` on
/// Windows.
fn default_cache() -> Option<PathBuf> {
    Some(dirs::cache_dir()?.join(Path::new("scumble/truth")))
}

/// The estimates of all pixels, and how many rows of them were found in the cache. Pixels without a surface are lit.
fn in_blocks(
    message: &str,
    cache: &Cache,
    source: &Source,
    surfaces: &[Option<Surface>],
    size_px: [u32; 2],
) -> Result<(Vec<Estimate>, u32)> {
    let [width, height] = size_px;
    let blocks: Vec<Rows> = (0..height)
        .step_by(ROWS_OF_BLOCK as usize)
        .map(|first| Rows { first, count: ROWS_OF_BLOCK.min(height - first) })
        .collect();
    let kept: Vec<Option<Vec<Estimate>>> = blocks.iter().map(|&rows| read_or_warn(cache, rows)).collect();
    let missing = blocks.iter().zip(&kept).filter(|(_, kept)| kept.is_none());
    let bar = progress(message, missing.map(|(rows, _)| seen(&surfaces[rows.pixels(width)])).sum());

    let mut rows_kept = 0;
    let mut estimates = Vec::with_capacity(surfaces.len());
    for (rows, kept) in blocks.into_iter().zip(kept) {
        if let Some(kept) = kept {
            rows_kept += rows.count;
            estimates.extend(kept);
            continue;
        }
        let of_block = of_rows(source, surfaces, width, rows, |done| bar.inc(done as u64));
        cache.write(rows, &of_block)?;
        estimates.extend(of_block);
    }
    bar.finish_and_clear();
    Ok((estimates, rows_kept))
}

/// A block of the cache; one that cannot be trusted is named and left out.
fn read_or_warn(cache: &Cache, rows: Rows) -> Option<Vec<Estimate>> {
    cache.read(rows).unwrap_or_else(|reason| {
        eprintln!("warning: {}: {reason}; its rows are computed anew", cache.path(rows).display());
        None
    })
}

/// Estimates of some rows of a picture `width` wide.
fn of_rows(
    source: &Source,
    surfaces: &[Option<Surface>],
    width: u32,
    rows: Rows,
    progress: impl Fn(usize) + Sync,
) -> Vec<Estimate> {
    let pixels = rows.pixels(width);
    let mut estimates = vec![Estimate { visibility: 1.0, standard_error: 0.0 }; pixels.len()];
    let (places, receivers): (Vec<usize>, Vec<Receiver>) = pixels
        .clone()
        .filter_map(|pixel| Some((pixel - pixels.start, receiver(surfaces[pixel].as_ref()?, pixel, width))))
        .unzip();
    for (place, estimate) in places.into_iter().zip(source.estimates(&receivers, progress)) {
        estimates[place] = estimate;
    }
    estimates
}

/// Visibility without texels of every pixel of a picture `width_px` wide; 1 where there is no surface or the light has
/// no view. The plan's fit says where the reference plane is, on which radii are measured.
pub fn true_visibility(
    message: &str,
    rays: &Rays,
    filter: &Filter,
    plan: &Plan,
    surfaces: &[Option<Surface>],
    width_px: u32,
) -> Vec<f32> {
    let source = match plan.views().first() {
        None => Source::Open,
        Some(view) => Source::Kernel(KernelTruth::new(rays, &view.fit, *filter)),
    };
    let bar = progress(message, seen(surfaces));
    let whole = Rows { first: 0, count: surfaces.len() as u32 / width_px };
    let estimates = of_rows(&source, surfaces, width_px, whole, |done| bar.inc(done as u64));
    bar.finish_and_clear();
    estimates.into_iter().map(|estimate| estimate.visibility).collect()
}

/// Pixels that show a surface.
fn seen(surfaces: &[Option<Surface>]) -> u64 {
    surfaces.iter().flatten().count() as u64
}

/// What is seen in the pixels of a picture that show a surface.
fn receivers(surfaces: &[Option<Surface>], width_px: u32) -> Vec<Receiver> {
    let seen = surfaces.iter().enumerate();
    seen.filter_map(|(index, surface)| Some(receiver(surface.as_ref()?, index, width_px))).collect()
}

/// What is seen in the pixel `index` of rows `width_px` wide.
fn receiver(surface: &Surface, index: usize, width_px: u32) -> Receiver {
    let (position, normal, index) = (surface.position, surface.normal.normalize_or_zero(), index as u32);
    Receiver { position, normal, pixel: [index % width_px, index / width_px] }
}
