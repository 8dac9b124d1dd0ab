//! The scenes by name, and the one function that opens a scene by name or by path.

use crate::{Error, Scene, automatic, compositions, model};
use std::path::Path;

/// A scene of the catalogue.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// What `--scene` takes.
    pub name: &'static str,
    /// What it shows and what it is good for, one line.
    pub description: &'static str,
    build: fn(&Path) -> Result<Scene, Error>,
}

const CATALOGUE: [Entry; 4] = [
    Entry {
        name: "yard",
        description: "fence, swing, deck chair and parasol in a low soft sun: thin bars, long shadows, contact",
        build: compositions::yard,
    },
    Entry {
        name: "stairwell",
        description: "spiral staircase under a spot lamp: treads over treads, many blocker distances",
        build: compositions::stairwell,
    },
    Entry {
        name: "recital",
        description: "grand piano under a spot lamp: a big body on thin legs, soft edges beside contact",
        build: compositions::recital,
    },
    Entry {
        name: "contact",
        description: "a box on a plane in a soft sun: the penumbra that grows from nothing",
        build: compositions::contact,
    },
];

/// All scenes of the catalogue, the richest first.
pub fn catalogue() -> &'static [Entry] {
    &CATALOGUE
}

/// Opens a scene of the catalogue by its name, or any `.obj`, `.gltf` or `.glb` file by its path.
///
/// `assets` is the folder of the shipped models; a path needs none. A file's scene gets a camera and a sun from its
/// bounds, and a ground where the model brings none; its lengths are taken as metres.
pub fn open(name_or_path: &str, assets: &Path) -> Result<Scene, Error> {
    if let Some(entry) = CATALOGUE.iter().find(|entry| entry.name == name_or_path) {
        return (entry.build)(assets);
    }
    let path = Path::new(name_or_path);
    match model::load(path) {
        Some(meshes) => Ok(automatic::compose(path, meshes?)),
        None => Err(Error::UnknownScene {
            name: name_or_path.to_owned(),
            known: CATALOGUE.map(|entry| entry.name).join(", "),
        }),
    }
}
