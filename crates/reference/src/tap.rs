//! Whether a tap of the filter is shaded: which surface the tap belongs to, and whether something lies before it.
//!
//! The tap is the light's ray at offset `o` from the receiver; `t` is the depth of the receiver's tangent plane there,
//! `d_1` the depth of the first surface on the ray, `gap = t - d_1`. A *layer* is a place where the ray meets a side
//! that faces the light. With `r` the filter's radius (a blocker search's own radius) as a length at the receiver's
//! depth:
//! ```text
//! gap <= 0                                   lit
//! gap > reach                                shaded
//! d_1 is of the mesh that shades o = 0       shaded: the receiver lies under it
//! no layer within r / 20 of d_1              shaded: a back, of which the front is elsewhere
//! another open layer before t + gap          shaded: it is nearer to t and belongs to the receiver, d_1 is before it
//! else                                       lit: d_1 is the receiver's own surface, which rises above the tangent plane
//! reach = r (1 + |s_receiver| + |s_1|)       s: change of depth per metre sideways, of the tangent plane and of d_1's triangle
//! ```
//! Two planes that meet within the kernel are apart by no more than `r (|s_receiver| + |s_1|)` in it, whatever the
//! light's angle; a radius more lets a stair of flat treads be a surface too. The distance `r / 20` is for doubled
//! cloth, of which either side may be the upper one by a thread; a kernel of 25 taps does not tell so small a step.
//!
//! A layer is *open* unless it lies inside of a body or touches its underside: no receiver is there to be shaded. The
//! ground continues under a wall, and at the foot of the wall's lit side it must not make the wall an occluder. A mesh
//! holds the layer when the ray, from the layer on, leaves the mesh more often than it enters it.
//!
//! Limits: folds steeper than the reach shade as they do in a map. Where a wall is thinner than the kernel, taps behind
//! it find the floor of its other side, and the foot of its lit side is darkened. Where the receiver's surface is
//! narrower than the kernel, a surface beside it that rises within reach is taken for its own.

use glam::{DVec2, DVec3};
use scumble_core::{Bias, Fit, ReceiverPlane};

use crate::{Hit, Rays};

/// Distance of the sides of doubled cloth, in radii of the filter. The parasols of real files are up to 0.04 apart
/// along a slanted ray.
const TWINS: f64 = 0.05;

/// A receiver with what its taps can meet.
pub struct Surroundings<'a> {
    rays: &'a Rays,
    fit: &'a Fit,
    receiver: &'a ReceiverPlane,
    /// The receiver on the reference plane.
    middle: DVec2,
    /// The mesh that shades the receiver itself.
    shading_mesh: Option<usize>,
}

impl<'a> Surroundings<'a> {
    /// Of the receiver at `position`, which has the tangent plane `receiver`.
    pub fn new(rays: &'a Rays, fit: &'a Fit, receiver: &'a ReceiverPlane, position: DVec3) -> Self {
        let mut around = Self { rays, fit, receiver, middle: fit.plane_from_world(position), shading_mesh: None };
        around.shading_mesh = around.first(DVec2::ZERO, receiver.depth_at(DVec2::ZERO)).map(|hit| hit.mesh);
        around
    }

    /// Depth of what shades the tap at `offset`, where the tangent plane has the depth `plane_depth`; `None` where it
    /// is lit. What lies before the near plane shades nothing.
    pub fn occluder_depth(&self, offset: DVec2, plane_depth: f64, radius_world: f64) -> Option<f64> {
        let first = self.first(offset, plane_depth)?;
        let first_depth = self.fit.depth(first.position);
        let gap = plane_depth - first_depth;
        if gap > self.reach(&first, radius_world) || self.shading_mesh == Some(first.mesh) {
            return Some(first_depth);
        }

        let epsilon = self.rays.epsilon();
        let (start, direction) = self.ray(offset);
        let radius = self.at_receiver(radius_world);
        let hits = self.rays.all_hits(start, direction);
        let depth = |hit: &Hit| self.fit.depth(hit.position);
        let mut layers = hits.iter().filter(|hit| hit.front);
        let own = layers.next().map(depth).filter(|&own| own <= first_depth + epsilon.max(TWINS * radius));
        let is_nearer = |layer: &Hit, own: f64| depth(layer) > own + epsilon && depth(layer) < plane_depth + gap;
        let is_own =
            own.is_some_and(|own| !layers.any(|layer| is_nearer(layer, own) && is_open(layer, &hits, epsilon)));
        (!is_own).then_some(first_depth)
    }

    /// The first surface on the tap's ray, if it lies before `plane_depth`.
    fn first(&self, offset: DVec2, plane_depth: f64) -> Option<Hit> {
        let end_depth = plane_depth - self.rays.epsilon();
        let (start, direction) = self.ray(offset);
        if end_depth <= self.fit.depth_near || self.rays.free(start, self.at(offset, end_depth)) {
            return None;
        }
        self.rays.first_hit(start, direction)
    }

    /// Start on the near plane, and direction, of the tap's ray.
    fn ray(&self, offset: DVec2) -> (DVec3, DVec3) {
        let start = self.at(offset, self.fit.depth_near);
        (start, self.at(offset, self.fit.depth_far) - start)
    }

    /// See the module; in metres of depth.
    fn reach(&self, first: &Hit, radius_world: f64) -> f64 {
        let bias = Bias::without_texels();
        let of_first = ReceiverPlane::new(self.fit, first.position, first.geometric_normal, &bias, DVec2::ZERO);
        self.at_receiver(radius_world) * (1.0 + self.receiver.slope.length() + of_first.slope.length())
    }

    /// A length of the reference plane at the receiver's depth.
    fn at_receiver(&self, length: f64) -> f64 {
        length / self.fit.reference_from_depth(self.receiver.depth)
    }

    fn at(&self, offset: DVec2, depth: f64) -> DVec3 {
        self.fit.world_from_plane(self.middle + offset, depth)
    }
}

/// Whether no mesh holds the layer. `hits` are all on the ray, near ones first.
fn is_open(layer: &Hit, hits: &[Hit], epsilon: f64) -> bool {
    let from_layer = || hits.iter().filter(|hit| hit.distance >= layer.distance - epsilon);
    // How often the ray has left `mesh` more often than entered it, up to and with everything at `end`'s depth.
    let left = |mesh: usize, end: f64| -> i32 {
        let until = from_layer().filter(|hit| hit.mesh == mesh && hit.distance <= end + epsilon);
        until.map(|hit| if hit.front { -1 } else { 1 }).sum()
    };
    from_layer().all(|hit| left(hit.mesh, hit.distance) <= 0)
}
