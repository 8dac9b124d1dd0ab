//! A headless device and a compute harness for the tests.
#![allow(dead_code, reason = "each test file uses its own part")]

pub mod casters;
pub mod rig;

use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

/// A device with its queue.
pub struct Gpu {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    turn: Mutex<()>,
}

/// The device of this process; fails with words where there is none.
pub fn gpu() -> &'static Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(|| open(wgpu::Limits::default()))
}

/// A device of its own with these limits.
pub fn open(required_limits: wgpu::Limits) -> Gpu {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
    let adapter =
        pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default())).unwrap_or_else(|error| {
            panic!(
                "no GPU adapter ({error}). These tests need one; without a GPU install Mesa's software Vulkan driver, \
                 on Debian and Ubuntu: apt-get install mesa-vulkan-drivers libvulkan1"
            )
        });
    let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
        label: Some("tests"),
        required_features: adapter.features() & wgpu::Features::DEPTH_CLIP_CONTROL,
        required_limits,
        experimental_features: wgpu::ExperimentalFeatures::disabled(),
        memory_hints: wgpu::MemoryHints::default(),
        trace: wgpu::Trace::Off,
    }))
    .expect("the adapter gives a device with these limits");
    Gpu { device, queue, turn: Mutex::new(()) }
}

impl Gpu {
    /// Submitting and polling run the callbacks of every thread's work; with this held, one's own have run by the end.
    fn alone(&self) -> MutexGuard<'_, ()> {
        self.turn.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// An encoder.
    pub fn encoder(&self) -> wgpu::CommandEncoder {
        self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default())
    }

    /// Submits and waits until everything is done and every callback has run.
    pub fn finish(&self, encoder: wgpu::CommandEncoder) {
        let _alone = self.alone();
        self.queue.submit([encoder.finish()]);
        self.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
    }

    /// A buffer with contents.
    pub fn buffer<T: bytemuck::Pod>(&self, contents: &[T], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let bytes: &[u8] = bytemuck::cast_slice(contents);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: bytes.len() as u64,
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        self.queue.write_buffer(&buffer, 0, bytes);
        buffer
    }

    /// Contents of a buffer with COPY_SRC.
    pub fn read<T: bytemuck::Pod>(&self, buffer: &wgpu::Buffer) -> Vec<T> {
        let copy = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: buffer.size(),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = self.encoder();
        encoder.copy_buffer_to_buffer(buffer, 0, &copy, 0, buffer.size());
        let _alone = self.alone();
        self.queue.submit([encoder.finish()]);
        copy.map_async(wgpu::MapMode::Read, .., |result| result.expect("the copy can be mapped"));
        self.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
        let view = copy.get_mapped_range(..).expect("the copy is mapped");
        bytemuck::pod_collect_to_vec(&view)
    }

    /// Depths of the corner `size` of a layer of a Depth32Float texture, by rows.
    pub fn read_depth(&self, texture: &wgpu::Texture, layer: u32, [width, height]: [u32; 2]) -> Vec<f32> {
        let row_bytes = (texture.width() * 4).next_multiple_of(256);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(row_bytes) * u64::from(texture.height()),
            usage: wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = self.encoder();
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo {
                texture,
                mip_level: 0,
                origin: wgpu::Origin3d { x: 0, y: 0, z: layer },
                aspect: wgpu::TextureAspect::DepthOnly,
            },
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row_bytes), rows_per_image: None },
            },
            wgpu::Extent3d { width: texture.width(), height: texture.height(), depth_or_array_layers: 1 },
        );
        self.finish(encoder);
        let all: Vec<f32> = self.read(&buffer);
        let stride = row_bytes as usize / 4;
        (0..height as usize).flat_map(|row| all[row * stride..row * stride + width as usize].to_vec()).collect()
    }

    /// Runs `expression` of WGSL (over `row: array<vec4f>` element `in`) for each input, and returns one vec4f each.
    ///
    /// `prelude` declares what the expression uses; `groups` are bind groups 0 and up; the table is in the next group.
    pub fn evaluate(
        &self,
        prelude: &str,
        body: &str,
        group: Option<(&wgpu::BindGroupLayout, &wgpu::BindGroup)>,
        inputs: &[[[f32; 4]; 4]],
    ) -> Vec<[f32; 4]> {
        let source = format!(
            "{prelude}\n
            struct Row {{ a: vec4f, b: vec4f, c: vec4f, d: vec4f }}
            @group(1) @binding(0) var<storage, read> rows: array<Row>;
            @group(1) @binding(1) var<storage, read_write> results: array<vec4f>;
            @compute @workgroup_size(64)
            fn evaluate(@builtin(global_invocation_id) id: vec3u) {{
                if id.x >= arrayLength(&rows) {{ return; }}
                let row = rows[id.x];
                var result = vec4f(0.0);
                {body}
                results[id.x] = result;
            }}"
        );
        let device = &self.device;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("harness"),
            source: wgpu::ShaderSource::Wgsl(source.into()),
        });
        let storage = |read_only| wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only },
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let entry = |binding, read_only| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: storage(read_only),
            count: None,
        };
        let table_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &[entry(0, true), entry(1, false)],
        });
        let empty = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries: &[] });
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(group.map_or(&empty, |(layout, _)| layout)), Some(&table_layout)],
            immediate_size: 0,
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("harness"),
            layout: Some(&layout),
            module: &module,
            entry_point: Some("evaluate"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let rows = self.buffer(inputs, wgpu::BufferUsages::STORAGE);
        let results =
            self.buffer(&vec![[0.0f32; 4]; inputs.len()], wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let table = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &table_layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: rows.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: results.as_entire_binding() },
            ],
        });
        let empty_group =
            device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &empty, entries: &[] });
        let mut encoder = self.encoder();
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, group.map_or(&empty_group, |(_, group)| group), &[]);
            pass.set_bind_group(1, &table, &[]);
            pass.dispatch_workgroups(inputs.len().div_ceil(64) as u32, 1, 1);
        }
        self.finish(encoder);
        self.read(&results)
    }
}
