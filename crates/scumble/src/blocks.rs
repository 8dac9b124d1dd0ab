//! Which pixels one lookup is enough for: what the demand pass found at the corners of blocks of pixels, and the pass that
//! joins the four corners of each block.
//!
//! A corner is *lit* where the filter lets all light through, *umbra* where it lets none, and *mixed* anywhere else; a block
//! is what all of its corners agree on. A pixel of a lit or dark block looks up the map once and filters only where the
//! lookup disagrees. The pass counts blocks by map and kind, which tells what was saved. So what is missed is a penumbra, or a part of one, that lies between corners outside of it, where a
//! single lookup says what they say.

use crate::uniforms::LIGHTS_MAX;

/// One word a block and light: the smallest texel that core WebGPU stores to.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;
/// Side of a work group in blocks; the shader's `@workgroup_size`.
const GROUP_SIDE: u32 = 8;

/// The corners and blocks of one prepass size and stride.
#[derive(Debug)]
pub struct Blocks {
    corners_size: [u32; 2],
    corners: wgpu::TextureView,
    blocks: wgpu::TextureView,
    classify: wgpu::BindGroup,
}

/// The pass that makes blocks of corners.
#[derive(Debug)]
pub struct ClassifyPass {
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
}

/// Corners across and down of a picture that has one every `stride` pixels, and one on its last row and column.
pub fn corners_of(size_px: [u32; 2], stride: u32) -> [u32; 2] {
    size_px.map(|side| side.saturating_sub(1).div_ceil(stride) + 1)
}

/// A texture for what is known of blocks, of a layer a light.
fn blocks_texture(device: &wgpu::Device, size: [u32; 2]) -> wgpu::TextureView {
    texture(device, size, wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::TEXTURE_BINDING)
}

/// What stands for blocks before the first are known: no device writes to it.
pub fn no_blocks(device: &wgpu::Device) -> wgpu::TextureView {
    texture(device, [1, 1], wgpu::TextureUsages::TEXTURE_BINDING)
}

fn texture(device: &wgpu::Device, [width, height]: [u32; 2], usage: wgpu::TextureUsages) -> wgpu::TextureView {
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("scumble blocks"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: LIGHTS_MAX },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    })
}

/// What the shaders read blocks as.
pub fn sampled_binding() -> wgpu::BindingType {
    wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Uint,
        view_dimension: wgpu::TextureViewDimension::D2Array,
        multisampled: false,
    }
}

/// What passes write corners and blocks as.
pub fn written_binding() -> wgpu::BindingType {
    wgpu::BindingType::StorageTexture {
        access: wgpu::StorageTextureAccess::WriteOnly,
        format: FORMAT,
        view_dimension: wgpu::TextureViewDimension::D2Array,
    }
}

impl Blocks {
    /// Textures and bind groups created by [`Blocks::new`].
    pub const ALLOCATIONS: u64 = 3;

    /// Allocates for a prepass of `corners_size` corners; blocks are counted at the beginning of `counts`.
    pub fn new(device: &wgpu::Device, pass: &ClassifyPass, corners_size: [u32; 2], counts: &wgpu::Buffer) -> Self {
        let corners = blocks_texture(device, corners_size);
        let blocks = blocks_texture(device, corners_size);
        let classify = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("scumble classify"),
            layout: &pass.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&corners) },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(&blocks) },
                wgpu::BindGroupEntry { binding: 2, resource: counts.as_entire_binding() },
            ],
        });
        Self { corners_size, corners, blocks, classify }
    }

    /// Corners across and down.
    pub fn corners_size(&self) -> [u32; 2] {
        self.corners_size
    }

    /// Where the demand pass writes what it finds.
    pub fn corners(&self) -> &wgpu::TextureView {
        &self.corners
    }

    /// What the shaders read.
    pub fn blocks(&self) -> &wgpu::TextureView {
        &self.blocks
    }
}

impl ClassifyPass {
    /// Creates the pipeline.
    pub fn new(device: &wgpu::Device) -> Self {
        let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty,
            count: None,
        };
        let counted = wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: false },
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("scumble classify"),
            entries: &[entry(0, sampled_binding()), entry(1, written_binding()), entry(2, counted)],
        });
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("scumble classify"),
            source: wgpu::ShaderSource::Wgsl(crate::shaders::classify_wgsl().into()),
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("scumble classify"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("scumble classify"),
            layout: Some(&pipeline_layout),
            module: &module,
            entry_point: Some("classify_blocks"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        Self { pipeline, layout }
    }

    /// Records the joining of corners that were written before in the same encoder.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder, blocks: &Blocks, light_count: u32) {
        let groups = blocks.corners_size.map(|side| side.div_ceil(GROUP_SIDE));
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("scumble classify"),
            timestamp_writes: None,
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &blocks.classify, &[]);
        pass.dispatch_workgroups(groups[0], groups[1], light_count);
    }
}

#[cfg(test)]
mod tests {
    use super::corners_of;

    #[test]
    fn every_pixel_lies_between_corners() {
        for (size, stride, expected) in [(1, 4, 1), (4, 4, 2), (5, 4, 2), (6, 4, 3), (1280, 4, 321), (7, 1, 7)] {
            let [corners, _] = corners_of([size, 1], stride);
            assert_eq!(corners, expected, "{size} by {stride}");
            // The last pixel's block has a corner on its other side, which may be the last pixel itself.
            assert!((size - 1) / stride < corners && (corners - 1) * stride + 1 >= size);
        }
    }
}
