//! Model files: one function for all formats, and models of the assets folder put where a composition wants them.

use crate::gltf_file::load_gltf;
use crate::obj::load_obj;
use crate::{Error, Mesh, bounds_of};
use glam::{DAffine3, DVec3};
use std::path::Path;
use tracing::subscriber::NoSubscriber;

/// The shipped models are in centimetres.
const METRES_PER_CENTIMETRE: f64 = 0.01;

/// Loads a `.obj`, `.gltf` or `.glb` file in the file's own units; `None` when the extension is another.
pub fn load(file: &Path) -> Option<Result<Vec<Mesh>, Error>> {
    let extension = file.extension()?.to_str()?.to_ascii_lowercase();
    match extension.as_str() {
        "obj" => Some(load_obj(file)),
        "gltf" | "glb" => Some(load_gltf(file)),
        _ => None,
    }
}

/// Where a model stands: its own origin is ignored, its footprint's centre stands on `foot`, turned about the vertical.
#[derive(Debug, Clone, Copy)]
pub struct Placement {
    /// The point under the middle of the model, metres.
    pub foot: DVec3,
    /// Turn about +y, radians, counter-clockwise seen from above.
    pub yaw: f64,
}

impl Placement {
    /// Stands at `x`, `z` on the ground at height 0, turned by `yaw` radians.
    pub fn at(x: f64, z: f64, yaw: f64) -> Self {
        Self { foot: DVec3::new(x, 0.0, z), yaw }
    }
}

/// Loads `assets/NAME/NAME.obj` in metres, standing with the middle of its footprint on the origin.
pub fn load_asset(assets: &Path, name: &str) -> Result<Vec<Mesh>, Error> {
    let file = assets.join(name).join(format!("{name}.obj"));
    // What is shipped is known; a user can do nothing about its doubled faces.
    let meshes = tracing::subscriber::with_default(NoSubscriber::default(), || load_obj(&file))?;
    let Some(bounds) = bounds_of(&meshes) else {
        return Ok(meshes);
    };
    let middle = bounds.center();
    let foot = DVec3::new(middle.x, bounds.min.y, middle.z);
    let metres_from_model =
        DAffine3::from_scale(DVec3::splat(METRES_PER_CENTIMETRE)) * DAffine3::from_translation(-foot);
    Ok(meshes.into_iter().map(|mesh| mesh.transformed(&metres_from_model)).collect())
}

/// Copies of a model that stands on the origin, one for each placement.
pub fn place(model: &[Mesh], placements: &[Placement]) -> Vec<Mesh> {
    placements
        .iter()
        .flat_map(|placement| {
            let world_from_model =
                DAffine3::from_translation(placement.foot) * DAffine3::from_rotation_y(placement.yaw);
            model.iter().map(move |mesh| mesh.clone().transformed(&world_from_model))
        })
        .collect()
}
