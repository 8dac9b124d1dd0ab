//! One linear colour per glTF material: the base colour factor times the mean of the base colour texture.
//!
//! A scene for shadows needs no texture, but a ship should be brown and its sails light: the mean over all texels,
//! taken in linear light (texels are sRGB code values) and weighted by alpha, is enough. Texture transforms, repeats
//! and the part of the texture that a mesh really uses are ignored.

use glam::Vec3;
use gltf::image::{Data, Format};
use std::path::Path;

/// Texels looked at per image, on a regular stride: a mean over 4096 has a standard error below 1 %.
const SAMPLES: usize = 4096;

/// The mean linear colour of every image; an image that cannot be read is white, with a warning.
pub fn image_means(document: &gltf::Document, file: &Path, buffers: &[gltf::buffer::Data]) -> Vec<Vec3> {
    document
        .images()
        .map(|image| {
            if !is_base_color(document, image.index()) {
                return Vec3::ONE;
            }
            if !has_source(document, image.index()) || !lies_in_buffer(&image, buffers) {
                tracing::warn!(
                    "{}: image {} has no data of its own; its material is white",
                    file.display(),
                    image.index()
                );
                return Vec3::ONE;
            }
            match Data::from_source(image.source(), file.parent(), buffers) {
                Ok(data) => mean(&data),
                Err(problem) => {
                    tracing::warn!("{}: image {} cannot be read ({problem})", file.display(), image.index());
                    Vec3::ONE
                }
            }
        })
        .collect()
}

/// The material's colour: factor times texture mean.
pub fn linear_color(material: &gltf::Material<'_>, image_means: &[Vec3]) -> Vec3 {
    let surface = material.pbr_metallic_roughness();
    let [r, g, b, _] = surface.base_color_factor();
    let mean = surface
        .base_color_texture()
        .and_then(|info| image_means.get(info.texture().source().index()).copied())
        .unwrap_or(Vec3::ONE);
    (Vec3::new(r, g, b) * mean).clamp(Vec3::ZERO, Vec3::ONE)
}

fn is_base_color(document: &gltf::Document, image: usize) -> bool {
    document.materials().any(|material| {
        material
            .pbr_metallic_roughness()
            .base_color_texture()
            .is_some_and(|info| info.texture().source().index() == image)
    })
}

/// The library takes it for granted that an image names a file, or a part of a buffer and its type.
fn has_source(document: &gltf::Document, image: usize) -> bool {
    let of_file = document.as_json().images.get(image);
    of_file.is_some_and(|image| image.uri.is_some() || (image.buffer_view.is_some() && image.mime_type.is_some()))
}

/// The decoder slices an embedded image without a check of its own.
fn lies_in_buffer(image: &gltf::Image<'_>, buffers: &[gltf::buffer::Data]) -> bool {
    match image.source() {
        gltf::image::Source::View { view, .. } => buffers
            .get(view.buffer().index())
            .zip(view.offset().checked_add(view.length()))
            .is_some_and(|(data, end)| end <= data.0.len()),
        gltf::image::Source::Uri { .. } => true,
    }
}

fn mean(image: &Data) -> Vec3 {
    let channels = match image.format {
        Format::R8G8B8 => 3,
        Format::R8G8B8A8 => 4,
        // Base colours come as 8-bit RGB in practice; other layouts keep the factor alone.
        _ => return Vec3::ONE,
    };
    let texels = image.pixels.len() / channels;
    let stride = (texels / SAMPLES).max(1) * channels;
    let (mut sum, mut weight) = (Vec3::ZERO, 0.0);
    for texel in image.pixels.chunks_exact(channels).step_by(stride / channels) {
        let alpha = texel.get(3).map_or(1.0, |&a| f32::from(a) / 255.0);
        let srgb = [texel[0], texel[1], texel[2]].map(|code| f32::from(code) / 255.0);
        sum += alpha * Vec3::from_array(srgb.map(crate::obj::linear_from_srgb));
        weight += alpha;
    }
    if weight > 0.0 { sum / weight } else { Vec3::ONE }
}
