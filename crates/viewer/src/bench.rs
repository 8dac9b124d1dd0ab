//! `bench`: what a size costs and what it changes, by scene and method.
//!
//! Times are medians over frames in which the variants take turns, so that a machine that warms up or gets busy does so
//! for all of them. Errors are of the visibility at every pixel, against the same filter over the hard shadow without
//! texels, on the surface around the very positions and normals that the shader saw: what the texel does, its bias, and
//! the tangent plane that a map compares with where the surface is folded.
//!
//! Each row is on the disk when it is done ([`partial`]), so that a run that was killed goes on.

mod against;
mod column;
mod comparison;
mod demand;
mod difference;
mod edges;
#[cfg(test)]
mod examples;
mod markdown;
mod partial;
mod pictures;
mod record;
mod reference;
mod report;
mod row;
mod scene;
mod sweep;
mod trade;
mod walk;

use std::path::{Path, PathBuf};

use anyhow::{Result, ensure};
use scumble_reference::LightTruth;

use crate::bench::against::changes;
use crate::bench::column::{descriptions, table};
use crate::bench::markdown::{MARKDOWN_MARK, markdown};
use crate::bench::partial::{Header, Partial};
use crate::bench::record::{BenchRecord, OptionsRecord, SCHEMA};
use crate::bench::reference::pairs;
use crate::bench::report::{REPORT_MARK, report};
use crate::bench::scene::{bench_scene, is_finished, rows_of_scene, walk_scene};
use crate::bench::trade::trades;
use crate::cli::{Bench, Conditions};
use crate::device::Gpu;
use crate::output::{Kind, claim, make_directory, write, write_json};
use crate::progress::{progress, say};
use crate::record::{MachineRecord, RatioRecord};
use crate::scenes::available;
use crate::setup::{Setup, assets};
use crate::stage::Stage;
use crate::truth::Store;

/// Where the results go.
struct Results {
    table: PathBuf,
    record: PathBuf,
    report: PathBuf,
    markdown: PathBuf,
}

/// Runs the command.
pub fn run(options: &Bench) -> Result<()> {
    // Everything that can be refused is refused before the first frame.
    let is_complete = !options.sizes.is_empty() && !options.methods.is_empty() && !options.softness.is_empty();
    ensure!(is_complete, "--sizes, --methods and --softness need one entry at least");
    let (samples, allowed) = (options.light_samples(), LightTruth::SAMPLES);
    ensure!(allowed.contains(&samples), "--light-samples {samples}: one of {allowed:?} is allowed");
    let old = options.against.as_deref().map(BenchRecord::read).transpose()?;
    let conditions = conditions(options);
    let setups = open_scenes(options, &conditions)?;
    let Some(ratio) = setups.first().map(RatioRecord::of) else { return Ok(()) };
    make_directory(&options.out)?;
    let results = Results {
        table: claim(&options.out.join("bench.csv"), Kind::Csv)?,
        record: claim(&options.out.join("bench.json"), Kind::Json(SCHEMA))?,
        report: claim(&options.out.join("report.html"), Kind::Html(REPORT_MARK))?,
        markdown: claim(&options.out.join("bench.md"), Kind::Markdown(MARKDOWN_MARK))?,
    };
    let store = Store::new(options.cache.as_deref())?;
    let gpu = Gpu::open()?;
    let machine = MachineRecord::of(&gpu);
    let names: Vec<String> = setups.iter().map(|setup| setup.scene.name.clone()).collect();
    let asked = OptionsRecord::new(options, &names, &conditions);
    let mut partial = Partial::open(&options.out, &Header::new(&asked, &machine, &ratio))?;

    // The scenes, one after the other.
    let count = names.len() * rows_of_scene(options);
    let rows = progress("rows", count as u64);
    rows.set_position(partial.rows().len() as u64);
    partial.rows().iter().for_each(|row| say(format_args!("{row}  (of the run before)")));
    for setup in
        setups.into_iter().filter(|setup| !is_finished(options, &partial, &setup.scene.name)).collect::<Vec<_>>()
    {
        let mut stage = Stage::new(gpu.clone(), setup)?;
        let size_px = [conditions.width, conditions.height];
        bench_scene(options, size_px, &stage, &store, &mut partial, &rows)?;
        walk_scene(options, size_px, &mut stage, &mut partial)?;
    }
    rows.finish_and_clear();

    // The results.
    let record = BenchRecord {
        schema: SCHEMA.into(),
        machine,
        ratio,
        columns: descriptions(&asked),
        options: asked,
        rows: partial.rows().to_vec(),
        demand: partial.demand().to_vec(),
        walks: partial.walks().to_vec(),
        sweep: partial.sweep().to_vec(),
    };
    write(&results.table, table(&record.options, &record.rows)?.as_bytes())?;
    write_json(&results.record, &record)?;
    write(&results.report, report(&record, &options.out)?.as_bytes())?;
    write(&results.markdown, markdown(&record).as_bytes())?;
    partial.remove()?;
    pairs(&record.rows).iter().for_each(|pair| println!("{pair}"));
    trades(&record.rows).iter().for_each(|trade| println!("{trade}"));
    println!("{}, {}, {}", results.table.display(), results.record.display(), results.markdown.display());
    println!("Report: {}", results.report.display());
    if let Some(old) = old {
        println!("{}", changes(&old, &record)?);
    }
    Ok(())
}

/// Makes the report of a folder's record anew.
pub fn remake_report(folder: &Path) -> Result<()> {
    let record = BenchRecord::read(&folder.join("bench.json"))?;
    let path = claim(&folder.join("report.html"), Kind::Html(REPORT_MARK))?;
    write(&path, report(&record, folder)?.as_bytes())?;
    println!("Report: {}", path.display());
    Ok(())
}

/// The conditions that the options come to.
fn conditions(options: &Bench) -> Conditions {
    let mut conditions = options.conditions.clone();
    if options.quick {
        conditions.width = conditions.width.div_ceil(2);
        conditions.height = conditions.height.div_ceil(2);
    }
    conditions
}

/// Every scene is opened before the first is measured, so that a slip in the last name costs no time.
fn open_scenes(options: &Bench, conditions: &Conditions) -> Result<Vec<Setup>> {
    let scenes = match &options.scenes[..] {
        [] => available(&assets(conditions.assets.as_deref())),
        named => named.to_vec(),
    };
    let setups = scenes.iter().map(|scene| Setup::open(scene, None, conditions)).collect::<Result<Vec<_>>>()?;
    for (index, setup) in setups.iter().enumerate() {
        let name = &setup.scene.name;
        let is_new = setups[..index].iter().all(|other| other.scene.name != *name);
        options.softness.iter().try_for_each(|&softness| setup.light(softness).map(drop))?;
        ensure!(is_new, "--scenes: two scenes are named {name}; results are kept by name, so run them one by one");
    }
    Ok(setups)
}
