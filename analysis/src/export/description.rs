//! What the dataset is: `dataset_description.json` and `README.md`.

use serde::Serialize;

/// The version of the specification that the layout follows.
const BIDS_VERSION: &str = "1.10.0";

/// The text for whoever opens the dataset.
pub(super) const README: &str = include_str!("readme.md");

/// `dataset_description.json`, with BIDS' keys. Authors and licence are the owner's to name.
#[derive(Serialize)]
#[serde(rename_all = "PascalCase")]
pub(super) struct Description {
    name: &'static str,
    #[serde(rename = "BIDSVersion")]
    bids_version: &'static str,
    dataset_type: &'static str,
    generated_by: [Program; 1],
}

#[derive(Serialize)]
#[serde(rename_all = "PascalCase")]
struct Program {
    name: &'static str,
    version: &'static str,
    description: &'static str,
}

impl Description {
    /// That of a dataset written by this program.
    pub(super) fn new() -> Self {
        let program = Program {
            name: env!("CARGO_PKG_NAME"),
            version: env!("CARGO_PKG_VERSION"),
            description: "from the sessions in sourcedata, command export",
        };
        Self {
            name: "How large a filter hides the steps of a shadow",
            bids_version: BIDS_VERSION,
            dataset_type: "raw",
            generated_by: [program],
        }
    }
}
