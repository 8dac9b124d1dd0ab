//! Writing a session: a directory with `session.json` and `events.jsonl`.
//!
//! Each event is one line, written whole and synchronised to the disk before `append` returns, so
//! that no answer is lost once the next picture is shown. Nothing is overwritten: `create` refuses a
//! directory that holds a session. One program writes a session at a time (a lock on the file).
//!
//! The header comes first and is whole on disk before the events have a file. A program that ends in between
//! leaves a session without answers, which goes on as any other.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::event::Event;
use crate::header::SessionHeader;
use crate::read::{Session, no_events, read};

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
        make_directory(directory)?;
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
    /// the notice quotes it. Events without a file get one, if there is a header.
    pub fn reopen(directory: &Path) -> Result<(Self, Session), Error> {
        Self::reopen_beginning(directory, &read(&directory.join(HEADER_FILE))?, |_| Ok(()))
    }

    /// Reopens the events under a header's bytes, if `check` takes the session; it runs before the file is changed.
    pub(crate) fn reopen_beginning(
        directory: &Path,
        header: &[u8],
        check: impl FnOnce(&Session) -> Result<(), Error>,
    ) -> Result<(Self, Session), Error> {
        let path = directory.join(EVENTS_FILE);
        let was_there = path.try_exists().map_err(Error::io(&path))?;
        // Nothing is made beside a header that is not one.
        SessionHeader::parse(&directory.join(HEADER_FILE), header)?;
        let open = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&path);
        let file = open.map_err(Error::io(&path))?;
        let mut writer = Self::lock(directory, path, file)?;
        // Read through the locked handle: on some systems the lock keeps every other one out.
        let mut bytes = Vec::new();
        writer.file.read_to_end(&mut bytes).map_err(Error::io(&writer.path))?;
        let mut session = Session::parse(directory, header, &bytes)?;
        if !was_there {
            session.notices.push(no_events(&writer.path));
            sync_directory(directory)?;
        }
        session.replay()?;
        check(&session)?;
        writer.length_bytes = session.whole_lines_bytes();
        writer.drop_tail().map_err(Error::io(&writer.path))?;
        Ok((writer, session))
    }

    /// Writes one event and waits until the disk has it under the session's name.
    ///
    /// After an error the event is not in the record, as far as the system allows, and the writer is of no more
    /// use: [`SessionWriter::recover`] goes on with the session. Errors: the system's, and a file under the
    /// session's name that is not the one that was written, as its folder was moved or replaced.
    pub fn append(&mut self, event: &Event) -> Result<(), Error> {
        let mut line = serde_json::to_vec(event).map_err(|error| Error::io(&self.path)(error.into()))?;
        line.push(b'\n');
        let length_bytes = self.length_bytes + line.len() as u64;
        // A file that somebody has cut off would get a hole, so nothing is written to it.
        self.find_under_its_name(self.length_bytes)?;
        let written = self.file.write_all(&line).and_then(|()| self.file.sync_data()).map_err(Error::io(&self.path));
        if let Err(error) = written.and_then(|()| self.find_under_its_name(length_bytes)) {
            // The write's own error is the one to report; a tail that stays is dropped by a reader.
            let _ = self.drop_tail();
            return Err(error);
        }
        self.length_bytes = length_bytes;
        Ok(())
    }

    /// Refuses a length of the file under the session's name that is not that of what was written: a file that
    /// is written goes on to exist when its name is gone or another file's, and then nobody finds it.
    fn find_under_its_name(&self, length_bytes: u64) -> Result<(), Error> {
        let found_bytes = std::fs::metadata(&self.path).map_err(Error::io(&self.path))?.len();
        if found_bytes == length_bytes {
            return Ok(());
        }
        let reason = format!(
            "the file has {found_bytes} bytes, allowed is {length_bytes}: it was changed or replaced during the session"
        );
        Err(Error::io(&self.path)(std::io::Error::other(reason)))
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

/// Whether a program, this one or another, writes the session now.
pub fn is_being_written(directory: &Path) -> bool {
    let Ok(file) = File::open(directory.join(EVENTS_FILE)) else { return false };
    matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock))
}

/// The bytes of the header's file.
pub(crate) fn json_of(path: &Path, header: &SessionHeader) -> Result<Vec<u8>, Error> {
    let mut json = serde_json::to_vec_pretty(header).map_err(|error| Error::io(path)(error.into()))?;
    json.push(b'\n');
    Ok(json)
}

fn create_new(directory: &Path, path: &Path) -> Result<File, Error> {
    OpenOptions::new().write(true).create_new(true).open(path).map_err(|error| match error.kind() {
        ErrorKind::AlreadyExists => Error::SessionExists(directory.into()),
        _ => Error::io(path)(error),
    })
}

/// Makes a session's directory where it does not exist, so that it outlives a loss of power.
pub(crate) fn make_directory(directory: &Path) -> Result<(), Error> {
    std::fs::create_dir_all(directory).map_err(Error::io(directory))?;
    // The study's folder names the session and may be as new; a folder that is not to be read is not ours.
    for above in directory.ancestors().skip(1).take(2) {
        let _ = sync_directory(if above.as_os_str().is_empty() { Path::new(".") } else { above });
    }
    Ok(())
}

/// Makes the names of new files durable, where directories can be synchronised.
pub(crate) fn sync_directory(directory: &Path) -> Result<(), Error> {
    if cfg!(unix) {
        File::open(directory).and_then(|directory| directory.sync_all()).map_err(Error::io(directory))?;
    }
    Ok(())
}
