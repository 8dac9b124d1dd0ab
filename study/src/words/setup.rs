//! The texts of the pages before the instructions.

/// See [`super::Words::setup`].
pub(crate) struct SetupWords {
    pub(crate) go_on: &'static str,
}

pub(super) const ENGLISH: SetupWords = SetupWords { go_on: "Go on" };

pub(super) const GERMAN: SetupWords = SetupWords { go_on: "Weiter" };
