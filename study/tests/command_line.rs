//! What the command line refuses, in words, before any window opens.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;
use std::process::{Command, Output};

use scumble_psychophysics::Protocol;

fn study(arguments: &[&str]) -> Output {
    // Without a display no window can open, so a refusal that comes too late says so.
    Command::new(env!("CARGO_BIN_EXE_scumble-study"))
        .args(arguments)
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .unwrap()
}

fn assert_refused(arguments: &[&str], words: &[&str]) {
    let output = study(arguments);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!output.status.success(), "{arguments:?} was not refused");
    for word in words {
        assert!(message.contains(word), "{arguments:?}: {word:?} is not in {message:?}");
    }
}

fn write(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn other_protocols_are_refused_with_what_is_allowed() {
    for name in ["two alternative", "protocol.json"] {
        assert_refused(&["--protocol", name], &[name, "published, two-alternative, yes-no", ".toml"]);
    }
}

#[test]
fn a_protocol_file_that_is_none_is_refused_by_name_and_place() {
    let folder = tempfile::tempdir().unwrap();
    let damaged = write(folder.path(), "damaged.toml", "name = \"mine\"\ntask = \"three_alternative\"\n");
    assert_refused(&["--protocol", &damaged], &["damaged.toml:2", "three_alternative"]);
    let mut protocol = Protocol::two_alternative();
    protocol.schedule.trials_min = 0;
    let out_of_range = write(folder.path(), "range.toml", &protocol.to_toml().unwrap());
    assert_refused(&["--protocol", &out_of_range], &["range.toml", "trials_min is 0", "1 or more"]);
    assert_refused(&["--protocol", "absent.toml"], &["absent.toml"]);
}

#[test]
fn a_name_instead_of_a_code_is_refused() {
    assert_refused(&["--participant", "Ada Lovelace"], &["participant", "Ada Lovelace", "a code of"]);
}

#[test]
fn an_existing_session_is_never_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("p01")).unwrap();
    let events = write(&folder.path().join("p01"), "events.jsonl", "kept\n");
    let data = folder.path().to_str().unwrap();
    assert_refused(&["--data", data, "--participant", "p01"], &["p01", "holds a session", "--participant"]);
    assert_eq!(std::fs::read_to_string(events).unwrap(), "kept\n");
}

#[test]
fn a_session_that_is_not_there_cannot_be_resumed() {
    assert_refused(&["--data", "absent", "--participant", "p01", "--resume"], &["absent"]);
    assert_refused(&["--resume"], &["--participant"]);
    for option in ["--seed", "--protocol", "--participant-number"] {
        let both = ["--participant", "p01", "--resume", option, "1"];
        assert_refused(&both, &[option, "--resume"]);
    }
}

#[test]
fn a_size_of_pixels_that_is_none_is_refused() {
    for value in ["0", "-3", "nan", "inf", "many"] {
        let argument = format!("--px-per-degree={value}");
        assert_refused(&[&argument], &["px-per-degree", "above 0"]);
    }
}

#[test]
fn help_teaches_by_examples() {
    let output = study(&["--help"]);
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).unwrap();
    let words = [
        "Which one was the line?",
        "--participant p07 --resume",
        "--protocol yes-no",
        "--participant-number 3",
        "published",
        "scumble-analysis fit",
        "exit status",
    ];
    for word in words {
        assert!(text.contains(word), "{word:?} is not in {text}");
    }
}
