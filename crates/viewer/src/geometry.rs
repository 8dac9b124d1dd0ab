//! A scene on the device: one stream of positions, which is all that a shadow map reads, one of normals and colours,
//! and one list of triangles.

use std::ops::Range;

use anyhow::{Result, ensure};
use glam::Vec3;
use scumble_scenes::Scene;
use wgpu::util::DeviceExt;

use crate::device::Gpu;
use crate::masks::MaskedMeshes;

/// The buffers of a scene.
pub struct Geometry {
    positions: wgpu::Buffer,
    attributes: wgpu::Buffer,
    indices: wgpu::Buffer,
    /// Indices of what is whole; those of what is cut out follow.
    index_count: u32,
    masked: Option<MaskedMeshes>,
}

#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Attributes {
    normal_world: Vec3,
    linear_color: Vec3,
}

impl Geometry {
    /// Positions for the passes of shadow maps and the depth of a frame.
    pub const POSITION_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
        array_stride: size_of::<Vec3>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &wgpu::vertex_attr_array![0 => Float32x3],
    };

    /// What the G-buffer needs besides positions.
    pub const ATTRIBUTE_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
        array_stride: size_of::<Attributes>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &wgpu::vertex_attr_array![1 => Float32x3, 2 => Float32x3],
    };

    /// Uploads all meshes of a scene as one.
    pub fn upload(gpu: &Gpu, scene: &Scene) -> Result<Self> {
        let vertex_count: usize = scene.meshes.iter().map(|mesh| mesh.positions.len()).sum();
        ensure!(vertex_count < u32::MAX as usize, "{}: {vertex_count} vertices, at most 2^32 - 1 fit", scene.name);
        let mut positions: Vec<Vec3> = Vec::with_capacity(vertex_count);
        let mut attributes = Vec::with_capacity(vertex_count);
        let mut first_vertices = Vec::with_capacity(scene.meshes.len());
        for mesh in &scene.meshes {
            first_vertices.push(positions.len() as u32);
            positions.extend_from_slice(&mesh.positions);
            attributes.extend(
                mesh.normals.iter().map(|&normal_world| Attributes { normal_world, linear_color: mesh.linear_color }),
            );
        }
        let (indices, indices_of, index_count) = indices(scene, &first_vertices);
        let buffer = |label, contents: &[u8], usage| {
            gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
        };
        Ok(Self {
            positions: buffer("positions", bytemuck::cast_slice(&positions), wgpu::BufferUsages::VERTEX),
            attributes: buffer("attributes", bytemuck::cast_slice(&attributes), wgpu::BufferUsages::VERTEX),
            indices: buffer("triangles", bytemuck::cast_slice(&indices), wgpu::BufferUsages::INDEX),
            index_count,
            masked: MaskedMeshes::upload(gpu, scene, &indices_of)?,
        })
    }

    /// What is cut out, for pipelines that look up its masks, after one of the two below.
    pub fn masked(&self) -> Option<&MaskedMeshes> {
        self.masked.as_ref()
    }

    /// Draws positions only, of what is whole.
    pub fn draw_positions(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.positions.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..self.index_count, 0, 0..1);
    }

    /// Draws with normals and colours, what is whole.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(1, self.attributes.slice(..));
        self.draw_positions(pass);
    }
}

/// All indices, those of whole meshes first; where those of each mesh are; how many are of whole meshes.
fn indices(scene: &Scene, first_vertices: &[u32]) -> (Vec<u32>, Vec<Range<u32>>, u32) {
    let (mut indices, mut places) = (Vec::new(), vec![0..0; scene.meshes.len()]);
    let mut whole = 0;
    for is_masked in [false, true] {
        for ((mesh, first), place) in scene.meshes.iter().zip(first_vertices).zip(&mut places) {
            if mesh.mask.is_some() == is_masked {
                let begin = indices.len() as u32;
                indices.extend(mesh.triangles.iter().flatten().map(|index| first + index));
                *place = begin..indices.len() as u32;
            }
        }
        if !is_masked {
            whole = indices.len() as u32;
        }
    }
    (indices, places, whole)
}
