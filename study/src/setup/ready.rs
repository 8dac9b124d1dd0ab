//! What the set-up leads to: everything that a session needs before its first trial.

use scumble_psychophysics::{Consent, Demographics, Display, Language, SessionHeader, Software};

use super::{LuminanceTable, StudyFolder};

/// A set-up without problems.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ready {
    /// The study, whose protocol is to be kept when the session begins.
    pub(crate) study: StudyFolder,
    /// Code of the participant, checked.
    pub(crate) participant: String,
    /// Number of the participant, which a Latin square of rounds is read at.
    pub(crate) participant_number: u32,
    /// What the participant reads.
    pub(crate) language: Language,
    /// The participant's agreement; `None` where the study has no consent text.
    pub(crate) consent: Option<Consent>,
    /// What the participant said about themselves; `None` where that is nothing.
    pub(crate) demographics: Option<Demographics>,
    /// Light in the room, in the researcher's words.
    pub(crate) room: Option<String>,
    /// Index of the participant's monitor in the list that the set-up was given; `None` of an empty list.
    pub(crate) monitor: Option<usize>,
    /// What was measured of the display.
    pub(crate) measured: MeasuredDisplay,
}

/// What was measured of a display; `None` for each thing that was not.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct MeasuredDisplay {
    /// Physical pixels per millimetre.
    pub(crate) px_per_mm: Option<f64>,
    /// From the participant's eyes to the display, in millimetres.
    pub(crate) viewing_distance_mm: Option<f64>,
    /// Physical pixels per degree of visual angle.
    pub(crate) px_per_degree: Option<f64>,
    /// Levels and their luminance in candela per square metre.
    pub(crate) luminance_table: Option<Vec<(u8, f64)>>,
    /// Grey level that looked like half of white.
    pub(crate) gamma_check_level: Option<u8>,
}

impl MeasuredDisplay {
    /// What is known without the set-up pages: the table in the study's folder, which the error names, and the
    /// pixels per degree that somebody gave.
    pub(crate) fn of_study(study: &StudyFolder, px_per_degree: Option<f64>) -> anyhow::Result<Self> {
        let table = LuminanceTable::read(study.directory()).map_err(anyhow::Error::msg)?;
        Ok(Self { px_per_degree, luminance_table: table.map(|table| table.rows), ..Self::default() })
    }

    /// What the system knows of the display, with what was measured.
    pub(crate) fn complete(self, display: Display) -> Display {
        let Self { px_per_mm, viewing_distance_mm, px_per_degree, luminance_table, gamma_check_level } = self;
        Display { px_per_mm, viewing_distance_mm, px_per_degree, luminance_table, gamma_check_level, ..display }
    }
}

impl Ready {
    /// The header of the session, but for its display, which is known once there is a window.
    pub(crate) fn header(&self, seed: u64, started_at: jiff::Timestamp, software: Software) -> SessionHeader {
        let protocol = self.study.protocol().clone();
        SessionHeader {
            participant_number: self.participant_number,
            language: Some(self.language),
            consent: self.consent.clone(),
            demographics: self.demographics,
            room: self.room.clone(),
            ..SessionHeader::new(&self.participant, protocol, seed, started_at, software)
        }
    }
}
