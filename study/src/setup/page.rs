//! The pages and their order: the researcher's, then the participant's, then the summary.

/// A page of the set-up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Page {
    /// Folder, protocol, language, participant, monitor.
    Study,
    /// Viewing distance and pixel size.
    Screen,
    /// The display's tone curve.
    Brightness,
    /// Light around the display. The researcher's last page.
    Room,
    /// The text to agree to, where the study has one.
    Consent,
    /// In place of everything that follows, for who does not agree.
    Declined,
    /// Optional questions about the participant.
    About,
    /// Everything that will be recorded.
    Summary,
}

impl Page {
    /// The pages of a study in their order; [`Page::Declined`] is beside it.
    pub(super) fn sequence(asks_for_consent: bool) -> Vec<Page> {
        use Page::*;
        let all = [Study, Screen, Brightness, Room, Consent, About, Summary];
        all.into_iter().filter(|page| *page != Consent || asks_for_consent).collect()
    }
}
