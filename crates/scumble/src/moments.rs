//! The passes of variance shadow maps: from a drawn map to mean and variance of depth under the kernel.
//!
//! Three dispatches a map, `reduce` (blocks of texels), `box` along x, `box` along y. The last writes into the texture that
//! shaders read; the middle one into a texture that all maps take turns with. [`scumble_core::moments`] has the formulas.
//! Everything is allocated once, at the size of the maps' texture: 8 bytes a texel of each layer and of the texture between. Rg32Float because
//! core WebGPU stores to it and 16 bits do not hold depth; a variance is not blended, so nothing needs its filtering.

use glam::DVec2;
use scumble_core::moments::block_texels;
use scumble_core::{Fit, Light};

use crate::error::Error;
use crate::maps::Maps;
use crate::shaders::{vsm_box_wgsl, vsm_reduce_wgsl};
use crate::uniforms::MomentsUniform;
use crate::view::View;

/// Mean and variance.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Float;
/// Bytes of a texel of [`FORMAT`].
pub const TEXEL_BYTES: u64 = 8;
/// Side of a work group in blocks; the shaders' `@workgroup_size`.
const GROUP_SIDE: u32 = 8;
/// Bytes from one map's uniforms to the next: the largest alignment that a device may ask for.
const UNIFORM_STRIDE: u64 = 256;

/// Textures, bind groups and pipelines of every map.
#[derive(Debug)]
pub struct Moments {
    filtered: wgpu::TextureView,
    uniforms: wgpu::Buffer,
    maps: Vec<Map>,
    /// By map: what its moments were made by, while the map is as it was.
    made: Vec<Option<Task>>,
    reduce: wgpu::ComputePipeline,
    along: [wgpu::ComputePipeline; 2],
    bytes: u64,
}

/// The bind groups of one map.
#[derive(Debug)]
struct Map {
    reduce: wgpu::BindGroup,
    along: [wgpu::BindGroup; 2],
}

/// What the passes have to do for one map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Task {
    /// Number of the map.
    pub map: u32,
    /// What the shaders are told.
    pub uniform: MomentsUniform,
}

impl Task {
    /// For a view under a kernel of this half side.
    pub fn new(view: &View, radius_world: f64) -> Self {
        let radius = radius_world / view.texel_world();
        let block = blocks_of(view.texel_world(), radius_world);
        Self {
            map: view.map,
            uniform: MomentsUniform {
                viewport: view.size_texels,
                origin: view.origin_texels,
                block,
                radius: (radius / DVec2::new(f64::from(block[0]), f64::from(block[1]))).as_vec2().to_array(),
                near_over_far: near_over_far(&view.fit) as f32,
                padding: 0,
            },
        }
    }

    /// Blocks along x and y.
    fn size(&self) -> [u32; 2] {
        let MomentsUniform { viewport, block, .. } = self.uniform;
        [viewport[0].div_ceil(block[0]), viewport[1].div_ceil(block[1])]
    }

    /// Blocks of the map.
    pub fn blocks(&self) -> u64 {
        let [across, down] = self.size().map(u64::from);
        across * down
    }

    /// Texels and blocks that the passes read, but for those cut off at the map's border.
    pub fn taps(&self) -> u64 {
        let [width, height] = self.uniform.viewport.map(u64::from);
        let [across, down] = self.size().map(u64::from);
        // As in vsm_box.wgsl: the middle, and all whose weight is above 0.
        let taps = self.uniform.radius.map(|radius| 2 * (f64::from(radius).max(0.5) + 0.5).ceil() as u64 - 1);
        width * height + across * down * (taps[0] + taps[1])
    }
}

/// Texels of a block along x and y, for texels of this size.
pub fn blocks_of(texel_world: DVec2, radius_world: f64) -> [u32; 2] {
    (radius_world / texel_world).to_array().map(block_texels)
}

/// Near plane's depth by the far plane's under a spot; 1 where map depth is linear.
fn near_over_far(fit: &Fit) -> f64 {
    match fit.light {
        Light::Directional { .. } => 1.0,
        Light::Spot { .. } | Light::Point { .. } => fit.depth_near / fit.depth_far,
    }
}

/// A texture of moments with its view of all layers.
fn moments_texture(device: &wgpu::Device, side: u32, layers: u32) -> (wgpu::Texture, wgpu::TextureView) {
    texture(device, side, layers, wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::TEXTURE_BINDING)
}

/// What stands for moments where the filter has none: no device writes to it.
pub fn no_moments(device: &wgpu::Device) -> wgpu::TextureView {
    texture(device, 1, 1, wgpu::TextureUsages::TEXTURE_BINDING).1
}

fn texture(
    device: &wgpu::Device,
    side: u32,
    layers: u32,
    usage: wgpu::TextureUsages,
) -> (wgpu::Texture, wgpu::TextureView) {
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("scumble moments"),
        size: wgpu::Extent3d { width: side, height: side, depth_or_array_layers: layers },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage,
        view_formats: &[],
    });
    let all = texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    });
    (texture, all)
}

/// What shaders read moments as.
pub fn sampled_binding(view_dimension: wgpu::TextureViewDimension) -> wgpu::BindingType {
    wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension,
        multisampled: false,
    }
}

impl Moments {
    /// Allocates for `count` maps in the layers of `maps`, one each or all in the first.
    ///
    /// # Errors
    /// A device without compute shaders that store to textures.
    pub fn new(device: &wgpu::Device, maps: &Maps, count: u32) -> Result<Self, Error> {
        let limits = device.limits();
        let has_compute = limits.max_compute_workgroups_per_dimension > 0;
        let found = if has_compute { limits.max_storage_textures_per_shader_stage } else { 0 };
        if found == 0 {
            return Err(Error::NoMoments { found });
        }
        let layer_count = maps.layers().len() as u32;
        let (texture, filtered) = moments_texture(device, maps.side(), layer_count);
        let (between, _) = moments_texture(device, maps.side(), 1);
        let between = between.create_view(&wgpu::TextureViewDescriptor::default());
        let uniforms = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("scumble moments"),
            size: UNIFORM_STRIDE * u64::from(count),
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });

        // Pipelines: the reduction reads depth, the others moments.
        let depth = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Depth,
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        let from_depth = layout(device, depth);
        let from_moments = layout(device, sampled_binding(wgpu::TextureViewDimension::D2));
        let reduce = pipeline(device, &from_depth, &vsm_reduce_wgsl(), "reduce_blocks", &[]);
        let along = [0.0, 1.0]
            .map(|axis| pipeline(device, &from_moments, &vsm_box_wgsl(), "box_blocks", &[("box_axis", axis)]));

        let maps_of_layers = (0..layer_count).zip(maps.layers()).cycle();
        let groups = (0..count)
            .zip(maps_of_layers)
            .map(|(number, (layer, map))| {
                let own = texture.create_view(&wgpu::TextureViewDescriptor {
                    dimension: Some(wgpu::TextureViewDimension::D2),
                    base_array_layer: layer,
                    array_layer_count: Some(1),
                    ..Default::default()
                });
                let group = |layout: &wgpu::BindGroupLayout, from: &wgpu::TextureView, to: &wgpu::TextureView| {
                    group(device, layout, &uniforms, number, from, to)
                };
                Map {
                    reduce: group(&from_depth, map, &own),
                    along: [group(&from_moments, &own, &between), group(&from_moments, &between, &own)],
                }
            })
            .collect();
        let bytes = TEXEL_BYTES * u64::from(maps.side()).pow(2) * u64::from(layer_count + 1);
        let made = vec![None; count as usize];
        Ok(Self { filtered, uniforms, maps: groups, made, reduce, along, bytes })
    }

    /// Textures, buffers and bind groups created.
    pub fn allocations(&self) -> u64 {
        3 + 3 * self.maps.len() as u64
    }

    /// Bytes of both textures.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// All layers, for shaders that shade.
    pub fn filtered(&self) -> &wgpu::TextureView {
        &self.filtered
    }

    /// Tells the passes of a map with the queue's next submission.
    pub fn write(&self, queue: &wgpu::Queue, task: &Task) {
        let offset = u64::from(task.map) * UNIFORM_STRIDE;
        queue.write_buffer(&self.uniforms, offset, bytemuck::bytes_of(&task.uniform));
    }

    /// Maps are drawn again; their moments are those of what they were.
    pub fn forget(&mut self) {
        self.made.fill(None);
    }

    /// One map is drawn again.
    pub fn forget_map(&mut self, map: u32) {
        if let Some(made) = self.made.get_mut(map as usize) {
            *made = None;
        }
    }

    /// Records the passes of those of these maps whose moments are not there yet, one compute pass for all; of how many.
    pub fn record(&mut self, encoder: &mut wgpu::CommandEncoder, tasks: &[Task]) -> u64 {
        let is_left = |task: &&Task| self.made.get(task.map as usize).copied().flatten() != Some(**task);
        let left: Vec<Task> = tasks.iter().filter(is_left).copied().collect();
        if left.is_empty() {
            return 0;
        }
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("scumble moments"),
            timestamp_writes: None,
        });
        for task in &left {
            let place = (task.map as usize).min(self.maps.len() - 1);
            self.made[place] = Some(*task);
            let map = &self.maps[place];
            let [across, down] = task.size().map(|side| side.div_ceil(GROUP_SIDE));
            let [along_x, along_y] = &self.along;
            let [rows, columns] = &map.along;
            for (pipeline, group) in [(&self.reduce, &map.reduce), (along_x, rows), (along_y, columns)] {
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, group, &[]);
                pass.dispatch_workgroups(across, down, 1);
            }
        }
        left.len() as u64
    }
}

fn layout(device: &wgpu::Device, source: wgpu::BindingType) -> wgpu::BindGroupLayout {
    let entry =
        |binding, ty| wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::COMPUTE, ty, count: None };
    let uniform = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let written = wgpu::BindingType::StorageTexture {
        access: wgpu::StorageTextureAccess::WriteOnly,
        format: FORMAT,
        view_dimension: wgpu::TextureViewDimension::D2,
    };
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("scumble moments"),
        entries: &[entry(0, uniform), entry(1, source), entry(2, written)],
    })
}

fn group(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    uniforms: &wgpu::Buffer,
    map: u32,
    from: &wgpu::TextureView,
    to: &wgpu::TextureView,
) -> wgpu::BindGroup {
    let uniform = wgpu::BufferBinding {
        buffer: uniforms,
        offset: u64::from(map) * UNIFORM_STRIDE,
        size: wgpu::BufferSize::new(size_of::<MomentsUniform>() as u64),
    };
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("scumble moments"),
        layout,
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::Buffer(uniform) },
            wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(from) },
            wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::TextureView(to) },
        ],
    })
}

fn pipeline(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    source: &str,
    entry_point: &str,
    constants: &[(&str, f64)],
) -> wgpu::ComputePipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("scumble moments"),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("scumble moments"),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("scumble moments"),
        layout: Some(&layout),
        module: &module,
        entry_point: Some(entry_point),
        compilation_options: wgpu::PipelineCompilationOptions { constants, ..Default::default() },
        cache: None,
    })
}
