//! The texture that holds every map: one layer a map, allocated once at the cap, of which views use a corner
//! (Kreuzer 2017, Fig. 5.5); or under a budget one page, which the plan [packs](crate::atlas). Nothing here is created
//! again when a size changes.

use crate::view::View;

/// Format of the maps.
pub const MAP_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// The texture, a render view a layer and the pipeline that clears a viewport.
#[derive(Debug)]
pub struct Maps {
    side: u32,
    layers: Vec<wgpu::TextureView>,
    sampled: wgpu::TextureView,
    texture: wgpu::Texture,
    clear: wgpu::RenderPipeline,
}

impl Maps {
    /// Allocates `count` layers of `side` squared texels.
    pub fn new(device: &wgpu::Device, side: u32, count: u32) -> Self {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("scumble maps"),
            size: wgpu::Extent3d { width: side, height: side, depth_or_array_layers: count },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: MAP_FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let layers = (0..count)
            .map(|layer| {
                texture.create_view(&wgpu::TextureViewDescriptor {
                    label: Some("scumble map layer"),
                    dimension: Some(wgpu::TextureViewDimension::D2),
                    base_array_layer: layer,
                    array_layer_count: Some(1),
                    ..Default::default()
                })
            })
            .collect();
        let sampled = texture.create_view(&wgpu::TextureViewDescriptor {
            label: Some("scumble maps"),
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        Self { side, layers, sampled, texture, clear: clear_pipeline(device) }
    }

    /// Texels per side.
    pub fn side(&self) -> u32 {
        self.side
    }

    /// Each layer by itself.
    pub fn layers(&self) -> &[wgpu::TextureView] {
        &self.layers
    }

    /// All layers, for sampling.
    pub fn sampled(&self) -> &wgpu::TextureView {
        &self.sampled
    }

    /// The texture itself.
    pub fn texture(&self) -> &wgpu::Texture {
        &self.texture
    }

    /// Bytes of the texture.
    pub fn bytes(&self) -> u64 {
        u64::from(self.side) * u64::from(self.side) * 4 * self.layers.len() as u64
    }

    /// Begins a depth-only pass whose viewport and scissor are the view's, cleared to map depth 1.
    pub fn begin<'encoder>(
        &self,
        encoder: &'encoder mut wgpu::CommandEncoder,
        view: &View,
    ) -> wgpu::RenderPass<'encoder> {
        let is_whole_layer = view.size_texels.iter().all(|&side| side >= self.side);
        let load = if is_whole_layer { wgpu::LoadOp::Clear(1.0) } else { wgpu::LoadOp::Load };
        let mut pass = self.begin_loaded(encoder, view, load);
        if !is_whole_layer {
            pass.set_pipeline(&self.clear);
            pass.draw(0..3, 0..1);
        }
        pass
    }

    /// Begins the same pass over what the layer holds, or with the whole layer cleared.
    pub fn begin_loaded<'encoder>(
        &self,
        encoder: &'encoder mut wgpu::CommandEncoder,
        view: &View,
        load: wgpu::LoadOp<f32>,
    ) -> wgpu::RenderPass<'encoder> {
        let [width, height] = view.size_texels.map(|side| side.clamp(1, self.side));
        let [x, y] = [view.origin_texels[0].min(self.side - width), view.origin_texels[1].min(self.side - height)];
        let layer = (view.layer as usize).min(self.layers.len() - 1);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("scumble map"),
            color_attachments: &[],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.layers[layer],
                depth_ops: Some(wgpu::Operations { load, store: wgpu::StoreOp::Store }),
                stencil_ops: None,
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_viewport(x as f32, y as f32, width as f32, height as f32, 0.0, 1.0);
        pass.set_scissor_rect(x, y, width, height);
        pass
    }
}

/// Depth state of a pipeline that draws into the maps with the given comparison.
pub fn depth_state(compare: wgpu::CompareFunction) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: MAP_FORMAT,
        depth_write_enabled: Some(true),
        depth_compare: Some(compare),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    }
}

fn clear_pipeline(device: &wgpu::Device) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("scumble clear"),
        source: wgpu::ShaderSource::Wgsl(crate::shaders::CLEAR_WGSL.into()),
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("scumble clear"),
        bind_group_layouts: &[],
        immediate_size: 0,
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("scumble clear"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("clear_vertex"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(depth_state(wgpu::CompareFunction::Always)),
        multisample: wgpu::MultisampleState::default(),
        fragment: None,
        multiview_mask: None,
        cache: None,
    })
}
