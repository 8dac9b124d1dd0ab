//! `bench`: what a size costs and what it changes, by scene and method.
//!
//! Times are medians over frames in which the variants take turns, so that a machine that warms up or gets busy does so
//! for all of them. Errors are of the visibility at every pixel, against the same filter over the hard shadow without
//! texels, on the surface around the very positions and normals that the shader saw: what the texel does, its bias, and
//! the tangent plane that a map compares with where the surface is folded.
//!
//! Each row is on the disk when it is done ([`partial`]), so that a run that was killed goes on.

mod against;
mod cell;
mod column;
mod comparison;
mod demand;
mod difference;
mod edges;
#[cfg(test)]
mod examples;
mod markdown;
mod pair;
mod partial;
mod pictures;
mod record;
mod report;
mod row;
mod scene;
mod sweep;
mod trade;
mod violation;
mod walk;

use std::fmt;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use scumble_reference::LightTruth;

use crate::bench::against::changes;
use crate::bench::column::{descriptions, table};
use crate::bench::markdown::{MARKDOWN_MARK, markdown};
use crate::bench::pair::pairs;
use crate::bench::partial::{Header, Partial};
use crate::bench::record::{BenchRecord, OptionsRecord, SCHEMA};
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

/// Why the whole catalogue may be nothing.
const NO_SCENE: &str = "no scene of the catalogue has its models here: `scumble-viewer scenes` says what is absent";

/// Runs the command.
pub fn run(options: &Bench) -> Result<()> {
    // Everything that can be refused is refused before the first frame.
    let (samples, allowed) = (options.light_samples(), LightTruth::SAMPLES);
    ensure!(allowed.contains(&samples), "--light-samples {samples}: one of {allowed:?} is allowed");
    let old = options.against.as_deref().map(BenchRecord::read).transpose()?;
    let conditions = conditions(options);
    let setups = open_scenes(options, &conditions)?;
    let ratio = RatioRecord::of(setups.first().context(NO_SCENE)?);
    let results = Results::claim(&options.out)?;
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
    let size_px = [conditions.width, conditions.height];
    for setup in setups {
        if is_finished(options, &partial, &setup.scene.name) {
            continue;
        }
        let mut stage = Stage::new(gpu.clone(), setup)?;
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
    results.write(&record)?;
    partial.remove()?;
    pairs(&record.rows).iter().for_each(|pair| println!("{pair}"));
    trades(&record.rows).iter().for_each(|trade| println!("{trade}"));
    println!("{results}");
    if let Some(old) = old {
        println!("{}", changes(&old, &record)?);
    }
    Ok(())
}

/// Where the results go.
struct Results {
    folder: PathBuf,
    table: PathBuf,
    record: PathBuf,
    report: PathBuf,
    markdown: PathBuf,
}

impl Results {
    /// In a folder, which is made if missing.
    fn claim(folder: &Path) -> Result<Self> {
        make_directory(folder)?;
        Ok(Self {
            folder: folder.to_owned(),
            table: claim(&folder.join("bench.csv"), Kind::Csv)?,
            record: claim(&folder.join("bench.json"), Kind::Json(SCHEMA))?,
            report: claim(&folder.join("report.html"), Kind::Html(REPORT_MARK))?,
            markdown: claim(&folder.join("bench.md"), Kind::Markdown(MARKDOWN_MARK))?,
        })
    }

    fn write(&self, record: &BenchRecord) -> Result<()> {
        write(&self.table, table(&record.options, &record.rows)?.as_bytes())?;
        write_json(&self.record, record)?;
        write(&self.report, report(record, &self.folder)?.as_bytes())?;
        write(&self.markdown, markdown(record).as_bytes())
    }
}

impl fmt::Display for Results {
    /// The paths, the report on a line of its own.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let tables = [&self.table, &self.record, &self.markdown].map(|path| path.display().to_string());
        write!(formatter, "{}\nReport: {}", tables.join(", "), self.report.display())
    }
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
