//! The script in `docs` reads what `fit` writes, and finds the same mean by a fit of its own.

#![allow(clippy::unwrap_used, reason = "a test stops at what it did not expect, in helpers too")]

use std::{path::Path, process::Command};

use scumble_analysis::{Simulation, Study, fit_study};
use scumble_core::RelationFile;
use scumble_psychophysics::{ObserverModel, Protocol};

#[test]
#[ignore = "needs Python with pandas and matplotlib, which `cargo xtask test` installs where it can"]
fn pandas_reads_the_files_as_they_are_and_finds_the_same_mean_by_a_fit_of_its_own() {
    for protocol in ["two-alternative", "yes-no"] {
        let folder = tempfile::tempdir().unwrap();
        let (sessions, out) = (folder.path().join("sessions"), folder.path().join("out"));
        let protocol = Protocol::named(protocol).unwrap();
        let simulation =
            Simulation { protocol, observers: 5, seed: 4, median: ObserverModel::default(), between_sd_log10: 0.1 };
        simulation.write(&sessions, || ()).unwrap();
        fit_study(&Study::read(&[sessions]).unwrap(), &out).unwrap();

        let tools = Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("tools").join("python");
        let python = tools.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/relation.py");
        let picture = folder.path().join("figure.png");
        let output = Command::new(python).arg(script).arg(&out).arg(&picture).output().unwrap();
        let (text, errors) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
        assert!(output.status.success() && picture.exists(), "{errors}");
        assert!(errors.is_empty(), "{errors}");

        let line = text.lines().find(|line| line.starts_with("mean of logarithms")).unwrap();
        let found: f64 = line.split_whitespace().last().unwrap().parse().unwrap();
        let json = std::fs::read_to_string(out.join("relation.json")).unwrap();
        let relation = RelationFile::from_json(&json).unwrap();
        let ours = relation.other_estimators.iter().find(|other| other.name == "mean_of_logarithms").unwrap();
        // The script's grid is 0.001 log10 fine, 0.2 %.
        assert!((found / ours.ratio.value - 1.0).abs() < 0.002, "{line}; ours {}", ours.ratio.value);
    }
}
