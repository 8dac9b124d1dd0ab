//! What can be wrong with a scene's name or file.

use std::path::PathBuf;

/// Why a scene could not be opened. Every message is one line that names the file, the place, and what is allowed.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The name is neither in the catalogue nor a path with a known extension.
    #[error("unknown scene '{name}': allowed are {known}, or a path to a .gltf, .glb or .obj file")]
    UnknownScene {
        /// What was asked for.
        name: String,
        /// The names of the catalogue, separated by commas.
        known: String,
    },
    /// The scene's model is not shipped and not there.
    #[error(
        "the scene {name} needs {}, which is not there: {origin}; put it there, or name its folder in {}",
        file.display(),
        crate::MODELS_VARIABLE
    )]
    Absent {
        /// The scene.
        name: &'static str,
        /// What is needed.
        file: PathBuf,
        /// Where it comes from.
        origin: &'static str,
    },
    /// The file cannot be read.
    #[error("{}: cannot be read: {reason}", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// The system's reason.
        reason: std::io::Error,
    },
    /// The file is read but is not what it says, or holds what is not allowed.
    #[error("{}, {place}: {problem}; {allowed}", file.display())]
    Content {
        /// The file.
        file: PathBuf,
        /// Where in the file: a line, an object, an accessor.
        place: String,
        /// What was found there.
        problem: String,
        /// What is allowed there.
        allowed: &'static str,
    },
}
