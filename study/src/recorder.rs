//! The session on disk, from the decision where it goes to its last event.

use std::path::{Path, PathBuf};

use jiff::Timestamp;
use scumble_psychophysics::{
    Display, EVENTS_FILE, Error, Event, Experiment, HEADER_FILE, Moment, SessionHeader, SessionWriter,
};

/// A session that is planned or being written.
pub(crate) struct Recorder {
    directory: PathBuf,
    state: State,
    /// Physical pixels per degree of visual angle, which no system knows.
    px_per_degree: Option<f64>,
}

enum State {
    /// Nothing is on disk: the display is not known yet, or nobody has begun.
    Planned(Box<SessionHeader>),
    Open(SessionWriter),
    Complete,
}

impl Recorder {
    /// A fresh session; refuses a directory that holds one.
    pub(crate) fn plan(directory: &Path, header: SessionHeader, px_per_degree: Option<f64>) -> anyhow::Result<Self> {
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
        let state = State::Planned(Box::new(header));
        Ok(Self { directory: directory.into(), state, px_per_degree })
    }

    /// An interrupted session, the experiment as it stood, and what the reader noticed.
    pub(crate) fn reopen(directory: &Path) -> anyhow::Result<(Self, Experiment, Vec<String>)> {
        let (writer, session) = SessionWriter::reopen(directory)?;
        anyhow::ensure!(!session.is_complete(), "{}: the session is complete", directory.display());
        let experiment = session.replay()?;
        let state = State::Open(writer);
        let recorder = Self { directory: directory.into(), state, px_per_degree: None };
        Ok((recorder, experiment, session.notices))
    }

    /// Writes the header when the participant begins; nothing happens if it is on disk.
    pub(crate) fn begin(&mut self, display: Option<Display>) -> Result<(), Error> {
        if let State::Planned(header) = &mut self.state {
            let px_per_degree = self.px_per_degree;
            header.display = display.map(|display| Display { px_per_degree, ..display });
            self.state = State::Open(SessionWriter::create(&self.directory, header)?);
        }
        Ok(())
    }

    /// Puts an event on disk. Before the participant has begun there is nothing to put it in, and
    /// after the end nothing may follow.
    pub(crate) fn append(&mut self, event: &Event) -> Result<(), Error> {
        if let State::Open(writer) = &mut self.state {
            writer.append(event)?;
            if matches!(event, Event::End(_)) {
                self.state = State::Complete;
            }
        }
        Ok(())
    }

    /// Whether the last event is on disk.
    pub(crate) fn is_complete(&self) -> bool {
        matches!(self.state, State::Complete)
    }

    /// Where the session lies.
    pub(crate) fn directory(&self) -> &Path {
        &self.directory
    }
}

/// This moment, with what is worth knowing about it.
pub(crate) fn moment(notes: Vec<String>) -> Moment {
    Moment { at: Timestamp::now(), notes }
}
