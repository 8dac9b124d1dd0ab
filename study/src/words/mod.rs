//! Everything that the program says, in every language: a struct of texts a part of the program, filled in
//! once a language, so that a text that is missing does not compile.

pub(crate) mod desk;
pub(crate) mod participant;
pub(crate) mod setup;

use scumble_psychophysics::Language;

/// The texts of one language.
pub(crate) struct Words {
    /// On the participant's screen, from the instructions on.
    pub(crate) participant: participant::ParticipantWords,
    /// On the pages before the instructions.
    pub(crate) setup: setup::SetupWords,
    /// In the administrator's window.
    pub(crate) desk: desk::DeskWords,
}

/// The texts of a language.
pub(crate) fn words(language: Language) -> &'static Words {
    match language {
        Language::English => &ENGLISH,
        Language::German => &GERMAN,
    }
}

static ENGLISH: Words = Words { participant: participant::ENGLISH, setup: setup::ENGLISH, desk: desk::ENGLISH };
static GERMAN: Words = Words { participant: participant::GERMAN, setup: setup::GERMAN, desk: desk::GERMAN };
