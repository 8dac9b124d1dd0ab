//! What a material cuts out is cut out of the picture, of the shadow map and of the rays alike.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use image::{Rgba, RgbaImage};

/// Texels of the mask across and down, and of one of its squares.
const TEXELS: u32 = 64;
const SQUARE: u32 = 16;

/// A card of 2 m by 2 m that lies 0.6 m over a ground of 4 m, a board of chess with every other square cut out.
fn card(folder: &Path, alpha_mode: &str) -> PathBuf {
    let board = |x: u32, y: u32| if (x / SQUARE + y / SQUARE).is_multiple_of(2) { 255 } else { 0 };
    let texture = RgbaImage::from_fn(TEXELS, TEXELS, |x, y| Rgba([230, 220, 200, board(x, y)]));
    texture.save(folder.join("card.png")).unwrap();
    let quad = |half: f32, y: f32| [[-half, y, -half], [-half, y, half], [half, y, half], [half, y, -half]];
    let positions = [quad(1.0, 0.6), quad(2.0, 0.0)];
    let uvs: [f32; 8] = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0];
    let mut bytes: Vec<u8> = positions.as_flattened().as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend(uvs.iter().flat_map(|x| x.to_le_bytes()));
    bytes.extend([0u16, 1, 2, 0, 2, 3].iter().flat_map(|i| i.to_le_bytes()));
    fs::write(folder.join("card.bin"), bytes).unwrap();
    let json = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0, 1]}}],
        "nodes": [{{"mesh": 0}}, {{"mesh": 1}}],
        "images": [{{"uri": "card.png"}}], "textures": [{{"source": 0}}],
        "materials": [{{"alphaMode": "{alpha_mode}", "pbrMetallicRoughness": {{"baseColorTexture": {{"index": 0}}}}}}],
        "meshes": [
            {{"name": "card", "primitives":
                [{{"attributes": {{"POSITION": 0, "TEXCOORD_0": 2}}, "indices": 3, "material": 0}}]}},
            {{"name": "floor", "primitives": [{{"attributes": {{"POSITION": 1}}, "indices": 3}}]}}],
        "accessors": [
            {{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, 0.6, -1], "max": [1, 0.6, 1]}},
            {{"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-2, 0, -2], "max": [2, 0, 2]}},
            {{"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"}},
            {{"bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 48}}, {{"buffer": 0, "byteOffset": 48, "byteLength": 48}},
            {{"buffer": 0, "byteOffset": 96, "byteLength": 32}}, {{"buffer": 0, "byteOffset": 128, "byteLength": 12}}],
        "buffers": [{{"uri": "card.bin", "byteLength": 140}}]}}"#
    );
    let file = folder.join("card.gltf");
    fs::write(&file, json).unwrap();
    file
}

/// The row of a fixed map that is fine enough for its texels not to count, against the same filter by rays.
fn row(alpha_mode: &str) -> serde_json::Value {
    let folder = tempfile::tempdir().unwrap();
    let (scene, out, cache) = (card(folder.path(), alpha_mode), folder.path().join("out"), folder.path().join("cache"));
    let text = |path: &Path| path.to_str().unwrap().to_owned();
    let output = Command::new(env!("CARGO_BIN_EXE_scumble-viewer"))
        .args(["bench", "--scenes", &text(&scene), "--methods", "pcf", "--sizes", "2048", "--radius", "0.05"])
        .args(["--frames", "3", "--width", "640", "--height", "360", "--quick"])
        .args(["--cache", &text(&cache), "--out", &text(&out)])
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let record: serde_json::Value = serde_json::from_slice(&fs::read(out.join("bench.json")).unwrap()).unwrap();
    record["rows"][0].clone()
}

#[test]
fn the_holes_of_a_mask_are_the_same_in_picture_map_and_rays() {
    let (whole, cut) = (row("OPAQUE"), row("MASK"));
    let number = |row: &serde_json::Value, of: &str, what: &str| row["comparison"][of][what].as_f64().unwrap();
    // Were one of them blind to the holes, half of what lies under the card would be wrong by 1.
    for row in [&whole, &cut] {
        assert!(number(row, "lit_facing", "rms") < 0.02, "{}", row["comparison"]);
    }
    // Eight squares have eight times a quarter of the card's edge, which adds up to twice of it.
    let ratio = number(&cut, "penumbra", "pixels") / number(&whole, "penumbra", "pixels");
    assert!(ratio > 1.5, "{ratio}");
}
