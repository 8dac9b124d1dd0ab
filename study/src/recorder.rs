//! The session on disk, and what waits in memory while the disk takes nothing.
//!
//! Every event is kept in memory as well. When the disk refuses one (full, gone, read-only), the recorder
//! says so and keeps it; [`Recorder::retry`] then makes the folder hold the whole session again, in its
//! old place.

use std::path::{Path, PathBuf};

use scumble_psychophysics::{Event, Session, SessionHeader, SessionWriter};

use crate::setup::StudyFolder;

/// A session that is planned or being written.
pub(crate) struct Recorder {
    directory: PathBuf,
    header: SessionHeader,
    /// The folder of a fresh session's study, which gets the protocol when the session begins.
    study: Option<StudyFolder>,
    /// In order; those from `saved` on wait for the disk.
    events: Vec<Event>,
    saved: usize,
    has_begun: bool,
    /// `None` before the session begins and after an error.
    writer: Option<SessionWriter>,
    problem: Option<String>,
}

impl Recorder {
    /// A fresh session of a study in a folder that holds none.
    pub(crate) fn plan(study: StudyFolder, directory: &Path, header: SessionHeader) -> anyhow::Result<Self> {
        // A folder that cannot be made is found here, and not in front of the participant.
        let folder = study.directory();
        std::fs::create_dir_all(folder).map_err(|error| {
            anyhow::anyhow!("{}: cannot be the study's folder: {error}; allowed is a folder", folder.display())
        })?;
        Ok(Self { study: Some(study), ..Self::new(directory, header, Vec::new(), None) })
    }

    /// An interrupted session, and what it holds.
    pub(crate) fn reopen(directory: &Path) -> anyhow::Result<(Self, Session)> {
        let (writer, session) = SessionWriter::reopen(directory)?;
        let recorder = Self::new(directory, session.header.clone(), session.events.clone(), Some(writer));
        Ok((recorder, session))
    }

    fn new(directory: &Path, header: SessionHeader, events: Vec<Event>, writer: Option<SessionWriter>) -> Self {
        let (saved, has_begun) = (events.len(), writer.is_some());
        let directory = directory.into();
        Self { directory, header, study: None, events, saved, has_begun, writer, problem: None }
    }

    /// Writes the header, as it is now, when the participant begins; nothing happens if it is on disk.
    pub(crate) fn begin(&mut self, complete: impl FnOnce(&mut SessionHeader)) {
        if !self.has_begun {
            complete(&mut self.header);
            self.has_begun = true;
            match self.keep_protocol().and_then(|()| Ok(SessionWriter::create(&self.directory, &self.header)?)) {
                Ok(writer) => self.writer = Some(writer),
                Err(error) => self.fail(error),
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
                Err(error) => self.fail(error.into()),
            }
        }
    }

    /// Tries again to write what waits.
    pub(crate) fn retry(&mut self) {
        if self.problem.is_none() {
            return;
        }
        let (header, events) = (&self.header, &self.events);
        match self.keep_protocol().and_then(|()| Ok(SessionWriter::recover(&self.directory, header, events)?)) {
            Ok(writer) => {
                self.writer = Some(writer);
                self.saved = self.events.len();
                self.problem = None;
            }
            Err(error) => self.fail(error),
        }
    }

    /// Writes the whole session, what waits included, into a folder of its own among the system's temporary files,
    /// and gives that folder: for the end of the program while the disk refuses events.
    pub(crate) fn rescue(&self) -> anyhow::Result<PathBuf> {
        let folder = format!("scumble-{}-{}", self.header.participant, self.header.seed);
        let directory = std::env::temp_dir().join(folder);
        SessionWriter::recover(&directory, &self.header, &self.events)?;
        Ok(directory)
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
        self.events.last().is_some_and(Event::is_last)
    }

    /// Whether the participant has begun.
    pub(crate) fn has_begun(&self) -> bool {
        self.has_begun
    }

    /// Where the session lies.
    pub(crate) fn directory(&self) -> &Path {
        &self.directory
    }

    fn keep_protocol(&self) -> anyhow::Result<()> {
        match &self.study {
            Some(study) => Ok(study.keep_protocol()?),
            None => Ok(()),
        }
    }

    /// The writer is of no use after an error: where its file stands is not known. Dropping it frees the lock.
    fn fail(&mut self, error: anyhow::Error) {
        self.writer = None;
        self.problem = Some(format!("{error:#}"));
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;
    use jiff::Timestamp;
    use scumble_psychophysics::{Moment, Protocol, Software, read_session};

    fn note(text: &str) -> Event {
        Event::Note(Moment { at: Timestamp::now(), notes: vec![text.into()], interrupted_secs: None })
    }

    fn begin(study: &Path) -> (PathBuf, Recorder) {
        let directory = study.join("p07");
        let protocol = Protocol::two_alternative();
        let header = SessionHeader::new("p07", protocol, 1, Timestamp::now(), Software::of("a test", "0"));
        let folder = StudyFolder::open(study, None).unwrap();
        let mut recorder = Recorder::plan(folder, &directory, header).unwrap();
        recorder.begin(|header| header.room = Some("dim".into()));
        recorder.append(note("one"));
        assert_eq!(recorder.problem(), None);
        (directory, recorder)
    }

    fn assert_holds_all(directory: &Path, recorder: &Recorder) {
        assert_eq!((recorder.problem(), recorder.unsaved()), (None, &[][..]));
        let session = read_session(directory).unwrap();
        assert_eq!(session.events, recorder.events());
        assert_eq!(session.header, *recorder.header());
    }

    #[test]
    fn a_folder_that_is_gone_and_back_gets_what_waited_for_it() {
        let study = tempfile::tempdir().unwrap();
        let (directory, mut recorder) = begin(study.path());
        let aside = study.path().join("aside");
        std::fs::rename(&directory, &aside).unwrap();
        recorder.append(note("two"));
        recorder.append(note("three"));
        assert!(recorder.problem().unwrap().contains("p07"), "{:?}", recorder.problem());
        assert_eq!(recorder.unsaved().len(), 2);
        std::fs::rename(&aside, &directory).unwrap();
        recorder.retry();
        assert_holds_all(&directory, &recorder);
        recorder.append(note("four"));
        assert_holds_all(&directory, &recorder);
    }

    #[test]
    fn a_folder_that_is_deleted_is_written_anew_with_all_that_it_held() {
        let study = tempfile::tempdir().unwrap();
        let (directory, mut recorder) = begin(study.path());
        std::fs::remove_dir_all(&directory).unwrap();
        recorder.append(note("two"));
        assert!(recorder.problem().is_some());
        recorder.retry();
        assert_holds_all(&directory, &recorder);
    }

    #[test]
    fn another_session_in_its_place_is_left_alone() {
        let study = tempfile::tempdir().unwrap();
        let (directory, mut recorder) = begin(study.path());
        std::fs::remove_dir_all(&directory).unwrap();
        let (_, other) = begin(study.path());
        let before = std::fs::read(directory.join(scumble_psychophysics::EVENTS_FILE)).unwrap();
        drop(other);
        recorder.append(note("two, which is longer than the other one"));
        for _ in 0..2 {
            assert!(recorder.problem().is_some());
            recorder.retry();
        }
        assert_eq!(std::fs::read(directory.join(scumble_psychophysics::EVENTS_FILE)).unwrap(), before);
        assert_eq!(recorder.unsaved().len(), 1);
    }
}
