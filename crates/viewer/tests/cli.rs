//! The command line as a user meets it: one line for bad input, and files that agree with each other.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// The viewer, without Mesa's layer that looks for a Wayland display and complains on standard error where there is
/// none.
fn program() -> Command {
    let mut program = Command::new(env!("CARGO_BIN_EXE_scumble-viewer"));
    program.env("NODEVICE_SELECT", "1");
    program
}

fn viewer(arguments: &[&str]) -> Output {
    program().args(arguments).output().expect("the program starts")
}

/// Standard error of a run that must fail with status 1 and exactly one line.
fn complaint(arguments: &[&str]) -> String {
    one_line(&viewer(arguments))
}

fn one_line(output: &Output) -> String {
    let text = String::from_utf8(output.stderr.clone()).expect("text");
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert_eq!(text.trim_end().lines().count(), 1, "{text}");
    text
}

fn path_text(path: &Path) -> &str {
    path.to_str().expect("a path of letters")
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
fn a_radius_that_is_none_is_refused() {
    for radius in ["-1", "0", "NaN", "inf", "wide"] {
        let line = complaint(&["shot", "--scene", "contact", "--radius", radius, "--out", "x.png"]);
        assert!(line.contains(radius) && line.contains("above 0"), "{line}");
    }
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
    assert_eq!(line.matches("os error").count(), 1, "{line}");

    let truncated = directory.path().join("cut.glb");
    fs::write(&truncated, b"glTF\x02\0\0\0\xff\xff\0\0").unwrap();
    let line = complaint(&["shot", "--scene", path_text(&truncated), "--out", path_text(&out)]);
    assert!(line.contains("cut.glb"), "{line}");
}

#[test]
fn triangles_without_an_area_or_there_twice_and_missing_materials_are_named_and_the_rest_is_drawn() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("odd.obj");
    let faces = "f 1 2 3\nf 2 3 1\nf 1 2 2\nf 1 2 4\n";
    fs::write(&file, format!("mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n{faces}")).unwrap();
    let picture = directory.path().join("odd.png");
    let sizes = ["--width", "64", "--height", "36", "--samples", "1", "--size", "64", "--method", "none"];
    let output = viewer(&[&["shot", "--scene", path_text(&file), "--out", path_text(&picture)], &sizes[..]].concat());
    let notices = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success() && picture.is_file(), "{notices}");
    let of_file: Vec<&str> = notices.lines().filter(|line| line.contains("odd.obj")).collect();
    assert_eq!(of_file.len(), 1, "{notices}");
    assert!(of_file[0].contains("1 triangles have no area") && of_file[0].contains("1 are there twice"), "{notices}");
    assert!(notices.contains("gone.mtl"), "{notices}");
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
    let output = program()
        .args(["shot", "--scene", "contact", "--out", path_text(&out)])
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

#[test]
fn a_lamp_changed_to_a_bulb_has_a_map_for_each_face_that_is_seen_and_a_sun_is_none() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("bulb.png");
    let options = ["--light", "point", "--width", "160", "--height", "90", "--out", path_text(&out)];
    let shot = |scene| viewer(&[&["shot", "--scene", scene, "--size", "64", "--samples", "1"], &options[..]].concat());
    let output = shot("stairwell");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let record: serde_json::Value = serde_json::from_slice(&fs::read(out.with_extension("json")).unwrap()).unwrap();
    assert!(record["light"]["point"].is_object(), "{}", record["light"]);
    let maps = record["maps"].as_array().unwrap();
    assert!((2..=6).contains(&maps.len()) && record["texels"] == 64 * 64 * maps.len());
    let line = one_line(&shot("yard"));
    assert!(line.contains("--light point") && line.contains("sun") && line.contains("stairwell"), "{line}");
}

#[test]
fn a_scene_in_other_units_is_the_same_picture() {
    let directory = tempfile::tempdir().unwrap();
    let picture = |scene: &str| {
        let path = directory.path().join(format!("{scene}.png"));
        let options = ["--method", "pcss", "--size", "512", "--width", "320", "--height", "180", "--samples", "1"];
        let output = viewer(&[&["shot", "--scene", scene, "--out", path_text(&path)], &options[..]].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        fs::read(&path).unwrap()
    };
    let contact = picture("contact");
    assert!(picture("giant") == contact, "lengths times 2^20");
    assert!(picture("speck") == contact, "lengths times 2^-20");
}

#[test]
fn a_bench_writes_a_table_a_record_and_the_pictures_that_it_names() {
    let directory = tempfile::tempdir().unwrap();
    let (out, cache) = (directory.path().join("results"), directory.path().join("cache"));
    let arguments = [
        "bench",
        "--scenes",
        "contact",
        "--methods",
        "pcf",
        "--sizes",
        "1024,adaptive",
        "--frames",
        "3",
        "--width",
        "640",
        "--height",
        "360",
        "--quick",
        "--cache",
        path_text(&cache),
        "--out",
        path_text(&out),
    ];
    let output = viewer(&arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(!out.join("bench.partial.jsonl").exists(), "what is finished is not begun");

    let table = fs::read_to_string(out.join("bench.csv")).unwrap();
    assert_eq!(table.lines().count(), 3, "{table}");
    let record: serde_json::Value = serde_json::from_slice(&fs::read(out.join("bench.json")).unwrap()).unwrap();
    let rows = record["rows"].as_array().unwrap();
    for row in rows {
        for picture in ["picture", "error_map", "truth"] {
            let path = out.join(row["pictures"][picture].as_str().unwrap());
            assert_eq!(image::open(&path).unwrap().width(), 320, "{}", path.display());
        }
        let error = &row["comparison"]["penumbra"];
        assert!(error["pixels"].as_u64().unwrap() > 500, "there is a penumbra");
        assert!(error["rms"].as_f64().unwrap() < 0.08, "{row}");
    }
    assert!(rows[1]["texels"].as_u64().unwrap() < 1024 * 1024 / 2, "the adaptive map is the smaller one");
    assert_eq!(rows[1]["comparison"]["violation_share"], 0.0);
    assert!(rows.iter().all(|row| row["allocations"] == 0), "frames allocate nothing once the size rests");

    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains("data:image/jpeg;base64,") && !page.contains("src='contact"), "the page holds its pictures");
    let again = viewer(&["report", path_text(&out)]);
    assert!(again.status.success() && fs::read_to_string(out.join("report.html")).unwrap() == page);

    let against = viewer(&[&arguments[..], &["--against", path_text(&out.join("bench.json"))]].concat());
    let changes = String::from_utf8_lossy(&against.stdout).into_owned();
    assert!(against.status.success() && changes.contains("2 rows compared"), "{changes}");
    assert!(!changes.contains(": error ") && !changes.contains(": map "), "the same command draws the same: {changes}");

    let old = directory.path().join("old.json");
    fs::write(&old, r#"{ "schema": "scumble/bench/1" }"#).unwrap();
    let refused = viewer(&[&arguments[..], &["--against", path_text(&old)]].concat());
    let line = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(!refused.status.success() && line.contains("scumble/bench/4 is expected"), "{line}");
}
