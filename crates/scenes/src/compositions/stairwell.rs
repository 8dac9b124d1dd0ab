//! `stairwell`: a spiral staircase in a corner of two walls, under a spot lamp. Treads shade treads at many distances,
//! the balusters draw thin lines on floor and wall.

use super::ASPECT;
use crate::model::{Placement, load_asset, place};
use crate::shapes::cuboid;
use crate::{Error, Scene};
use glam::{DVec3, Vec3};
use scumble_core::{Camera, Light};
use std::path::Path;

/// Composes the stairwell.
pub fn stairwell(assets: &Path) -> Result<Scene, Error> {
    let plaster = Vec3::new(0.66, 0.63, 0.57);
    let mut meshes = vec![
        cuboid("floor", DVec3::new(-3.0, -0.1, -1.9), DVec3::new(4.4, 0.0, 3.6), Vec3::new(0.42, 0.36, 0.30)),
        cuboid("back wall", DVec3::new(-3.0, 0.0, -2.0), DVec3::new(4.4, 4.4, -1.9), plaster),
        cuboid("side wall", DVec3::new(-3.1, -0.1, -2.0), DVec3::new(-3.0, 4.4, 3.6), plaster),
    ];
    meshes.extend(place(&load_asset(assets, "spiralStaircase")?, &[Placement::at(0.0, 0.0, 0.6)]));

    let lamp = DVec3::new(1.9, 4.9, 2.2);
    Ok(Scene {
        name: "stairwell".to_owned(),
        meshes,
        camera: Camera {
            eye: DVec3::new(2.1, 3.0, 5.9),
            target: DVec3::new(-0.45, 1.55, 0.0),
            up: DVec3::Y,
            vertical_fov: 0.70,
            aspect: ASPECT,
            near: 0.1,
            far: 20.0,
        },
        light: Light::Spot {
            position: lamp,
            direction: (DVec3::new(-0.35, 1.35, -0.2) - lamp).normalize(),
            cone_half_angle: 0.66,
            radius_world: 0.12,
        },
        pcf_radius_world: 0.03,
    })
}
