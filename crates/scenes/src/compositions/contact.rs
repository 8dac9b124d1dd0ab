//! `contact`: one box on a plane. Simple enough to predict every shadow value by hand.

use super::ASPECT;
use crate::shapes::{cuboid, ground};
use crate::{Error, Scene};
use glam::{DVec3, Vec3};
use scumble_core::{Camera, Light};
use std::path::Path;

/// A box of 1 x 1.5 x 1 m on a plane of 12 x 12 m, under a sun of half angle 2.5 degrees. Needs no assets.
pub fn contact(_assets: &Path) -> Result<Scene, Error> {
    Ok(Scene {
        name: "contact".to_owned(),
        meshes: vec![
            ground("ground", DVec3::ZERO, 12.0, Vec3::new(0.55, 0.52, 0.47)),
            cuboid("box", DVec3::new(-0.5, 0.0, -0.5), DVec3::new(0.5, 1.5, 0.5), Vec3::new(0.62, 0.27, 0.14)),
        ],
        camera: Camera {
            eye: DVec3::new(-1.1, 2.6, 4.6),
            target: DVec3::new(0.75, 0.45, 0.0),
            up: DVec3::Y,
            vertical_fov: 0.66,
            aspect: ASPECT,
            near: 0.1,
            far: 30.0,
        },
        light: Light::Directional {
            direction: DVec3::new(0.80, -0.62, 0.25).normalize(),
            half_angle: 2.5f64.to_radians(),
        },
        pcf_radius_world: 0.06,
    })
}
