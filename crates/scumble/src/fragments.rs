//! The demand from a renderer's own fragment shaders, for one without a depth prepass (Kreuzer 2017, 5.1.3).
//!
//! A frame, in place of [`Shadows::measure`]: [`FragmentDemand::begin`] before the pass that shades; in the pass its bind
//! group, and `shadow_visibility_measured` in the shader ([`fragments_wgsl`](crate::fragments_wgsl)); [`FragmentDemand::end`]
//! after it. [`FragmentDemand::read`] takes what has come back, as [`Shadows::read_demand`] does. The price: filters run at
//! every pixel, and what is shaded and then hidden counts.

use bytemuck::{Pod, Zeroable};
use scumble_core::{Demand, Statistic};
use wgpu::util::{BufferInitDescriptor, DeviceExt};

use crate::error::Error;
use crate::measure::{NOTHING, Readings};
use crate::readback::Ring;
use crate::shadows::Shadows;
use crate::uniforms::MAPS_MAX;

/// `ShadowFragments` of `shader/fragments.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct FragmentsStorage {
    /// Radius that one pixel of footprint asks for, in footprints: ratio times kappa.
    pub radius_per_footprint: f32,
    /// Smallest radius that is counted, world length at the reference plane.
    pub radius_floor_world: f32,
    /// By map: bits of the smallest radius.
    pub minima: [u32; MAPS_MAX as usize],
}

/// Storage, bindings and readback of one renderer's fragments.
#[derive(Debug)]
pub struct FragmentDemand {
    storage: wgpu::Buffer,
    start: wgpu::Buffer,
    layout: wgpu::BindGroupLayout,
    group: wgpu::BindGroup,
    ring: Ring<Readings>,
}

impl FragmentDemand {
    /// Allocates for the maps of `shadows`, with the relation and the guards of its settings.
    ///
    /// # Errors
    /// Settings with another statistic than the minimum, a device whose fragment shaders cannot write to storage.
    pub fn new(device: &wgpu::Device, shadows: &Shadows) -> Result<Self, Error> {
        let settings = shadows.settings();
        if settings.statistic != Statistic::Minimum {
            return Err(Error::FragmentStatistic(settings.statistic));
        }
        let found = device.limits().max_storage_buffers_per_shader_stage;
        if found == 0 {
            return Err(Error::NoFragmentStorage);
        }
        let contents = FragmentsStorage {
            radius_per_footprint: (settings.relation.ratio() * settings.footprint_kappa) as f32,
            radius_floor_world: settings.demand_radius_world(0.0, 0.0) as f32,
            minima: [NOTHING; MAPS_MAX as usize],
        };
        let buffer = |usage| {
            let contents = bytemuck::bytes_of(&contents);
            device.create_buffer_init(&BufferInitDescriptor { label: Some("scumble fragments"), contents, usage })
        };
        let storage = buffer(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST);
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("scumble fragments"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Storage { read_only: false },
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            }],
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("scumble fragments"),
            layout: &layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: storage.as_entire_binding() }],
        });
        let ring = Ring::new(device, storage.size());
        Ok(Self { start: buffer(wgpu::BufferUsages::COPY_SRC), storage, layout, group, ring })
    }

    /// Layout of the bind group, for fragment stages.
    #[must_use]
    pub fn bind_group_layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }

    /// What `shadow_visibility_measured` writes to; for the group number given to `fragments_wgsl`.
    #[must_use]
    pub fn bind_group(&self) -> &wgpu::BindGroup {
        &self.group
    }

    /// Forgets the fragments before this; outside of passes, before the one that shades.
    pub fn begin(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.copy_buffer_to_buffer(&self.start, 0, &self.storage, 0, self.storage.size());
    }

    /// Sends what was found under the maps uploaded last on its way back; whether there was room for it. One call a
    /// submission; never waits.
    pub fn end(&mut self, encoder: &mut wgpu::CommandEncoder, shadows: &Shadows) -> bool {
        self.ring.record(encoder, &self.storage, shadows.readings())
    }

    /// Gives `shadows` the newest result that has come back, for the plans from here on. Returns whether there was one.
    pub fn read(&mut self, shadows: &mut Shadows) -> bool {
        let Some((bytes, readings)) = self.ring.take() else { return false };
        let found: FragmentsStorage = bytemuck::pod_read_unaligned(&bytes);
        let radius = |(bits, reading): (u32, Option<crate::demand::Reading>)| {
            Some(reading?.found_demand(Demand::from_minimum_bits(bits)))
        };
        shadows.set_measured(found.minima.into_iter().zip(readings).map(radius));
        true
    }
}
