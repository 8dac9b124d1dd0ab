//! The filter without texels: every lookup of [`scumble_core::filter`] is a ray.
//!
//! A lookup at offset `o` and depth `d` follows the light's ray that crosses the reference plane at the receiver's point
//! plus `o`. It is lit when nothing lies on the ray between the map's near plane and `d - epsilon`. The blocker search takes
//! the depth of the first surface on the same ray. So this is a shadow map of infinite resolution, with the bias that
//! rounding needs ([`Bias::without_texels`], [`Rays::epsilon`]) and none that texels need.
//!
//! Source: the comparison with an alias-free hard shadow of course notes Eisemann et al. (2009), 1.6, filtered by the kernel
//! under test in place of the light.

use glam::{DVec2, Vec3};
use rayon::prelude::*;
use scumble_core::filter::{self, SoftShadow};
use scumble_core::{Bias, Filter, Fit, ReceiverPlane, Taps, rotation_angle};

use crate::Rays;

/// Receivers that a thread takes at a time, and the step of the progress.
const CHUNK: usize = 1024;

/// A point whose visibility is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Receiver {
    /// World space, metres.
    pub position: Vec3,
    /// Geometric unit normal, either side.
    pub normal: Vec3,
    /// The pixel it is seen in, which turns the taps.
    pub pixel: [u32; 2],
}

/// A light's filter over rays.
pub struct KernelTruth<'a> {
    /// The scene.
    pub rays: &'a Rays,
    /// The light's view; says where radii are measured and where the near plane is.
    pub fit: &'a Fit,
    /// The filter under test.
    pub filter: Filter,
    /// The renderer's taps.
    pub taps: Taps,
    /// No PCSS filter is narrower than this, in metres at the reference plane; 0 for the filter's own truth, the map's
    /// `radius_min_world` to leave the clamp out of the comparison.
    pub radius_min_world: f64,
}

impl<'a> KernelTruth<'a> {
    /// With the default taps and no smallest radius.
    pub fn new(rays: &'a Rays, fit: &'a Fit, filter: Filter) -> Self {
        Self { rays, fit, filter, taps: Taps::default(), radius_min_world: 0.0 }
    }

    /// Visibility of one receiver, and the radius of its filter (0 for a hard shadow).
    pub fn at(&self, receiver: &Receiver) -> SoftShadow {
        let position = receiver.position.as_dvec3();
        let normal = receiver.normal.as_dvec3();
        let plane = ReceiverPlane::new(self.fit, position, normal, &Bias::without_texels(), DVec2::ZERO);
        let middle = self.fit.plane_from_world(position);
        let lookup = |offset: DVec2, depth: f64| f64::from(u8::from(self.lit(middle + offset, depth)));
        let depth_at = |offset: DVec2| self.first_depth(middle + offset);
        let turn = rotation_angle(receiver.pixel);

        let fixed = |visibility, radius_world| SoftShadow { visibility, blockers: None, radius_world };
        match self.filter {
            Filter::Hard => fixed(filter::hard(lookup, &plane), 0.0),
            Filter::Pcf { radius_world } => {
                fixed(filter::pcf(lookup, &self.taps.filter, radius_world, turn, &plane), radius_world)
            }
            Filter::Pcss => filter::pcss(depth_at, lookup, &self.taps, turn, self.fit, &plane, self.radius_min_world),
        }
    }

    /// Visibility of all receivers, on all cores. `progress` is called with the number of receivers just done, from any
    /// thread.
    pub fn visibility(&self, receivers: &[Receiver], progress: impl Fn(usize) + Sync) -> Vec<f32> {
        let mut visibility = vec![1.0; receivers.len()];
        receivers.par_chunks(CHUNK).zip(visibility.par_chunks_mut(CHUNK)).for_each(|(receivers, visibility)| {
            for (receiver, visibility) in receivers.iter().zip(visibility) {
                *visibility = self.at(receiver).visibility as f32;
            }
            progress(receivers.len());
        });
        visibility
    }

    /// Whether the light's ray through `plane` on the reference plane reaches `depth`. What lies before the near plane is lit.
    fn lit(&self, plane: DVec2, depth: f64) -> bool {
        let (near, end) = (self.fit.depth_near, depth - self.rays.epsilon());
        end <= near || self.rays.free(self.fit.world_from_plane(plane, near), self.fit.world_from_plane(plane, end))
    }

    /// Depth of the first surface behind the near plane on the light's ray through `plane`.
    fn first_depth(&self, plane: DVec2) -> Option<f64> {
        let start = self.fit.world_from_plane(plane, self.fit.depth_near);
        let direction = self.fit.world_from_plane(plane, self.fit.depth_far) - start;
        self.rays.first_hit(start, direction).map(|hit| self.fit.depth(hit.position))
    }
}
