//! What scenes need of the images of a glTF file: the mean colour of those that colour something, the alpha of those that
//! cut something out.
//!
//! A scene for shadows needs no texture, but a ship should be brown and its sails light: the mean over all texels, taken in
//! linear light (texels are sRGB code values) and weighted by alpha, is enough. Texture transforms, repeats and the part of
//! the texture that a mesh really uses are ignored by the mean; transforms by masks, too. A mask without a texture is opaque.
//! Two channels are a grey and its alpha, as PNG files have them.

use std::path::Path;
use std::sync::Arc;

use glam::{UVec2, Vec3};
use gltf::image::{Data, Format};
use gltf::material::AlphaMode;
use gltf::texture::WrappingMode;

use crate::alpha_mask::{AlphaTexture, Wrap};

/// Texels looked at per image, on a regular stride: a mean over 4096 has a standard error below 1 %.
const SAMPLES: usize = 4096;
/// Which byte of a 16-bit number is the higher one.
const HIGH_BYTE: usize = if cfg!(target_endian = "little") { 1 } else { 0 };
/// The cutoff of a mask that names none, by the format.
const CUTOFF: f32 = 0.5;

/// An image of a file, as far as it is needed.
pub struct Image {
    /// Mean linear colour; white where the image cannot be read or colours nothing.
    mean: Vec3,
    /// Size and alphas by rows; `None` where there are none, or nothing is cut out by them.
    alphas: Option<(UVec2, Arc<[u8]>)>,
}

impl Image {
    const WHITE: Self = Self { mean: Vec3::ONE, alphas: None };

    fn of(data: &Data, is_mask: bool) -> Self {
        let size = UVec2::new(data.width, data.height);
        Self { mean: mean(data), alphas: alphas(data).filter(|_| is_mask).map(|alphas| (size, alphas)) }
    }
}

/// Every image of a document; one that cannot be read is white and opaque, with a warning.
pub fn images(document: &gltf::Document, file: &Path, buffers: &[gltf::buffer::Data]) -> Vec<Image> {
    let image_of = |image: gltf::Image<'_>| {
        let mut users = document.materials().filter(|material| is_colored_by(material, image.index())).peekable();
        if users.peek().is_none() {
            return Image::WHITE;
        }
        if !has_source(document, image.index()) || !lies_in_buffer(&image, buffers) {
            tracing::warn!(
                "{}: image {} has no data of its own; its material is white and opaque",
                file.display(),
                image.index()
            );
            return Image::WHITE;
        }
        match Data::from_source(image.source(), file.parent(), buffers) {
            Ok(data) => Image::of(&data, users.any(|material| material.alpha_mode() == AlphaMode::Mask)),
            Err(problem) => {
                tracing::warn!(
                    "{}: image {} cannot be read ({problem}); its material is white and opaque",
                    file.display(),
                    image.index()
                );
                Image::WHITE
            }
        }
    };
    document.images().map(image_of).collect()
}

/// The material's colour: factor times texture mean.
pub fn linear_color(material: &gltf::Material<'_>, images: &[Image]) -> Vec3 {
    let surface = material.pbr_metallic_roughness();
    let [r, g, b, _] = surface.base_color_factor();
    let mean = image_of(material, images).map_or(Vec3::ONE, |image| image.mean);
    (Vec3::new(r, g, b) * mean).clamp(Vec3::ZERO, Vec3::ONE)
}

/// What cuts the material out, with the set of texture coordinates that looks it up; `None` where nothing does.
pub fn alpha_texture(material: &gltf::Material<'_>, images: &[Image]) -> Option<(AlphaTexture, u32)> {
    if material.alpha_mode() != AlphaMode::Mask {
        return None;
    }
    let surface = material.pbr_metallic_roughness();
    let [.., factor] = surface.base_color_factor();
    let info = surface.base_color_texture()?;
    let (size, alphas) = image_of(material, images)?.alphas.clone()?;
    let sampler = info.texture().sampler();
    let cutoff = material.alpha_cutoff().unwrap_or(CUTOFF);
    let texture = AlphaTexture {
        size,
        alphas,
        wrap: [sampler.wrap_s(), sampler.wrap_t()].map(wrap),
        // Alpha is factor times texel.
        cutoff: if cutoff > 0.0 { cutoff / factor } else { 0.0 },
    };
    (!texture.is_solid()).then_some((texture, info.tex_coord()))
}

fn image_of<'a>(material: &gltf::Material<'_>, images: &'a [Image]) -> Option<&'a Image> {
    images.get(material.pbr_metallic_roughness().base_color_texture()?.texture().source().index())
}

fn is_colored_by(material: &gltf::Material<'_>, image: usize) -> bool {
    let texture = material.pbr_metallic_roughness().base_color_texture();
    texture.is_some_and(|info| info.texture().source().index() == image)
}

fn wrap(mode: WrappingMode) -> Wrap {
    match mode {
        WrappingMode::Repeat => Wrap::Repeat,
        WrappingMode::MirroredRepeat => Wrap::Mirror,
        WrappingMode::ClampToEdge => Wrap::Clamp,
    }
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

/// The alphas of an image to 8 bits; `None` of one that has none.
fn alphas(image: &Data) -> Option<Arc<[u8]>> {
    let every = |bytes: usize, at: usize| image.pixels.chunks_exact(bytes).map(|texel| texel[at]).collect();
    match image.format {
        Format::R8G8 => Some(every(2, 1)),
        Format::R8G8B8A8 => Some(every(4, 3)),
        // The high byte of a number in the machine's order.
        Format::R16G16 => Some(every(4, 2 + HIGH_BYTE)),
        Format::R16G16B16A16 => Some(every(8, 6 + HIGH_BYTE)),
        Format::R32G32B32A32FLOAT => {
            let alpha = |texel: &[u8]| f32::from_ne_bytes([texel[12], texel[13], texel[14], texel[15]]);
            Some(image.pixels.chunks_exact(16).map(|texel| (alpha(texel) * 255.0).round() as u8).collect())
        }
        _ => None,
    }
}
