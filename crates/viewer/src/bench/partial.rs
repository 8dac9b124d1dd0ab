//! bench.partial.jsonl: what a run has finished so far, so that one that was killed goes on.
//!
//! The first line says what was asked for and on which machine; a run of anything else is refused. After it, one line
//! for each thing that is done: the times of a scene, whose variants took turns, each row, sweep, path. Lines
//! are appended and brought to the disk one by one; a last line that was cut off is dropped. The file goes when the
//! results are written.

use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use serde::{Deserialize, Serialize};

use crate::bench::demand::DemandHistogram;
use crate::bench::difference::differences;
use crate::bench::record::OptionsRecord;
use crate::bench::row::{Key, Row, Spreads};
use crate::bench::sweep::SweepPoint;
use crate::bench::walk::Walk;
use crate::record::{MachineRecord, RatioRecord};

/// What the first line says the file is.
const SCHEMA: &str = "scumble/bench-partial/1";

/// The first line: what the others are true of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    schema: String,
    options: OptionsRecord,
    machine: MachineRecord,
    ratio: RatioRecord,
}

impl Header {
    /// Of a run.
    pub fn new(options: &OptionsRecord, machine: &MachineRecord, ratio: &RatioRecord) -> Self {
        Self { schema: SCHEMA.into(), options: options.clone(), machine: machine.clone(), ratio: ratio.clone() }
    }
}

/// Any other line.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Entry {
    Times { scene: String, variants: Vec<(Key, Spreads)> },
    Row(Box<Row>),
    Demand(DemandHistogram),
    Walk(Box<Walk>),
    Sweep { scene: String, method: String, points: Vec<SweepPoint> },
}

/// The file and what it holds.
pub struct Partial {
    path: PathBuf,
    file: File,
    times: Vec<(Key, Spreads)>,
    timed_scenes: Vec<String>,
    rows: Vec<Row>,
    demand: Vec<DemandHistogram>,
    walks: Vec<Walk>,
    swept: Vec<(String, String)>,
    sweep: Vec<SweepPoint>,
}

impl Partial {
    /// Goes on with the file in the results folder, or begins it.
    ///
    /// # Errors
    /// A file of another run, with the first difference, and damage other than a cut last line.
    pub fn open(out: &Path, header: &Header) -> Result<Self> {
        let path = out.join("bench.partial.jsonl");
        let text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => String::new(),
            Err(error) => return Err(error).with_context(|| format!("{}: cannot be read", path.display())),
        };
        let whole = &text[..text.rfind('\n').map_or(0, |end| end + 1)];
        let file = OpenOptions::new()
            .create(true)
            .append(true)
            .open(&path)
            .with_context(|| format!("{}: cannot be written", path.display()))?;
        let mut partial = Self {
            path,
            file,
            times: Vec::new(),
            timed_scenes: Vec::new(),
            rows: Vec::new(),
            demand: Vec::new(),
            walks: Vec::new(),
            swept: Vec::new(),
            sweep: Vec::new(),
        };
        let mut lines = whole.lines().enumerate();
        match lines.next() {
            None => {
                partial.file.set_len(0)?;
                partial.append(header)?;
            }
            Some((_, first)) => {
                partial.check(first, header)?;
                partial.file.set_len(whole.len() as u64)?;
            }
        }
        for (index, line) in lines {
            let damaged = || format!("{}: line {} is damaged; delete the file", partial.path.display(), index + 1);
            let entry = serde_json::from_str(line).with_context(damaged)?;
            partial.take(entry);
        }
        Ok(partial)
    }

    fn check(&self, first: &str, header: &Header) -> Result<()> {
        let path = self.path.display();
        let Ok(found) = serde_json::from_str::<Header>(first) else {
            bail!("{path}: is no beginning of a benchmark of this version; delete the file");
        };
        if let Some(difference) = differences(&found, header)?.first() {
            bail!("{path}: was begun by another run ({difference}); repeat that run to go on, or delete the file");
        }
        Ok(())
    }

    fn take(&mut self, entry: Entry) {
        match entry {
            Entry::Times { scene, variants } => {
                self.timed_scenes.push(scene);
                self.times.extend(variants);
            }
            Entry::Row(row) => self.rows.push(*row),
            Entry::Demand(histogram) => self.demand.push(histogram),
            Entry::Walk(walk) => self.walks.push(*walk),
            Entry::Sweep { scene, method, points } => {
                self.swept.push((scene, method));
                self.sweep.extend(points);
            }
        }
    }

    fn append(&mut self, line: &impl Serialize) -> Result<()> {
        let mut text = serde_json::to_string(line)?;
        text.push('\n');
        let written = self.file.write_all(text.as_bytes()).and_then(|()| self.file.sync_data());
        written.with_context(|| format!("{}: cannot be written", self.path.display()))
    }

    fn add(&mut self, entry: Entry) -> Result<()> {
        self.append(&entry)?;
        self.take(entry);
        Ok(())
    }

    /// Keeps the times of all variants of a scene.
    pub fn add_times(&mut self, scene: &str, variants: Vec<(Key, Spreads)>) -> Result<()> {
        self.add(Entry::Times { scene: scene.into(), variants })
    }

    /// Keeps a row.
    pub fn add_row(&mut self, row: Row) -> Result<()> {
        self.add(Entry::Row(Box::new(row)))
    }

    /// Keeps a histogram of the demand.
    pub fn add_demand(&mut self, histogram: DemandHistogram) -> Result<()> {
        self.add(Entry::Demand(histogram))
    }

    /// Keeps a path.
    pub fn add_walk(&mut self, walk: Walk) -> Result<()> {
        self.add(Entry::Walk(Box::new(walk)))
    }

    /// Keeps the sweep of a method.
    pub fn add_sweep(&mut self, scene: &str, method: &str, points: Vec<SweepPoint>) -> Result<()> {
        self.add(Entry::Sweep { scene: scene.into(), method: method.into(), points })
    }

    /// Whether the variants of a scene have been timed.
    pub fn has_times(&self, scene: &str) -> bool {
        self.timed_scenes.iter().any(|timed| timed == scene)
    }

    /// Times of a variant; none without timestamps.
    pub fn times(&self, key: &Key) -> Spreads {
        self.times.iter().find(|(timed, _)| timed == key).map(|(_, spreads)| spreads.clone()).unwrap_or_default()
    }

    /// Whether a row is done.
    pub fn has_row(&self, key: &Key) -> bool {
        self.rows.iter().any(|row| row.key == *key)
    }

    /// Whether the demand on a map, of any size, has been counted.
    pub fn has_demand(&self, key: &Key) -> bool {
        self.demand.iter().any(|histogram| histogram.key.is_beside(key))
    }

    /// Whether a path is done.
    pub fn has_walk(&self, key: &Key, path: &str) -> bool {
        self.walks.iter().any(|walk| walk.key == *key && walk.path == path)
    }

    /// Whether a sweep is done.
    pub fn has_sweep(&self, scene: &str, method: &str) -> bool {
        self.swept.iter().any(|(swept, by)| swept == scene && by == method)
    }

    /// Rows that are done.
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// Histograms of the demand, by scene and filter.
    pub fn demand(&self) -> &[DemandHistogram] {
        &self.demand
    }

    /// Paths that are done.
    pub fn walks(&self) -> &[Walk] {
        &self.walks
    }

    /// Points of all sweeps that are done.
    pub fn sweep(&self) -> &[SweepPoint] {
        &self.sweep
    }

    /// Removes the file, after the results were written.
    pub fn remove(self) -> Result<()> {
        fs::remove_file(&self.path).with_context(|| format!("{}: cannot be removed", self.path.display()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::examples;

    fn header() -> Header {
        let record = examples::record(vec![]);
        Header::new(&record.options, &record.machine, &record.ratio)
    }

    fn begun(out: &Path) -> PathBuf {
        let mut partial = Partial::open(out, &header()).unwrap();
        let row = examples::row("yard", "pcf", "2048", 3.0, 0.05);
        partial.add_times("yard", vec![(row.key.clone(), row.times_ms.clone())]).unwrap();
        partial.add_row(row).unwrap();
        partial.path
    }

    #[test]
    fn a_killed_run_goes_on_behind_its_last_whole_line() {
        let out = tempfile::tempdir().unwrap();
        let path = begun(out.path());
        let row = examples::row("yard", "pcf", "2048", 3.0, 0.05);
        OpenOptions::new().append(true).open(&path).unwrap().write_all(b"{\"row\":{\"scene\":\"ya").unwrap();
        let mut partial = Partial::open(out.path(), &header()).unwrap();
        assert!(partial.has_row(&row.key) && partial.has_times("yard") && !partial.has_times("contact"));
        assert_eq!((partial.rows(), partial.times(&row.key)), (&[row.clone()][..], row.times_ms));
        partial.add_sweep("yard", "pcf", Vec::new()).unwrap();
        let again = Partial::open(out.path(), &header()).unwrap();
        assert!(again.has_sweep("yard", "pcf") && again.rows().len() == 1);
        again.remove().unwrap();
        assert!(!path.exists());
    }

    #[test]
    fn a_run_of_other_options_is_refused_with_the_difference() {
        let out = tempfile::tempdir().unwrap();
        begun(out.path());
        let mut other = header();
        other.options.frames = 20;
        let refused = Partial::open(out.path(), &other).err().unwrap().to_string();
        assert!(refused.contains("options.frames: 15 there, 20 here") && refused.contains("partial"), "{refused}");
    }

    #[test]
    fn a_damaged_line_is_named() {
        let out = tempfile::tempdir().unwrap();
        let path = begun(out.path());
        let text = fs::read_to_string(&path).unwrap().replacen("{\"times\"", "{\"tim", 1);
        fs::write(&path, text).unwrap();
        let refused = Partial::open(out.path(), &header()).err().unwrap().to_string();
        assert!(refused.contains("line 2"), "{refused}");
    }
}
