//! The text of a file that people edit: bytes to text and to lines, and errors that name both.

use std::path::Path;

use crate::error::Error;

/// A file's text and its path, which is for messages.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Text<'a> {
    path: &'a Path,
    pub(crate) text: &'a str,
}

impl<'a> Text<'a> {
    /// The text of `bytes`, which must be UTF-8.
    pub(crate) fn new(path: &'a Path, bytes: &'a [u8]) -> Result<Self, Error> {
        match std::str::from_utf8(bytes) {
            Ok(text) => Ok(Self { path, text }),
            Err(error) => {
                let line = line_of(bytes, error.valid_up_to());
                Err(damaged(
                    path,
                    line,
                    "bytes that are not UTF-8",
                    "text in UTF-8, as the program or an editor writes it",
                ))
            }
        }
    }

    /// Refuses what editors and converters put into a file that a program wrote.
    pub(crate) fn refuse_conversions(self) -> Result<Self, Error> {
        if self.text.starts_with('\u{feff}') {
            return Err(self.damaged(
                0,
                "a byte order mark before the text",
                "the text alone: save it as UTF-8 without one",
            ));
        }
        if let Some(place) = self.text.find('\r') {
            let allowed = "line feeds alone: undo the conversion of line ends";
            return Err(self.damaged(place, "a carriage return", allowed));
        }
        Ok(self)
    }

    /// The error for what stands at a byte.
    pub(crate) fn damaged(&self, place: usize, found: impl Into<String>, allowed: impl Into<String>) -> Error {
        damaged(self.path, line_of(self.text.as_bytes(), place), found, allowed)
    }
}

/// The error for what stands in a line.
pub(crate) fn damaged(path: &Path, line: usize, found: impl Into<String>, allowed: impl Into<String>) -> Error {
    Error::Damaged { path: path.into(), line, found: found.into(), allowed: allowed.into() }
}

/// The line, from 1, of a byte.
fn line_of(bytes: &[u8], place: usize) -> usize {
    1 + bytes[..place.min(bytes.len())].iter().filter(|byte| **byte == b'\n').count()
}
