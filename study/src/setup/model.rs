//! The set-up as it stands: which page, what is entered, and what is wrong with it.

use std::path::Path;

use jiff::Timestamp;
use scumble_psychophysics::{Consent, Display, Language};

use super::about::About;
use super::calibration::Calibration;
use super::consent::ConsentText;
use super::gamma::GammaCheck;
use super::luminance::LuminanceTable;
use super::page::Page;
use super::problem::Problem;
use super::ready::{MeasuredDisplay, Ready};
use super::recent::RecentFolders;
use super::study_entry::{FindSession, StudyEntry};

/// What is known before the first page.
pub(crate) struct Given {
    /// Folder of the study; empty where the command line names none.
    pub(crate) folder: String,
    /// Protocol that the command line asks for.
    pub(crate) protocol: Option<String>,
    /// Participant's code; empty where the command line names none.
    pub(crate) participant: String,
    /// Participant's number from the command line.
    pub(crate) participant_number: Option<u32>,
    /// Language of the first page.
    pub(crate) language: Language,
    /// Monitors as the system names them, and the index of the one that the window is on.
    pub(crate) monitors: Vec<Display>,
    /// See [`Given::monitors`].
    pub(crate) monitor: usize,
    /// Pixels per degree from the command line.
    pub(crate) px_per_degree: Option<f64>,
    /// Folders that were open before.
    pub(crate) recent: RecentFolders,
    /// Says what lies under a participant's code.
    pub(crate) find: FindSession,
}

/// The set-up of one session.
pub(crate) struct Setup {
    page: Page,
    language: Language,
    monitors: Vec<Display>,
    monitor: usize,
    /// The one that the window is on, which need not be the chosen one; `None` where the system does not tell.
    found_on: Option<Display>,
    recent: Vec<std::path::PathBuf>,
    study: StudyEntry,
    /// Distance and pixel size.
    pub(crate) calibration: Calibration,
    /// The grey beside the rows.
    pub(crate) gamma: GammaCheck,
    /// Light in the room, as it was typed.
    pub(crate) room: String,
    agreed: Option<Consent>,
    /// The participant's answers about themselves.
    pub(crate) about: About,
}

impl Setup {
    /// The first page.
    pub(crate) fn new(given: Given) -> Self {
        let Given { folder, protocol, participant, participant_number, language, find, .. } = given;
        let mut study = StudyEntry::new(folder, protocol, participant, participant_number, find);
        study.look(language);
        Self {
            page: Page::Study,
            language,
            monitor: given.monitor.min(given.monitors.len().saturating_sub(1)),
            monitors: given.monitors,
            found_on: None,
            recent: given.recent.offered(),
            study,
            calibration: Calibration::new(given.px_per_degree),
            gamma: GammaCheck::default(),
            room: String::new(),
            agreed: None,
            about: About::default(),
        }
    }

    /// The page on show.
    pub(crate) fn page(&self) -> Page {
        self.page
    }

    /// Number of the page on show, from 1, and of all pages.
    pub(crate) fn progress(&self) -> (usize, usize) {
        let pages = self.pages();
        (self.place() + 1, pages.len())
    }

    /// Language of the pages and of the session.
    pub(crate) fn language(&self) -> Language {
        self.language
    }

    /// Entries of the first page.
    pub(crate) fn study(&self) -> &StudyEntry {
        &self.study
    }

    /// Folders that were open before and are there, newest first.
    pub(crate) fn recent(&self) -> &[std::path::PathBuf] {
        &self.recent
    }

    /// The monitors to choose from, and the index of the chosen one.
    pub(crate) fn monitors(&self) -> (&[Display], usize) {
        (&self.monitors, self.monitor)
    }

    /// The monitor that the window was found on.
    pub(crate) fn find_on(&mut self, monitor: Option<Display>) {
        self.found_on = monitor;
    }

    /// The monitor that the window is on, where that is not the chosen one.
    pub(crate) fn elsewhere(&self) -> Option<&Display> {
        let chosen = self.monitors.get(self.monitor)?;
        self.found_on.as_ref().filter(|found| *found != chosen)
    }

    /// The text to agree to; `None` where the study has none.
    pub(crate) fn consent_text(&self) -> Option<&ConsentText> {
        self.study.opened()?.consent.as_ref().ok()?.as_ref()
    }

    /// The table of the study's display; `None` where it was not measured.
    pub(crate) fn luminance(&self) -> Option<&LuminanceTable> {
        self.study.opened()?.luminance.as_ref().ok()?.as_ref()
    }

    /// Whether the participant has agreed to the text as it stands.
    pub(crate) fn has_agreed(&self) -> bool {
        let agreed = self.agreed.as_ref().map(|consent| &consent.text_sha256);
        agreed.is_some() && agreed == self.consent_text().map(|text| &text.sha256)
    }

    /// Another folder.
    pub(crate) fn set_folder(&mut self, folder: String) {
        self.study.set_folder(folder, self.language);
        self.forget_participant();
    }

    /// A folder that was dropped on the window or picked from a list.
    pub(crate) fn pick_folder(&mut self, folder: &Path) {
        self.set_folder(folder.display().to_string());
    }

    /// Another protocol for a new study.
    pub(crate) fn choose_protocol(&mut self, name: &'static str) {
        self.study.choose_protocol(name, self.language);
    }

    /// Another language, of this page already.
    pub(crate) fn set_language(&mut self, language: Language) {
        self.language = language;
        self.study.look(language);
    }

    /// Another participant's code.
    pub(crate) fn set_participant(&mut self, code: String) {
        self.study.set_participant(code);
        self.forget_participant();
    }

    /// What one person agreed to and told is not another one's.
    fn forget_participant(&mut self) {
        self.agreed = None;
        self.about = About::default();
    }

    /// Another participant's number; empty for the one at the end of the code.
    pub(crate) fn set_number(&mut self, number: String) {
        self.study.set_number(number);
    }

    /// Another monitor, whose pixels are as yet unknown.
    pub(crate) fn set_monitor(&mut self, index: usize) {
        if index < self.monitors.len() && index != self.monitor {
            self.monitor = index;
            self.calibration.matched = false;
            self.gamma.matched = false;
        }
    }

    /// The interrupted session of the first page was discarded; the participant begins anew, with the number that they
    /// had in it.
    pub(crate) fn discarded(&mut self, participant_number: u32) {
        self.study.take_over(participant_number);
        self.look_again();
    }

    /// Reads the folder and the session anew: files there were changed.
    pub(crate) fn look_again(&mut self) {
        self.study.look(self.language);
    }

    /// Goes on to the next page, unless something is wrong with this one or it is the last.
    pub(crate) fn next(&mut self) {
        if self.page == Page::Study {
            self.study.look_closely(self.language);
        }
        if self.page != Page::Declined
            && self.problem().is_none()
            && let Some(page) = self.pages().get(self.place() + 1)
        {
            self.page = *page;
        }
    }

    /// Goes back to the page before; entries stay.
    pub(crate) fn back(&mut self) {
        let before = self.place().checked_sub(1).map(|place| self.pages()[place]);
        self.page = match self.page {
            Page::Declined => Page::Consent,
            page => before.unwrap_or(page),
        };
    }

    /// The participant agrees to the text on show.
    pub(crate) fn agree(&mut self, at: Timestamp) {
        if !self.has_agreed() {
            let agreed = |text: &ConsentText| Consent { text_sha256: text.sha256.clone(), agreed_at: at };
            self.agreed = self.consent_text().map(agreed);
        }
        self.next();
    }

    /// The participant does not agree; nothing will be recorded.
    pub(crate) fn decline(&mut self) {
        self.agreed = None;
        self.page = Page::Declined;
    }

    /// What is wrong with the page on show.
    pub(crate) fn problem(&self) -> Option<Problem<'_>> {
        self.problem_of(self.page)
    }

    /// Everything for a session; the error is the first page on which something is wrong.
    pub(crate) fn finish(&self) -> Result<Ready, Page> {
        if let Some(page) = self.pages().into_iter().find(|page| self.problem_of(*page).is_some()) {
            return Err(page);
        }
        let study = self.study.opened().ok_or(Page::Study)?.study.clone();
        let viewing_distance_mm = self.calibration.distance_mm().map_err(|_| Page::Screen)?;
        let luminance_table = self.luminance().map(|table| table.rows.clone());
        Ok(Ready {
            participant: self.study.participant().to_owned(),
            participant_number: self.study.participant_number().ok_or(Page::Study)?,
            study,
            language: self.language,
            consent: self.agreed.clone().filter(|_| self.has_agreed()),
            demographics: self.about.demographics().map_err(|_| Page::About)?,
            room: Some(self.room.trim()).filter(|room| !room.is_empty()).map(str::to_owned),
            monitor: (!self.monitors.is_empty()).then_some(self.monitor),
            measured: MeasuredDisplay {
                px_per_mm: self.calibration.px_per_mm(),
                viewing_distance_mm,
                px_per_degree: self.calibration.px_per_degree(),
                // A photometer knows better than the eye.
                gamma_check_level: self.gamma.matched_level().filter(|_| luminance_table.is_none()),
                luminance_table,
            },
        })
    }

    fn problem_of(&self, page: Page) -> Option<Problem<'_>> {
        match page {
            Page::Study => self.study.problem(),
            Page::Screen => self.calibration.distance_mm().err().map(Problem::NotADistance),
            Page::Consent => (!self.has_agreed()).then_some(Problem::NoConsent),
            Page::About => self.about.age_years().err().map(Problem::NotAnAge),
            Page::Brightness | Page::Room | Page::Declined | Page::Summary => None,
        }
    }

    fn pages(&self) -> Vec<Page> {
        Page::sequence(self.consent_text().is_some())
    }

    /// Place of the page on show among the pages; that of the consent text for who declined it.
    fn place(&self) -> usize {
        let page = if self.page == Page::Declined { Page::Consent } else { self.page };
        self.pages().iter().position(|known| *known == page).unwrap_or(0)
    }
}

#[cfg(test)]
#[path = "model_tests.rs"]
mod tests;
