//! The receivers of a frame: for every pixel the world position, the geometric normal, and what the shading needs.
//!
//! | texture | format | holds |
//! |---|---|---|
//! | position | Rgba32Float | world position, w = 1 where there is a surface |
//! | normal | Rgba16Float | geometric normal towards the eye |
//! | shading normal | Rgba16Float | interpolated normal on the same side |
//! | colour | Rgba8UnormSrgb | reflectance |
//! | depth | Depth32Float | 0 near, 1 far: the depth prepass that a demand pass reads |
//!
//! Ground truth is computed at the very positions and normals that the shader saw, read back from here.

use anyhow::{Result, ensure};
use glam::{Mat4, Vec3, Vec4};
use scumble_core::Camera;
use wgpu::util::DeviceExt;

use crate::device::Gpu;
use crate::geometry::Geometry;
use crate::masks::{UV_LAYOUT, mask_layout};
use crate::readback::read_texture;
use crate::shading::LightingUniform;

const POSITION_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;
const NORMAL_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
const COLOR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Twin of `Camera` in camera.wgsl.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct CameraUniform {
    clip_from_world: Mat4,
    world_from_clip: Mat4,
    eye_world: Vec4,
}

/// Where a pixel's surface is; `None` in [`GBuffer::read_surfaces`] is a pixel of the sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// World position.
    pub position: Vec3,
    /// Geometric normal, towards the eye.
    pub normal: Vec3,
}

/// The pipeline that fills a [`GBuffer`], and the layout by which later passes read it.
pub struct GBufferPass {
    pipeline: wgpu::RenderPipeline,
    masked: wgpu::RenderPipeline,
    camera_layout: wgpu::BindGroupLayout,
    /// Group 0 of the full-screen passes: camera, the four textures, lighting.
    pub layout: wgpu::BindGroupLayout,
}

impl GBufferPass {
    /// Builds the pipeline.
    pub fn new(gpu: &Gpu) -> Self {
        let camera_layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("camera"),
            entries: &[uniform_entry(0)],
        });
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("g-buffer"),
            entries: &[
                uniform_entry(0),
                texture_entry(1),
                texture_entry(2),
                texture_entry(3),
                texture_entry(4),
                uniform_entry(5),
            ],
        });
        let source = concat!(
            include_str!("../shader/camera.wgsl"),
            include_str!("../shader/mask.wgsl"),
            include_str!("../shader/gbuffer.wgsl")
        );
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("g-buffer"),
            source: wgpu::ShaderSource::Wgsl(source.into()),
        });
        let targets = [POSITION_FORMAT, NORMAL_FORMAT, NORMAL_FORMAT, COLOR_FORMAT].map(|format| Some(format.into()));
        let (position, attributes) = (Some(Geometry::POSITION_LAYOUT), Some(Geometry::ATTRIBUTE_LAYOUT));
        let pipeline = |entry_points: [&str; 2], groups: &[Option<&wgpu::BindGroupLayout>], buffers: &[_]| {
            let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("g-buffer"),
                bind_group_layouts: groups,
                immediate_size: 0,
            });
            gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some("g-buffer"),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some(entry_points[0]),
                    compilation_options: Default::default(),
                    buffers,
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: Some(wgpu::DepthStencilState {
                    format: DEPTH_FORMAT,
                    depth_write_enabled: Some(true),
                    depth_compare: Some(wgpu::CompareFunction::Less),
                    stencil: Default::default(),
                    bias: Default::default(),
                }),
                multisample: Default::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some(entry_points[1]),
                    compilation_options: Default::default(),
                    targets: &targets,
                }),
                multiview_mask: None,
                cache: None,
            })
        };
        let mask = mask_layout(gpu);
        Self {
            pipeline: pipeline(
                ["vertex", "fragment"],
                &[Some(&camera_layout)],
                &[position.clone(), attributes.clone()],
            ),
            masked: pipeline(
                ["vertex_masked", "fragment_masked"],
                &[Some(&camera_layout), Some(&mask)],
                &[position, attributes, Some(UV_LAYOUT)],
            ),
            camera_layout,
            layout,
        }
    }
}

/// The textures of one frame size and one camera.
pub struct GBuffer {
    /// Pixels across and down.
    pub size_px: [u32; 2],
    /// What the full-screen passes bind as group 0.
    pub bind_group: wgpu::BindGroup,
    /// The depth prepass, 0 near.
    pub depth_view: wgpu::TextureView,
    camera_bind_group: wgpu::BindGroup,
    position: wgpu::Texture,
    normal: wgpu::Texture,
    views: [wgpu::TextureView; 4],
}

impl GBuffer {
    /// Allocates textures of `size_px` for a fixed camera and lighting.
    pub fn new(
        gpu: &Gpu,
        pass: &GBufferPass,
        size_px: [u32; 2],
        camera: &Camera,
        lighting: &LightingUniform,
    ) -> Result<Self> {
        let side_max = gpu.device.limits().max_texture_dimension_2d;
        ensure!(
            size_px.iter().all(|&side| (1..=side_max).contains(&side)),
            "a picture of {} x {} samples: this device allows 1 to {side_max} per side",
            size_px[0],
            size_px[1]
        );
        let [position, normal, shading_normal, color] = [
            ("position", POSITION_FORMAT),
            ("normal", NORMAL_FORMAT),
            ("shading normal", NORMAL_FORMAT),
            ("colour", COLOR_FORMAT),
        ]
        .map(|(label, format)| target(gpu, label, size_px, format));
        let depth = target(gpu, "depth", size_px, DEPTH_FORMAT);
        let views =
            [&position, &normal, &shading_normal, &color].map(|texture| texture.create_view(&Default::default()));

        let clip_from_world = camera.clip_from_world();
        let camera_uniform = CameraUniform {
            clip_from_world: clip_from_world.as_mat4(),
            world_from_clip: clip_from_world.inverse().as_mat4(),
            eye_world: camera.eye.as_vec3().extend(1.0),
        };
        let uniform = |label, contents| {
            let usage = wgpu::BufferUsages::UNIFORM;
            gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
        };
        let camera_buffer = uniform("camera", bytemuck::bytes_of(&camera_uniform));
        let lighting_buffer = uniform("lighting", bytemuck::bytes_of(lighting));
        let camera_bind_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("camera"),
            layout: &pass.camera_layout,
            entries: &[entry(0, camera_buffer.as_entire_binding())],
        });
        let bind_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("g-buffer"),
            layout: &pass.layout,
            entries: &[
                entry(0, camera_buffer.as_entire_binding()),
                entry(1, wgpu::BindingResource::TextureView(&views[0])),
                entry(2, wgpu::BindingResource::TextureView(&views[1])),
                entry(3, wgpu::BindingResource::TextureView(&views[2])),
                entry(4, wgpu::BindingResource::TextureView(&views[3])),
                entry(5, lighting_buffer.as_entire_binding()),
            ],
        });
        let depth_view = depth.create_view(&Default::default());
        Ok(Self { size_px, bind_group, depth_view, camera_bind_group, position, normal, views })
    }

    /// Draws the scene.
    pub fn draw(&self, encoder: &mut wgpu::CommandEncoder, pass: &GBufferPass, geometry: &Geometry) {
        let attachments = self.views.each_ref().map(|view| Some(color_attachment(view)));
        let mut render = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("g-buffer"),
            color_attachments: &attachments,
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth_view,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        render.set_pipeline(&pass.pipeline);
        render.set_bind_group(0, &self.camera_bind_group, &[]);
        geometry.draw(&mut render);
        if let Some(masked) = geometry.masked() {
            render.set_pipeline(&pass.masked);
            masked.draw(&mut render, 2);
        }
    }

    /// The surface of every pixel, rows from top to bottom.
    pub fn read_surfaces(&self, gpu: &Gpu) -> Result<Vec<Option<Surface>>> {
        let positions: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&read_texture(gpu, &self.position)?);
        let normals: Vec<[u16; 4]> = bytemuck::pod_collect_to_vec(&read_texture(gpu, &self.normal)?);
        let surfaces = positions.iter().zip(&normals).map(|(&[x, y, z, hit], normal)| {
            let [nx, ny, nz, _] = normal.map(f32_from_f16);
            (hit > 0.0).then(|| Surface { position: Vec3::new(x, y, z), normal: Vec3::new(nx, ny, nz) })
        });
        Ok(surfaces.collect())
    }
}

/// The number that a half-precision float stands for.
fn f32_from_f16(bits: u16) -> f32 {
    let sign = if bits >> 15 == 1 { -1.0 } else { 1.0 };
    let exponent = i32::from(bits >> 10 & 0x1f);
    let mantissa = f32::from(bits & 0x3ff);
    sign * match exponent {
        0 => mantissa * 2f32.powi(-24),
        0x1f if mantissa == 0.0 => f32::INFINITY,
        0x1f => f32::NAN,
        _ => (1.0 + mantissa / 1024.0) * 2f32.powi(exponent - 15),
    }
}

/// A texture that a pass draws into, later passes read and the program reads back.
pub fn target(gpu: &Gpu, label: &str, size_px: [u32; 2], format: wgpu::TextureFormat) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: size_px[0], height: size_px[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC
            | if format.is_depth_stencil_format() {
                wgpu::TextureUsages::empty()
            } else {
                wgpu::TextureUsages::COPY_DST
            },
        view_formats: &[],
    })
}

/// Clears to zero and stores.
pub fn color_attachment(view: &wgpu::TextureView) -> wgpu::RenderPassColorAttachment<'_> {
    wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store },
    }
}

/// A texture that fragments read texel by texel.
pub fn texture_entry(binding: u32) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty: wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: false },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        },
        count: None,
    }
}

/// One resource of a bind group.
pub fn entry(binding: u32, resource: wgpu::BindingResource<'_>) -> wgpu::BindGroupEntry<'_> {
    wgpu::BindGroupEntry { binding, resource }
}

/// A uniform buffer of vertices and fragments.
pub fn uniform_entry(binding: u32) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_floats_become_the_numbers_they_stand_for() {
        for (bits, value) in [(0x3c00, 1.0), (0xbc00, -1.0), (0x3800, 0.5), (0x0000, 0.0), (0x0001, 5.960_464_5e-8)] {
            assert_eq!(f32_from_f16(bits), value);
        }
        assert!((f32_from_f16(0x3555) - 1.0 / 3.0).abs() < 1e-4);
    }
}
