//! The filter without texels: every lookup of [`scumble_core::filter`] is a ray.
//!
//! A tap at offset `o` is the light's ray that crosses the reference plane at the receiver's point plus `o`. A map of
//! infinite resolution would call it shaded when its first surface lies before the receiver's tangent plane. The truth
//! deviates from that, because the filter stands for "the filtered hard shadow" (Kreuzer 2017, 4.1.2): the hard shadow
//! is a function on surfaces, and its mean is taken over the surface around the receiver, not over a plane that leaves
//! it. A neighbouring fold, riser or wall that rises above the tangent plane and is lit is a part of that surface and
//! no occluder. So the tap asks whether light reaches the surface where the ray meets it; `tap` says which surface.
//!
//! What a map differs by from this truth is its texels, the bias that they need, and the self-shadowing of its tangent
//! plane in concave places. Bias here is only what rounding needs ([`Bias::without_texels`], [`Rays::epsilon`]).
//!
//! Source: the comparison with an alias-free hard shadow of course notes Eisemann et al. (2009), 1.6, filtered by the
//! kernel under test in place of the light.

use std::f64::consts::SQRT_2;

use glam::{DVec2, Vec3};
use rayon::prelude::*;
use scumble_core::filter::{self, SoftShadow};
use scumble_core::{Bias, Filter, Fit, ReceiverPlane, Taps, rotation_angle};

use crate::Rays;
use crate::tap::Surroundings;

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
    /// The renderer's taps; of VSM points of its square.
    pub taps: Taps,
    /// No PCSS filter is narrower than this, in metres at the reference plane; 0 for the filter's own truth, the map's
    /// `radius_min_world` to leave the clamp out of the comparison.
    pub radius_min_world: f64,
}

impl<'a> KernelTruth<'a> {
    /// With the filter's default taps and no smallest radius.
    pub fn new(rays: &'a Rays, fit: &'a Fit, filter: Filter) -> Self {
        Self { rays, fit, filter, taps: Taps::of(&filter, Taps::count_of(&filter)), radius_min_world: 0.0 }
    }

    /// Visibility of one receiver, and the radius of its filter (0 for a hard shadow).
    pub fn at(&self, receiver: &Receiver) -> SoftShadow {
        let position = receiver.position.as_dvec3();
        let normal = receiver.normal.as_dvec3();
        let plane = ReceiverPlane::new(self.fit, position, normal, &Bias::without_texels(), DVec2::ZERO);
        let around = Surroundings::new(self.rays, self.fit, &plane, position);
        // A square is aligned with the map and not turned, and its corners reach farther.
        let (turn, reach) = match self.filter {
            Filter::Vsm { .. } => (0.0, SQRT_2),
            Filter::Hard | Filter::Pcf { .. } | Filter::Pcss => (rotation_angle(receiver.pixel), 1.0),
        };
        let pcf = |radius_world: f64| {
            let lookup = |offset, depth| {
                f64::from(u8::from(around.occluder_depth(offset, depth, reach * radius_world).is_none()))
            };
            filter::pcf(lookup, &self.taps.filter, radius_world, turn, &plane)
        };

        match self.filter {
            Filter::Hard => {
                let lookup = |offset, depth| f64::from(u8::from(around.occluder_depth(offset, depth, 0.0).is_none()));
                SoftShadow { visibility: filter::hard(lookup, &plane), blockers: None, radius_world: 0.0 }
            }
            Filter::Pcf { radius_world } | Filter::Vsm { radius_world } => {
                SoftShadow { visibility: pcf(radius_world), blockers: None, radius_world }
            }
            Filter::Pcss => {
                let search = filter::search_radius_world(self.fit, plane.depth).max(self.radius_min_world);
                let depth_at = |offset| around.occluder_depth(offset, plane.depth_at(offset), search);
                // The surroundings' reach is the filter's radius, so it is searched for before any tap is looked at.
                let lit = |_, _| 1.0;
                let found = filter::pcss(depth_at, lit, &self.taps, turn, self.fit, &plane, self.radius_min_world);
                let visibility = if found.blockers.is_some() { pcf(found.radius_world) } else { 1.0 };
                SoftShadow { visibility, ..found }
            }
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
}
