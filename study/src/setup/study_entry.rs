//! The first page's entries: which study, who takes part, on which monitor.

use std::path::{Path, PathBuf};

use jiff::Timestamp;
use scumble_psychophysics::{Error, Language, Order, Protocol, SessionHeader};

use crate::session_folder::Found;
use crate::software::software;

use super::consent::{ConsentProblem, ConsentText};
use super::effort::Effort;
use super::luminance::LuminanceTable;
use super::problem::Problem;
use super::study_folder::{DEFAULT_PROTOCOL, FolderProblem, StudyFolder};

/// The protocols that a new study can be given on the page, the default first.
pub(crate) const OFFERED_PROTOCOLS: [&str; 3] = [DEFAULT_PROTOCOL, "yes-no", "published"];

/// Says what the folder of a study holds under a participant's code: [`crate::session_folder::find`].
pub(crate) type FindSession = Box<dyn Fn(&Path, &str) -> Result<Found, Error>>;

/// A folder of a study with all that the set-up reads from it.
#[derive(Debug)]
pub(crate) struct Opened {
    pub(crate) study: StudyFolder,
    pub(crate) effort: Option<Effort>,
    pub(super) consent: Result<Option<ConsentText>, ConsentProblem>,
    pub(super) luminance: Result<Option<LuminanceTable>, String>,
}

/// The entries, and what the disk says to them.
pub(crate) struct StudyEntry {
    folder: String,
    /// From the command line; not to be changed on the page.
    asked_protocol: Option<String>,
    chosen_protocol: &'static str,
    participant: String,
    /// Number of the participant as it was typed; empty for the one that goes with the code.
    number: String,
    /// A participant of this study whose session was discarded on this page, and their number there.
    discarded: Option<(String, u32)>,
    opened: Option<Result<Opened, FolderProblem>>,
    /// The last protocol and what it asks for: simulated people need a moment, too long for every letter.
    effort: Option<(Protocol, Option<Effort>)>,
    /// `None` while there is no study or no code.
    found: Option<Result<Found, Error>>,
    find: FindSession,
}

impl StudyEntry {
    pub(super) fn new(
        folder: String,
        asked_protocol: Option<String>,
        participant: String,
        number: Option<u32>,
        find: FindSession,
    ) -> Self {
        let number = number.map_or_else(String::new, |number| number.to_string());
        let chosen_protocol = DEFAULT_PROTOCOL;
        let (discarded, opened, effort, found) = (None, None, None, None);
        Self { folder, asked_protocol, chosen_protocol, participant, number, discarded, opened, effort, found, find }
    }

    /// The folder as it was typed.
    pub(crate) fn folder(&self) -> &str {
        &self.folder
    }

    /// The whole path of the study, where only a part of it was typed.
    pub(crate) fn whole_path(&self) -> Option<String> {
        let whole = self.opened()?.study.directory().display().to_string();
        (whole != self.folder.trim()).then_some(whole)
    }

    /// The participant's code as it was typed.
    pub(crate) fn participant(&self) -> &str {
        &self.participant
    }

    /// The participant's number as it was typed.
    pub(crate) fn number(&self) -> &str {
        &self.number
    }

    /// The study, where the folder can be one.
    pub(crate) fn opened(&self) -> Option<&Opened> {
        self.opened.as_ref()?.as_ref().ok()
    }

    /// What lies under the participant's code, where that can be read.
    pub(crate) fn found(&self) -> Option<&Found> {
        self.found.as_ref()?.as_ref().ok()
    }

    /// Whether a protocol can still be chosen: for a new study, where the command line names none.
    pub(crate) fn offers_protocols(&self) -> bool {
        self.asked_protocol.is_none() && self.opened().is_some_and(|opened| opened.study.is_new())
    }

    /// The protocol that the command line asks for.
    pub(crate) fn asked_protocol(&self) -> Option<&str> {
        self.asked_protocol.as_deref()
    }

    /// The protocol chosen for a new study.
    pub(crate) fn chosen_protocol(&self) -> &'static str {
        self.chosen_protocol
    }

    /// Whether the participant's number decides anything.
    pub(crate) fn number_matters(&self) -> bool {
        self.opened().is_some_and(|opened| opened.study.protocol().schedule.order == Order::LatinSquare)
    }

    /// The number that goes with the code: that of the session that was discarded under it, else the one that it ends
    /// with, 0 without one; `None` while there is no study.
    pub(crate) fn number_of_code(&self) -> Option<u32> {
        let opened = self.opened()?;
        if let Some((_, number)) = self.discarded.as_ref().filter(|(code, _)| *code == self.participant) {
            return Some(*number);
        }
        Some(header_of(&self.participant, opened.study.protocol()).participant_number)
    }

    /// The number typed, else the one that goes with the code; `None` for what is no number.
    pub(super) fn participant_number(&self) -> Option<u32> {
        match self.number.trim() {
            "" => self.number_of_code(),
            typed => typed.parse().ok(),
        }
    }

    pub(super) fn set_folder(&mut self, folder: String, language: Language) {
        self.folder = folder;
        self.discarded = None;
        self.look(language);
    }

    pub(super) fn set_participant(&mut self, code: String) {
        self.participant = code;
        self.look_for_session();
    }

    pub(super) fn set_number(&mut self, number: String) {
        self.number = number;
    }

    pub(super) fn choose_protocol(&mut self, name: &'static str, language: Language) {
        self.chosen_protocol = name;
        self.look(language);
    }

    /// The session under this code was discarded; the one that takes its place has its number.
    pub(super) fn take_over(&mut self, number: u32) {
        self.discarded = Some((self.participant.clone(), number));
    }

    /// Reads everything anew from the disk.
    pub(super) fn look(&mut self, language: Language) {
        let folder = path_of(&self.folder);
        self.opened = (!self.folder.trim().is_empty()).then(|| self.open(&folder, language));
        self.look_for_session();
    }

    /// [`StudyEntry::look`], and whether a session could be written.
    pub(super) fn look_closely(&mut self, language: Language) {
        self.look(language);
        if let Some(Err(problem)) = self.opened().map(|opened| opened.study.probe()) {
            self.opened = Some(Err(problem));
        }
    }

    fn open(&mut self, folder: &Path, language: Language) -> Result<Opened, FolderProblem> {
        let mut study = StudyFolder::open(folder, self.asked_protocol.as_deref())?;
        if self.asked_protocol.is_none() && study.is_new() {
            study = StudyFolder::open(folder, Some(self.chosen_protocol))?;
        }
        let effort = self.effort_of(study.protocol());
        let consent = ConsentText::read(folder, language);
        let luminance = LuminanceTable::read(folder);
        Ok(Opened { study, effort, consent, luminance })
    }

    fn effort_of(&mut self, protocol: &Protocol) -> Option<Effort> {
        match &self.effort {
            Some((known, effort)) if known == protocol => *effort,
            _ => self.effort.insert((protocol.clone(), Effort::of(protocol))).1,
        }
    }

    fn look_for_session(&mut self) {
        let opened = self.opened().filter(|opened| is_code(&self.participant, opened.study.protocol()));
        self.found = opened.map(|opened| (self.find)(opened.study.directory(), &self.participant));
    }

    /// What keeps these entries from being a session's.
    pub(super) fn problem(&self) -> Option<Problem<'_>> {
        let opened = match &self.opened {
            None => return Some(Problem::NoFolder),
            Some(Err(problem)) => return Some(Problem::Folder(problem)),
            Some(Ok(opened)) => opened,
        };
        if let Err(problem) = &opened.consent {
            return Some(Problem::Consent(problem));
        }
        if let Err(problem) = &opened.luminance {
            return Some(Problem::Luminance(problem));
        }
        if self.participant.is_empty() {
            return Some(Problem::NoCode);
        }
        if !is_code(&self.participant, opened.study.protocol()) {
            return Some(Problem::NotACode(&self.participant));
        }
        if self.participant_number().is_none() {
            return Some(Problem::NotANumber(&self.number));
        }
        match self.found.as_ref()? {
            Ok(Found::Free(_)) => None,
            Ok(found) => Some(Problem::Session(found)),
            Err(error) => Some(Problem::Damaged(error)),
        }
    }
}

/// The whole of the path that was typed; `~` is the user's own folder, as in a shell.
fn path_of(typed: &str) -> PathBuf {
    let typed = typed.trim();
    let path = match (typed.strip_prefix('~'), dirs::home_dir()) {
        (Some(""), Some(home)) => home,
        (Some(rest), Some(home)) if rest.starts_with(std::path::is_separator) => home.join(&rest[1..]),
        _ => PathBuf::from(typed),
    };
    std::path::absolute(&path).unwrap_or(path)
}

/// Whether a session header takes this code.
fn is_code(code: &str, protocol: &Protocol) -> bool {
    let checked = header_of(code, protocol).check();
    !matches!(checked, Err(Error::Parameter { field, .. }) if field == "participant")
}

fn header_of(code: &str, protocol: &Protocol) -> SessionHeader {
    SessionHeader::new(code, protocol.clone(), 0, Timestamp::UNIX_EPOCH, software())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_may_begin_with_the_users_own_folder_or_where_the_program_was_started() {
        let home = dirs::home_dir().unwrap();
        assert_eq!(path_of(" ~/studies/one "), home.join("studies/one"));
        assert_eq!(path_of("~"), home);
        let here = std::env::current_dir().unwrap();
        assert_eq!(path_of("~other/one"), here.join("~other/one"));
        assert_eq!(path_of("one two"), here.join("one two"));
    }
}
