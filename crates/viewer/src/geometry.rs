//! A scene on the device: one stream of positions, which is all that a shadow map reads, one of normals and colours,
//! and one list of triangles.

use anyhow::{Result, ensure};
use glam::Vec3;
use scumble_scenes::Scene;
use wgpu::util::DeviceExt;

use crate::device::Gpu;

/// The buffers of a scene.
pub struct Geometry {
    positions: wgpu::Buffer,
    attributes: wgpu::Buffer,
    indices: wgpu::Buffer,
    index_count: u32,
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
        let mut indices = Vec::new();
        for mesh in &scene.meshes {
            let first = positions.len() as u32;
            positions.extend_from_slice(&mesh.positions);
            attributes.extend(
                mesh.normals.iter().map(|&normal_world| Attributes { normal_world, linear_color: mesh.linear_color }),
            );
            indices.extend(mesh.triangles.iter().flatten().map(|index| first + index));
        }
        let buffer = |label, contents: &[u8], usage| {
            gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
        };
        Ok(Self {
            positions: buffer("positions", bytemuck::cast_slice(&positions), wgpu::BufferUsages::VERTEX),
            attributes: buffer("attributes", bytemuck::cast_slice(&attributes), wgpu::BufferUsages::VERTEX),
            indices: buffer("triangles", bytemuck::cast_slice(&indices), wgpu::BufferUsages::INDEX),
            index_count: indices.len() as u32,
        })
    }

    /// Draws positions only.
    pub fn draw_positions(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.positions.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..self.index_count, 0, 0..1);
    }

    /// Draws with normals and colours.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(1, self.attributes.slice(..));
        self.draw_positions(pass);
    }
}
