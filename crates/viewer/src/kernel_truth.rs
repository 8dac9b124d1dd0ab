//! Visibility without texels: the filter of `scumble_core`, with a ray in place of every map lookup.
//!
//! Taps, their turn by pixel, radii and the receiver's tangent plane are those of the shader; a tap is lit when the segment
//! from the light's near plane to the tangent plane is free. So a map that differs from this differs by its texels, and by
//! the bias that they need.

use glam::DVec2;
use indicatif::ProgressBar;
use rayon::prelude::*;
use scumble::scumble_core::{Bias, Fit, ReceiverPlane, Taps, filter, rotation_angle};
use scumble::{Filter, Plan};
use scumble_reference::Rays;

use crate::gbuffer::Surface;
use crate::setup::Setup;

/// Pixels that a thread takes at a time, and steps of the progress bar.
const CHUNK: usize = 4096;

/// The rays of a scene.
pub struct KernelTruth {
    rays: Rays,
    taps: Taps,
}

impl KernelTruth {
    /// Builds the hierarchy.
    pub fn new(setup: &Setup) -> Self {
        Self { rays: Rays::new(&setup.scene), taps: Taps::default() }
    }

    /// Visibility of every pixel of a picture `width_px` wide; 1 where there is no surface or the light has no view.
    ///
    /// The plan's fit says where the reference plane is, on which radii are measured; texels play no part.
    pub fn visibility(
        &self,
        kind: &Filter,
        plan: &Plan,
        surfaces: &[Option<Surface>],
        width_px: u32,
        bar: &ProgressBar,
    ) -> Vec<f32> {
        let mut visibility = vec![1.0f32; surfaces.len()];
        let Some(view) = plan.views().first() else { return visibility };
        surfaces.par_chunks(CHUNK).zip(visibility.par_chunks_mut(CHUNK)).enumerate().for_each(
            |(number, (surfaces, visibility))| {
                for (index, (surface, visibility)) in surfaces.iter().zip(visibility).enumerate() {
                    let pixel = (number * CHUNK + index) as u32;
                    if let Some(surface) = surface {
                        *visibility = self.at(kind, &view.fit, surface, [pixel % width_px, pixel / width_px]) as f32;
                    }
                }
                bar.inc(surfaces.len() as u64);
            },
        );
        visibility
    }

    /// Visibility of one surface.
    fn at(&self, kind: &Filter, fit: &Fit, surface: &Surface, pixel: [u32; 2]) -> f64 {
        let position = surface.position.as_dvec3();
        let normal = surface.normal.as_dvec3().normalize_or_zero();
        let plane = ReceiverPlane::new(fit, position, normal, &Bias::without_texels(), DVec2::ZERO);
        let middle = fit.plane_from_world(position);
        let along_ray = |offset: DVec2, depth: f64| fit.world_from_plane(middle + offset, depth);
        let lookup = |offset: DVec2, depth: f64| {
            let start = along_ray(offset, fit.depth_near);
            let end = along_ray(offset, depth - self.rays.epsilon());
            f64::from(u8::from(self.rays.free(start, end)))
        };
        let depth_at = |offset: DVec2| {
            let start = along_ray(offset, fit.depth_near);
            let hit = self.rays.first_hit(start, along_ray(offset, fit.depth_far) - start)?;
            Some(fit.depth(hit.position))
        };
        let turn = rotation_angle(pixel);
        match *kind {
            Filter::Hard => filter::hard(lookup, &plane),
            Filter::Pcf { radius_world } => filter::pcf(lookup, &self.taps.filter, radius_world, turn, &plane),
            Filter::Pcss => filter::pcss(depth_at, lookup, &self.taps, turn, fit, &plane, 0.0).visibility,
        }
    }
}
