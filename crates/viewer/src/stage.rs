//! A scene on the device, with the passes that do not depend on a shadow map.

use anyhow::Result;
use image::RgbImage;

use crate::device::Gpu;
use crate::gbuffer::{GBuffer, GBufferPass, target};
use crate::geometry::Geometry;
use crate::pipelines::Pipelines;
use crate::setup::Setup;
use crate::shading::{LightingUniform, ShadingPass};
use crate::timer::{Timer, Times};

/// Visibility of the light, 1 lit and 0 dark.
pub const VISIBILITY_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;

/// Everything that the variants of a comparison share.
pub struct Stage {
    /// The device.
    pub gpu: Gpu,
    /// Scene and conditions.
    pub setup: Setup,
    /// The scene's buffers.
    pub geometry: Geometry,
    /// Draws receivers.
    pub gbuffer_pass: GBufferPass,
    /// What all maps are drawn and read with.
    pub pipelines: Pipelines,
    shading: ShadingPass,
}

impl Stage {
    /// Uploads the scene and builds the pipelines.
    pub fn new(gpu: Gpu, setup: Setup) -> Result<Self> {
        let geometry = Geometry::upload(&gpu, &setup.scene)?;
        let gbuffer_pass = GBufferPass::new(&gpu);
        let shading = ShadingPass::new(&gpu, &gbuffer_pass);
        Ok(Self { gpu, setup, geometry, gbuffer_pass, pipelines: Pipelines::default(), shading })
    }

    /// Draws the receivers of a picture of `size_px` with `samples_per_side`^2 samples per pixel.
    pub fn receivers(&self, size_px: [u32; 2], samples_per_side: u32) -> Result<GBuffer> {
        let scene = &self.setup.scene;
        let lighting = LightingUniform::new(scene, size_px[1], samples_per_side);
        let samples = size_px.map(|side| side * samples_per_side);
        let gbuffer = GBuffer::new(&self.gpu, &self.gbuffer_pass, samples, &scene.camera, &lighting)?;
        let mut encoder = self.gpu.encoder("receivers");
        gbuffer.draw(&mut encoder, &self.gbuffer_pass, &self.geometry);
        self.gpu.finish(encoder)?;
        Ok(gbuffer)
    }

    /// Milliseconds of what a frame does besides its shadow: receivers and shading. Empty without timestamps.
    pub fn time_drawing(&self, gbuffer: &GBuffer, visibility: &wgpu::Texture, timer: &mut Timer) -> Result<Times> {
        let mut encoder = self.gpu.encoder("drawing");
        timer.start(&mut encoder);
        gbuffer.draw(&mut encoder, &self.gbuffer_pass, &self.geometry);
        self.shading.draw(&self.gpu, &mut encoder, gbuffer, visibility, 1);
        timer.mark(&mut encoder, "drawing");
        timer.resolve(&mut encoder);
        self.gpu.finish(encoder)?;
        timer.read(&self.gpu)
    }

    /// A texture for the visibility of every sample of a G-buffer.
    pub fn visibility_texture(&self, gbuffer: &GBuffer) -> wgpu::Texture {
        target(&self.gpu, "visibility", gbuffer.size_px, VISIBILITY_FORMAT)
    }

    /// Visibility that was computed elsewhere, rows from top to bottom.
    pub fn upload_visibility(&self, gbuffer: &GBuffer, visibility: &[f32]) -> wgpu::Texture {
        let texture = self.visibility_texture(gbuffer);
        let [width, height] = gbuffer.size_px;
        self.gpu.queue.write_texture(
            texture.as_image_copy(),
            bytemuck::cast_slice(visibility),
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(width * 4), rows_per_image: None },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        texture
    }

    /// The picture of a G-buffer made by [`receivers`](Self::receivers) under a visibility texture of its size.
    pub fn picture(&self, gbuffer: &GBuffer, visibility: &wgpu::Texture, samples_per_side: u32) -> Result<RgbImage> {
        self.shading.picture(&self.gpu, gbuffer, visibility, samples_per_side)
    }
}
