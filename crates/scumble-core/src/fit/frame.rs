//! Light space as seen from the middle of the scene: bodies keep their precision far from the world's origin.

use glam::{DMat3, DMat4, DVec2, DVec3};

use super::DEPTH_MARGIN;
use crate::face::Face;
use crate::light::Light;
use crate::polyhedron::{HalfSpace, Polyhedron};

/// A lamp's near plane is no nearer than this share of its far plane: 32-bit depth then resolves 6e-6 of the range at
/// its far end. Casters nearer to a lamp than 1 % of its reach cast no shadow.
const NEAR_SHARE: f64 = 0.01;

/// Light space as seen from a local origin.
pub(crate) struct Frame {
    pub(super) light: Light,
    pub(super) face: Option<Face>,
    origin: DVec3,
    /// World to light space.
    pub(crate) light_from_world: DMat4,
    /// The local origin in light space.
    origin_light: DVec3,
}

impl Frame {
    /// The light space of `light`, or of its `face`, about `origin` in world space.
    pub(crate) fn new(light: Light, face: Option<Face>, origin: DVec3) -> Self {
        let light_from_world = light.light_from_world_of(face);
        Self { light, face, origin, light_from_world, origin_light: light_from_world.transform_point3(origin) }
    }

    fn light_from_local(&self, p: DVec3) -> DVec3 {
        self.origin_light + self.light_from_world.transform_vector3(p)
    }

    /// A point of light space about the local origin.
    pub(super) fn local_from_light(&self, p: DVec3) -> DVec3 {
        self.world_from_light(p - self.origin_light)
    }

    /// Turns a vector of light space into world space.
    pub(super) fn world_from_light(&self, v: DVec3) -> DVec3 {
        DMat3::from_mat4(self.light_from_world).transpose() * v
    }

    /// All points that lie between two corners across a directional light.
    pub(crate) fn column(&self, min: DVec2, max: DVec2) -> [HalfSpace; 4] {
        let side = |axis: DVec3, at: DVec2| {
            HalfSpace::through(self.local_from_light(at.extend(0.0)), self.world_from_light(axis))
        };
        [side(DVec3::X, min), side(DVec3::NEG_X, max), side(DVec3::Y, min), side(DVec3::NEG_Y, max)]
    }

    /// Smallest and largest depth; infinite and negative infinite of an empty body.
    pub(crate) fn depth_range(&self, body: &Polyhedron) -> (f64, f64) {
        let depths = body.vertices().map(|p| -self.light_from_local(p).z);
        depths.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), d| (lo.min(d), hi.max(d)))
    }

    /// The part of the scene in the light's volume with its depth range, a lamp's cut at its near plane. The near plane of a
    /// point light is that of all its faces.
    pub(super) fn lit_part(&self, scene: &Polyhedron) -> Option<(Polyhedron, f64, f64)> {
        let lit = scene.clip_all(&self.light.half_spaces(self.face, self.origin));
        let (near, far) = self.depth_range(&lit);
        let (nearest, farthest) = match self.light {
            Light::Directional { .. } => return Some((lit, near, far)),
            Light::Spot { .. } => (near, far),
            Light::Point { reach_world, .. } => {
                let (nearest, farthest) = self.distances_along_axes(scene);
                (nearest, farthest.min(reach_world))
            }
        };
        // Behind the lamp, or nothing but its apex.
        if lit.is_empty() || far <= 0.0 {
            return None;
        }
        let near = nearest.max(NEAR_SHARE * farthest) * (1.0 - DEPTH_MARGIN);
        let plane =
            HalfSpace::through(self.local_from_light(DVec3::new(0.0, 0.0, -near)), self.world_from_light(DVec3::NEG_Z));
        Some((lit.clip(&plane), near, far))
    }

    /// Smallest and largest depth of a box whose sides are those of the world in the faces of a point light: distances along
    /// the longest component. All faces find the same, since their light spaces differ by axes alone.
    fn distances_along_axes(&self, scene: &Polyhedron) -> (f64, f64) {
        let none = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let corners = scene.vertices().map(|p| self.light_from_local(p));
        let (min, max) = corners.fold(none, |(lo, hi), p| (lo.min(p), hi.max(p)));
        (min.max(-max).max_element().max(0.0), max.max(-min).max_element())
    }

    /// The box of a body's rays on the reference plane.
    pub(super) fn bounds(&self, body: &Polyhedron, reference: f64) -> (DVec2, DVec2) {
        let none = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        body.vertices().fold(none, |(lo, hi), v| {
            let p = self.light_from_local(v);
            let q = match self.light {
                Light::Directional { .. } => p.truncate(),
                Light::Spot { .. } | Light::Point { .. } => p.truncate() * (reference / -p.z),
            };
            (lo.min(q), hi.max(q))
        })
    }

    /// The light's square view plane: around the scene for a directional light, around the cone for a spot, the face of a
    /// point light.
    pub(super) fn square(&self, scene: &Polyhedron, reference: f64) -> (DVec2, DVec2) {
        match self.light {
            Light::Directional { .. } => {
                let (min, max) = self.bounds(scene, reference);
                let half = DVec2::splat(0.5 * (max - min).max_element());
                let middle = min + 0.5 * (max - min);
                (middle - half, middle + half)
            }
            Light::Spot { cone_half_angle, .. } => {
                let half = DVec2::splat(reference * cone_half_angle.tan());
                (-half, half)
            }
            Light::Point { .. } => (DVec2::splat(-reference), DVec2::splat(reference)),
        }
    }
}
