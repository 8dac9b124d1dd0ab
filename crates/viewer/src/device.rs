//! The GPU without a window: adapter, device, queue, and what the adapter can do.
//!
//! Asks for what the adapter offers of: timestamp queries (times at pass boundaries) and unclipped depth (casters in
//! front of the light's near plane). The pictures need neither; times are absent where timestamps are.

use anyhow::{Context, Result, anyhow};

/// What a machine without an adapter is told.
const NO_ADAPTER: &str = "no graphics adapter found: install a Vulkan driver (Debian and Ubuntu: `apt-get install \
                          mesa-vulkan-drivers libvulkan1`, which renders on the processor) or a driver for the card";

/// The most powerful adapter. OpenGL is asked last and only where nothing else answers: looking for it without a
/// display makes system libraries print complaints of their own.
fn adapter() -> Result<wgpu::Adapter> {
    let options =
        wgpu::RequestAdapterOptions { power_preference: wgpu::PowerPreference::HighPerformance, ..Default::default() };
    let asked = wgpu::Backends::from_env().unwrap_or(wgpu::Backends::all());
    for backends in [asked & wgpu::Backends::PRIMARY, asked & wgpu::Backends::SECONDARY] {
        let descriptor =
            wgpu::InstanceDescriptor { backends, ..wgpu::InstanceDescriptor::new_without_display_handle_from_env() };
        match pollster::block_on(wgpu::Instance::new(descriptor).request_adapter(&options)) {
            Ok(adapter) if can_draw(&adapter) => return Ok(adapter),
            _ => {}
        }
    }
    Err(anyhow!(NO_ADAPTER))
}

/// Whether the adapter draws to every format of the G-buffer; OpenGL ES may lack floats of 32 bits.
fn can_draw(adapter: &wgpu::Adapter) -> bool {
    let features = adapter.get_texture_format_features(wgpu::TextureFormat::Rgba32Float);
    features.allowed_usages.contains(wgpu::TextureUsages::RENDER_ATTACHMENT)
}

/// An open device with its queue.
#[derive(Clone)]
pub struct Gpu {
    /// Makes resources.
    pub device: wgpu::Device,
    /// Takes commands.
    pub queue: wgpu::Queue,
    /// Name, driver and backend of the adapter, for records.
    pub info: wgpu::AdapterInfo,
}

impl Gpu {
    /// Opens the most powerful adapter there is, a software one if need be.
    ///
    /// The environment chooses another one: `WGPU_BACKEND` is read by wgpu, `VK_DRIVER_FILES` by the Vulkan loader.
    pub fn open() -> Result<Self> {
        let adapter = adapter()?;
        let wanted = wgpu::Features::TIMESTAMP_QUERY
            | wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS
            | wgpu::Features::DEPTH_CLIP_CONTROL
            | wgpu::Features::FLOAT32_FILTERABLE;
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("viewer"),
            required_features: adapter.features() & wanted,
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let info = adapter.get_info();
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .with_context(|| format!("the adapter {} refuses a device", info.name))?;
        Ok(Self { device, queue, info })
    }

    /// Whether passes can be timed on this device.
    pub fn has_timestamps(&self) -> bool {
        let needed = wgpu::Features::TIMESTAMP_QUERY | wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS;
        self.device.features().contains(needed)
    }

    /// A command encoder with a label for debuggers.
    pub fn encoder(&self, label: &str) -> wgpu::CommandEncoder {
        self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some(label) })
    }

    /// Submits the commands and waits until the device has done them.
    pub fn finish(&self, encoder: wgpu::CommandEncoder) -> Result<()> {
        self.queue.submit([encoder.finish()]);
        self.device.poll(wgpu::PollType::wait_indefinitely()).context("the device was lost")?;
        Ok(())
    }
}
