//! Materials that cut their surface out: what is read of a glTF file, and when a mask is none.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use glam::Vec2;
use image::{DynamicImage, ImageFormat, Rgba, RgbaImage};
use scumble_scenes::{Mesh, Wrap, load_gltf};
use std::path::PathBuf;
use tempfile::TempDir;

/// A card of 2 m by 2 m, whose texture is 4 texels across with a hole in its left half, as a file.
struct Card {
    material: &'static str,
    /// Alpha of the left half.
    left: u8,
    attributes: &'static str,
    image: &'static str,
}

const WHOLE: Card = Card {
    material: r#""alphaMode": "MASK", "alphaCutoff": 0.25"#,
    left: 0,
    attributes: r#""POSITION": 0, "TEXCOORD_0": 1"#,
    image: "card.png",
};

impl Card {
    fn load(&self) -> Vec<Mesh> {
        let (_folder, file) = self.written();
        load_gltf(&file).unwrap()
    }

    fn written(&self) -> (TempDir, PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let texture = DynamicImage::from(RgbaImage::from_fn(4, 4, |x, _| {
            Rgba([200, 100, 50, if x < 2 { self.left } else { 255 }])
        }));
        let pictures = [("card.png", texture.clone()), ("grey.png", texture.to_luma_alpha8().into())];
        for (name, texture) in pictures.into_iter().chain([("deep.png", DynamicImage::from(texture.to_rgba16()))]) {
            texture.save_with_format(folder.path().join(name), ImageFormat::Png).unwrap();
        }
        let positions: [f32; 12] = [0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 2.0, 2.0, 0.0, 0.0, 2.0, 0.0];
        let uvs: [f32; 8] = [0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0];
        let mut bytes: Vec<u8> = positions.iter().chain(&uvs).flat_map(|x| x.to_le_bytes()).collect();
        bytes.extend([0u16, 1, 2, 0, 2, 3].iter().flat_map(|i| i.to_le_bytes()));
        std::fs::write(folder.path().join("card.bin"), bytes).unwrap();
        let Self { material, attributes, image, .. } = self;
        let json = format!(
            r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
            "images": [{{"uri": "{image}"}}], "samplers": [{{"wrapS": 33071, "wrapT": 33648}}],
            "textures": [{{"source": 0, "sampler": 0}}],
            "materials": [{{{material}, "pbrMetallicRoughness":
                {{"baseColorTexture": {{"index": 0}}, "baseColorFactor": [1, 1, 1, 0.5]}}}}],
            "meshes": [{{"primitives": [{{"attributes": {{{attributes}}}, "indices": 2, "material": 0}}]}}],
            "accessors": [
                {{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [2, 2, 0]}},
                {{"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"}},
                {{"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}}],
            "bufferViews": [{{"buffer": 0, "byteLength": 48}}, {{"buffer": 0, "byteOffset": 48, "byteLength": 32}},
                {{"buffer": 0, "byteOffset": 80, "byteLength": 12}}],
            "buffers": [{{"uri": "card.bin", "byteLength": 92}}]}}"#
        );
        let file = folder.path().join("card.gltf");
        std::fs::write(&file, json).unwrap();
        (folder, file)
    }
}

#[test]
fn a_masked_card_keeps_its_texture_coordinates_and_what_they_look_up() {
    let meshes = WHOLE.load();
    let mask = meshes[0].mask.as_ref().unwrap();
    assert_eq!(mask.uvs.len(), meshes[0].positions.len());
    let corner = meshes[0].positions.iter().position(|p| p.x == 2.0 && p.y == 2.0).unwrap();
    assert_eq!(mask.uvs[corner], Vec2::new(1.0, 0.0));
    assert_eq!(mask.texture.wrap, [Wrap::Clamp, Wrap::Mirror]);
    // The factor of 0.5 makes the cutoff 0.25 one of 0.5 for the texture.
    assert_eq!(mask.texture.cutoff, 0.5);
    assert!(!mask.texture.is_there(Vec2::new(0.49, 0.5)) && mask.texture.is_there(Vec2::new(0.51, 0.5)));
}

#[test]
fn grey_and_deep_pictures_cut_out_alike() {
    let of = |image| Card { image, ..WHOLE }.load()[0].mask.clone().unwrap().texture;
    let colored = of("card.png");
    assert_eq!([of("grey.png"), of("deep.png")], [colored.clone(), colored]);
}

#[test]
fn a_surface_without_a_hole_has_no_mask() {
    for card in [
        Card { material: r#""alphaMode": "OPAQUE""#, ..WHOLE },
        Card { material: r#""alphaMode": "BLEND""#, ..WHOLE },
        Card { left: 200, ..WHOLE },
        Card { material: r#""alphaMode": "MASK", "alphaCutoff": 0"#, ..WHOLE },
        Card { attributes: r#""POSITION": 0"#, ..WHOLE },
        Card { image: "missing.png", ..WHOLE },
    ] {
        let meshes = card.load();
        assert_eq!((meshes[0].triangles.len(), &meshes[0].mask), (2, &None), "{}", card.material);
    }
}

#[test]
fn texture_coordinates_that_are_none_are_refused_with_what_is_allowed() {
    let (_folder, file) = Card { attributes: r#""POSITION": 0, "TEXCOORD_0": 0"#, ..WHOLE }.written();
    let message = load_gltf(&file).unwrap_err().to_string();
    assert!(message.contains("accessor 0: Vec3 of F32; allowed are texture coordinates"), "{message}");
}
