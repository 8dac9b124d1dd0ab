//! glTF files, text and binary: what is read, and the one line for what is not allowed.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use glam::{DVec3, Vec3};
use scumble_scenes::{Mesh, bounds_of, load_gltf, open};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Where the buffer's bytes are.
#[derive(Clone, Copy)]
enum Buffer {
    /// In `triangle.bin` beside the file.
    External,
    /// In the binary chunk.
    Chunk,
}

/// One triangle and three indices: 36 bytes of positions, then 6 of indices, padded to 44.
fn buffer(positions: [[f32; 3]; 3], indices: [u16; 3]) -> Vec<u8> {
    let mut bytes: Vec<u8> = positions.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend(indices.iter().flat_map(|i| i.to_le_bytes()));
    bytes.extend([0, 0]);
    bytes
}

fn unit_triangle() -> Vec<u8> {
    buffer([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]], [0, 1, 2])
}

/// A document of one mesh under a node that is moved and scaled under a parent that is turned.
fn document(uri: &str, count: usize) -> String {
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}],
        "nodes": [{{"rotation": [0, 0.7071067811865476, 0, 0.7071067811865476], "children": [1]}},
                  {{"mesh": 0, "translation": [5, 1, 0], "scale": [2, 2, 2]}}],
        "materials": [{{"pbrMetallicRoughness": {{"baseColorFactor": [0.8, 0.4, 0.2, 1]}}}}],
        "meshes": [{{"name": "sail", "primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1, "material": 0}}]}}],
        "accessors": [
            {{"bufferView": 0, "componentType": 5126, "count": {count}, "type": "VEC3", "min": [0, 0, -1], "max": [1, 0, 0]}},
            {{"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}}],
        "bufferViews": [{{"buffer": 0, "byteOffset": 0, "byteLength": 36}}, {{"buffer": 0, "byteOffset": 36, "byteLength": 6}}],
        "buffers": [{{{uri} "byteLength": 44}}]}}"#
    )
}

/// The GLB container: header, JSON chunk padded with spaces, binary chunk.
fn glb(json: &str, binary: &[u8]) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let total = 12 + 8 + json.len() + 8 + binary.len();
    let mut bytes = b"glTF".to_vec();
    let mut word = |value: usize| bytes.extend((value as u32).to_le_bytes());
    word(2);
    word(total);
    word(json.len());
    bytes.extend(b"JSON");
    bytes.extend(&json);
    bytes.extend((binary.len() as u32).to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend(binary);
    bytes
}

fn written(kind: Buffer, count: usize, binary: &[u8]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let file = match kind {
        Buffer::External => {
            std::fs::write(folder.path().join("triangle.bin"), binary).unwrap();
            let file = folder.path().join("triangle.gltf");
            std::fs::write(&file, document(r#""uri": "triangle.bin","#, count)).unwrap();
            file
        }
        Buffer::Chunk => {
            let file = folder.path().join("triangle.glb");
            std::fs::write(&file, glb(&document("", count), binary)).unwrap();
            file
        }
    };
    (folder, file)
}

fn complaint(file: &Path) -> String {
    let message = load_gltf(file).unwrap_err().to_string();
    assert!(!message.contains('\n'), "{message}");
    assert!(message.starts_with(&file.display().to_string()), "{message}");
    message
}

fn check_sail(meshes: &[Mesh]) {
    assert_eq!((meshes.len(), meshes[0].name.as_str()), (1, "sail"));
    assert_eq!(meshes[0].linear_color, Vec3::new(0.8, 0.4, 0.2));
    // Scaled to 2, moved by (5, 1, 0), then turned by 90 degrees about y: x becomes -z, z becomes x.
    let bounds = bounds_of(meshes).unwrap();
    assert!(bounds.min.abs_diff_eq(DVec3::new(-2.0, 1.0, -7.0), 1e-5), "{bounds:?}");
    assert!(bounds.max.abs_diff_eq(DVec3::new(0.0, 1.0, -5.0), 1e-5), "{bounds:?}");
    assert!(meshes[0].normals.iter().all(|n| n.abs_diff_eq(Vec3::Y, 1e-6)));
}

#[test]
fn a_triangle_is_the_same_from_an_external_buffer_and_from_a_binary_chunk() {
    for kind in [Buffer::External, Buffer::Chunk] {
        let (_folder, file) = written(kind, 3, &unit_triangle());
        check_sail(&load_gltf(&file).unwrap());
    }
}

#[test]
fn a_triangle_is_read_from_a_buffer_inside_the_document() {
    // 44 bytes in base 64, written out: 0 0 0, 1 0 0, 0 0 -1, indices 0 1 2.
    let data = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIC/AAABAAIAAAA=";
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("triangle.gltf");
    let uri = format!(r#""uri": "data:application/octet-stream;base64,{data}","#);
    std::fs::write(&file, document(&uri, 3)).unwrap();
    check_sail(&load_gltf(&file).unwrap());
}

#[test]
fn a_file_by_path_becomes_a_scene_with_a_camera_a_sun_and_a_ground() {
    let (_folder, file) = written(Buffer::Chunk, 3, &unit_triangle());
    let scene = open(&file.display().to_string(), Path::new("no assets needed")).unwrap();
    assert_eq!(scene.name, "triangle");
    assert!(scene.meshes.iter().any(|mesh| mesh.name == "ground"));
    assert!(scene.camera.checked().is_ok() && scene.light.checked().is_ok());
}

#[test]
fn truncated_files_are_refused() {
    let (_folder, file) = written(Buffer::External, 3, &unit_triangle()[..20]);
    assert!(complaint(&file).contains("buffer 0: 20 bytes where 44 are announced"));

    let (_folder, file) = written(Buffer::Chunk, 3, &unit_triangle());
    let bytes = std::fs::read(&file).unwrap();
    for length in [0, 3, 11, 100, bytes.len() - 30] {
        std::fs::write(&file, &bytes[..length]).unwrap();
        assert!(complaint(&file).contains("allowed"), "{length}");
    }
}

#[test]
fn accessors_beyond_their_buffer_are_refused() {
    for count in [4, usize::MAX / 64] {
        let (_folder, file) = written(Buffer::Chunk, count, &unit_triangle());
        assert!(complaint(&file).contains("accessor 0"), "{count}");
    }
}

#[test]
fn accessors_of_another_type_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("triangle.glb");
    for (from, to, named) in [
        ("5126", "5121", "accessor 0: Vec3 of U8"),
        ("VEC3", "VEC2", "accessor 0: Vec2 of F32"),
        ("5123", "5126", "accessor 1: Scalar of F32"),
        ("SCALAR", "VEC2", "accessor 1: Vec2 of U16"),
    ] {
        std::fs::write(&file, glb(&document("", 3).replace(from, to), &unit_triangle())).unwrap();
        assert!(complaint(&file).contains(named), "{named}");
    }
}

#[test]
fn indices_beyond_the_vertices_are_refused() {
    let binary = buffer([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [0, 1, 3]);
    let (_folder, file) = written(Buffer::Chunk, 3, &binary);
    assert!(complaint(&file).contains("mesh 0 primitive 0: index 3 where 3 vertices are given"));
}

#[test]
fn coordinates_that_are_not_finite_are_refused() {
    for wrong in [f32::NAN, f32::INFINITY] {
        let binary = buffer([[0.0; 3], [1.0, wrong, 0.0], [0.0, 1.0, 0.0]], [0, 1, 2]);
        let (_folder, file) = written(Buffer::Chunk, 3, &binary);
        assert!(complaint(&file).contains("mesh 0 primitive 0 vertex 1: a coordinate that is not finite"));
    }
}

#[test]
fn a_triangle_without_an_area_is_no_triangle() {
    let binary = buffer([[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], [0, 1, 2]);
    let (_folder, file) = written(Buffer::Chunk, 3, &binary);
    assert!(complaint(&file).contains("no triangles"));
}

#[test]
fn files_that_are_not_what_they_say_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for content in ["v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "{}", "", r#"{"asset": {"version": "2.0"}}"#] {
        for name in ["model.gltf", "model.glb"] {
            let file = folder.path().join(name);
            std::fs::write(&file, content).unwrap();
            assert!(complaint(&file).contains("allowed"), "{content}");
        }
    }
    let (_folder, file) = written(Buffer::External, 3, &unit_triangle());
    std::fs::remove_file(file.with_file_name("triangle.bin")).unwrap();
    assert!(complaint(&file).contains("buffers: "));
    assert!(load_gltf(Path::new("nowhere.glb")).unwrap_err().to_string().starts_with("nowhere.glb: cannot be read"));
}
