//! QUEST against the tables of two other programs: every configuration, sequence, row and column.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use std::collections::BTreeMap;
use std::path::PathBuf;

use scumble_psychophysics::{Quest, QuestConfig, QuestSummary};
use serde::Deserialize;

const TOLERANCE: f64 = 1e-9;

#[derive(Deserialize)]
struct Meta {
    configs: BTreeMap<String, QuestConfig>,
    scripted_offsets: Vec<f64>,
    scripted_responses: Vec<u8>,
}

/// One row of either table, as names and numbers; an empty field is NaN.
type Row = BTreeMap<String, f64>;

fn data(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

fn meta() -> Meta {
    let text = std::fs::read_to_string(data("quest_reference_meta.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// Rows of a table by configuration and sequence, in order.
fn table(name: &str) -> BTreeMap<(String, String), Vec<Row>> {
    let mut reader = csv::Reader::from_path(data(name)).unwrap();
    let names = reader.headers().unwrap().clone();
    let mut sequences: BTreeMap<_, Vec<Row>> = BTreeMap::new();
    for record in reader.records() {
        let record = record.unwrap();
        let key = (record[0].to_string(), record[1].to_string());
        let row = names.iter().zip(&record).skip(2);
        let row = row.map(|(name, text)| (name.into(), text.parse().unwrap_or(f64::NAN)));
        sequences.entry(key).or_default().push(row.collect());
    }
    sequences
}

/// A summary in the columns of the tables.
fn columns(summary: &QuestSummary, quest: &Quest) -> Row {
    let optional = |value: Option<f64>| value.unwrap_or(f64::NAN);
    [
        ("trial", f64::from(summary.trial)),
        ("intensity", optional(summary.intensity)),
        ("response", optional(summary.response.map(f64::from))),
        ("mean", summary.mean),
        ("mode", summary.mode),
        ("median", summary.median),
        ("q05", summary.q05),
        ("q95", summary.q95),
        ("next_quantile", summary.next_quantile),
        ("sd", summary.sd),
        ("pdf_max", summary.pdf_max),
        ("out_of_range", f64::from(summary.out_of_range)),
        ("xThreshold", quest.x_threshold()),
        ("quantileOrder", quest.quantile_order()),
    ]
    .into_iter()
    .map(|(name, value)| (name.to_string(), value))
    .collect()
}

fn responses(rows: &[Row]) -> Vec<(f64, bool)> {
    rows.iter().skip(1).map(|row| (row["intensity"], row["response"] == 1.0)).collect()
}

/// Cells of the table that the summaries miss by more than the tolerance, and the cells compared.
fn compare(expected: &[Row], found: &[Row]) -> (Vec<String>, usize) {
    assert_eq!(expected.len(), found.len());
    let mut misses = Vec::new();
    let mut cells = 0;
    for (expected, found) in expected.iter().zip(found) {
        for (name, expected) in expected {
            let found = found[name];
            let both_empty = expected.is_nan() && found.is_nan();
            if !both_empty && (found - expected).abs().is_nan() || (found - expected).abs() > TOLERANCE {
                misses.push(format!("{name}: {found} instead of {expected}"));
            }
            cells += 1;
        }
    }
    (misses, cells)
}

fn check_table(name: &str) {
    let configs = meta().configs;
    let mut cells_of_table = 0;
    for ((config, sequence), rows) in table(name) {
        let quest = Quest::new(configs[&config]).unwrap();
        let summaries = QuestSummary::of_sequence(configs[&config], &responses(&rows)).unwrap();
        let found: Vec<Row> = summaries.iter().map(|row| columns(row, &quest)).collect();
        let (misses, cells) = compare(&rows, &found);
        assert!(misses.is_empty(), "{config} {sequence}: {misses:?}");
        cells_of_table += cells;
    }
    // 7 sequences of 41 rows in 12 columns.
    assert_eq!(cells_of_table, 7 * 41 * 12);
}

#[test]
fn every_cell_of_psychopys_table_is_met() {
    check_table("quest_reference.csv");
}

#[test]
fn every_cell_of_psychtoolboxs_table_is_met() {
    check_table("quest_reference_ptb.csv");
}

#[test]
fn the_comparison_fails_on_a_wrong_cell() {
    let rows = &table("quest_reference.csv")[&("log10_cv1".into(), "mixed".into())];
    for name in ["mean", "intensity", "out_of_range"] {
        let mut wrong = rows.clone();
        *wrong[40].get_mut(name).unwrap() += 2e-9;
        assert_eq!(compare(rows, &wrong).0.len(), 1, "{name}");
        *wrong[40].get_mut(name).unwrap() = f64::NAN;
        assert_eq!(compare(rows, &wrong).0.len(), 1, "{name}");
    }
}

#[test]
fn the_closed_loop_sequences_are_placed_where_quest_places_them() {
    let configs = meta().configs;
    for name in ["quest_reference.csv", "quest_reference_ptb.csv"] {
        for ((config, sequence), rows) in table(name) {
            if sequence == "scripted" {
                continue;
            }
            let mut quest = Quest::new(configs[&config]).unwrap();
            for (intensity, response) in responses(&rows) {
                assert!((quest.placement() - intensity).abs() < TOLERANCE);
                quest.update(quest.placement(), response).unwrap();
            }
            let last = &rows[40];
            assert!((quest.mean() - last["mean"]).abs() < TOLERANCE);
        }
    }
}

#[test]
fn the_scripted_sequence_is_the_one_of_the_configuration_file() {
    let meta = meta();
    for ((config, sequence), rows) in table("quest_reference.csv") {
        if sequence != "scripted" {
            continue;
        }
        let guess = meta.configs[&config].t_guess;
        let scripted = meta.scripted_offsets.iter().zip(&meta.scripted_responses);
        for ((intensity, response), (offset, scripted)) in responses(&rows).iter().zip(scripted) {
            assert!((intensity - (guess + offset)).abs() < 1e-12);
            assert_eq!(u8::from(*response), *scripted);
        }
    }
}

#[test]
fn every_configuration_of_the_file_is_usable() {
    let configs = meta().configs;
    assert_eq!(configs.len(), 5);
    for config in configs.into_values() {
        let quest = Quest::new(config).unwrap();
        assert_eq!(quest.posterior().len(), 501);
        assert!((quest.x_threshold() - 0.0048435434738648185).abs() < 1e-15);
        assert!((quest.quantile_order() - 0.589792467215265).abs() < 1e-14);
    }
}

#[test]
fn a_shifted_configuration_gives_shifted_summaries() {
    let configs = meta().configs;
    let cv1 = configs["log10_cv1"];
    let ratio3 = configs["log10_ratio3"];
    let rows = &table("quest_reference.csv")[&("log10_cv1".into(), "scripted".into())];
    let here = responses(rows);
    let there: Vec<_> = here.iter().map(|(x, response)| (x + 1.0, *response)).collect();
    let here = QuestSummary::of_sequence(cv1, &here).unwrap();
    let there = QuestSummary::of_sequence(ratio3, &there).unwrap();
    for (here, there) in here.iter().zip(&there) {
        for (here, there) in
            [(here.mean, there.mean), (here.mode, there.mode), (here.next_quantile, there.next_quantile)]
        {
            assert!((there - here - 1.0).abs() < 1e-12);
        }
        assert!((there.sd - here.sd).abs() < 1e-12);
    }
}
