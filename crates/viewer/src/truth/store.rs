//! Truths by what they depend on: what was computed before is read, the rest is computed and kept.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use scumble_reference::{Estimate, Receiver};
use scumble_scenes::Mesh;

use crate::gbuffer::Surface;
use crate::progress::progress;
use crate::truth::cache::{Cache, Rows};
use crate::truth::key::Key;
use crate::truth::source::Source;

/// Rows that are kept in the cache at a time: some seconds of work, which is what a kill loses.
const ROWS_OF_BLOCK: u32 = 16;

/// A folder of truths.
pub struct Store {
    directory: PathBuf,
}

/// A truth that was found or computed.
pub struct Found {
    /// Of every pixel; those without a surface are lit.
    pub estimates: Vec<Estimate>,
    /// Rows that were there.
    pub rows_kept: u32,
    /// By which it is found again.
    pub key: Key,
    /// Where it is.
    pub folder: PathBuf,
}

impl Store {
    /// The folder asked for, else the one of the system.
    pub fn new(asked: Option<&Path>) -> Result<Self> {
        let directory = asked.map(Path::to_owned).or_else(default_cache).context(
            "--cache DIR is needed: this system names no folder for caches, and a truth that is cut off goes on from there",
        )?;
        Ok(Self { directory })
    }

    /// The truth of every pixel of a picture.
    pub fn find(
        &self,
        message: &str,
        source: &Source,
        meshes: &[Mesh],
        surfaces: &[Option<Surface>],
        size_px: [u32; 2],
    ) -> Result<Found> {
        let key = source.key(meshes, &receivers(surfaces, size_px[0]));
        let cache = Cache::open(&self.directory, key, size_px[0])?;
        let (estimates, rows_kept) = in_blocks(message, &cache, source, surfaces, size_px)?;
        Ok(Found { estimates, rows_kept, key, folder: self.directory.join(key.to_string()) })
    }
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
