//! What the demonstration found, read from the files that its programs wrote, and the promises it has to keep.

use anyhow::{Context, Result, ensure};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::fmt;
use std::path::Path;

/// Median ratio of the simulated people: Kreuzer (2017), Eq. 5.1.
pub const TRUE_RATIO: f64 = 3.47;
/// Largest share by which twelve people may miss it. Between people the SD is 0.1 log10, so the mean of twelve has a
/// standard error of 7 %.
const RATIO_TOLERANCE: f64 = 0.15;
/// Adaptive maps use at most this share of the texels of fixed maps of 2048 x 2048.
const TEXEL_SHARE_MAX: f64 = 0.25;

/// RMS error of the shadow fraction over all lit sides: a shadow that is missing from 1 % of them costs as much.
const ERROR_MAX: f64 = 0.1;

/// The version of `bench.json` that is read here.
const BENCH_SCHEMA: &str = "scumble/bench/4";

/// The demonstration's numbers.
pub struct Summary {
    /// The fitted relation.
    pub relation: Relation,
    /// The benchmark.
    pub bench: Bench,
}

/// The part of `relation.json` that is shown.
#[derive(Deserialize)]
pub struct Relation {
    pub ratio: Estimate,
    pub people: u64,
    pub trials: u64,
}

#[derive(Deserialize)]
pub struct Estimate {
    pub value: f64,
    pub ci95: [f64; 2],
}

/// The part of `bench.json` that is shown.
#[derive(Deserialize)]
pub struct Bench {
    schema: String,
    pub machine: Machine,
    pub options: Options,
    pub rows: Vec<Row>,
}

/// What the benchmark was asked for.
#[derive(Deserialize)]
pub struct Options {
    pub width: u32,
    pub height: u32,
    pub frames: u32,
}

#[derive(Deserialize)]
pub struct Machine {
    pub device: String,
    pub driver: String,
}

/// One scene, method and size.
#[derive(Deserialize)]
pub struct Row {
    pub scene: String,
    pub triangles: u64,
    pub method: String,
    pub size: String,
    pub texels: u64,
    pub maps: Vec<Map>,
    pub times_ms: Times,
    pub comparison: Comparison,
    pub pictures: Pictures,
}

#[derive(Deserialize)]
pub struct Map {
    /// x, y, width, height in texels.
    pub viewport: [u32; 4],
    /// The screen asks for more than the largest size allowed.
    pub capped: bool,
}

/// Absent where the device has no timestamps.
#[derive(Deserialize)]
pub struct Times {
    pub depth: Option<Spread>,
    pub demand: Option<Spread>,
    pub evaluation: Option<Spread>,
}

#[derive(Deserialize)]
pub struct Spread {
    pub median: f64,
    pub lower_quartile: f64,
    pub upper_quartile: f64,
}

#[derive(Deserialize)]
pub struct Comparison {
    pub lit_facing: Error,
    pub penumbra: Error,
    /// Share of the penumbra whose filter is narrower than the relation asks for.
    pub violation_share: Option<f64>,
}

/// Of the shadow fraction, against the kernel truth.
#[derive(Deserialize)]
pub struct Error {
    pub max: f64,
    pub p99: f64,
    pub rms: f64,
}

/// Paths below the benchmark's folder.
#[derive(Deserialize)]
pub struct Pictures {
    pub picture: String,
    pub error_map: String,
    pub truth: String,
}

impl Row {
    /// `447 x 512`, for every map.
    pub fn size_texels(&self) -> String {
        let size = |map: &Map| format!("{} x {}", map.viewport[2], map.viewport[3]);
        self.maps.iter().map(size).collect::<Vec<_>>().join(", ")
    }

    /// Whether an adaptive size gave way to the cap.
    pub fn is_capped(&self) -> bool {
        self.is_adaptive() && self.maps.iter().any(|map| map.capped)
    }

    /// Whether the size was chosen by the relation.
    pub fn is_adaptive(&self) -> bool {
        self.size == "adaptive"
    }
}

impl Summary {
    /// Reads `relation.json` and `bench/bench.json` of a demonstration's folder.
    pub fn read(folder: &Path) -> Result<Self> {
        let bench: Bench = read(&folder.join("bench/bench.json"))?;
        ensure!(bench.schema == BENCH_SCHEMA, "bench.json has the schema {}; {BENCH_SCHEMA} is expected", bench.schema);
        Ok(Self { relation: read(&folder.join("relation.json"))?, bench })
    }

    /// Each fixed row with the adaptive row of the same scene and method.
    pub fn pairs(&self) -> Vec<(&Row, &Row)> {
        let rows = &self.bench.rows;
        let adaptive = |fixed: &&Row| {
            let same = |row: &&Row| row.is_adaptive() && row.scene == fixed.scene && row.method == fixed.method;
            rows.iter().find(same)
        };
        let fixed = rows.iter().filter(|row| !row.is_adaptive());
        fixed.filter_map(|fixed| Some((fixed, adaptive(&fixed)?))).collect()
    }

    /// The promises: a ratio near the true one, few texels, and an error of both sizes against the same truth.
    pub fn check(&self) -> Result<()> {
        let ratio = self.relation.ratio.value;
        ensure!(
            (ratio / TRUE_RATIO - 1.0).abs() <= RATIO_TOLERANCE,
            "the fitted ratio {ratio:.3} is not within {:.0} % of {TRUE_RATIO}",
            100.0 * RATIO_TOLERANCE
        );
        let pairs = self.pairs();
        ensure!(!pairs.is_empty(), "the benchmark compared no adaptive map with a fixed one");
        for (fixed, adaptive) in pairs {
            let name = format!("{} {}", adaptive.scene, adaptive.method);
            let share = adaptive.texels as f64 / fixed.texels as f64;
            ensure!(share <= TEXEL_SHARE_MAX, "{name}: the adaptive map has {share:.2} of the fixed map's texels");
            ensure!(fixed.pictures.truth == adaptive.pictures.truth, "{name}: two truths");
            for row in [fixed, adaptive] {
                let rms = row.comparison.lit_facing.rms;
                ensure!(rms < ERROR_MAX, "{name} {}: the RMS error of {rms:.3} is not below {ERROR_MAX}", row.size);
            }
        }
        Ok(())
    }
}

fn read<T: DeserializeOwned>(path: &Path) -> Result<T> {
    let text = std::fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))?;
    serde_json::from_str(&text).with_context(|| format!("{} is not as expected", path.display()))
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Relation { ratio, people, trials } = &self.relation;
        let [low, high] = ratio.ci95;
        writeln!(f, "Fitted ratio: {:.2} texels [{low:.2}, {high:.2}], {people} people, {trials} trials", ratio.value)?;
        let Bench { machine, options: Options { width, height, frames }, .. } = &self.bench;
        writeln!(f, "{}, {}; {width} x {height}, medians of {frames} frames", machine.device, machine.driver)?;
        writeln!(
            f,
            "\n{:<10} {:<5} {:<9} {:>12} {:>9} {:>9} {:>9} {:>9} {:>8}",
            "scene", "", "size", "texels", "depth ms", "demand", "shade ms", "RMS", "p99"
        )?;
        for row in &self.bench.rows {
            let time = |spread: &Option<Spread>| spread.as_ref().map_or("-".into(), |s| format!("{:.1}", s.median));
            writeln!(
                f,
                "{:<10} {:<5} {:<9} {:>12} {:>9} {:>9} {:>9} {:>9.4} {:>8.3}",
                row.scene,
                row.method,
                row.size,
                row.size_texels(),
                time(&row.times_ms.depth),
                time(&row.times_ms.demand),
                time(&row.times_ms.evaluation),
                row.comparison.penumbra.rms,
                row.comparison.penumbra.p99
            )?;
        }
        Ok(())
    }
}
