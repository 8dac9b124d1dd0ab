//! `assets/README.md` tells the truth: every folder is in its table, with its licence and its triangle count.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use scumble_scenes::load_obj;
use std::collections::BTreeMap;
use std::path::PathBuf;

fn assets() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../assets")
}

/// Rows of the table by folder, each the cells after the folder's.
fn table() -> BTreeMap<String, Vec<String>> {
    let readme = std::fs::read_to_string(assets().join("README.md")).unwrap();
    readme
        .lines()
        .filter(|line| line.starts_with("| `"))
        .map(|line| {
            let mut cells = line.trim_matches('|').split('|').map(|cell| cell.trim().to_owned());
            let folder = cells.next().unwrap().trim_matches('`').to_owned();
            (folder, cells.collect())
        })
        .collect()
}

fn folders() -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(assets())
        .unwrap()
        .map(|entry| entry.unwrap())
        .filter(|entry| entry.file_type().unwrap().is_dir())
        .map(|entry| entry.file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn every_folder_is_in_the_table_and_every_row_is_a_folder() {
    assert_eq!(folders(), table().into_keys().collect::<Vec<_>>());
}

#[test]
fn every_folder_has_its_licence_and_its_provenance() {
    for (folder, cells) in table() {
        let path = assets().join(&folder);
        let licence = ["LICENSE.html", "LICENSE.txt"].iter().find_map(|f| std::fs::read_to_string(path.join(f)).ok());
        assert!(licence.unwrap().contains("Creative Commons Zero"), "{folder}");

        let provenance = std::fs::read_to_string(path.join("PROVENANCE.txt")).unwrap();
        let field = |name: &str| {
            let line = provenance.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(": "));
            line.unwrap_or_else(|| panic!("{folder}: no {name}")).to_owned()
        };
        assert_eq!([&cells[0], &cells[1]], [&field("title"), &field("author")], "{folder}");
        assert!(field("licence").starts_with(&cells[2]), "{folder}");
        for name in ["origin", "package", "units", "changes"] {
            assert!(!field(name).is_empty());
        }
    }
}

#[test]
fn every_triangle_count_in_the_table_is_what_the_loader_finds() {
    for (folder, cells) in table() {
        let meshes = load_obj(&assets().join(&folder).join(format!("{folder}.obj"))).unwrap();
        let count: usize = meshes.iter().map(|mesh| mesh.triangles.len()).sum();
        assert_eq!(cells[3].replace(',', ""), count.to_string(), "{folder}");
    }
}

#[test]
fn every_model_has_the_size_in_the_table_in_centimetres() {
    for (folder, cells) in table() {
        let meshes = load_obj(&assets().join(&folder).join(format!("{folder}.obj"))).unwrap();
        let size = scumble_scenes::bounds_of(&meshes).unwrap().size();
        let found = format!("{:.0} x {:.0} x {:.0}", size.x, size.y, size.z);
        assert_eq!(cells[4], found, "{folder}");
    }
}
