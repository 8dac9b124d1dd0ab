//! `--against`: what changed since a former run, beyond noise.
//!
//! Rows are paired by scene, method and size. A time changed where its quartile ranges do not overlap and the medians
//! differ by more than 5 %: on a busy machine either alone happens by chance. Texels are counted, so that any difference
//! is one. The error is the RMS in the penumbra; it changed where it differs by more than 2 %. The time of drawing, which is
//! the scene's, tells a busier machine from slower shadows.

use std::collections::BTreeSet;
use std::fmt;

use anyhow::Result;

use crate::bench::difference::differences;
use crate::bench::record::{BenchRecord, OptionsRecord};
use crate::bench::row::Row;
use crate::statistics::Spread;

/// Least change of a median: medians of 15 frames on a busy machine scatter by 3 to 4 %.
const TIME_SHARE: f64 = 0.05;
/// Least change of an error: on another driver the third digit differs by rounding at the edges of texels.
const ERROR_SHARE: f64 = 0.02;
/// The part of a frame that is no shadow's.
const DRAWING: &str = "drawing";

/// What a comparison found, for a terminal.
#[derive(Debug, Default, PartialEq)]
pub struct Changes {
    /// Other devices, options and loads, which make numbers differ that no code changed; rows in one of the runs only.
    pub notes: Vec<String>,
    /// Slower, more texels, or a larger error.
    pub worse: Vec<String>,
    /// The opposite.
    pub better: Vec<String>,
    /// Number of rows in both runs.
    pub pairs: usize,
}

/// Compares two runs.
pub fn changes(old: &BenchRecord, new: &BenchRecord) -> Result<Changes> {
    let mut changes = Changes { notes: conditions(old, new)?, ..Changes::default() };
    changes.notes.extend(loads(old, new));
    for (run, rows, others) in [("new", &new.rows, &old.rows), ("old", &old.rows, &new.rows)] {
        changes.notes.extend(only_in(run, rows, others));
    }
    for row in &new.rows {
        if let Some(before) = find(&old.rows, row) {
            changes.compare(before, row);
        }
    }
    Ok(changes)
}

/// The scenes whose drawing takes another time, by the first row that both runs have.
fn loads(old: &BenchRecord, new: &BenchRecord) -> Vec<String> {
    let mut scenes = BTreeSet::new();
    let load = |row: &Row| {
        let (then, now) = (find(&old.rows, row)?.times_ms.get(DRAWING)?, row.times_ms.get(DRAWING)?);
        (scenes.insert(row.key.scene.clone()) && differ(then, now)).then(|| {
            format!(
                "{}: drawing without shadows {:.2} -> {:.2} ms: another load of the machine, or other code than that of shadows",
                row.key.scene, then.median, now.median
            )
        })
    };
    new.rows.iter().filter_map(load).collect()
}

/// The rows that the other run has not: the first by name, and how many more.
fn only_in(run: &str, rows: &[Row], others: &[Row]) -> Option<String> {
    let mut alone = rows.iter().filter(|row| find(others, row).is_none());
    let first = alone.next()?;
    Some(match alone.count() {
        0 => format!("only in the {run} run: {}", first.key),
        more => format!("only in the {run} run: {} and {more} more", first.key),
    })
}

fn find<'a>(rows: &'a [Row], like: &Row) -> Option<&'a Row> {
    rows.iter().find(|row| row.key == like.key)
}

/// What makes numbers differ for all rows at once.
fn conditions(old: &BenchRecord, new: &BenchRecord) -> Result<Vec<String>> {
    let mut notes = Vec::new();
    let device = |record: &BenchRecord| format!("{}, {}", record.machine.device, record.machine.driver);
    if device(old) != device(new) {
        notes.push(format!("another device: {} then, {} now; times compare the two", device(old), device(new)));
    }
    let alike = |options: &OptionsRecord| OptionsRecord {
        scenes: Vec::new(),
        methods: Vec::new(),
        softness: Vec::new(),
        sizes: Vec::new(),
        paths: Vec::new(),
        sweep_ratio: false,
        ..options.clone()
    };
    let found = differences(&alike(&old.options), &alike(&new.options))?;
    notes.extend(
        found
            .into_iter()
            .chain(differences(&old.ratio.value, &new.ratio.value)?.into_iter().map(|it| format!("ratio{it}"))),
    );
    Ok(notes)
}

impl Changes {
    fn compare(&mut self, old: &Row, new: &Row) {
        self.pairs += 1;
        for (part, now) in new.times_ms.iter().filter(|(part, _)| *part != DRAWING) {
            if let Some(then) = old.times_ms.get(part).filter(|then| differ(then, now)) {
                self.add(new, part, then.median, now.median, "ms");
            }
        }
        if old.texels != new.texels {
            self.add(new, "map", old.texels as f64, new.texels as f64, "texels");
        }
        if let (Some(then), Some(now)) = (old.error(), new.error())
            && (now - then).abs() > ERROR_SHARE * then
        {
            self.add(new, "error", then, now, "RMS");
        }
    }

    fn add(&mut self, row: &Row, what: &str, then: f64, now: f64, unit: &str) {
        let change = if then > 0.0 { format!(" ({:+.0} %)", 100.0 * (now / then - 1.0)) } else { String::new() };
        let digits = match unit {
            "RMS" => 4,
            "ms" => 2,
            _ => 0,
        };
        let line = format!("{}: {what} {then:.digits$} -> {now:.digits$} {unit}{change}", row.key);
        if now > then { &mut self.worse } else { &mut self.better }.push(line);
    }
}

fn differ(then: &Spread, now: &Spread) -> bool {
    let overlap = then.lower_quartile <= now.upper_quartile && now.lower_quartile <= then.upper_quartile;
    !overlap && (now.median - then.median).abs() > TIME_SHARE * then.median
}

impl fmt::Display for Changes {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [("note  ", &self.notes), ("better", &self.better), ("worse ", &self.worse)];
        for (name, lines) in parts {
            for line in lines {
                writeln!(formatter, "{name}  {line}")?;
            }
        }
        let Self { worse, better, pairs, .. } = self;
        write!(formatter, "{pairs} rows compared: {} numbers worse, {} better", worse.len(), better.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::examples::{record, row};

    #[test]
    fn a_run_against_itself_changed_nothing() {
        let run = record(vec![row("yard", "pcf", "2048", 10.0, 0.05)]);
        assert_eq!(changes(&run, &run).unwrap(), Changes { pairs: 1, ..Changes::default() });
    }

    #[test]
    fn a_slower_larger_and_wronger_row_is_worse_in_three_numbers() {
        let old = record(vec![row("yard", "pcf", "adaptive", 10.0, 0.05)]);
        let mut slow = row("yard", "pcf", "adaptive", 12.0, 0.06);
        slow.texels = 100_001;
        let worse = changes(&old, &record(vec![slow.clone()])).unwrap();
        assert_eq!((worse.worse.len(), worse.better.len()), (3, 0));
        assert!(worse.worse.contains(&"yard pcf adaptive: total 10.00 -> 12.00 ms (+20 %)".to_owned()), "{worse}");
        let better = changes(&record(vec![slow]), &old).unwrap();
        assert_eq!((better.worse.len(), better.better.len()), (0, 3));
    }

    #[test]
    fn a_time_needs_both_disjoint_quartiles_and_five_per_cent() {
        let spread =
            |median: f64, half: f64| Spread { median, lower_quartile: median - half, upper_quartile: median + half };
        assert!(!differ(&spread(10.0, 0.01), &spread(10.4, 0.01)), "4 %, however sure");
        assert!(!differ(&spread(10.0, 1.0), &spread(11.5, 1.0)), "quartile ranges that overlap");
        assert!(differ(&spread(10.0, 0.1), &spread(10.6, 0.1)));
        assert!(differ(&spread(10.6, 0.1), &spread(10.0, 0.1)));
    }

    #[test]
    fn an_error_may_move_by_its_rounding() {
        let run = |error| record(vec![row("yard", "pcf", "2048", 10.0, error)]);
        assert!(changes(&run(0.05), &run(0.0509)).unwrap().worse.is_empty());
        assert_eq!(changes(&run(0.05), &run(0.0515)).unwrap().worse.len(), 1);
        assert_eq!(changes(&run(0.05), &run(0.0485)).unwrap().better.len(), 1);
    }

    #[test]
    fn other_devices_options_and_rows_are_named() {
        let old = record(vec![row("yard", "pcf", "2048", 10.0, 0.05)]);
        let mut new = record(vec![row("yard", "pcss", "2048", 10.0, 0.05)]);
        new.machine.device = "another".into();
        new.options.width = 640;
        new.options.scenes.clear();
        let found = changes(&old, &new).unwrap();
        assert_eq!(
            found.notes,
            [
                "another device: a device, a driver then, another, a driver now; times compare the two",
                "width: 1280 there, 640 here",
                "only in the new run: yard pcss 2048",
                "only in the old run: yard pcf 2048",
            ]
        );
        assert!(found.to_string().ends_with("0 rows compared: 0 numbers worse, 0 better"));
        let three = ["1024", "2048", "4096"].map(|size| row("yard", "pcf", size, 10.0, 0.05));
        let many = changes(&record(three.into()), &record(Vec::new())).unwrap();
        assert_eq!(many.notes, ["only in the old run: yard pcf 1024 and 2 more"]);
    }

    #[test]
    fn a_slower_drawing_is_a_note_once_a_scene_and_no_row_is_worse_for_it() {
        let run = |median: f64| {
            let drawing = Spread { median, lower_quartile: 0.99 * median, upper_quartile: 1.01 * median };
            let mut rows = ["1024", "2048"].map(|size| row("yard", "pcf", size, 10.0, 0.05));
            for row in &mut rows {
                row.times_ms.insert(DRAWING.into(), drawing);
            }
            record(rows.into())
        };
        let found = changes(&run(80.0), &run(200.0)).unwrap();
        assert_eq!((found.notes.len(), found.worse.len(), found.pairs), (1, 0, 2));
        assert!(found.notes[0].starts_with("yard: drawing without shadows 80.00 -> 200.00 ms"), "{found}");
    }
}
