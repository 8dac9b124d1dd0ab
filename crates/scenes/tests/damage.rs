//! Files with damage anywhere give meshes or one line, never a panic.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use proptest::prelude::*;
use scumble_scenes::{load_gltf, load_obj};
use std::path::Path;

/// Files of each kind; twenty times as many were tried.
const CASES: u32 = 600;

/// Two texels as a PNG file, one of them a hole.
fn texture() -> Vec<u8> {
    let texels = image::RgbaImage::from_raw(2, 1, vec![9, 9, 9, 0, 9, 9, 9, 255]).unwrap();
    let mut file = std::io::Cursor::new(Vec::new());
    texels.write_to(&mut file, image::ImageFormat::Png).unwrap();
    file.into_inner()
}

/// A triangle and a strip in one binary file, with a transform, a material that is cut out by an image, and its image.
fn whole_glb() -> Vec<u8> {
    let positions: [f32; 12] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 1.0, 0.5, -1.0];
    let mut binary: Vec<u8> = positions.iter().flat_map(|x| x.to_le_bytes()).collect();
    binary.extend([0u16, 1, 2, 3].iter().flat_map(|i| i.to_le_bytes()));
    binary.extend([0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0f32].iter().flat_map(|x| x.to_le_bytes()));
    let texture = texture();
    binary.extend(&texture);
    binary.resize(binary.len().next_multiple_of(4), 0);
    let [texture_length, length] = [texture.len(), binary.len()].map(|count| count.to_string());
    let json = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
        "nodes":[{"mesh":0,"translation":[5,1,0],"scale":[2,2,2],"children":[1]},{"mesh":0}],
        "images":[{"bufferView":3,"mimeType":"image/png"}],"textures":[{"source":0}],
        "materials":[{"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"material":0},
                                 {"attributes":{"POSITION":0},"indices":1,"mode":5}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,-1],"max":[1,0.5,0]},
                     {"bufferView":1,"componentType":5123,"count":4,"type":"SCALAR"},
                     {"bufferView":2,"componentType":5126,"count":4,"type":"VEC2"}],
        "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":8},
                       {"buffer":0,"byteOffset":56,"byteLength":32},{"buffer":0,"byteOffset":88,"byteLength":TEXTURE}],
        "buffers":[{"byteLength":LENGTH}]}"#;
    let mut json = json.replace("TEXTURE", &texture_length).replace("LENGTH", &length).into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let word = |value: usize| (value as u32).to_le_bytes();
    let total = 12 + 8 + json.len() + 8 + binary.len();
    [&b"glTF"[..], &word(2), &word(total), &word(json.len()), b"JSON", &json, &word(binary.len()), b"BIN\0", &binary]
        .concat()
}

const WHOLE_OBJ: &str = "mtllib a.mtl\no box\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 2 1\nvn 0 0 1\nvt 0 0\nusemtl red\n\
    f 1 2 3 4\nf 1//1 2//1 5//1\nf -1 -2 -3\ns off\nl 1 2\n";

fn one_line_or_meshes(result: Result<Vec<scumble_scenes::Mesh>, scumble_scenes::Error>) {
    match result {
        Ok(meshes) => {
            for mesh in &meshes {
                assert!(mesh.positions.iter().chain(&mesh.normals).all(|vector| vector.is_finite()));
                assert!(mesh.mask.as_ref().is_none_or(|mask| mask.uvs.len() == mesh.positions.len()));
                assert!(mesh.triangles.iter().flatten().all(|&corner| (corner as usize) < mesh.positions.len()));
            }
        }
        Err(error) => {
            let text = error.to_string();
            assert!(!text.is_empty() && !text.contains('\n'), "{text}");
        }
    }
}

fn written(name: &str, bytes: &[u8], load: impl Fn(&Path)) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join(name);
    std::fs::write(&file, bytes).unwrap();
    load(&file);
}

/// Bytes that are other ones, and where the file ends.
fn damage(length: usize) -> impl Strategy<Value = (Vec<(usize, u8)>, usize)> {
    (prop::collection::vec((0..length, any::<u8>()), 0..8), prop_oneof![3 => Just(length), 1 => 0..length])
}

fn damaged(whole: &[u8], (changes, end): &(Vec<(usize, u8)>, usize)) -> Vec<u8> {
    let mut bytes = whole.to_vec();
    for &(place, byte) in changes {
        bytes[place] = byte;
    }
    bytes.truncate(*end);
    bytes
}

#[test]
fn the_undamaged_file_is_cut_out() {
    written("a.glb", &whole_glb(), |file| {
        let meshes = load_gltf(file).unwrap();
        assert!(meshes.iter().any(|mesh| mesh.mask.is_some()) && meshes.iter().any(|mesh| mesh.mask.is_none()));
    });
}

proptest! {
    #![proptest_config(ProptestConfig { cases: CASES, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_damaged_gltf_file_is_refused_or_read(damage in damage(whole_glb().len())) {
        written("a.glb", &damaged(&whole_glb(), &damage), |file| one_line_or_meshes(load_gltf(file)));
    }

    #[test]
    fn a_damaged_obj_file_is_refused_or_read(damage in damage(WHOLE_OBJ.len())) {
        written("a.obj", &damaged(WHOLE_OBJ.as_bytes(), &damage), |file| one_line_or_meshes(load_obj(file)));
    }
}

#[test]
fn the_undamaged_files_are_read() {
    written("a.glb", &whole_glb(), |file| assert_eq!(load_gltf(file).unwrap().len(), 4));
    written("a.obj", WHOLE_OBJ.as_bytes(), |file| assert!(!load_obj(file).unwrap().is_empty()));
}
