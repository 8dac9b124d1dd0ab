//! `bench`: what a size costs and what it changes, by scene and method.
//!
//! Times are medians over frames in which the variants take turns, so that a machine that warms up or gets busy does so
//! for all of them. Errors are of the visibility at every pixel, against the same filter over the hard shadow without
//! texels, on the surface around the very positions and normals that the shader saw: what the texel does, its bias, and
//! the tangent plane that a map compares with where the surface is folded.

mod comparison;
mod pictures;
mod row;

use std::path::Path;

use anyhow::{Result, ensure};
use indicatif::{ProgressBar, ProgressStyle};
use scumble_reference::Rays;
use serde::Serialize;

use crate::bench::comparison::{Screen, compare};
use crate::bench::row::{Row, Timings, table};
use crate::cli::{Bench, Size};
use crate::device::Gpu;
use crate::output::{Kind, claim, make_directory, write, write_json};
use crate::record::{MachineRecord, RatioRecord};
use crate::setup::Setup;
use crate::stage::Stage;
use crate::timer::Timer;
use crate::truth::true_visibility;
use crate::variant::Variant;

/// What the record says it is.
const SCHEMA: &str = "scumble/bench/1";

/// Samples per pixel along x and along y of the pictures.
const SAMPLES_PER_SIDE: u32 = 2;

/// bench.json.
#[derive(Serialize)]
struct BenchRecord<'a> {
    schema: &'static str,
    machine: MachineRecord,
    ratio: RatioRecord,
    width: u32,
    height: u32,
    frames: u32,
    rows: &'a [Row],
}

/// Runs the command.
pub fn run(options: &Bench) -> Result<()> {
    ensure!(!options.sizes.is_empty() && !options.methods.is_empty(), "--sizes and --methods need one entry at least");
    let scenes = match &options.scenes[..] {
        [] => scumble_scenes::catalogue().iter().map(|entry| entry.name.to_owned()).collect(),
        named => named.to_vec(),
    };
    make_directory(&options.out)?;
    let table_path = claim(&options.out.join("bench.csv"), Kind::Csv)?;
    let record_path = claim(&options.out.join("bench.json"), Kind::Json(SCHEMA))?;
    let mut conditions = options.conditions.clone();
    if options.quick {
        conditions.width = conditions.width.div_ceil(2);
        conditions.height = conditions.height.div_ceil(2);
    }
    // Every scene is opened before the first is measured, so that a slip in the last name costs no time.
    let setups = scenes.iter().map(|scene| Setup::open(scene, &conditions)).collect::<Result<Vec<_>>>()?;
    let Some(ratio) = setups.first().map(RatioRecord::of) else { return Ok(()) };

    let gpu = Gpu::open()?;
    let machine = MachineRecord::of(&gpu);
    let size_px = [conditions.width, conditions.height];
    let mut rows = Vec::new();
    for setup in setups {
        rows.extend(bench_scene(options, size_px, Stage::new(gpu.clone(), setup)?)?);
    }

    write(&table_path, table(&rows)?.as_bytes())?;
    let record = BenchRecord {
        schema: SCHEMA,
        machine,
        ratio,
        width: size_px[0],
        height: size_px[1],
        frames: options.frames,
        rows: &rows,
    };
    write_json(&record_path, &record)?;
    rows.iter().for_each(|row| println!("{row}"));
    println!("{}, {}", table_path.display(), record_path.display());
    Ok(())
}

fn bench_scene(options: &Bench, size_px: [u32; 2], stage: Stage) -> Result<Vec<Row>> {
    let name = stage.setup.scene.name.clone();
    let receivers = stage.receivers(size_px, 1)?;
    let mut timer = Timer::new(&stage.gpu);
    let mut variants = Vec::new();
    for &method in &options.methods {
        for &size in &options.sizes {
            variants.push(Variant::new(&stage, &receivers, method, size)?);
        }
    }

    let bar = progress(&format!("{name}: frames"), u64::from(options.frames) + 1);
    for variant in &mut variants {
        variant.settle(&stage, &receivers, &mut timer)?;
    }
    bar.inc(1);
    let mut timings: Vec<Timings> = variants.iter().map(|_| Timings::default()).collect();
    for _ in 0..options.frames {
        for (variant, timing) in variants.iter_mut().zip(&mut timings) {
            let times = variant.frame(&stage, &receivers, &mut timer)?;
            timing.add(&times);
        }
        bar.inc(1);
    }
    bar.finish_and_clear();

    let mut rows = Vec::new();
    let surfaces = receivers.read_surfaces(&stage.gpu)?;
    let screen = Screen::new(&stage.setup.scene.light, surfaces, size_px);
    let samples_per_side = if options.quick { 1 } else { SAMPLES_PER_SIDE };
    let rays = Rays::new(&stage.setup.scene);
    for &method in &options.methods {
        let Some(first) = variants.iter().find(|variant| variant.method == method) else { continue };
        let plan = &first.plan()?.clone();
        let filter = stage.setup.filter(method);
        let message = format!("{name}: truth of {}", method.name());
        let truth = true_visibility(&message, &rays, &filter, plan, &screen.surfaces, size_px[0]);

        let directory = options.out.join(directory_name(&name)).join(method.name());
        make_directory(&directory)?;
        let pictures = pictures::Pictures::new(&stage, &directory, size_px, samples_per_side)?;
        let truth_picture = pictures.truth(&rays, &filter, plan, &truth)?;
        let of_method = variants.iter_mut().zip(&timings).filter(|(variant, _)| variant.method == method);
        for (variant, timing) in of_method {
            let visibility = variant.read_visibility(&stage)?;
            let radii = variant.read_radii(&stage, &receivers)?;
            let comparison = compare(&stage, variant, &screen, &visibility, &truth, &radii)?;
            let label = label(variant.size, &options.sizes);
            let files = pictures.variant(variant, &label, &visibility, &truth, &screen.lit_facing, &truth_picture)?;
            rows.push(Row::new(&stage, variant, size_px, timing, comparison, files, &options.out)?);
        }
    }
    Ok(rows)
}

/// `adaptive`, `fixed` for the largest fixed size, `fixed-512` for others.
fn label(size: Size, sizes: &[Size]) -> String {
    let area = |size: &Size| match size {
        Size::Fixed([across, down]) => u64::from(*across) * u64::from(*down),
        Size::Adaptive => 0,
    };
    match size {
        Size::Adaptive => "adaptive".into(),
        _ if Some(area(&size)) == sizes.iter().map(area).max() => "fixed".into(),
        _ => format!("fixed-{size}"),
    }
}

/// A scene's name as a folder's, whatever its file was called.
fn directory_name(scene: &str) -> String {
    let safe = |character: char| if character.is_alphanumeric() || "-_".contains(character) { character } else { '-' };
    scene.chars().map(safe).collect()
}

/// A bar on standard error; nothing is drawn where that is no terminal.
pub fn progress(message: &str, length: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg:32} {wide_bar} {percent:>3} % {eta:>4}");
    let bar = ProgressBar::new(length).with_message(message.to_owned());
    match style {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// A path inside the results, as the records name it.
fn relative(path: &Path, out: &Path) -> String {
    path.strip_prefix(out).unwrap_or(path).to_string_lossy().replace('\\', "/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_fixed_size_is_the_fixed_one() {
        let sizes = [Size::Fixed([512, 512]), Size::Adaptive, Size::Fixed([1024, 2048])];
        assert_eq!(sizes.map(|size| label(size, &sizes)), ["fixed-512", "adaptive", "fixed"]);
    }

    #[test]
    fn a_scene_cannot_name_a_folder_elsewhere() {
        assert_eq!(directory_name("../my scene.v2"), "---my-scene-v2");
    }
}
