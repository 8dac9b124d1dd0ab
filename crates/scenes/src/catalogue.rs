//! The scenes by name, and the one function that opens a scene by name or by path.

use crate::models::model_file;
use crate::{Error, Scene, automatic, compositions, model};
use std::path::{Path, PathBuf};

/// A scene of the catalogue.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// What `--scene` takes.
    pub name: &'static str,
    /// What it shows and what it is good for, one line.
    pub description: &'static str,
    /// The file of its model below [`models_folder`](crate::models_folder), and where to get it; `None` for what is shipped.
    pub model: Option<Model>,
    build: fn(&Path) -> Result<Scene, Error>,
}

/// A model that is not shipped.
#[derive(Debug, Clone, Copy)]
pub struct Model {
    /// Below the folder of models.
    pub file: &'static str,
    /// Name, maker, licence.
    pub origin: &'static str,
}

impl Entry {
    /// The model's file where it is needed and not there; `assets` as for [`open`].
    #[must_use]
    pub fn missing(&self, assets: &Path) -> Option<PathBuf> {
        let file = model_file(assets, self.model?.file);
        (!file.is_file()).then_some(file)
    }
}

const CATALOGUE: [Entry; 11] = [
    Entry {
        name: "yard",
        description: "fence, swing, deck chair and parasol in a low soft sun: thin bars, long shadows, contact",
        model: None,
        build: compositions::yard,
    },
    Entry {
        name: "stairwell",
        description: "spiral staircase under a spot lamp: treads over treads, many blocker distances",
        model: None,
        build: compositions::stairwell,
    },
    Entry {
        name: "recital",
        description: "grand piano under a spot lamp: a big body on thin legs, soft edges beside contact",
        model: None,
        build: compositions::recital,
    },
    Entry {
        name: "room",
        description: "table, shelf, bench and chair under a hanging lamp: contact under every foot, soft edges on walls",
        model: None,
        build: compositions::room,
    },
    Entry {
        name: "street",
        description: "a town's courtyard in a hazy sun: roofs and arcades over 60 m of ground, contact everywhere",
        model: Some(Model {
            file: compositions::STREET_FILE,
            origin: "zdm2, a map of Cube 2: Sauerbraten, as glTF, y up, a unit a metre (Calinou/game-maps-obj), CC BY 4.0",
        }),
        build: compositions::street,
    },
    Entry {
        name: "harbour",
        description: "a ship at a quay: rigging of centimetres over deck, sails and stone, 2 to 20 m high",
        model: Some(Model {
            file: compositions::HARBOUR_FILE,
            origin: "Dutch ship medium of Poly Haven, 1k, glTF with its textures, CC0 1.0",
        }),
        build: compositions::harbour,
    },
    Entry {
        name: "contact",
        description: "a box on a plane in a soft sun: the penumbra that grows from nothing",
        model: None,
        build: compositions::contact,
    },
    Entry {
        name: "slats",
        description: "a blind before the sun: parallel edges at a regular pitch, on floor and wall",
        model: None,
        build: compositions::slats,
    },
    Entry {
        name: "wedge",
        description: "a plate's slanted edge 1 m over a plane, the sun in the zenith: every value is known",
        model: None,
        build: compositions::wedge,
    },
    Entry {
        name: "giant",
        description: "contact in lengths of 2^20 for 1: what gives another picture holds a hidden length",
        model: None,
        build: compositions::giant,
    },
    Entry {
        name: "speck",
        description: "contact in lengths of 2^-20 for 1: the same at the other end",
        model: None,
        build: compositions::speck,
    },
];

/// All scenes of the catalogue, the richest first.
pub fn catalogue() -> &'static [Entry] {
    &CATALOGUE
}

/// Opens a scene of the catalogue by its name, or any `.obj`, `.gltf` or `.glb` file by its path.
///
/// `assets` is the folder of the shipped models; a path needs none. Models that are not shipped are looked for in
/// [`models_folder`](crate::models_folder). A file's scene gets a camera and a sun from its
/// bounds, and a ground where the model brings none; its lengths are taken as metres.
pub fn open(name_or_path: &str, assets: &Path) -> Result<Scene, Error> {
    if let Some(entry) = CATALOGUE.iter().find(|entry| entry.name == name_or_path) {
        return match (entry.missing(assets), entry.model) {
            (Some(file), Some(model)) => Err(Error::Absent { name: entry.name, file, origin: model.origin }),
            _ => (entry.build)(assets),
        };
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
