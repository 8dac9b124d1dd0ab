//! bench.json: everything that a run measured, with what it was asked for and where it took place.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, anyhow, bail};
use scumble::AtCap;
use serde::{Deserialize, Serialize};

use crate::bench::column::Description;
use crate::bench::demand::DemandHistogram;
use crate::bench::row::Row;
use crate::bench::sweep::SweepPoint;
use crate::bench::walk::Walk;
use crate::cli::{Bench, Conditions};
use crate::record::{MachineRecord, RatioRecord};

/// What the record says it is.
pub const SCHEMA: &str = "scumble/bench/4";

/// bench.json.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BenchRecord {
    /// [`SCHEMA`].
    pub schema: String,
    /// Device, driver, versions, commit.
    pub machine: MachineRecord,
    /// The relation of the adaptive sizes and of the violations.
    pub ratio: RatioRecord,
    /// What was asked for.
    pub options: OptionsRecord,
    /// What the columns of bench.csv mean.
    pub columns: Vec<Description>,
    /// By scene, method and size.
    pub rows: Vec<Row>,
    /// The texels that the screen asks for, by scene and soft filter.
    pub demand: Vec<DemandHistogram>,
    /// By scene, filter and path; empty unless asked for.
    pub walks: Vec<Walk>,
    /// By scene, method and ratio; empty unless it was asked for.
    pub sweep: Vec<SweepPoint>,
}

/// The options that the numbers depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OptionsRecord {
    /// In the order of the run.
    pub scenes: Vec<String>,
    /// As the command line spells them.
    pub methods: Vec<String>,
    /// Times the filter radius and light size.
    pub softness: Vec<f64>,
    /// As the command line spells them.
    pub sizes: Vec<String>,
    /// Timed frames of every variant.
    pub frames: u32,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Rays of every pixel to the light.
    pub light_samples: u32,
    /// One sample per pixel in the pictures.
    pub quick: bool,
    /// Paths of camera and light.
    pub paths: Vec<String>,
    /// Whether the ratio was varied, too.
    pub sweep_ratio: bool,
    /// Most texels per side of an adaptive map.
    pub cap: u32,
    /// What gives way there.
    pub at_cap: AtCap,
    /// Maps of a sun.
    #[serde(default = "one_map")]
    pub cascades: u32,
    /// Half angle in degrees of a sun, radius in metres of a lamp; null for each scene's own.
    pub light_size: Option<f64>,
    /// Radius of pcf in metres at the shadow; null for each scene's own.
    pub radius: Option<f64>,
}

/// What records hold that were written before there were cascades.
fn one_map() -> u32 {
    1
}

impl OptionsRecord {
    /// Of the command line, with the scenes and the picture's size that it comes to.
    pub fn new(options: &Bench, scenes: &[String], conditions: &Conditions) -> Self {
        Self {
            scenes: scenes.to_vec(),
            methods: options.methods.iter().map(|method| method.name().to_owned()).collect(),
            softness: options.softness.clone(),
            sizes: options.sizes.iter().map(ToString::to_string).collect(),
            frames: options.frames,
            width: conditions.width,
            height: conditions.height,
            light_samples: options.light_samples(),
            quick: options.quick,
            paths: options.paths.iter().map(|path| path.name().to_owned()).collect(),
            sweep_ratio: options.sweep_ratio,
            cap: conditions.cap,
            at_cap: conditions.at_cap.at_cap(),
            cascades: conditions.cascades,
            light_size: conditions.light_size,
            radius: conditions.radius,
        }
    }
}

impl BenchRecord {
    /// Reads the record of a former run.
    ///
    /// # Errors
    /// One line that names the file and what is expected: a file that cannot be read, is cut off, or has another schema.
    pub fn read(path: &Path) -> Result<Self> {
        let text = fs::read_to_string(path).with_context(|| format!("{}: cannot be read", path.display()))?;
        Self::parse(&text).map_err(|error| anyhow!("{}: {error}", path.display()))
    }

    fn parse(text: &str) -> Result<Self> {
        let value: serde_json::Value =
            serde_json::from_str(text).map_err(|error| anyhow!("a whole bench.json is expected: {error}"))?;
        match value["schema"].as_str() {
            Some(SCHEMA) => {}
            Some(other) => bail!("has the schema {other}; {SCHEMA} is expected, which this version's bench writes"),
            None => bail!("has no schema; a bench.json of {SCHEMA} is expected"),
        }
        serde_json::from_value(value).map_err(|error| anyhow!("is no bench.json of {SCHEMA}: {error}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::examples;

    #[test]
    fn a_record_is_read_as_it_was_written() {
        let record = examples::record(vec![examples::row("yard", "pcf", "adaptive", 3.0, 0.05)]);
        assert_eq!(BenchRecord::parse(&serde_json::to_string(&record).unwrap()).unwrap(), record);
    }

    #[test]
    fn a_record_of_another_version_or_cut_off_is_refused_with_what_is_expected() {
        let whole = serde_json::to_string(&examples::record(vec![])).unwrap();
        let old = whole.replace(SCHEMA, "scumble/bench/1");
        for (text, found) in [(&old[..], "scumble/bench/1"), (&whole[..whole.len() / 2], "whole"), ("{}", "no schema")]
        {
            let refused = BenchRecord::parse(text).unwrap_err().to_string();
            assert!(refused.contains(found) && refused.contains("bench"), "{refused}");
            assert!(!refused.contains('\n'));
        }
    }
}
