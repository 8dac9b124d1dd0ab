//! From receivers and visibility to a picture: Lambert reflection, sky light with ambient obscurance, a simple sky.
//!
//! The G-buffer has `samples_per_side`^2 samples per pixel of the picture; they are averaged after the tone curve.
//! Nothing here is measured: the pictures show what the numbers say.

use anyhow::{Context, Result};
use glam::{DVec3, Vec3};
use image::RgbImage;
use scumble_core::Light;
use scumble_scenes::Scene;

use crate::device::Gpu;
use crate::fullscreen;
use crate::gbuffer::{GBuffer, GBufferPass, entry, target, texture_entry};
use crate::readback::read_texture;

/// Marks a directional light where a spot has the cosine of its cone.
const NO_CONE: f32 = -2.0;
/// The cosine of a point light's cone, whose soft edge ends below 0, which is its cosine to every side: its direction is zero.
const ALL_SIDES: f32 = -1.0;
/// The obscurance looks this far, as a share of the distance from the eye to what it looks at.
const OBSCURANCE_SHARE: f64 = 0.06;

/// Twin of `Lighting` in lighting.wgsl.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub struct LightingUniform {
    light_color: Vec3,
    obscurance_radius_world: f32,
    light_position: Vec3,
    focal_length_px: f32,
    light_direction: Vec3,
    cone_cosine: f32,
    zenith_color: Vec3,
    reference_distance_squared: f32,
    horizon_color: Vec3,
    samples_per_side: u32,
    ground_color: Vec3,
    exposure: f32,
    up: Vec3,
    padding: f32,
    below_color: Vec3,
    padding_end: f32,
}

impl LightingUniform {
    /// The look of a scene: sun and sky for a directional light, a warm lamp in a dim room for a spot and a point light.
    pub fn new(scene: &Scene, height_px: u32, samples_per_side: u32) -> Self {
        let camera = &scene.camera;
        let up = camera.up.normalize().as_vec3();
        let focal_length_px = f64::from(height_px * samples_per_side) / 2.0 / (camera.vertical_fov / 2.0).tan();
        let obscurance = OBSCURANCE_SHARE * (camera.target - camera.eye).length();
        let common = Self {
            obscurance_radius_world: obscurance as f32,
            focal_length_px: focal_length_px as f32,
            samples_per_side,
            exposure: 1.0,
            up,
            ..bytemuck::Zeroable::zeroed()
        };
        match &scene.light {
            Light::Directional { direction, .. } => Self {
                light_color: Vec3::new(2.5, 2.22, 1.8),
                light_direction: direction.normalize().as_vec3(),
                cone_cosine: NO_CONE,
                zenith_color: Vec3::new(0.20, 0.38, 0.80),
                horizon_color: Vec3::new(0.60, 0.78, 1.05),
                ground_color: Vec3::new(0.30, 0.27, 0.23),
                below_color: Vec3::new(0.50, 0.56, 0.62),
                ..common
            },
            Light::Spot { position, direction, cone_half_angle, .. } => {
                Self::lamp(common, *position, direction.normalize().as_vec3(), cone_half_angle.cos() as f32, scene)
            }
            Light::Point { position, .. } => Self::lamp(common, *position, Vec3::ZERO, ALL_SIDES, scene),
        }
    }

    fn lamp(common: Self, position: DVec3, light_direction: Vec3, cone_cosine: f32, scene: &Scene) -> Self {
        Self {
            light_color: Vec3::new(3.3, 2.75, 2.0),
            light_position: position.as_vec3(),
            light_direction,
            cone_cosine,
            reference_distance_squared: reference_distance(position, scene).powi(2) as f32,
            zenith_color: Vec3::new(0.15, 0.17, 0.22),
            horizon_color: Vec3::new(0.24, 0.23, 0.23),
            ground_color: Vec3::new(0.20, 0.17, 0.14),
            below_color: Vec3::new(0.10, 0.09, 0.08),
            ..common
        }
    }
}

/// Where a spot's light has the strength of `light_color`: at the distance of what the camera looks at.
fn reference_distance(position: DVec3, scene: &Scene) -> f64 {
    position.distance(scene.camera.target).max(1e-3)
}

/// The pipelines of the picture.
pub struct ShadingPass {
    ambient: wgpu::RenderPipeline,
    shade: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
}

impl ShadingPass {
    const OPENNESS_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R8Unorm;
    const PICTURE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

    /// Builds the pipelines.
    pub fn new(gpu: &Gpu, gbuffer: &GBufferPass) -> Self {
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("shading"),
            entries: &[texture_entry(0), texture_entry(1)],
        });
        const SHARED: &str = concat!(
            include_str!("../shader/camera.wgsl"),
            include_str!("../shader/gbuffer_read.wgsl"),
            include_str!("../shader/lighting.wgsl")
        );
        let ambient_source = [SHARED, include_str!("../shader/ambient.wgsl")].concat();
        let shade_source = [SHARED, include_str!("../shader/shading.wgsl")].concat();
        let ambient_layouts = [&gbuffer.layout];
        let shade_layouts = [&gbuffer.layout, &layout];
        let ambient = fullscreen::pipeline(
            gpu,
            "ambient",
            &ambient_source,
            "ambient",
            &[],
            &ambient_layouts,
            Self::OPENNESS_FORMAT,
        );
        let shade =
            fullscreen::pipeline(gpu, "shade", &shade_source, "shade", &[], &shade_layouts, Self::PICTURE_FORMAT);
        Self { ambient, shade, layout }
    }

    /// The picture of a G-buffer under a visibility texture of the same size.
    pub fn picture(
        &self,
        gpu: &Gpu,
        gbuffer: &GBuffer,
        visibility: &wgpu::Texture,
        samples_per_side: u32,
    ) -> Result<RgbImage> {
        let mut encoder = gpu.encoder("picture");
        let picture = self.draw(gpu, &mut encoder, gbuffer, visibility, samples_per_side);
        gpu.finish(encoder)?;
        let rgba = read_texture(gpu, &picture)?;
        let rgb = rgba.chunks_exact(4).flat_map(|texel| &texel[..3]).copied().collect();
        RgbImage::from_raw(picture.width(), picture.height(), rgb)
            .context("the picture has another size than its pixels")
    }

    /// Records the passes of a picture and returns where it will be.
    pub fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        gbuffer: &GBuffer,
        visibility: &wgpu::Texture,
        samples_per_side: u32,
    ) -> wgpu::Texture {
        let [width, height] = gbuffer.size_px.map(|side| side / samples_per_side);
        let openness = target(gpu, "openness", gbuffer.size_px, Self::OPENNESS_FORMAT);
        let picture = target(gpu, "picture", [width, height], Self::PICTURE_FORMAT);
        let views = [visibility, &openness].map(|texture| texture.create_view(&Default::default()));
        let bind_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("shading"),
            layout: &self.layout,
            entries: &[
                entry(0, wgpu::BindingResource::TextureView(&views[0])),
                entry(1, wgpu::BindingResource::TextureView(&views[1])),
            ],
        });
        fullscreen::draw(encoder, "ambient", &self.ambient, &[&gbuffer.bind_group], &openness);
        fullscreen::draw(encoder, "shade", &self.shade, &[&gbuffer.bind_group, &bind_group], &picture);
        picture
    }
}

#[cfg(test)]
mod tests {
    use std::mem::{offset_of, size_of};

    use super::*;

    #[test]
    fn the_uniform_has_the_layout_of_its_shader() {
        let source = concat!(
            include_str!("../shader/camera.wgsl"),
            include_str!("../shader/gbuffer_read.wgsl"),
            include_str!("../shader/lighting.wgsl")
        );
        let module = naga::front::wgsl::parse_str(source).unwrap();
        let (_, lighting) = module.types.iter().find(|(_, kind)| kind.name.as_deref() == Some("Lighting")).unwrap();
        let naga::TypeInner::Struct { members, span } = &lighting.inner else { panic!("Lighting is a struct") };
        let offset_of_member = |name: &str| {
            members.iter().find(|member| member.name.as_deref() == Some(name)).map(|member| member.offset as usize)
        };
        macro_rules! same_offset {
            ($($field:ident),*) => {
                $(assert_eq!(offset_of_member(stringify!($field)), Some(offset_of!(LightingUniform, $field)));)*
            };
        }
        same_offset!(
            light_color,
            obscurance_radius_world,
            light_position,
            focal_length_px,
            light_direction,
            cone_cosine
        );
        same_offset!(zenith_color, reference_distance_squared, horizon_color, samples_per_side, ground_color, exposure);
        same_offset!(up, below_color);
        assert_eq!(*span as usize, size_of::<LightingUniform>());
    }
}
