//! The meshes of a scene that are cut out by a texture: their part of the buffers, and what the shaders look up.

use std::ops::Range;

use anyhow::{Result, ensure};
use glam::Vec2;
use scumble_scenes::{AlphaTexture, Scene, Wrap};
use wgpu::util::DeviceExt;

use crate::device::Gpu;
use crate::gbuffer::{entry, texture_entry, uniform_entry};

/// What is cut out of a scene.
pub struct MaskedMeshes {
    uvs: wgpu::Buffer,
    parts: Vec<(Range<u32>, wgpu::BindGroup)>,
}

/// Twin of `Mask` in mask.wgsl.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct MaskUniform {
    size: [i32; 2],
    wrap: [i32; 2],
    cutoff: f32,
    padding: [f32; 3],
}

/// Texture coordinates, one a vertex of the scene.
pub const UV_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Vec2>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![3 => Float32x2],
};

/// Group 1 of the pipelines that cut out.
pub fn mask_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("mask"),
        entries: &[uniform_entry(0), texture_entry(1)],
    })
}

impl MaskedMeshes {
    /// Uploads the masks of a scene. `indices_of` has the place of each mesh in the scene's list of indices.
    ///
    /// # Errors
    /// A texture larger than the device's.
    pub fn upload(gpu: &Gpu, scene: &Scene, indices_of: &[Range<u32>]) -> Result<Option<Self>> {
        if scene.meshes.iter().all(|mesh| mesh.mask.is_none()) {
            return Ok(None);
        }
        let layout = mask_layout(gpu);
        let (mut uvs, mut parts) = (Vec::<Vec2>::new(), Vec::new());
        for (mesh, indices) in scene.meshes.iter().zip(indices_of) {
            let end = uvs.len() + mesh.positions.len();
            if let Some(mask) = &mesh.mask {
                let limit = gpu.device.limits().max_texture_dimension_2d;
                let size = mask.texture.size;
                ensure!(size.max_element() <= limit, "{}: a mask of {size} texels, {limit} a side fit", mesh.name);
                parts.push((indices.clone(), bind_group(gpu, &layout, &mask.texture)));
                uvs.extend(&mask.uvs);
            }
            uvs.resize(end, Vec2::ZERO);
        }
        let uvs = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("texture coordinates"),
            contents: bytemuck::cast_slice(&uvs),
            usage: wgpu::BufferUsages::VERTEX,
        });
        Ok(Some(Self { uvs, parts }))
    }

    /// Draws them with the pipeline, positions and indices that are set; texture coordinates go to `slot`.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, slot: u32) {
        pass.set_vertex_buffer(slot, self.uvs.slice(..));
        for (indices, mask) in &self.parts {
            pass.set_bind_group(1, mask, &[]);
            pass.draw_indexed(indices.clone(), 0, 0..1);
        }
    }
}

fn bind_group(gpu: &Gpu, layout: &wgpu::BindGroupLayout, texture: &AlphaTexture) -> wgpu::BindGroup {
    let uniform = MaskUniform {
        size: texture.size.as_ivec2().to_array(),
        wrap: texture.wrap.map(|wrap| match wrap {
            Wrap::Repeat => 0,
            Wrap::Mirror => 1,
            Wrap::Clamp => 2,
        }),
        cutoff: texture.cutoff,
        padding: [0.0; 3],
    };
    let uniform = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("mask"),
        contents: bytemuck::bytes_of(&uniform),
        usage: wgpu::BufferUsages::UNIFORM,
    });
    let alphas = gpu.device.create_texture_with_data(
        &gpu.queue,
        &wgpu::TextureDescriptor {
            label: Some("mask"),
            size: wgpu::Extent3d { width: texture.size.x, height: texture.size.y, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::R8Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::default(),
        &texture.alphas,
    );
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("mask"),
        layout,
        entries: &[
            entry(0, uniform.as_entire_binding()),
            entry(1, wgpu::BindingResource::TextureView(&alphas.create_view(&Default::default()))),
        ],
    })
}
