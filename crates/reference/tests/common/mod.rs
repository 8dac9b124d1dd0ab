//! What the tests of a known answer share.

use glam::DVec3;
use scumble_core::{Camera, Light};
use scumble_scenes::{Mesh, Scene};

/// Meshes under a light, seen from in front and above.
pub fn scene(light: Light, meshes: Vec<Mesh>) -> Scene {
    Scene {
        name: "known answer".to_owned(),
        meshes,
        camera: Camera {
            eye: DVec3::new(0.0, 3.0, 6.0),
            target: DVec3::ZERO,
            up: DVec3::Y,
            vertical_fov: 1.0,
            aspect: 1.5,
            near: 0.1,
            far: 100.0,
        },
        light,
        pcf_radius_world: 0.2,
    }
}

/// A sun of 0.1 rad half angle.
pub fn sun(direction: DVec3) -> Light {
    Light::Directional { direction, half_angle: 0.1 }
}
