//! `session.json`: who, with what protocol, on what display, from which seed.

use jiff::Timestamp;
use scumble_stimuli::Transfer;
use serde::{Deserialize, Serialize};

use crate::demographics::Demographics;
use crate::display::Display;
use crate::error::{Error, require};
use crate::event::is_sha256;
use crate::language::Language;
use crate::observer::ObserverModel;
use crate::protocol::Protocol;

/// The format of a session directory.
pub const SESSION_SCHEMA: &str = "scumble/session/3";

/// Formats that are read: each key that the present one added may be missing.
pub(crate) const READABLE_SCHEMAS: [&str; 2] = ["scumble/session/2", SESSION_SCHEMA];

/// Longest participant code, short enough that no name with address hides in it.
const CODE_LENGTH_MAX: usize = 16;

/// Everything about a session but its events.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SessionHeader {
    /// [`SESSION_SCHEMA`], or the one before it.
    pub schema: String,
    /// A code, never a name: 1 to 16 letters, digits, `-` and `_`.
    pub participant: String,
    /// Number of the participant in the study, which a Latin square of rounds is read at.
    pub participant_number: u32,
    /// When the session began.
    pub started_at: Timestamp,
    /// Every draw of the session follows from it.
    pub seed: u64,
    /// Every parameter of the session.
    pub protocol: Protocol,
    /// What the pictures were shown on; `None` for a session without a display.
    #[serde(deserialize_with = "Option::deserialize")]
    pub display: Option<Display>,
    /// The simulated person who answered; `None` for a human.
    #[serde(deserialize_with = "Option::deserialize")]
    pub simulated_observer: Option<ObserverModel>,
    /// Language of the participant's screen.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub language: Option<Language>,
    /// What the participant agreed to; `None` where nothing was asked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub consent: Option<Consent>,
    /// What the participant told; `None` where nothing was asked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub demographics: Option<Demographics>,
    /// The room's light, in words.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub room: Option<String>,
    /// Programs that made the session.
    pub software: Software,
}

/// A person's consent to take part.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Consent {
    /// SHA-256 of the text that was shown, byte for byte.
    pub text_sha256: String,
    /// When the person agreed.
    pub agreed_at: Timestamp,
}

/// Versions of what made a session.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Software {
    /// Name of the program that ran the session.
    pub program: String,
    /// Its version.
    pub program_version: String,
    /// Version of this crate, whose state machine chose the trials.
    pub psychophysics_version: String,
}

impl Software {
    /// The versions of a program built with this crate.
    pub fn of(program: &str, program_version: &str) -> Self {
        Self {
            program: program.into(),
            program_version: program_version.into(),
            psychophysics_version: env!("CARGO_PKG_VERSION").into(),
        }
    }
}

impl SessionHeader {
    /// A header without display and simulated person. The participant's number is the one at the end
    /// of the code, 0 where there is none.
    pub fn new(participant: &str, protocol: Protocol, seed: u64, started_at: Timestamp, software: Software) -> Self {
        Self {
            schema: SESSION_SCHEMA.into(),
            participant: participant.into(),
            participant_number: number_at_end(participant),
            started_at,
            seed,
            protocol,
            display: None,
            simulated_observer: None,
            language: None,
            consent: None,
            demographics: None,
            room: None,
            software,
        }
    }

    /// Refuses a foreign schema, a participant code that could be a name with more than a word, and
    /// parameters outside their ranges; the error names the field.
    pub fn check(&self) -> Result<(), Error> {
        let is_readable = READABLE_SCHEMAS.contains(&self.schema.as_str());
        require(is_readable, "schema", &self.schema, "scumble/session/3 and scumble/session/2")?;
        let is_code_letter = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        require(
            (1..=CODE_LENGTH_MAX).contains(&self.participant.len()) && self.participant.chars().all(is_code_letter),
            "participant",
            format!("{:?}", self.participant),
            "a code of 1 to 16 letters, digits, - and _",
        )?;
        if let Some(display) = &self.display {
            display.check()?;
        }
        if let Some(observer) = &self.simulated_observer {
            observer.check()?;
        }
        if let Some(consent) = &self.consent {
            require(
                is_sha256(&consent.text_sha256),
                "consent.text_sha256",
                &consent.text_sha256,
                "64 hexadecimal digits",
            )?;
        }
        if let Some(demographics) = &self.demographics {
            demographics.check()?;
        }
        self.protocol.check()
    }

    /// The light of the levels that the pictures are drawn for: the measured one, else that of sRGB, the standard
    /// that an unmeasured display comes nearest to.
    pub fn transfer(&self) -> Result<Transfer, Error> {
        self.display.as_ref().map_or_else(|| Ok(Transfer::srgb()), Display::transfer)
    }
}

/// The number that a code ends with; 0 without one, or with one beyond 32 bits.
fn number_at_end(code: &str) -> u32 {
    let letters = code.trim_end_matches(|c: char| c.is_ascii_digit());
    code[letters.len()..].parse().unwrap_or(0)
}
