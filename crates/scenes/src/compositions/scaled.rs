//! `giant` and `speck`: the scene *contact* in other units. Every length is multiplied by a power of two, which changes
//! no digit of a float, so that a method without a hidden length gives the same picture to the bit of its inputs.

use super::contact;
use crate::{Error, Scene};
use scumble_core::Light;
use std::path::Path;

/// 1,048,576: about 1e6.
const GIANT: f64 = (1u64 << 20) as f64;

/// *contact* with lengths of 2^20 for 1.
pub fn giant(assets: &Path) -> Result<Scene, Error> {
    Ok(scaled(contact(assets)?, "giant", GIANT))
}

/// *contact* with lengths of 2^-20 for 1.
pub fn speck(assets: &Path) -> Result<Scene, Error> {
    Ok(scaled(contact(assets)?, "speck", 1.0 / GIANT))
}

fn scaled(mut scene: Scene, name: &str, factor: f64) -> Scene {
    scene.name = name.to_owned();
    for position in scene.meshes.iter_mut().flat_map(|mesh| &mut mesh.positions) {
        *position *= factor as f32;
    }
    let camera = &mut scene.camera;
    for point in [&mut camera.eye, &mut camera.target] {
        *point *= factor;
    }
    camera.near *= factor;
    camera.far *= factor;
    if let Light::Spot { position, radius_world, .. } = &mut scene.light {
        *position *= factor;
        *radius_world *= factor;
    }
    scene.pcf_radius_world *= factor;
    scene
}
