//! The command line as a user meets it: one line for bad input, and files that agree with each other.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn viewer(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_scumble-viewer")).args(arguments).output().unwrap()
}

/// Standard error of a run that must fail with status 1 and exactly one line.
fn complaint(arguments: &[&str]) -> String {
    one_line(&viewer(arguments))
}

fn one_line(output: &Output) -> String {
    let text = String::from_utf8(output.stderr.clone()).unwrap();
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert_eq!(text.trim_end().lines().count(), 1, "{text}");
    text
}

fn path_text(path: &Path) -> &str {
    path.to_str().unwrap()
}

#[test]
fn without_a_command_the_help_is_printed() {
    let output = viewer(&[]);
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("shot") && text.contains("bench") && text.contains("Examples:"), "{text}");
}

#[test]
fn a_bad_size_is_refused_with_what_is_allowed() {
    let line = complaint(&["shot", "--scene", "contact", "--size", "2048x", "--out", "x.png"]);
    assert!(line.contains("2048x") && line.contains("adaptive"), "{line}");
}

#[test]
fn a_bad_method_is_refused_with_the_methods_there_are() {
    let line = complaint(&["shot", "--scene", "contact", "--method", "magic", "--out", "x.png"]);
    assert!(line.contains("magic") && line.contains("pcss"), "{line}");
}

#[test]
fn an_unknown_scene_is_refused_with_the_scenes_there_are() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("x.png");
    let line = complaint(&["shot", "--scene", "atlantis", "--out", path_text(&out)]);
    assert!(line.contains("atlantis") && line.contains("contact"), "{line}");
    assert!(!out.exists());
}

#[test]
fn a_missing_or_truncated_scene_file_is_named() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("x.png");
    let missing = directory.path().join("missing.obj");
    let line = complaint(&["shot", "--scene", path_text(&missing), "--out", path_text(&out)]);
    assert!(line.contains("missing.obj"), "{line}");

    let truncated = directory.path().join("cut.glb");
    fs::write(&truncated, b"glTF\x02\0\0\0\xff\xff\0\0").unwrap();
    let line = complaint(&["shot", "--scene", path_text(&truncated), "--out", path_text(&out)]);
    assert!(line.contains("cut.glb"), "{line}");
}

#[test]
fn a_relation_that_is_none_is_refused_by_file_and_place() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("x.png");
    let relation = directory.path().join("relation.json");
    for text in
        ["", "{ \"schema\": \"scumble/relation/1\", \"ratio\": { \"value\": NaN } }", "{ \"schema\": \"other\" }"]
    {
        fs::write(&relation, text).unwrap();
        let arguments = ["shot", "--scene", "contact", "--relation", path_text(&relation), "--out", path_text(&out)];
        let line = complaint(&arguments);
        assert!(line.contains("relation.json"), "{line}");
    }
}

#[test]
fn a_file_of_another_kind_is_never_replaced() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("thesis.png");
    fs::write(&out, "not a picture").unwrap();
    let line = complaint(&["shot", "--scene", "contact", "--out", path_text(&out)]);
    assert!(line.contains("thesis.png"), "{line}");
    assert_eq!(fs::read_to_string(&out).unwrap(), "not a picture");
}

#[test]
fn a_machine_without_a_driver_is_told_what_to_install() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("x.png");
    let output = Command::new(env!("CARGO_BIN_EXE_scumble-viewer"))
        .args(["shot", "--scene", "contact", "--out", path_text(&out)])
        .env("WGPU_BACKEND", "vulkan")
        .env("VK_DRIVER_FILES", directory.path().join("none.json"))
        .env("VK_ICD_FILENAMES", directory.path().join("none.json"))
        .output()
        .unwrap();
    let line = one_line(&output);
    assert!(line.contains("mesa-vulkan-drivers"), "{line}");
}

#[test]
fn a_shot_writes_a_picture_and_a_record_whose_texels_are_those_of_its_viewports() {
    let directory = tempfile::tempdir().unwrap();
    for size in ["adaptive", "128x64"] {
        let out = directory.path().join(format!("{size}.png"));
        let arguments = ["shot", "--scene", "contact", "--method", "pcss", "--size", size, "--width", "160"];
        let output = viewer(&[&arguments[..], &["--height", "90", "--out", path_text(&out)]].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));

        let picture = image::open(&out).unwrap();
        assert_eq!((picture.width(), picture.height()), (160, 90));
        let record: serde_json::Value = serde_json::from_slice(&fs::read(out.with_extension("json")).unwrap()).unwrap();
        let maps = record["maps"].as_array().unwrap();
        let areas = maps.iter().map(|map| map["viewport"][2].as_u64().unwrap() * map["viewport"][3].as_u64().unwrap());
        assert_eq!(record["texels"].as_u64().unwrap(), areas.sum::<u64>());
        if size == "128x64" {
            assert_eq!(record["texels"], 128 * 64);
        }
    }
}
