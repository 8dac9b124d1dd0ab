//! The texts of the administrator's window.

/// See [`super::Words::desk`].
pub(crate) struct DeskWords {
    pub(crate) title: &'static str,
}

pub(super) const ENGLISH: DeskWords = DeskWords { title: "Scumble study: administrator" };

pub(super) const GERMAN: DeskWords = DeskWords { title: "Scumble-Studie: Versuchsleitung" };
