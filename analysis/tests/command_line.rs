//! The program itself: exit status, one line for what is wrong, the formats that it prints.

#![allow(clippy::unwrap_used, reason = "a test stops at what it did not expect, in helpers too")]

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

fn program(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_scumble-analysis")).args(arguments).output().unwrap()
}

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

/// The tables that QUEST itself is tested with.
fn quest_data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/psychophysics/tests/data").join(name)
}

fn path(path: &Path) -> &str {
    path.to_str().unwrap()
}

#[test]
fn simulate_and_fit_make_a_relation() {
    let folder = tempfile::tempdir().unwrap();
    let (sessions, out) = (folder.path().join("sessions"), folder.path().join("fit"));
    let simulate = ["simulate", "--out", path(&sessions), "--observers", "4", "--seed", "1"];
    assert!(program(&simulate).status.success());
    let fit = program(&["fit", path(&sessions), "--out", path(&out)]);
    assert!(fit.status.success(), "{fit:?}");
    assert!(String::from_utf8(fit.stdout).unwrap().contains("<- relation.json"));
    assert!(out.join("relation.json").exists());

    // The same sessions again: refused, with one line.
    let again = program(&simulate);
    assert_eq!(again.status.code(), Some(1));
    assert_eq!(String::from_utf8(again.stderr).unwrap().lines().count(), 1);
}

/// Sessions of a protocol whose texel sizes are changed, and what their fit says.
fn fit_of_pilot(folder: &Path, observers: &str, texels_px: &str) -> (Output, PathBuf) {
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/psychophysics/protocols/two-alternative.toml");
    let shipped = fs::read_to_string(shipped).unwrap();
    let changed = shipped.replace("texels_px = [5.0, 10.0, 20.0]", &format!("texels_px = {texels_px}"));
    let protocol = folder.join("pilot.toml");
    fs::write(&protocol, changed).unwrap();
    let (sessions, out) = (folder.join("sessions"), folder.join("fit"));
    let simulate = ["simulate", "--out", path(&sessions), "--observers", observers, "--seed", "2"];
    assert!(program(&[&simulate[..], &["--protocol", path(&protocol)]].concat()).status.success());
    (program(&["fit", path(&sessions), "--out", path(&out)]), out)
}

#[test]
fn a_pilot_is_refused_a_relation_is_told_what_to_do_next_and_gets_what_its_data_carry() {
    let cases = [
        ("1", "[5.0, 10.0, 20.0]", "at least 2 people with answers, found 1", "run the study with more people"),
        ("3", "[10.0]", "all answers are at a texel of 10 px", "two or more sizes in conditions.texels_px"),
    ];
    for (observers, texels_px, reason, next) in cases {
        let folder = tempfile::tempdir().unwrap();
        let (fit, out) = fit_of_pilot(folder.path(), observers, texels_px);
        assert_eq!(fit.status.code(), Some(1), "{fit:?}");
        let message = String::from_utf8(fit.stderr).unwrap();
        let line = message.lines().find(|line| line.starts_with("error: ")).unwrap();
        assert!(line.contains(reason) && line.contains(next) && line.contains("report.html"), "{line}");

        let mut files: Vec<String> =
            fs::read_dir(&out).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        files.sort();
        let expected =
            ["psychometric.svg", "report.html", "staircases.svg", "thresholds.csv", "trials.csv", "trials.json"];
        assert_eq!(files, expected);
        let page = fs::read_to_string(out.join("report.html")).unwrap();
        let (first_screen, rest) = page.split_once("<h2>").unwrap();
        assert!(first_screen.contains("No relation") && first_screen.contains(reason) && first_screen.contains(next));
        assert!(rest.contains("sim-0001") && rest.contains("Psychometric functions") && rest.contains("Tracks"));
        assert!(!page.contains("NaN"));
        let thresholds = fs::read_to_string(out.join("thresholds.csv")).unwrap();
        let conditions = 4 * texels_px.matches('.').count();
        assert_eq!(thresholds.lines().count(), 1 + conditions * observers.parse::<usize>().unwrap());
        let trials = fs::read_to_string(out.join("trials.csv")).unwrap();
        assert!(trials.lines().count() > 10 * conditions);
    }
}

#[test]
fn a_pilot_does_not_stand_beside_the_relation_of_an_earlier_fit() {
    let folder = tempfile::tempdir().unwrap();
    let (_, out) = fit_of_pilot(folder.path(), "1", "[5.0, 10.0, 20.0]");
    fs::remove_dir_all(&out).unwrap();
    fs::create_dir(&out).unwrap();
    fs::write(out.join("relation.json"), "{}").unwrap();
    let again = program(&["fit", path(&folder.path().join("sessions")), "--out", path(&out)]);
    let message = String::from_utf8(again.stderr).unwrap();
    assert_eq!(again.status.code(), Some(1));
    assert!(message.contains("relation.json: is of an earlier fit") && message.contains("allowed is another --out"));
    assert_eq!(fs::read_dir(&out).unwrap().count(), 1, "nothing is written beside it");
}

#[test]
fn export_prints_a_line_a_session_and_replaces_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let (sessions, out) = (folder.path().join("sessions"), folder.path().join("bids"));
    let simulate = ["simulate", "--out", path(&sessions), "--observers", "2", "--seed", "1"];
    assert!(program(&simulate).status.success());
    let export = ["export", path(&sessions), "--bids", path(&out)];
    let first = program(&export);
    assert!(first.status.success(), "{first:?}");
    let printed = String::from_utf8(first.stdout).unwrap();
    assert_eq!(printed.lines().count(), 3, "{printed}");
    for (line, label) in printed.lines().zip(["sub-sim0001", "sub-sim0002"]) {
        assert!(line.starts_with(label) && line.ends_with("trials stand, complete"), "{line}");
        assert!(out.join(label).join("beh").join(format!("{label}_task-twoalternative_events.tsv")).exists());
    }

    let again = program(&export);
    assert_eq!(again.status.code(), Some(1));
    let message = String::from_utf8(again.stderr).unwrap();
    assert_eq!(message.lines().count(), 1);
    assert!(message.contains("allowed is a folder that is empty or does not exist"), "{message}");
}

#[test]
fn threshold_prints_the_keys_of_the_reference() {
    let table = data("weibull_fit_data.csv");
    let output = program(&["threshold", "--data", path(&table), "--guess", "0.5", "--lapse", "0.01"]);
    assert!(output.status.success());
    let printed: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    for key in ["threshold_t", "slope_beta", "lapse", "nll", "deviance", "x82", "se_t", "se_beta"] {
        assert!(printed[key].is_f64(), "{key}");
    }
    assert!(program(&["threshold", "--data", path(&table), "--lapse", "free"]).status.success());
}

#[test]
fn threshold_prints_intervals_residuals_and_equal_numbers_for_equal_seeds() {
    let table = data("weibull_fit_data.csv");
    let print = |seed| program(&["threshold", "--data", path(&table), "--resamples", "300", "--seed", seed]);
    let output = print("4");
    assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
    assert_eq!(output.stdout, print("4").stdout);
    assert_ne!(output.stdout, print("5").stdout);

    let printed: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    for intervals in ["ci95_profile", "ci95_bootstrap"] {
        for key in ["threshold_t", "slope_beta", "x82"] {
            let ends = [0, 1].map(|end| printed[intervals][key][end].as_f64().unwrap());
            let value = printed[key].as_f64().unwrap();
            assert!(ends[0] < value && value < ends[1], "{intervals} {key}: {ends:?}");
        }
    }
    let levels = printed["levels"].as_array().unwrap();
    let squares: f64 = levels.iter().map(|level| level["residual"].as_f64().unwrap().powi(2)).sum();
    assert_eq!(levels.len(), 13);
    assert!((squares - printed["deviance"].as_f64().unwrap()).abs() < 1e-9);
    assert!((0.0..=1.0).contains(&printed["deviance_p"].as_f64().unwrap()));
    assert_eq!(printed["notes"].as_array().unwrap().len(), 0);
}

#[test]
fn quest_prints_the_reference_table() {
    let meta = fs::read_to_string(quest_data("quest_reference_meta.json")).unwrap();
    let meta: serde_json::Value = serde_json::from_str(&meta).unwrap();
    let reference = fs::read_to_string(quest_data("quest_reference.csv")).unwrap();
    let (header, rows) = reference.split_once('\n').unwrap();
    let folder = tempfile::tempdir().unwrap();

    let mut sequences: Vec<(&str, &str)> =
        rows.lines().map(|row| row.split(',').collect::<Vec<_>>()).map(|cells| (cells[0], cells[1])).collect();
    sequences.dedup();
    assert_eq!(sequences.len(), 7);
    for (config, sequence) in sequences {
        let expected: Vec<Vec<&str>> = rows
            .lines()
            .map(|row| row.split(',').collect::<Vec<_>>())
            .filter(|cells| cells[0] == config && cells[1] == sequence)
            .collect();
        let config_file = folder.path().join(format!("{config}.json"));
        fs::write(&config_file, meta["configs"][config].to_string()).unwrap();
        let table = folder.path().join(format!("{sequence}.csv"));
        let answers: String = expected[1..].iter().map(|cells| format!("{},{}\n", cells[3], cells[4])).collect();
        fs::write(&table, format!("intensity,response\n{answers}")).unwrap();

        let output = program(&["quest", "--config", path(&config_file), "--responses", path(&table)]);
        let printed = String::from_utf8(output.stdout).unwrap();
        let mut lines = printed.lines();
        assert_eq!(lines.next(), Some(header.trim_end()));
        for (line, wanted) in lines.by_ref().zip(&expected) {
            for (found, wanted) in line.split(',').zip(wanted) {
                let same = match (found.parse::<f64>(), wanted.trim().parse::<f64>()) {
                    (Ok(found), Ok(wanted)) => (found - wanted).abs() <= 1e-9,
                    _ => found == *wanted,
                };
                assert!(same, "{config} {sequence}: {found} is not {wanted}");
            }
        }
        assert_eq!(printed.lines().count(), expected.len() + 1);
    }
}

#[test]
fn what_is_wrong_takes_one_line_and_exit_status_1() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        path
    };
    let out = folder.path().join("out");
    let empty = folder.path().join("empty");
    fs::create_dir(&empty).unwrap();
    let config = file(
        "config.json",
        r#"{"tGuess": 0, "tGuessSd": 1, "pThreshold": 0.82, "beta": 3.5, "delta": 0.01, "gamma": 0.5}"#,
    );
    let bad_config = file("bad.json", r#"{"tGuess": 0}"#);
    let answers = file("answers.csv", "intensity,response\n0,1\n0.1,2\n");
    let infinite = file("infinite.csv", "intensity,response\ninf,1\n");
    let all_correct = file("all.csv", "level,n_correct,n_total\n1,9,9\n2,9,9\n");
    let missing = folder.path().join("missing.csv");
    let jump = file("jump.csv", "level,n_correct,n_total\n1,5,10\n2,99,100\n");
    let fraction = file("fraction.csv", "level,n_correct,n_total\n1,5.5,10\n");
    let cases: [(&[&str], &str); 13] = [
        (&["fit", path(&empty), "--out", path(&out)], "no session"),
        (&["fit", path(&missing), "--out", path(&out)], "missing.csv"),
        (&["threshold", "--data", path(&missing)], "missing.csv"),
        (&["threshold", "--data", path(&all_correct)], "all.csv: the data cannot carry a fit"),
        (&["threshold", "--data", path(&all_correct), "--guess", "NaN"], "--guess is NaN"),
        (
            &["threshold", "--data", path(&jump)],
            "jump.csv: the data cannot carry a fit: the answers do not bound the slope",
        ),
        (
            &["threshold", "--data", path(&fraction)],
            "fraction.csv: line 2: n_correct is 5.5 of n_total 10; allowed are",
        ),
        (
            &["threshold", "--data", path(&jump), "--lapse", "0.6"],
            "--lapse is 0.6; allowed is at least 0 and below 0.2",
        ),
        (&["threshold", "--data", path(&jump), "--resamples", "7"], "--resamples is 7; allowed is 100 to 1000000"),
        (&["quest", "--config", path(&bad_config), "--responses", path(&answers)], "bad.json: line 1"),
        (&["quest", "--config", path(&config), "--responses", path(&answers)], "answers.csv: line 3"),
        (&["quest", "--config", path(&config), "--responses", path(&infinite)], "line 2"),
        (
            &["simulate", "--out", path(&out), "--observers", "2", "--seed", "1", "--protocol", "x"],
            "allowed is published, two-alternative, yes-no",
        ),
    ];
    for (arguments, expected) in cases {
        let output = program(arguments);
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {message}");
        assert_eq!(message.lines().count(), 1, "{message}");
        assert!(message.contains(expected), "{arguments:?}: {message}");
    }
    assert!(!out.exists());
}

#[test]
fn help_teaches_by_example() {
    for command in ["fit", "simulate", "export", "quest", "threshold"] {
        let help = String::from_utf8(program(&[command, "--help"]).stdout).unwrap();
        assert!(help.contains("Example") && help.contains(&format!("scumble-analysis {command}")));
    }
}
