//! `street`: a courtyard of a town whose roofs and arcades throw shadows over 60 m of ground, under a hazy sun: contact
//! everywhere, and a depth that one map cannot serve.
//!
//! The model is not shipped: the map *zdm2* of Cube 2: Sauerbraten as a glTF file, y up, one unit a metre.

use super::ASPECT;
use crate::gltf_file::load_gltf;
use crate::models::model_file;
use crate::{Error, Scene};
use glam::{DVec3, Vec3};
use scumble_core::{Camera, Light};
use std::path::Path;

/// Below the folder of models.
pub const FILE: &str = "zdm2/zdm2.glb";
/// Whitewash; the file has no colours.
const PLASTER: Vec3 = Vec3::new(0.55, 0.49, 0.40);

/// Composes the street.
pub fn street(assets: &Path) -> Result<Scene, Error> {
    let meshes = load_gltf(&model_file(assets, FILE))?;
    Ok(Scene {
        name: "street".to_owned(),
        meshes: meshes.into_iter().map(|mesh| mesh.colored(PLASTER)).collect(),
        camera: Camera {
            eye: DVec3::new(-12.5, 2.5, 16.5),
            target: DVec3::new(0.5, -0.5, 8.5),
            up: DVec3::Y,
            vertical_fov: 0.95,
            aspect: ASPECT,
            near: 0.1,
            far: 120.0,
        },
        light: Light::Directional {
            direction: DVec3::new(0.55, -0.95, -0.35).normalize(),
            half_angle: 1f64.to_radians(),
        },
        pcf_radius_world: 0.08,
    })
}
