//! A scene: meshes, a camera, a light, and how soft its shadows should look.

use crate::{Mesh, bounds_of};
use glam::DVec3;
use scumble_core::{Aabb, Camera, Light};

/// Everything a renderer or a ray tracer needs. World space is right-handed, y up, metres.
#[derive(Debug, Clone)]
pub struct Scene {
    /// The catalogue's name, or the file's stem.
    pub name: String,
    /// At least one mesh with at least one triangle; see [`Mesh`] for what is promised of each.
    pub meshes: Vec<Mesh>,
    /// A view in which the shadows can be judged; aspect 16:9.
    pub camera: Camera,
    /// The one light that casts shadows.
    pub light: Light,
    /// Suggested radius of a PCF kernel, in metres on the light's reference plane.
    pub pcf_radius_world: f64,
}

impl Scene {
    /// The smallest box around all meshes, the ground included; a point at the origin for a scene without positions.
    pub fn bounds(&self) -> Aabb {
        bounds_of(&self.meshes).unwrap_or(Aabb { min: DVec3::ZERO, max: DVec3::ZERO })
    }

    /// Triangles of all meshes together.
    pub fn triangle_count(&self) -> usize {
        self.meshes.iter().map(|mesh| mesh.triangles.len()).sum()
    }
}
