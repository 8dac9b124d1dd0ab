//! The pipelines that draw a scene into a shadow map: positions under the matrix of the drop-in's view, and the masks of
//! what is cut out.

use wgpu::util::DeviceExt;

use crate::device::Gpu;
use crate::gbuffer::entry;
use crate::geometry::Geometry;
use crate::masks::{UV_LAYOUT, mask_layout};

/// Draws casters.
pub struct CasterPass {
    pipeline: wgpu::RenderPipeline,
    masked: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
}

impl CasterPass {
    /// Builds the pipelines. Both sides of every triangle cast, because open surfaces have no other side to stand in.
    pub fn new(gpu: &Gpu, shadows: &scumble::Shadows) -> Self {
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("casters"),
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
        let source = concat!(include_str!("../shader/mask.wgsl"), include_str!("../shader/caster.wgsl"));
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("casters"),
            source: wgpu::ShaderSource::Wgsl(source.into()),
        });
        let pipeline = |vertex, fragment: Option<&str>, groups: &[Option<&wgpu::BindGroupLayout>], buffers: &[_]| {
            let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("casters"),
                bind_group_layouts: groups,
                immediate_size: 0,
            });
            gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some("casters"),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some(vertex),
                    compilation_options: Default::default(),
                    buffers,
                },
                primitive: wgpu::PrimitiveState { unclipped_depth: shadows.unclipped_depth(), ..Default::default() },
                depth_stencil: Some(shadows.depth_stencil_state()),
                multisample: Default::default(),
                fragment: fragment.map(|entry_point| wgpu::FragmentState {
                    module: &module,
                    entry_point: Some(entry_point),
                    compilation_options: Default::default(),
                    targets: &[],
                }),
                multiview_mask: None,
                cache: None,
            })
        };
        let position = Some(Geometry::POSITION_LAYOUT);
        let mask = mask_layout(gpu);
        Self {
            pipeline: pipeline("caster", None, &[Some(&layout)], std::slice::from_ref(&position)),
            masked: pipeline(
                "caster_masked",
                Some("cut_out"),
                &[Some(&layout), Some(&mask)],
                &[position, Some(UV_LAYOUT)],
            ),
            layout,
        }
    }

    /// The matrix of a view, for [`draw`](Self::draw).
    pub fn matrix(&self, gpu: &Gpu, clip_from_world: glam::Mat4) -> wgpu::BindGroup {
        let buffer = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("caster matrix"),
            contents: bytemuck::bytes_of(&clip_from_world),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("caster matrix"),
            layout: &self.layout,
            entries: &[entry(0, buffer.as_entire_binding())],
        })
    }

    /// Draws all casters into the pass of a view.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, matrix: &wgpu::BindGroup, geometry: &Geometry) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, matrix, &[]);
        geometry.draw_positions(pass);
        if let Some(masked) = geometry.masked() {
            pass.set_pipeline(&self.masked);
            masked.draw(pass, 1);
        }
    }
}
