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

const CATALOGUE: [Entry; 9] = [
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
        name: "room",
        description: "table, shelf, bench and chair under a hanging lamp: contact under every foot, soft edges on walls",
        build: compositions::room,
    },
    Entry {
        name: "contact",
        description: "a box on a plane in a soft sun: the penumbra that grows from nothing",
        build: compositions::contact,
    },
    Entry {
        name: "slats",
        description: "a blind before the sun: parallel edges at a regular pitch, on floor and wall",
        build: compositions::slats,
    },
    Entry {
        name: "wedge",
        description: "a plate's slanted edge 1 m over a plane, the sun in the zenith: every value is known",
        build: compositions::wedge,
    },
    Entry {
        name: "giant",
        description: "contact in lengths of 2^20 for 1: what gives another picture holds a hidden length",
        build: compositions::giant,
    },
    Entry {
        name: "speck",
        description: "contact in lengths of 2^-20 for 1: the same at the other end",
        build: compositions::speck,
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
