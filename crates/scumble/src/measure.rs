//! The demand pass on the GPU: the filter radii on screen by map and where receivers are by light, and their way back.
//!
//! Steps of one call: minima are set to infinity and counts to 0, `shader/measure.wgsl` goes over the depth prepass, the
//! result is copied into the [readback ring](crate::readback). Nothing is submitted and nothing waits.

mod prepass;

use glam::DVec3;
use scumble_core::{Camera, Light, RadiusHistogram, Seen, Settings, Statistic};
use wgpu::util::{BufferInitDescriptor, DeviceExt};

use crate::blocks::{Blocks, ClassifyPass, corners_of, written_binding};
use crate::demand::{Found, Reading};
use crate::error::Error;
use crate::measure::prepass::{camera_uniform, checked_size, pixel_at_unit_distance};
use crate::readback::Ring;
use crate::seen::{NOWHERE, Picture};
use crate::uniforms::{LIGHTS_MAX, LightReceivers, MAPS_MAX, MapDemand, MeasureUniform, Measured};

/// What the shader leaves where no fragment had a penumbra: the bits of infinity.
pub const NOTHING: u32 = 0x7F80_0000;

/// Side of a work group in measured pixels; the shader's `@workgroup_size`.
const GROUP_SIDE: u32 = 8;

/// Pipeline, buffers and ring of the demand pass.
#[derive(Debug)]
pub struct Measure {
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    uniform: wgpu::Buffer,
    demand: wgpu::Buffer,
    nothing: wgpu::Buffer,
    classify: ClassifyPass,
    blocks: Option<Blocks>,
    bound: Option<(wgpu::TextureView, wgpu::BindGroup)>,
    ring: Ring<(Readings, Picture)>,
}

/// By map; `None` where none is drawn.
pub type Readings = [Option<Reading>; MAPS_MAX as usize];

/// Where nothing was found yet.
const START: Measured = Measured {
    blocks: [[0; 3]; MAPS_MAX as usize],
    maps: [MapDemand { minimum_bits: NOTHING, shadowed: 0, counts: [0; RadiusHistogram::BINS as usize] };
        MAPS_MAX as usize],
    receivers: [LightReceivers { minima: [[NOWHERE; 4]; Seen::BANDS as usize] }; LIGHTS_MAX as usize],
};

/// By number; `None` where a light has no map.
pub type Lights = [Option<Light>; LIGHTS_MAX as usize];

/// What came back.
pub struct Taken {
    /// By map; `None` where none was drawn.
    pub maps: Vec<Option<Found>>,
    /// By light.
    pub seen: Vec<Option<Seen>>,
}

/// What one measurement is about.
pub struct Request<'a> {
    /// The camera of the prepass.
    pub camera: &'a Camera,
    /// Origin of the shaders' world space.
    pub origin_world: DVec3,
    /// Clamps and relation.
    pub settings: &'a Settings,
    /// Every how many pixels one is measured.
    pub stride: u32,
    /// Lights in the uniforms, by number; `None` where a light has no map.
    pub lights: Lights,
    /// Of their maps.
    pub readings: Readings,
}

/// What a recorded measurement did.
pub struct Recorded {
    /// Bind groups and textures that had to be created.
    pub allocations: u64,
    /// Whether the blocks are in a new texture.
    pub new_blocks: bool,
    /// Whether the ring had room to bring the result back.
    pub copied: bool,
}

impl Measure {
    /// Creates everything that the pass needs; `shadow_layout` is bind group 0.
    pub fn new(device: &wgpu::Device, shadow_layout: &wgpu::BindGroupLayout) -> Result<Self, Error> {
        let limits = device.limits();
        let of_compute = |found| if limits.max_compute_workgroups_per_dimension > 0 { found } else { 0 };
        let buffers = of_compute(limits.max_storage_buffers_per_shader_stage);
        let textures = of_compute(limits.max_storage_textures_per_shader_stage);
        if buffers == 0 || textures == 0 {
            return Err(Error::NoCompute { buffers, textures });
        }
        let layout = bind_group_layout(device);
        let demand_bytes = size_of::<Measured>() as u64;
        let buffer = |label, size, usage| {
            let descriptor = wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false };
            device.create_buffer(&descriptor)
        };
        let nothing = device.create_buffer_init(&BufferInitDescriptor {
            label: Some("scumble demand start"),
            contents: bytemuck::bytes_of(&START),
            usage: wgpu::BufferUsages::COPY_SRC,
        });
        Ok(Self {
            pipeline: pipeline(device, shadow_layout, &layout),
            layout,
            uniform: buffer(
                "scumble measure",
                size_of::<MeasureUniform>() as u64,
                wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            ),
            demand: buffer(
                "scumble demand",
                demand_bytes,
                wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
            ),
            nothing,
            classify: ClassifyPass::new(device),
            blocks: None,
            bound: None,
            ring: Ring::new(device, demand_bytes),
        })
    }

    /// Buffers that live as long as this.
    pub fn buffer_count(&self) -> usize {
        3 + self.ring.slot_count()
    }

    /// Records one measurement.
    pub fn record(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        shadow_bind_group: &wgpu::BindGroup,
        prepass: &wgpu::TextureView,
        request: &Request<'_>,
    ) -> Result<Recorded, Error> {
        let size_px = checked_size(prepass)?;
        if request.stride == 0 {
            return Err(Error::Stride);
        }
        let camera = request.camera.checked()?;
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&camera_uniform(&camera, size_px, request)));

        let light_count = request.lights.iter().rposition(Option::is_some).map_or(0, |last| last as u32 + 1);
        let new_blocks = self.make_blocks(device, corners_of(size_px, request.stride));
        let (bind_group, rebound) = self.bind(device, prepass);
        encoder.copy_buffer_to_buffer(&self.nothing, 0, &self.demand, 0, self.demand.size());
        let groups = corners_of(size_px, request.stride).map(|side| side.div_ceil(GROUP_SIDE));
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some("scumble measure"),
                timestamp_writes: None,
            });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, shadow_bind_group, &[]);
            pass.set_bind_group(1, &bind_group, &[]);
            pass.dispatch_workgroups(groups[0], groups[1], light_count);
        }
        if let Some(blocks) = &self.blocks {
            self.classify.record(encoder, blocks, light_count);
        }
        let picture = Picture {
            camera,
            gap: f64::from(request.stride) * pixel_at_unit_distance(&camera, size_px).max_element(),
            lights: request.lights,
            origin_world: request.origin_world,
        };
        let copied = self.ring.record(encoder, &self.demand, (request.readings, picture));
        let allocations = u64::from(rebound) + u64::from(new_blocks) * Blocks::ALLOCATIONS;
        Ok(Recorded { allocations, new_blocks, copied })
    }

    /// What was found, by block of pixels; `None` before the first measurement.
    pub fn blocks(&self) -> Option<&Blocks> {
        self.blocks.as_ref()
    }

    /// Blocks for this many corners; whether they had to be created.
    fn make_blocks(&mut self, device: &wgpu::Device, corners_size: [u32; 2]) -> bool {
        if self.blocks.as_ref().is_some_and(|blocks| blocks.corners_size() == corners_size) {
            return false;
        }
        self.blocks = Some(Blocks::new(device, &self.classify, corners_size, &self.demand));
        self.bound = None;
        true
    }

    /// The newest result that has come back.
    pub fn take(&mut self, statistic: Statistic) -> Option<Taken> {
        let (bytes, (readings, picture)) = self.ring.take()?;
        let found: Measured = bytemuck::pod_read_unaligned(&bytes);
        let of_map = |((demand, &blocks), reading): ((&MapDemand, &[u32; 3]), Option<Reading>)| {
            Some(reading?.found(demand, blocks, statistic))
        };
        Some(Taken {
            maps: found.maps.iter().zip(&found.blocks).zip(readings).map(of_map).collect(),
            seen: picture.seen(&found.receivers),
        })
    }

    /// The bind group of the prepass, and whether it had to be created.
    fn bind(&mut self, device: &wgpu::Device, prepass: &wgpu::TextureView) -> (wgpu::BindGroup, bool) {
        if let Some((view, group)) = &self.bound
            && view == prepass
        {
            return (group.clone(), false);
        }
        // The caller's view may have a stencil, or be of an array of one layer; the shader reads neither.
        let depth = prepass.texture().create_view(&wgpu::TextureViewDescriptor {
            label: Some("scumble prepass"),
            dimension: Some(wgpu::TextureViewDimension::D2),
            aspect: wgpu::TextureAspect::DepthOnly,
            ..Default::default()
        });
        let mut entries = vec![
            wgpu::BindGroupEntry { binding: 0, resource: self.uniform.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(&depth) },
            wgpu::BindGroupEntry { binding: 2, resource: self.demand.as_entire_binding() },
        ];
        entries.extend(self.blocks.as_ref().map(|blocks| wgpu::BindGroupEntry {
            binding: 3,
            resource: wgpu::BindingResource::TextureView(blocks.corners()),
        }));
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("scumble measure"),
            layout: &self.layout,
            entries: &entries,
        });
        self.bound = Some((prepass.clone(), group.clone()));
        (group, true)
    }
}

fn bind_group_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let entry =
        |binding, ty| wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::COMPUTE, ty, count: None };
    let buffer = |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("scumble measure"),
        entries: &[
            entry(0, buffer(wgpu::BufferBindingType::Uniform)),
            entry(
                1,
                wgpu::BindingType::Texture {
                    sample_type: wgpu::TextureSampleType::Depth,
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
            ),
            entry(2, buffer(wgpu::BufferBindingType::Storage { read_only: false })),
            entry(3, written_binding()),
        ],
    })
}

fn pipeline(
    device: &wgpu::Device,
    shadow_layout: &wgpu::BindGroupLayout,
    layout: &wgpu::BindGroupLayout,
) -> wgpu::ComputePipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("scumble measure"),
        source: wgpu::ShaderSource::Wgsl(crate::shaders::measure_wgsl().into()),
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("scumble measure"),
        bind_group_layouts: &[Some(shadow_layout), Some(layout)],
        immediate_size: 0,
    });
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("scumble measure"),
        layout: Some(&layout),
        module: &module,
        entry_point: Some("measure_demand"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    })
}
