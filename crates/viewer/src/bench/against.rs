//! `--against`: what changed since a former run, beyond noise.
//!
//! Rows are paired by scene, method and size. A time changed where its quartile ranges do not overlap and the medians
//! differ by more than 5 %: on a busy machine either alone happens by chance. Texels are counted, so that any difference
//! is one. The error is the RMS in the penumbra; it changed where it differs by more than 2 %.

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

/// What a comparison found, for a terminal.
#[derive(Debug, Default, PartialEq)]
pub struct Changes {
    /// Other devices and options, which make numbers differ that no code changed; rows in one of the runs only.
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
    for row in &new.rows {
        match find(&old.rows, row) {
            Some(before) => changes.compare(before, row),
            None => changes.notes.push(format!("{}: only in the new run", row.key)),
        }
    }
    let gone = old.rows.iter().filter(|row| find(&new.rows, row).is_none());
    changes.notes.extend(gone.map(|row| format!("{}: only in the old run", row.key)));
    Ok(changes)
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
        for (part, now) in &new.times_ms {
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
                "yard pcss 2048: only in the new run",
                "yard pcf 2048: only in the old run",
            ]
        );
        assert!(found.to_string().ends_with("0 rows compared: 0 numbers worse, 0 better"));
    }
}
