//! Models that are too large to ship, read from the folder that the environment variable SCUMBLE_MODELS names.
//!
//! `SCUMBLE_MODELS=models cargo test -p scumble-scenes --test models_not_shipped -- --ignored`

use scumble_scenes::{Scene, open};
use std::path::PathBuf;

fn scene(path: &str) -> Scene {
    let folder = std::env::var_os("SCUMBLE_MODELS").expect("SCUMBLE_MODELS names a folder");
    let file = PathBuf::from(folder).join(path);
    open(&file.display().to_string(), &PathBuf::new()).expect("the folder holds the model")
}

fn has_ground(scene: &Scene) -> bool {
    scene.meshes.iter().any(|mesh| mesh.name == "ground")
}

#[test]
#[ignore = "needs models that are not part of the repository, in the folder SCUMBLE_MODELS"]
fn a_ship_of_three_materials_and_external_buffers_gets_a_ground() {
    let ship = scene("dutch_ship/dutch_ship_medium_1k.gltf");
    assert!(has_ground(&ship));
    assert_eq!(ship.triangle_count(), 69_162 + 2);
    assert_eq!(ship.meshes.len(), 3 + 1);
    // Wood is darker than white and redder than blue: the texture's mean was read.
    assert!(ship.meshes.iter().any(|m| m.linear_color.x > 1.2 * m.linear_color.z && m.linear_color.x < 0.5));
}

#[test]
#[ignore = "needs models that are not part of the repository, in the folder SCUMBLE_MODELS"]
fn a_town_in_one_binary_file_stands_on_its_own_streets() {
    let town = scene("zdm2/zdm2.glb");
    assert!(!has_ground(&town));
    // 58,772 in the file; 1,146 have no area.
    assert_eq!(town.triangle_count(), 57_626);
}

#[test]
#[ignore = "needs models that are not part of the repository, in the folder SCUMBLE_MODELS"]
fn street_and_harbour_are_scenes_whose_light_reaches_what_the_camera_sees() {
    for (name, least) in [("street", 50_000), ("harbour", 60_000)] {
        let scene = open(name, &PathBuf::new()).expect("the folder holds the model");
        assert!(scene.triangle_count() > least);
        let fit = scumble_core::fit(&scene.camera, &scene.bounds(), &scene.light, true).expect("both are in range");
        assert!(fit.is_some(), "{name}");
    }
}
