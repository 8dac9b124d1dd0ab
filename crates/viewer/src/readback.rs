//! Buffers and textures of the device copied into the program's memory. Waits for the device.

use std::sync::mpsc;

use anyhow::{Context, Result};

use crate::device::Gpu;

/// The bytes of a buffer made with `COPY_SRC`.
pub fn read_buffer(gpu: &Gpu, source: &wgpu::Buffer) -> Result<Vec<u8>> {
    let staging = staging_buffer(gpu, source.size());
    let mut encoder = gpu.encoder("read buffer");
    encoder.copy_buffer_to_buffer(source, 0, &staging, 0, source.size());
    gpu.queue.submit([encoder.finish()]);
    map(gpu, &staging)
}

/// The texels of layer 0, mip 0 of a texture made with `COPY_SRC`, rows from top to bottom without padding.
pub fn read_texture(gpu: &Gpu, source: &wgpu::Texture) -> Result<Vec<u8>> {
    let bytes_per_texel = source.format().block_copy_size(None).context("a texture of several planes")?;
    let row_bytes = source.width() * bytes_per_texel;
    let row_pitch = row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let staging = staging_buffer(gpu, u64::from(row_pitch) * u64::from(source.height()));
    let mut encoder = gpu.encoder("read texture");
    encoder.copy_texture_to_buffer(
        source.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &staging,
            layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row_pitch), rows_per_image: None },
        },
        wgpu::Extent3d { width: source.width(), height: source.height(), depth_or_array_layers: 1 },
    );
    gpu.queue.submit([encoder.finish()]);
    let padded = map(gpu, &staging)?;
    Ok(padded.chunks_exact(row_pitch as usize).flat_map(|row| &row[..row_bytes as usize]).copied().collect())
}

fn staging_buffer(gpu: &Gpu, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("readback"),
        size,
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    })
}

fn map(gpu: &Gpu, staging: &wgpu::Buffer) -> Result<Vec<u8>> {
    let (sender, receiver) = mpsc::channel();
    staging.map_async(wgpu::MapMode::Read, .., move |result| {
        // The receiver lives until the end of this function; a failed send means that nobody waits any more.
        let _ = sender.send(result);
    });
    gpu.device.poll(wgpu::PollType::wait_indefinitely()).context("the device was lost")?;
    receiver.recv().context("the device dropped a readback")?.context("a buffer cannot be read back")?;
    Ok(staging.get_mapped_range(..).context("a buffer cannot be read back")?.to_vec())
}
