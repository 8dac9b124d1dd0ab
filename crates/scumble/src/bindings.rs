//! Bind group and layout of everything that `shadow_visibility` reads, and the buffers behind it.

use scumble_core::Taps;
use wgpu::util::{BufferInitDescriptor, DeviceExt};

use crate::blocks::{no_blocks, sampled_binding};
use crate::maps::Maps;
use crate::moments::{self, Moments, no_moments};
use crate::uniforms::{LightsUniform, TapsUniform};

/// Uniform buffers, sampler, layout and group.
#[derive(Debug)]
pub struct Bindings {
    lights: wgpu::Buffer,
    taps: wgpu::Buffer,
    sampler: wgpu::Sampler,
    layout: wgpu::BindGroupLayout,
    group: wgpu::BindGroup,
    moments: wgpu::TextureView,
}

impl Bindings {
    /// Buffers, textures and bind groups created here; one more without moments.
    pub const ALLOCATIONS: u64 = 4;

    /// Creates all, with the method's taps and no lights.
    pub fn new(device: &wgpu::Device, maps: &Maps, moments: Option<&Moments>) -> Self {
        // Uniforms: the lights start as zeros, which is "no map, all lit".
        let lights = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("scumble lights"),
            size: size_of::<LightsUniform>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let points = Taps::default();
        let taps = device.create_buffer_init(&BufferInitDescriptor {
            label: Some("scumble taps"),
            contents: bytemuck::bytes_of(&TapsUniform::new(&points.filter, &points.blocker)),
            usage: wgpu::BufferUsages::UNIFORM,
        });

        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("scumble comparison"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            compare: Some(wgpu::CompareFunction::LessEqual),
            ..Default::default()
        });
        let layout = layout(device);
        let no_blocks = no_blocks(device);
        let moments = match moments {
            Some(moments) => moments.filtered().clone(),
            None => no_moments(device),
        };
        let group = group(device, &layout, &lights, &taps, maps, &sampler, &no_blocks, &moments);
        Self { lights, taps, sampler, layout, group, moments }
    }

    /// Reads these blocks from here on.
    pub fn set_blocks(&mut self, device: &wgpu::Device, maps: &Maps, blocks: &wgpu::TextureView) {
        let Self { lights, taps, sampler, layout, moments, .. } = self;
        self.group = group(device, layout, lights, taps, maps, sampler, blocks, moments);
    }

    /// For pipelines that shade.
    pub fn layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }

    /// For passes that shade.
    pub fn group(&self) -> &wgpu::BindGroup {
        &self.group
    }

    /// Tells the shaders of a plan with the queue's next submission.
    pub fn write(&self, queue: &wgpu::Queue, lights: &LightsUniform) {
        queue.write_buffer(&self.lights, 0, bytemuck::bytes_of(lights));
    }

    /// Tells the shaders that the blocks are of this plan, and their side.
    pub fn write_block_px(&self, queue: &wgpu::Queue, block_px: u32) {
        let offset = std::mem::offset_of!(LightsUniform, block_px) as u64;
        queue.write_buffer(&self.lights, offset, bytemuck::bytes_of(&block_px));
    }
}

#[expect(clippy::too_many_arguments, reason = "one for each binding")]
fn group(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    lights: &wgpu::Buffer,
    taps: &wgpu::Buffer,
    maps: &Maps,
    sampler: &wgpu::Sampler,
    blocks: &wgpu::TextureView,
    moments: &wgpu::TextureView,
) -> wgpu::BindGroup {
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("scumble"),
        layout,
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: lights.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: taps.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::TextureView(maps.sampled()) },
            wgpu::BindGroupEntry { binding: 3, resource: wgpu::BindingResource::Sampler(sampler) },
            wgpu::BindGroupEntry { binding: 4, resource: wgpu::BindingResource::TextureView(blocks) },
            wgpu::BindGroupEntry { binding: 5, resource: wgpu::BindingResource::TextureView(moments) },
            wgpu::BindGroupEntry { binding: 6, resource: wgpu::BindingResource::TextureView(maps.sampled()) },
        ],
    })
}

fn layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT | wgpu::ShaderStages::COMPUTE,
        ty,
        count: None,
    };
    let uniform = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let maps = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Depth,
        view_dimension: wgpu::TextureViewDimension::D2Array,
        multisampled: false,
    };
    let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison);
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("scumble"),
        entries: &[
            entry(0, uniform),
            entry(1, uniform),
            entry(2, maps),
            entry(3, sampler),
            entry(4, sampled_binding()),
            entry(5, moments::sampled_binding(wgpu::TextureViewDimension::D2Array)),
            entry(6, moments::sampled_binding(wgpu::TextureViewDimension::D2Array)),
        ],
    })
}
