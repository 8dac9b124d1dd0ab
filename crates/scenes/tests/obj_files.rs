//! Wavefront files: what is read, and the one line for what is not allowed.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use glam::Vec3;
use scumble_scenes::{Error, Mesh, load_obj, open};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn written(name: &str, content: impl AsRef<[u8]>) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join(name);
    std::fs::write(&file, content).unwrap();
    (folder, file)
}

fn load(content: &str) -> Vec<Mesh> {
    let (_folder, file) = written("model.obj", content);
    load_obj(&file).unwrap()
}

/// The message for a file with this content: one line that begins with the file's name.
fn complaint(content: impl AsRef<[u8]>) -> String {
    let (_folder, file) = written("model.obj", content);
    let message = load_obj(&file).unwrap_err().to_string();
    assert!(!message.contains('\n'), "{message}");
    message.strip_prefix(&format!("{}, ", file.display())).unwrap().to_owned()
}

fn area(mesh: &Mesh) -> f32 {
    let twice = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| mesh.positions[i as usize]);
        (b - a).cross(c - a).length()
    };
    mesh.triangles.iter().map(twice).sum::<f32>() / 2.0
}

/// A chevron in the plane z = 0 whose fourth corner is a notch: area 0.5, where a fan gives 1.5.
const CHEVRON: &str = "v 0 0 0\nv 1 2 0\nv 2 0 0\nv 1 1.5 0\n";

#[test]
fn a_concave_polygon_covers_its_own_area() {
    for face in ["f 1 2 3 4", "f 4 3 2 1", "f 3 4 1 2"] {
        let meshes = load(&format!("{CHEVRON}{face}\n"));
        assert_eq!(meshes[0].triangles.len(), 2);
        assert!((area(&meshes[0]) - 0.5).abs() < 1e-6, "{face}");
    }
}

#[test]
fn doubled_faces_and_open_surfaces_stay_as_they_are() {
    let meshes = load("v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 3 2\nf 1 2 3\nf 1 3 2\n");
    assert_eq!(meshes[0].triangles.len(), 3);
    assert!(meshes[0].normals.contains(&Vec3::Y) && meshes[0].normals.contains(&Vec3::NEG_Y));
}

#[test]
fn faces_without_an_area_lines_and_points_are_left_out() {
    let meshes = load("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 4\nf 1 2 3\nf 1 1 2\nl 1 2\np 3\n");
    assert_eq!(meshes.len(), 1);
    assert_eq!(meshes[0].triangles.len(), 1);
}

#[test]
fn normals_of_the_file_are_kept() {
    let meshes = load("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 0\nvn 0 3 4\nf 1//1 2//2 3//2\n");
    let [a, b, _] = meshes[0].triangles[0].map(|i| meshes[0].normals[i as usize]);
    assert_eq!((a, b), (Vec3::X, Vec3::new(0.0, 0.6, 0.8)));
}

#[test]
fn materials_split_meshes_and_give_linear_colours() {
    let (folder, file) = written(
        "model.obj",
        "mtllib colours.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\nusemtl none\nf 3 2 1\n",
    );
    std::fs::write(folder.path().join("colours.mtl"), "newmtl red\nKd 1 0.5 0\n").unwrap();
    let meshes = load_obj(&file).unwrap();
    assert_eq!(meshes.len(), 2);
    // sRGB 0.5 is 0.2140 in linear light.
    assert!(meshes[0].linear_color.abs_diff_eq(Vec3::new(1.0, 0.21404, 0.0), 1e-4));
    assert!(meshes[0].name.ends_with("/red"));
}

#[test]
fn a_missing_material_library_leaves_the_faces_grey() {
    let meshes = load("mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl gone\nf 1 2 3\n");
    assert_eq!(meshes[0].linear_color, Vec3::splat(0.5));
}

#[test]
fn problems_name_their_line_and_what_is_allowed() {
    let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    assert_eq!(
        complaint(format!("{vertices}f 1 2 7\n")),
        "line 4: vertex index '7' where 3 are given; allowed are indices from 1 to the number given, or negative ones that \
         count back"
    );
    assert_eq!(
        complaint("v 0 0 0\nv 0 NaN 0\nv 0 1 0\nf 1 2 3\n"),
        "line 2: coordinate 'NaN'; allowed are finite numbers, three of them"
    );
    // Truncated in the middle of a line.
    assert!(complaint("v 0 0 0\nv 1 0 0\nv 0 ").starts_with("line 3: 1 coordinates"));
    assert!(complaint(format!("{vertices}f 1 2/9 3\n")).starts_with("line 4: texture coordinate index '9'"));
}

#[test]
fn files_that_are_not_what_they_say_are_refused() {
    assert!(complaint([0x67, 0x6c, 0x54, 0x46, 0xff, 0xfe]).starts_with("byte 4: not UTF-8 text"));
    assert!(complaint("").starts_with("as a whole: no triangles"));
    assert!(complaint("{\"asset\": {\"version\": \"2.0\"}}").contains("no triangles"));
    assert!(complaint("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n").contains("no triangles"));
}

#[test]
fn missing_files_and_unknown_names_say_what_is_known() {
    let missing = open("nowhere/model.obj", Path::new("assets")).unwrap_err();
    assert!(matches!(missing, Error::Read { .. }));
    assert!(missing.to_string().starts_with("nowhere/model.obj: cannot be read"));

    let unknown = open("atlantis", Path::new("assets")).unwrap_err().to_string();
    assert!(unknown.contains("'atlantis'") && unknown.contains("yard") && unknown.contains(".glb"), "{unknown}");
    let other_format = open("model.fbx", Path::new("assets")).unwrap_err();
    assert!(matches!(other_format, Error::UnknownScene { .. }));

    let no_assets = open("yard", Path::new("nowhere")).unwrap_err().to_string();
    assert!(no_assets.starts_with("nowhere/fence/fence.obj: cannot be read"), "{no_assets}");
}
