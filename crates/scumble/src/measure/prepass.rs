//! The depth prepass that is measured: whether it can be, and where its pixels are.

use glam::DVec2;
use scumble_core::Camera;

use crate::error::Error;
use crate::measure::Request;
use crate::uniforms::MeasureUniform;

/// Refuses a prepass that the pass cannot bind; returns its size.
pub fn checked_size(prepass: &wgpu::TextureView) -> Result<[u32; 2], Error> {
    let texture = prepass.texture();
    let is_readable = texture.format().has_depth_aspect()
        && texture.sample_count() == 1
        && texture.dimension() == wgpu::TextureDimension::D2
        && texture.mip_level_count() == 1
        && texture.depth_or_array_layers() == 1
        && texture.usage().contains(wgpu::TextureUsages::TEXTURE_BINDING);
    if is_readable {
        return Ok([texture.width(), texture.height()]);
    }
    Err(Error::Prepass {
        found: format!(
            "{:?} with {} samples, {} mip levels, {} layers and usage {:?}",
            texture.format(),
            texture.sample_count(),
            texture.mip_level_count(),
            texture.depth_or_array_layers(),
            texture.usage()
        ),
    })
}

/// Width and height of a pixel at view depth 1.
pub fn pixel_at_unit_distance(camera: &Camera, [width_px, height_px]: [u32; 2]) -> DVec2 {
    let height = camera.height_at_unit_distance();
    DVec2::new(height * camera.aspect / f64::from(width_px), height / f64::from(height_px))
}

/// Rays and depth of the prepass's pixels. The projection gives ndc depth = A + B / view depth.
pub fn camera_uniform(camera: &Camera, [width_px, height_px]: [u32; 2], request: &Request<'_>) -> MeasureUniform {
    let forward = camera.forward();
    let right = forward.cross(camera.up).normalize();
    let up = right.cross(forward);
    let pixel = pixel_at_unit_distance(camera, [width_px, height_px]);
    let (ray_x, ray_y) = (right * pixel.x, -up * pixel.y);
    let corner = forward - 0.5 * (f64::from(width_px) * ray_x + f64::from(height_px) * ray_y);
    let projection = camera.clip_from_view();
    let settings = request.settings;
    let ratio = settings.relation.ratio();
    MeasureUniform {
        eye: (camera.eye - request.origin_world).as_vec3().to_array(),
        depth_numerator: (-projection.w_axis.z) as f32,
        ray_corner: corner.as_vec3().to_array(),
        depth_offset: (-projection.z_axis.z) as f32,
        ray_x: ray_x.as_vec3().to_array(),
        stride: request.stride,
        ray_y: ray_y.as_vec3().to_array(),
        radius_per_footprint: (ratio * settings.footprint_kappa) as f32,
        forward: forward.as_vec3().to_array(),
        radius_floor_world: settings.demand_radius_world(0.0, 0.0) as f32,
        pixel_at_unit_distance: pixel.y as f32,
        padding: [0.0; 3],
    }
}
