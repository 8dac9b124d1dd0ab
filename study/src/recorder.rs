//! The session on disk, and what waits in memory while the disk takes nothing.
//!
//! Every event is kept in memory as well. When the disk refuses one (full, gone, read-only), the recorder
//! says so and keeps it; [`Recorder::retry`] then makes the folder hold the whole session again, in its
//! old place.

use std::path::{Path, PathBuf};

use scumble_psychophysics::{EVENTS_FILE, Error, Event, HEADER_FILE, Session, SessionHeader, SessionWriter};

/// A session that is planned or being written.
pub(crate) struct Recorder {
    directory: PathBuf,
    header: SessionHeader,
    /// In order; those from `saved` on wait for the disk.
    events: Vec<Event>,
    saved: usize,
    has_begun: bool,
    /// `None` before the session begins and after an error.
    writer: Option<SessionWriter>,
    problem: Option<String>,
}

impl Recorder {
    /// A fresh session; refuses a directory that holds one.
    pub(crate) fn plan(directory: &Path, header: SessionHeader) -> anyhow::Result<Self> {
        let exists = [HEADER_FILE, EVENTS_FILE].iter().any(|file| directory.join(file).exists());
        anyhow::ensure!(
            !exists,
            "{} holds a session already; --resume continues it, another --participant begins one",
            directory.display()
        );
        // A folder that cannot be made is found here, and not in front of the participant.
        if let Some(study) = directory.parent().filter(|study| !study.as_os_str().is_empty()) {
            std::fs::create_dir_all(study).map_err(|error| {
                anyhow::anyhow!("{}: cannot be the study's folder: {error}; allowed is a folder", study.display())
            })?;
        }
        Ok(Self::new(directory, header, Vec::new(), None))
    }

    /// An interrupted session, and what it holds.
    pub(crate) fn reopen(directory: &Path) -> anyhow::Result<(Self, Session)> {
        let (writer, session) = SessionWriter::reopen(directory)?;
        let recorder = Self::new(directory, session.header.clone(), session.events.clone(), Some(writer));
        Ok((recorder, session))
    }

    fn new(directory: &Path, header: SessionHeader, events: Vec<Event>, writer: Option<SessionWriter>) -> Self {
        let (saved, has_begun) = (events.len(), writer.is_some());
        Self { directory: directory.into(), header, events, saved, has_begun, writer, problem: None }
    }

    /// Writes the header, as it is now, when the participant begins; nothing happens if it is on disk.
    pub(crate) fn begin(&mut self, complete: impl FnOnce(&mut SessionHeader)) {
        if !self.has_begun {
            complete(&mut self.header);
            self.has_begun = true;
            match SessionWriter::create(&self.directory, &self.header) {
                Ok(writer) => self.writer = Some(writer),
                Err(error) => self.fail(&error),
            }
        }
    }

    /// Puts an event on disk, or keeps it until [`Recorder::retry`] succeeds. Before the participant has begun
    /// there is nothing to put it in, and after the end nothing may follow.
    pub(crate) fn append(&mut self, event: Event) {
        if !self.has_begun || self.is_closed() {
            return;
        }
        self.events.push(event);
        if let Some(writer) = &mut self.writer {
            match writer.append(&self.events[self.saved]) {
                Ok(()) => self.saved += 1,
                Err(error) => self.fail(&error),
            }
        }
    }

    /// Tries again to write what waits.
    pub(crate) fn retry(&mut self) {
        if self.problem.is_none() {
            return;
        }
        match SessionWriter::recover(&self.directory, &self.header, &self.events) {
            Ok(writer) => {
                self.writer = Some(writer);
                self.saved = self.events.len();
                self.problem = None;
            }
            Err(error) => self.fail(&error),
        }
    }

    /// Why events wait; `None` while everything is on disk.
    pub(crate) fn problem(&self) -> Option<&str> {
        self.problem.as_deref()
    }

    /// Events that are in memory alone.
    pub(crate) fn unsaved(&self) -> &[Event] {
        &self.events[self.saved..]
    }

    /// Every event, on disk or waiting for it.
    pub(crate) fn events(&self) -> &[Event] {
        &self.events
    }

    /// What stands, or will stand, above the events.
    pub(crate) fn header(&self) -> &SessionHeader {
        &self.header
    }

    /// Whether the last event has been given.
    pub(crate) fn is_closed(&self) -> bool {
        matches!(self.events.last(), Some(Event::End(_) | Event::Stop(_) | Event::Discard(_)))
    }

    /// Whether the participant has begun.
    pub(crate) fn has_begun(&self) -> bool {
        self.has_begun
    }

    /// Where the session lies.
    pub(crate) fn directory(&self) -> &Path {
        &self.directory
    }

    /// The writer is of no use after an error: where its file stands is not known. Dropping it frees the lock.
    fn fail(&mut self, error: &Error) {
        self.writer = None;
        self.problem = Some(error.to_string());
    }
}
