//! What was drawn of the casters that stand still, so that it is not drawn again.
//!
//! A map's place holds the static casters of a view until another view is drawn there, or the caller says that they changed.
//! They are in the map itself, or with [`Keep::StaticLayers`] in a layer beside it, which every frame puts into the map
//! before the moving casters.

use glam::{DVec3, Mat4};

use crate::maps::{Maps, depth_state};
use crate::options::Keep;
use crate::view::View;

/// What the layers hold, and the layers beside the maps.
#[derive(Debug)]
pub struct Kept {
    drawn: Vec<Option<Drawn>>,
    apart: Option<Apart>,
}

/// What depends on the view where static casters are, and the place.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Drawn {
    clip_from_world: Mat4,
    origin_world: DVec3,
    layer: u32,
    origin_texels: [u32; 2],
    size_texels: [u32; 2],
}

/// Layers for static casters, and the pass that puts them into the maps.
#[derive(Debug)]
struct Apart {
    layers: Maps,
    copy: wgpu::RenderPipeline,
    groups: Vec<wgpu::BindGroup>,
}

impl Kept {
    /// Allocates what the choice needs beside `maps`, the textures of `count` maps.
    pub fn new(device: &wgpu::Device, maps: &Maps, count: u32, keep: Keep) -> Self {
        let apart = (keep == Keep::StaticLayers).then(|| Apart::new(device, maps));
        Self { drawn: vec![None; count as usize], apart }
    }

    /// Bytes of the layers beside the maps.
    pub fn bytes(&self) -> u64 {
        self.apart.as_ref().map_or(0, |apart| apart.layers.bytes())
    }

    /// Textures and bind groups created.
    pub fn allocations(&self) -> u64 {
        self.apart.as_ref().map_or(0, |apart| 1 + apart.groups.len() as u64)
    }

    /// Whether there are layers beside the maps.
    pub fn is_apart(&self) -> bool {
        self.apart.is_some()
    }

    /// Forgets what all layers hold.
    pub fn forget(&mut self) {
        self.drawn.fill(None);
    }

    /// Forgets what lies where a view is drawn, and what was drawn for its map elsewhere.
    fn forget_under(&mut self, view: &View) {
        for (map, place) in (0..).zip(&mut self.drawn) {
            if map == view.map || place.is_some_and(|drawn| drawn.meets(view)) {
                *place = None;
            }
        }
    }

    /// Whether the static casters of a view are in its layer.
    pub fn holds(&self, view: &View, origin_world: DVec3) -> bool {
        let drawn = self.drawn.get(view.map as usize).copied().flatten();
        drawn == Some(Drawn::of(view, origin_world))
    }

    /// The pass for the static casters of a view, into `maps` or the layers beside them.
    pub fn begin_static<'encoder>(
        &mut self,
        maps: &Maps,
        encoder: &'encoder mut wgpu::CommandEncoder,
        view: &View,
        origin_world: DVec3,
    ) -> wgpu::RenderPass<'encoder> {
        self.forget_under(view);
        if let Some(drawn) = self.drawn.get_mut(view.map as usize) {
            *drawn = Some(Drawn::of(view, origin_world));
        }
        self.apart.as_ref().map_or(maps, |apart| &apart.layers).begin(encoder, view)
    }

    /// The pass for moving or all casters of a view: over its static casters where there is a layer of them, else over
    /// nothing, which leaves none in the map.
    pub fn begin<'encoder>(
        &mut self,
        maps: &Maps,
        encoder: &'encoder mut wgpu::CommandEncoder,
        view: &View,
        origin_world: DVec3,
    ) -> wgpu::RenderPass<'encoder> {
        let is_held = self.holds(view, origin_world);
        match &self.apart {
            Some(apart) if is_held => apart.begin_over(maps, encoder, view),
            Some(_) => maps.begin(encoder, view),
            None => {
                self.forget_under(view);
                maps.begin(encoder, view)
            }
        }
    }
}

impl Drawn {
    fn of(view: &View, origin_world: DVec3) -> Self {
        Self {
            clip_from_world: view.clip_from_world,
            origin_world,
            layer: view.layer,
            origin_texels: view.origin_texels,
            size_texels: view.size_texels,
        }
    }

    /// Whether a view takes up texels of this.
    fn meets(&self, view: &View) -> bool {
        let overlaps = |axis: usize| {
            self.origin_texels[axis] < view.origin_texels[axis] + view.size_texels[axis]
                && view.origin_texels[axis] < self.origin_texels[axis] + self.size_texels[axis]
        };
        self.layer == view.layer && overlaps(0) && overlaps(1)
    }
}

impl Apart {
    fn new(device: &wgpu::Device, maps: &Maps) -> Self {
        let layers = Maps::new(device, maps.side(), maps.layers().len() as u32);
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("scumble copy"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty: wgpu::BindingType::Texture {
                    sample_type: wgpu::TextureSampleType::Float { filterable: false },
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
                count: None,
            }],
        });
        let group = |layer: &wgpu::TextureView| {
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("scumble copy"),
                layout: &layout,
                entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(layer) }],
            })
        };
        Self { groups: layers.layers().iter().map(group).collect(), copy: copy_pipeline(device, &layout), layers }
    }

    fn begin_over<'encoder>(
        &self,
        maps: &Maps,
        encoder: &'encoder mut wgpu::CommandEncoder,
        view: &View,
    ) -> wgpu::RenderPass<'encoder> {
        let layer = (view.layer as usize).min(self.groups.len() - 1);
        let mut pass = maps.begin_loaded(encoder, view, wgpu::LoadOp::Load);
        pass.set_pipeline(&self.copy);
        pass.set_bind_group(0, &self.groups[layer], &[]);
        pass.draw(0..3, 0..1);
        pass
    }
}

fn copy_pipeline(device: &wgpu::Device, layout: &wgpu::BindGroupLayout) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("scumble copy"),
        source: wgpu::ShaderSource::Wgsl(crate::shaders::COPY_WGSL.into()),
    });
    let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("scumble copy"),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("scumble copy"),
        layout: Some(&pipeline_layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("copy_vertex"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(depth_state(wgpu::CompareFunction::Always)),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("copy_depth"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[],
        }),
        multiview_mask: None,
        cache: None,
    })
}
