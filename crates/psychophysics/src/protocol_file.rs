//! Protocols by name and from TOML files; an error names the file, the line and what is allowed.

use std::path::Path;

use toml::de::{DeTable, DeValue};

use crate::complaint::Complaint;
use crate::error::Error;
use crate::protocol::Protocol;
use crate::text::Text;

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
        shipped_text(name).map(shipped)
    }

    /// The protocol of a name on the command line: a shipped one, or a file that ends in `.toml`.
    pub fn open(name: &str) -> Result<Self, Error> {
        Self::open_with_text(name).map(|(protocol, _)| protocol)
    }

    /// [`Protocol::open`] with the bytes that were read, comments and all, for who keeps a copy.
    pub fn open_with_text(name: &str) -> Result<(Self, Vec<u8>), Error> {
        if !name.ends_with(".toml") {
            let text = shipped_text(name)?;
            return Ok((shipped(text), text.into()));
        }
        let path = Path::new(name);
        let bytes = std::fs::read(path).map_err(Error::io(path))?;
        Ok((Self::from_toml(path, &bytes)?, bytes))
    }

    /// The protocol of a file's text, checked; `path` is for messages.
    ///
    /// Errors name the line of what is no TOML, no key of a protocol, of another type or out of its range.
    pub fn from_toml(path: &Path, text: impl AsRef<[u8]>) -> Result<Self, Error> {
        let file = Text::new(path, text.as_ref())?;
        let complain = |key: &str, error: &toml::de::Error| {
            let allowed = "the TOML of a protocol, as `published`, `two-alternative` and `yes-no` are written";
            let Complaint { found, allowed } = Complaint::new(key, error.message(), allowed);
            let place = error.span().map_or_else(|| place_of(file.text, key), |span| span.start);
            file.damaged(place, found, allowed)
        };
        let deserializer = toml::Deserializer::parse(file.text).map_err(|error| complain(".", &error))?;
        let protocol: Self = serde_path_to_error::deserialize(deserializer)
            .map_err(|error| complain(&error.path().to_string(), error.inner()))?;
        match protocol.check() {
            Err(Error::Parameter { field, value, allowed }) => {
                Err(file.damaged(place_of(file.text, &field), format!("{field} is {value}"), allowed))
            }
            checked => checked.map(|()| protocol),
        }
    }

    /// The protocol as the text of a file.
    pub fn to_toml(&self) -> Result<String, Error> {
        toml::to_string_pretty(self).map_err(|error| Error::parameter("protocol", error, "what TOML can hold"))
    }
}

/// The file of the shipped protocol of a name; the error lists the names.
fn shipped_text(name: &str) -> Result<&'static str, Error> {
    let found = SHIPPED.iter().find(|(known, _)| *known == name);
    let allowed = "published, two-alternative, yes-no, or a file that ends in .toml";
    found.map(|(_, text)| *text).ok_or_else(|| Error::parameter("protocol", name, allowed))
}

/// A protocol of this crate; tests read every one.
fn shipped(text: &str) -> Protocol {
    match Protocol::from_toml(Path::new("shipped protocol"), text) {
        Ok(protocol) => protocol,
        Err(error) => panic!("{error}"),
    }
}

/// The byte at which the value of a key stands, `table.list[1]`; of a key that is not there, the byte at
/// which the innermost table around it begins.
fn place_of(text: &str, key: &str) -> usize {
    let Ok(document) = DeTable::parse(text) else { return 0 };
    let mut value = &DeValue::Table(document.into_inner());
    let mut place = 0;
    for part in key.split(['.', '[', ']']).filter(|part| !part.is_empty()) {
        let next = match value {
            DeValue::Table(table) => table.get(part),
            DeValue::Array(list) => part.parse().ok().and_then(|index: usize| list.get(index)),
            _ => None,
        };
        let Some(next) = next else { break };
        place = next.span().start;
        value = next.get_ref();
    }
    place
}
