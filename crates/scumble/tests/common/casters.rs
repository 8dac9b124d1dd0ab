//! Triangles, and a renderer that draws them into maps and a depth prepass.

use glam::{DVec3, Mat4, Vec3};
use scumble::{Camera, Plan, Shadows};

use super::Gpu;

/// Triangles to draw, positions relative to the origin of the options.
pub struct Casters {
    vertices: wgpu::Buffer,
    count: u32,
    layout: wgpu::BindGroupLayout,
    map: wgpu::RenderPipeline,
    prepass: wgpu::RenderPipeline,
}

/// Corners of a quad, in a row around it, as two triangles.
pub fn quad(corners: [Vec3; 4]) -> Vec<Vec3> {
    [0, 1, 2, 0, 2, 3].map(|i| corners[i]).to_vec()
}

/// The six sides of a box.
pub fn cuboid(min: Vec3, max: Vec3) -> Vec<Vec3> {
    let corner = |i: usize| {
        Vec3::new(
            if i & 1 == 0 { min.x } else { max.x },
            if i & 2 == 0 { min.y } else { max.y },
            if i & 4 == 0 { min.z } else { max.z },
        )
    };
    let sides = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    sides.into_iter().flat_map(|side| quad(side.map(corner))).collect()
}

const SHADER: &str = "
    @group(0) @binding(0) var<uniform> clip_from_world: mat4x4f;
    @vertex fn draw(@location(0) position: vec3f) -> @builtin(position) vec4f {
        return clip_from_world * vec4f(position, 1.0);
    }";

impl Casters {
    pub fn new(gpu: &Gpu, shadows: &Shadows, vertices: &[Vec3]) -> Self {
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            }],
        });
        Self {
            vertices: gpu.buffer(vertices, wgpu::BufferUsages::VERTEX),
            count: vertices.len() as u32,
            map: pipeline(gpu, &layout, shadows.depth_stencil_state(), shadows.unclipped_depth()),
            prepass: pipeline(gpu, &layout, shadows.depth_stencil_state(), false),
            layout,
        }
    }

    /// Draws all maps of a plan, and what their filter makes of them.
    pub fn draw_maps(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, shadows: &mut Shadows, plan: &Plan) {
        for view in plan.views() {
            let matrix = self.matrix(gpu, view.clip_from_world);
            self.draw(&mut shadows.begin(encoder, view), &self.map, &matrix);
        }
        shadows.prefilter(encoder);
    }

    /// Draws the maps of a plan that do not hold these casters yet.
    pub fn draw_static(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, shadows: &mut Shadows, plan: &Plan) {
        for view in plan.views() {
            if let Some(mut pass) = shadows.begin_static(encoder, view) {
                self.draw(&mut pass, &self.map, &self.matrix(gpu, view.clip_from_world));
            }
        }
    }

    /// Draws the depth prepass into a fresh texture.
    pub fn draw_prepass(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        camera: &Camera,
        origin_world: DVec3,
        [width, height]: [u32; 2],
    ) -> wgpu::TextureView {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Depth32Float,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let target = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let relative = camera.clip_from_world() * glam::DMat4::from_translation(origin_world);
        let matrix = self.matrix(gpu, relative.as_mat4());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: None,
            color_attachments: &[],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &target,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store }),
                stencil_ops: None,
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        self.draw(&mut pass, &self.prepass, &matrix);
        drop(pass);
        target
    }

    fn matrix(&self, gpu: &Gpu, matrix: Mat4) -> wgpu::BindGroup {
        let buffer = gpu.buffer(&[matrix.to_cols_array()], wgpu::BufferUsages::UNIFORM);
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &self.layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() }],
        })
    }

    fn draw(&self, pass: &mut wgpu::RenderPass<'_>, pipeline: &wgpu::RenderPipeline, matrix: &wgpu::BindGroup) {
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, matrix, &[]);
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.draw(0..self.count, 0..1);
    }
}

fn pipeline(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    depth: wgpu::DepthStencilState,
    unclipped_depth: bool,
) -> wgpu::RenderPipeline {
    let device = &gpu.device;
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(SHADER.into()),
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    let attributes = [wgpu::VertexAttribute { format: wgpu::VertexFormat::Float32x3, offset: 0, shader_location: 0 }];
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("draw"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: 12,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &attributes,
            })],
        },
        primitive: wgpu::PrimitiveState { unclipped_depth, ..Default::default() },
        depth_stencil: Some(depth),
        multisample: wgpu::MultisampleState::default(),
        fragment: None,
        multiview_mask: None,
        cache: None,
    })
}
