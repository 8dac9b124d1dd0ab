//! Scenes for shadow maps: what casts, what receives, from where it is seen and lit.
//!
//! A [`Scene`] is triangles, one camera and one light. It comes from the [`catalogue`], composed of the models in
//! `assets/` for pictures that show shadows well, or from any `.obj`, `.gltf` or `.glb` file, so that a user's own scene
//! works without code:
//!
//! ```no_run
//! # fn main() -> Result<(), scumble_scenes::Error> {
//! let yard = scumble_scenes::open("yard", "assets".as_ref())?;
//! let own = scumble_scenes::open("models/ship.glb", "assets".as_ref())?;
//! # Ok(()) }
//! ```
//!
//! What moves is a [`Path`]: every scene has `approach`, `pan` and `creep` for its camera and `sweep` for its light
//! ([`Scene::path`], [`Scene::moved`]).
//!
//! Goals: no shadow that the file does not hold (concave polygons are cut by ears, not as fans), every problem of a
//! file as one line that names file and place, everything in metres. Not goals: textures but for what they cut out ([`AlphaMask`]),
//! animation, transparency; a mesh has one colour.

mod alpha_mask;
mod automatic;
mod catalogue;
mod compositions;
mod error;
mod gltf_file;
mod gltf_images;
mod mesh;
mod model;
mod models;
mod motion;
mod obj;
mod obj_lines;
mod oddities;
mod path;
mod polygon;
mod scene;
mod shading;
mod shapes;

pub use alpha_mask::{AlphaMask, AlphaTexture, Wrap};
pub use catalogue::{Entry, Model, catalogue, open};
pub use error::Error;
pub use gltf_file::load_gltf;
pub use mesh::{Mesh, bounds_of};
pub use models::{MODELS_VARIABLE, models_folder};
pub use obj::load_obj;
pub use path::{Path, Pose};
pub use scene::Scene;
pub use shapes::{cuboid, ground};
