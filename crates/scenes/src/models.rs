//! Models that are too large to ship: where they are looked for.

use std::path::{Path, PathBuf};

/// The environment variable that names another folder.
pub const MODELS_VARIABLE: &str = "SCUMBLE_MODELS";

/// The folder: what [`MODELS_VARIABLE`] names, else `models` beside the folder of the shipped models.
pub fn models_folder(assets: &Path) -> PathBuf {
    match std::env::var_os(MODELS_VARIABLE) {
        Some(folder) => folder.into(),
        None => assets.with_file_name("models"),
    }
}

/// A file of the folder.
pub fn model_file(assets: &Path, file: &str) -> PathBuf {
    models_folder(assets).join(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn models_lie_beside_the_shipped_ones() {
        // The variable is the user's; without it the folder is a neighbour.
        if std::env::var_os(MODELS_VARIABLE).is_none() {
            assert_eq!(models_folder(Path::new("/a/assets")), Path::new("/a/models"));
        }
    }
}
