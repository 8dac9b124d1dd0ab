//! Protocols by name and from TOML files; an error names the file, the line and what is allowed.

use std::path::Path;

use toml::de::{DeTable, DeValue};

use crate::error::Error;
use crate::protocol::Protocol;

/// The protocols that come with the crate: name and file.
const SHIPPED: [(&str, &str); 3] = [
    ("published", include_str!("../protocols/published.toml")),
    ("two-alternative", include_str!("../protocols/two-alternative.toml")),
    ("yes-no", include_str!("../protocols/yes-no.toml")),
];

impl Protocol {
    /// The default: two pictures, "which one was the line?".
    pub fn two_alternative() -> Self {
        shipped(SHIPPED[1].1)
    }

    /// The shipped protocol of a name; the error lists the names.
    pub fn named(name: &str) -> Result<Self, Error> {
        let found = SHIPPED.iter().find(|(known, _)| *known == name);
        let allowed = "published, two-alternative, yes-no, or a file that ends in .toml";
        found.map(|(_, text)| shipped(text)).ok_or_else(|| Error::parameter("protocol", name, allowed))
    }

    /// The protocol of a name on the command line: a shipped one, or a file that ends in `.toml`.
    pub fn open(name: &str) -> Result<Self, Error> {
        if !name.ends_with(".toml") {
            return Self::named(name);
        }
        let path = Path::new(name);
        let bytes = std::fs::read(path).map_err(Error::io(path))?;
        let text = String::from_utf8(bytes).map_err(|error| {
            let line = line_of(error.as_bytes(), error.utf8_error().valid_up_to());
            damaged(path, line, "bytes that are not UTF-8", "text in UTF-8")
        })?;
        Self::from_toml(path, &text)
    }

    /// The protocol of a file's text; `path` is for messages.
    pub fn from_toml(path: &Path, text: &str) -> Result<Self, Error> {
        let protocol: Self = toml::from_str(text).map_err(|error| {
            let line = line_of(text.as_bytes(), error.span().map_or(0, |span| span.start));
            damaged(
                path,
                line,
                error.message(),
                "the keys of the protocols that come with the program, each with its unit",
            )
        })?;
        match protocol.check() {
            Err(Error::Parameter { field, value, allowed }) => {
                let line = line_of(text.as_bytes(), place_of(text, &field));
                Err(damaged(path, line, format!("{field} is {value}"), allowed))
            }
            checked => checked.map(|()| protocol),
        }
    }

    /// The protocol as the text of a file.
    pub fn to_toml(&self) -> Result<String, Error> {
        toml::to_string_pretty(self).map_err(|error| Error::parameter("protocol", error, "what TOML can hold"))
    }
}

/// A protocol of this crate; tests read every one.
fn shipped(text: &str) -> Protocol {
    match Protocol::from_toml(Path::new("shipped protocol"), text) {
        Ok(protocol) => protocol,
        Err(error) => panic!("{error}"),
    }
}

fn damaged(path: &Path, line: usize, found: impl Into<String>, allowed: impl Into<String>) -> Error {
    Error::Damaged { path: path.into(), line, found: found.into(), allowed: allowed.into() }
}

/// The line, from 1, of a byte.
fn line_of(text: &[u8], byte: usize) -> usize {
    1 + text[..byte.min(text.len())].iter().filter(|byte| **byte == b'\n').count()
}

/// The byte at which the value of a dotted key stands; 0 for a key that the text does not hold.
fn place_of(text: &str, key: &str) -> usize {
    let Ok(document) = DeTable::parse(text) else { return 0 };
    let mut table = document.get_ref();
    let mut place = 0;
    for part in key.split('.') {
        let Some(value) = table.get(part) else { return place };
        place = value.span().start;
        let DeValue::Table(next) = value.get_ref() else { return place };
        table = next;
    }
    place
}
