//! A session that the disk has refused goes on: what is on disk is made equal to what the program knows.
//!
//! The program keeps header and events in memory, so a folder that vanished, a file that was cut off and a
//! header that was half written lose nothing. What is on disk and is not the beginning of the session belongs
//! to somebody else: it is named, and stays as it is.

use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::path::Path;

use crate::complaint::quoted;
use crate::error::Error;
use crate::event::Event;
use crate::header::SessionHeader;
use crate::record::{EVENTS_FILE, HEADER_FILE, SessionWriter, json_of, make_directory, sync_directory};
use crate::text::damaged;

impl SessionWriter {
    /// Makes the disk hold the whole of a session again after [`SessionWriter::append`] or
    /// [`SessionWriter::create`] has failed, and goes on with it; the writer that failed must be dropped before.
    ///
    /// Where the session's files are, they must be its beginning: a tail that was cut off is dropped, and what is
    /// missing is written behind it. A file that is gone is made anew. After an error it may be called again.
    ///
    /// Errors: the first line that is not this session's, whose files stay as they are; the system's.
    pub fn recover(directory: &Path, header: &SessionHeader, events: &[Event]) -> Result<Self, Error> {
        header.check()?;
        make_directory(directory)?;
        let (header_path, path) = (directory.join(HEADER_FILE), directory.join(EVENTS_FILE));
        let json = json_of(&header_path, header)?;
        let missing = missing_of_header(&header_path, header, &json)?;

        let (mut writer, found) = Self::reopen_beginning(directory, &json, |found| {
            let differs = |(index, event): &(usize, &Event)| events.get(*index) != Some(*event);
            match found.events.iter().enumerate().find(differs) {
                Some((index, event)) => {
                    Err(damaged(&path, index + 1, text_of(Some(event)), text_of(events.get(index))))
                }
                None => Ok(()),
            }
        })?;
        if !missing.is_empty() {
            // What is there is right, so only what is missing is written: no moment has less on disk than before.
            let file = OpenOptions::new().create(true).append(true).open(&header_path);
            file.and_then(|mut file| file.write_all(missing).and_then(|()| file.sync_all()))
                .map_err(Error::io(&header_path))?;
        }
        sync_directory(directory)?;
        events[found.events.len()..].iter().try_for_each(|event| writer.append(event))?;
        Ok(writer)
    }
}

/// What the header's file lacks of its bytes: all where it is gone, the end where it was cut off, else nothing.
/// Errors: another header.
fn missing_of_header<'a>(path: &Path, header: &SessionHeader, json: &'a [u8]) -> Result<&'a [u8], Error> {
    let found = match std::fs::read(path) {
        Ok(found) => found,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(json),
        Err(error) => return Err(Error::io(path)(error)),
    };
    if let Some(missing) = json.strip_prefix(found.as_slice()) {
        return Ok(missing);
    }
    // An older version of the program may have written the same header with other spaces.
    if SessionHeader::parse(path, &found).is_ok_and(|found| found == *header) {
        return Ok(&[]);
    }
    let (line, found, allowed) = first_difference(&String::from_utf8_lossy(&found), &String::from_utf8_lossy(json));
    Err(damaged(path, line, found, format!("{allowed}, as this session has it")))
}

/// The first line that differs, from 1, and what both have there.
fn first_difference(found: &str, allowed: &str) -> (usize, String, String) {
    let same = found.lines().zip(allowed.lines()).take_while(|(found, allowed)| found == allowed).count();
    let at = |text: &str| text.lines().nth(same).map_or("nothing".to_owned(), |line| quoted(line.trim()));
    (same + 1, at(found), at(allowed))
}

/// An event in messages.
fn text_of(event: Option<&Event>) -> String {
    match event {
        Some(event) => quoted(&serde_json::to_string(event).unwrap_or_else(|_| format!("{event:?}"))),
        None => "nothing, as this session has no further event".to_owned(),
    }
}
