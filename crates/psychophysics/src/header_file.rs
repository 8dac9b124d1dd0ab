//! Reading `session.json`; an error names the line.

use std::path::Path;

use serde::Deserialize;

use crate::complaint::{Complaint, quoted};
use crate::error::Error;
use crate::header::{READABLE_SCHEMAS, SESSION_SCHEMA, SessionHeader};
use crate::read::parse_json;
use crate::text::Text;

/// The one key that every version has.
#[derive(Deserialize)]
struct Version {
    schema: String,
}

impl SessionHeader {
    /// The header of a file's bytes, checked; `path` is for messages.
    pub(crate) fn parse(path: &Path, bytes: &[u8]) -> Result<Self, Error> {
        let file = Text::new(path, bytes)?.refuse_conversions()?;
        // The version comes first: the keys of another one are not wrong, they are another version's.
        let version = parse_json::<Version>(file.text, "");
        if let Some(schema) =
            version.ok().map(|version| version.schema).filter(|schema| !READABLE_SCHEMAS.contains(&schema.as_str()))
        {
            let allowed =
                format!("{SESSION_SCHEMA}; another version of the program recorded this session, and reads it");
            let found = format!("schema is {}", quoted(&schema));
            return Err(file.damaged(place_of(file.text, "schema"), found, allowed));
        }
        let header: Self = parse_json(file.text, "the JSON of a session header, as the program wrote it")
            .map_err(|(place, Complaint { found, allowed })| file.damaged(place, found, allowed))?;
        header.check().map_err(|error| match error {
            Error::Parameter { field, value, allowed } => {
                file.damaged(place_of(file.text, &field), format!("{field} is {value}"), allowed)
            }
            other => other,
        })?;
        Ok(header)
    }
}

/// The byte at which a dotted key stands: its parts are looked for one behind the other, which finds the
/// key where a file is indented as the program does. 0 for a key that is not there.
fn place_of(json: &str, key: &str) -> usize {
    let mut place = 0;
    for part in key.split(['.', '[']).filter(|part| !part.ends_with(']')) {
        let Some(offset) = json[place..].find(&format!("\"{part}\":")) else { break };
        place += offset;
    }
    place
}
