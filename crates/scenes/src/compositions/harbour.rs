//! `harbour`: a ship at a quay in the evening: rigging of a few centimetres throws shadows from 2 to 20 m high on deck,
//! sails and stone.
//!
//! The model is not shipped: *Dutch ship medium* of Poly Haven, a glTF file in metres.

use super::ASPECT;
use crate::gltf_file::load_gltf;
use crate::models::model_file;
use crate::shapes::{cuboid, ground};
use crate::{Error, Scene};
use glam::{DVec3, Vec3};
use scumble_core::{Camera, Light};
use std::path::Path;

/// Below the folder of models.
pub const FILE: &str = "dutch_ship/dutch_ship_medium_1k.gltf";
/// Height of the water about the hull, metres: the keel reaches 2 m below the file's origin.
const WATER: f64 = -0.2;
/// Side of the water, metres.
const SEA: f64 = 60.0;

/// Composes the harbour.
pub fn harbour(assets: &Path) -> Result<Scene, Error> {
    let mut meshes = load_gltf(&model_file(assets, FILE))?;
    meshes.push(ground("water", DVec3::new(0.0, WATER, 0.0), SEA, Vec3::new(0.10, 0.19, 0.22)));
    meshes.push(cuboid(
        "quay",
        DVec3::new(-24.0, WATER - 1.0, -16.0),
        DVec3::new(24.0, 1.4, -4.6),
        Vec3::new(0.47, 0.43, 0.37),
    ));
    Ok(Scene {
        name: "harbour".to_owned(),
        meshes,
        camera: Camera {
            eye: DVec3::new(7.5, 11.0, 10.5),
            target: DVec3::new(1.0, 3.2, -1.8),
            up: DVec3::Y,
            vertical_fov: 0.85,
            aspect: ASPECT,
            near: 0.1,
            far: 120.0,
        },
        light: Light::Directional {
            direction: DVec3::new(-0.45, -0.80, -0.62).normalize(),
            half_angle: 1f64.to_radians(),
        },
        pcf_radius_world: 0.05,
    })
}
