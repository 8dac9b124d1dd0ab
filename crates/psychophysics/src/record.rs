//! Writing a session: a directory with `session.json` and `events.jsonl`.
//!
//! Each event is one line, written whole and synchronised to the disk before `append` returns, so
//! that no answer is lost once the next picture is shown. Nothing is overwritten: `create` refuses a
//! directory that holds a session. One program writes a session at a time (a lock on the file).

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::event::Event;
use crate::header::SessionHeader;
use crate::read::{Session, read};

/// Name of the header's file.
pub const HEADER_FILE: &str = "session.json";
/// Name of the events' file.
pub const EVENTS_FILE: &str = "events.jsonl";

/// A session that is being written.
#[derive(Debug)]
pub struct SessionWriter {
    path: PathBuf,
    file: File,
    /// Bytes of whole lines on disk.
    length_bytes: u64,
}

impl SessionWriter {
    /// Makes `directory` where it does not exist and writes the header.
    ///
    /// Errors: a directory that holds a session, a header that is out of range, the system's.
    pub fn create(directory: &Path, header: &SessionHeader) -> Result<Self, Error> {
        header.check()?;
        std::fs::create_dir_all(directory).map_err(Error::io(directory))?;
        let header_path = directory.join(HEADER_FILE);
        let path = directory.join(EVENTS_FILE);
        if header_path.exists() || path.exists() {
            return Err(Error::SessionExists(directory.into()));
        }

        let mut header_file = create_new(directory, &header_path)?;
        let json = json_of(&header_path, header)?;
        header_file.write_all(&json).and_then(|()| header_file.sync_all()).map_err(Error::io(&header_path))?;

        let file = create_new(directory, &path)?;
        file.sync_all().map_err(Error::io(&path))?;
        sync_directory(directory)?;
        Self::lock(directory, path, file)
    }

    /// Opens an interrupted session to go on with it, and gives what it holds.
    ///
    /// The session is replayed first, so that only a record that the seed leads to is continued. A
    /// last line that was cut off is removed from the file, so that nothing is ever glued to it;
    /// the notice quotes it.
    pub fn reopen(directory: &Path) -> Result<(Self, Session), Error> {
        let path = directory.join(EVENTS_FILE);
        let file = OpenOptions::new().read(true).write(true).open(&path).map_err(Error::io(&path))?;
        let mut writer = Self::lock(directory, path, file)?;
        // Read through the locked handle: on some systems the lock keeps every other one out.
        let mut bytes = Vec::new();
        writer.file.read_to_end(&mut bytes).map_err(Error::io(&writer.path))?;
        let session = Session::parse(directory, &read(&directory.join(HEADER_FILE))?, &bytes)?;
        session.replay()?;
        writer.length_bytes = session.whole_lines_bytes();
        writer.drop_tail().map_err(Error::io(&writer.path))?;
        Ok((writer, session))
    }

    /// Makes the disk hold the whole of a session again after [`SessionWriter::append`] or
    /// [`SessionWriter::create`] has failed, and goes on with it.
    ///
    /// Where the session's files are, they must be its beginning: a tail that was cut off is dropped, and what is
    /// missing is written behind it. Where they are gone, or not whole enough to hold an event, they are made anew.
    ///
    /// Errors: files that are not this session's beginning, which stay as they are; the system's.
    pub fn recover(directory: &Path, header: &SessionHeader, events: &[Event]) -> Result<Self, Error> {
        let (header_path, path) = (directory.join(HEADER_FILE), directory.join(EVENTS_FILE));
        if is_empty_or_gone(&path) && holds_part_of(&header_path, &json_of(&header_path, header)?)? {
            for path in [&path, &header_path].into_iter().filter(|path| path.exists()) {
                std::fs::remove_file(path).map_err(Error::io(path))?;
            }
            let mut writer = Self::create(directory, header)?;
            events.iter().try_for_each(|event| writer.append(event))?;
            return Ok(writer);
        }
        let (mut writer, found) = Self::reopen(directory)?;
        let is_beginning = found.header == *header && events.starts_with(&found.events);
        if !is_beginning {
            return Err(Error::SessionExists(directory.into()));
        }
        events[found.events.len()..].iter().try_for_each(|event| writer.append(event))?;
        Ok(writer)
    }

    /// Writes one event and waits until the disk has it under the session's name. After an error the event is not
    /// in the record, as far as the system allows.
    pub fn append(&mut self, event: &Event) -> Result<(), Error> {
        let mut line = serde_json::to_vec(event).map_err(|error| Error::io(&self.path)(error.into()))?;
        line.push(b'\n');
        let length_bytes = self.length_bytes + line.len() as u64;
        let written = self.file.write_all(&line).and_then(|()| self.file.sync_data());
        if let Err(error) = written.and_then(|()| self.find_under_its_name(length_bytes)) {
            // The write's own error is the one to report; a tail that stays is dropped by a reader.
            let _ = self.drop_tail();
            return Err(Error::io(&self.path)(error));
        }
        self.length_bytes = length_bytes;
        Ok(())
    }

    /// A file that is written goes on to exist when its name is gone or another file's; then nobody finds it.
    fn find_under_its_name(&self, length_bytes: u64) -> std::io::Result<()> {
        match std::fs::metadata(&self.path)?.len() == length_bytes {
            true => Ok(()),
            false => Err(std::io::Error::other("another file has taken the place of the session's")),
        }
    }

    fn lock(directory: &Path, path: PathBuf, file: File) -> Result<Self, Error> {
        match file.try_lock() {
            Ok(()) => Ok(Self { path, file, length_bytes: 0 }),
            Err(TryLockError::WouldBlock) => Err(Error::SessionInUse(directory.into())),
            Err(TryLockError::Error(error)) => Err(Error::io(path)(error)),
        }
    }

    /// Cuts the file behind its whole lines and goes there.
    fn drop_tail(&mut self) -> std::io::Result<()> {
        self.file.set_len(self.length_bytes)?;
        self.file.seek(SeekFrom::Start(self.length_bytes))?;
        self.file.sync_data()
    }
}

/// The bytes of the header's file.
fn json_of(path: &Path, header: &SessionHeader) -> Result<Vec<u8>, Error> {
    let mut json = serde_json::to_vec_pretty(header).map_err(|error| Error::io(path)(error.into()))?;
    json.push(b'\n');
    Ok(json)
}

fn is_empty_or_gone(path: &Path) -> bool {
    std::fs::metadata(path).map_or_else(|error| error.kind() == ErrorKind::NotFound, |file| file.len() == 0)
}

/// Whether a file is gone, or was cut off while these bytes were written to it.
fn holds_part_of(path: &Path, bytes: &[u8]) -> Result<bool, Error> {
    match std::fs::read(path) {
        Ok(found) => Ok(bytes.starts_with(&found)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(true),
        Err(error) => Err(Error::io(path)(error)),
    }
}

fn create_new(directory: &Path, path: &Path) -> Result<File, Error> {
    OpenOptions::new().write(true).create_new(true).open(path).map_err(|error| match error.kind() {
        ErrorKind::AlreadyExists => Error::SessionExists(directory.into()),
        _ => Error::io(path)(error),
    })
}

/// Makes the names of new files durable, where directories can be synchronised.
fn sync_directory(directory: &Path) -> Result<(), Error> {
    if cfg!(unix) {
        File::open(directory).and_then(|directory| directory.sync_all()).map_err(Error::io(directory))?;
    }
    Ok(())
}
