//! Exported datasets under the validator of the BIDS standard itself.

#![allow(clippy::unwrap_used, reason = "a test stops at what it did not expect, in helpers too")]

mod lab;

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use lab::{Sitting, header, small};
use scumble_analysis::Export;
use scumble_psychophysics::Event;
use serde_json::Value;

/// Warnings that a whole dataset of ours may have, each with its reason.
const ACCEPTED: [(&str, &str); 3] = [
    ("NO_AUTHORS", "only the laboratory knows them; the README of the dataset asks for them"),
    ("MISSING_SESSION", "not every participant of a study comes as often as the others"),
    ("INCONSISTENT_SUBJECTS", "who comes once has no second session's files"),
];

/// Codes of the errors and of the warnings that the validator finds.
fn complaints(dataset: &Path) -> [Vec<String>; 2] {
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("tools").join("bids-validator");
    let program = program.join("package/bin/bids-validator");
    assert!(program.exists(), "{} is not there: cargo xtask test puts it there", program.display());
    let output = Command::new("node").arg(program).arg(dataset).arg("--json").output().unwrap();
    let found: Value = serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{error}: {output:?}"));
    let codes = |kind: &str| -> Vec<String> {
        let issues = found["issues"][kind].as_array().unwrap();
        issues.iter().map(|issue| issue["key"].as_str().unwrap().to_owned()).collect()
    };
    [codes("errors"), codes("warnings")]
}

/// Sessions of every kind, in `folder`: each protocol, everything that an administrator can do, two sessions of
/// a person, codes that share a label.
fn record_everything(folder: &Path) {
    let sit = |code: &str, protocol: &str, started_at: &str, go: &dyn Fn(&mut Sitting)| {
        let directory = folder.join(format!("{code}-{}", &started_at[..10]));
        go(&mut Sitting::new(&directory, &header(code, small(protocol), started_at)));
    };
    sit("p-07_a", "two-alternative", "2026-03-01T09:30:00Z", &|sitting| {
        sitting.answer(5);
        sitting.moment(Event::Note, "tab\there, \"quotes\", line\nend, \\ and n/a");
        sitting.interrupt(3600.0);
        sitting.repeat_round();
        sitting.finish();
    });
    sit("p-07_a", "yes-no", "2026-03-02T09:30:00Z", &Sitting::finish);
    sit("p07a", "published", "2026-03-01T10:30:00Z", &|sitting| {
        sitting.answer(4);
        sitting.moment(Event::Stop, "felt sick");
    });
    sit("P07A", "two-alternative", "2026-03-01T11:30:00Z", &|sitting| sitting.answer(1));
}

fn export(sessions: &Path, out: PathBuf) -> PathBuf {
    Export::read(&[sessions.to_path_buf()]).unwrap().write(&out).unwrap();
    out
}

/// Replaces text in a file of the dataset.
fn damage(file: &Path, from: &str, to: &str) {
    let text = fs::read_to_string(file).unwrap();
    assert!(text.contains(from));
    fs::write(file, text.replacen(from, to, 1)).unwrap();
}

#[test]
#[ignore = "needs the BIDS validator, which `cargo xtask test` installs where npm is"]
fn the_bids_validator_finds_no_error_in_a_dataset_of_ours_and_finds_one_in_a_damaged_one() {
    let folder = tempfile::tempdir().unwrap();
    let sessions = folder.path().join("sessions");
    record_everything(&sessions);
    let one_each = export(&sessions.join("p07a-2026-03-01"), folder.path().join("one"));
    assert_eq!(complaints(&one_each), [vec![], vec!["NO_AUTHORS".to_owned()]]);

    let dataset = export(&sessions, folder.path().join("bids"));
    let [errors, warnings] = complaints(&dataset);
    assert!(errors.is_empty(), "{errors:?}");
    let unexpected: Vec<_> =
        warnings.iter().filter(|code| ACCEPTED.iter().all(|(accepted, _)| accepted != code)).collect();
    assert!(unexpected.is_empty(), "{unexpected:?}");

    let events = one_each.join("sub-p07a/beh/sub-p07a_task-published_events.tsv");
    damage(&events, "\tn/a\t", "\t\t");
    assert_eq!(complaints(&one_each)[0], ["TSV_EMPTY_CELL"]);
    damage(&dataset.join("participants.tsv"), "sub-p07a", "p07a");
    assert!(complaints(&dataset)[0].contains(&"PARTICIPANT_ID_PATTERN".to_owned()));
}
