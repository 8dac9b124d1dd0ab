//! `scenes`: what `--scene` knows by name, and what a scene lacks.

use scumble_scenes::{Entry, MODELS_VARIABLE, catalogue};

use crate::setup::assets;

/// Prints the catalogue.
pub fn list() {
    let assets = assets(None);
    for entry in catalogue() {
        println!("{:<12} {}", entry.name, entry.description);
        if let (Some(file), Some(model)) = (entry.missing(&assets), entry.model) {
            println!("{:<12} absent: needs {} ({})", "", file.display(), model.origin);
        }
    }
    println!("\n{MODELS_VARIABLE} names another folder for the models that are not shipped.");
}

/// The scenes whose models are there; the others are named on standard error.
pub fn available(assets: &std::path::Path) -> Vec<String> {
    let is_there = |entry: &&Entry| match entry.missing(assets) {
        None => true,
        Some(file) => {
            eprintln!("skipped: the scene {} needs {}; `scumble-viewer scenes` says more", entry.name, file.display());
            false
        }
    };
    catalogue().iter().filter(is_there).map(|entry| entry.name.to_owned()).collect()
}
