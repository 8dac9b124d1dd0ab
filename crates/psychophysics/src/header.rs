//! `session.json`: who, with what protocol, on what display, from which seed.

use jiff::Timestamp;
use serde::{Deserialize, Serialize};

use crate::error::{Error, require};
use crate::observer::ObserverModel;
use crate::protocol::Protocol;

/// The format of a session directory.
pub const SESSION_SCHEMA: &str = "scumble/session/2";

/// Longest participant code, short enough that no name with address hides in it.
const CODE_LENGTH_MAX: usize = 16;

/// Everything about a session but its events.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SessionHeader {
    /// [`SESSION_SCHEMA`].
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
    /// Programs that made the session.
    pub software: Software,
}

/// The display, as far as it is known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Display {
    /// Name of the monitor.
    pub monitor: Option<String>,
    /// Width in physical pixels.
    pub width_px: u32,
    /// Height in physical pixels.
    pub height_px: u32,
    /// Physical pixels per logical point.
    pub scale_factor: f64,
    /// Physical pixels per degree of visual angle at the participant's distance.
    pub px_per_degree: Option<f64>,
    /// Measured light; `None` where nobody measured.
    pub luminance: Option<Luminance>,
}

/// A display's light, measured with a photometer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Luminance {
    /// Of level 0.
    pub black_cd_m2: f64,
    /// Of level 255.
    pub white_cd_m2: f64,
    /// Exponent of the display's tone curve.
    pub gamma: f64,
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
            software,
        }
    }

    /// Refuses a foreign schema, a participant code that could be a name with more than a word, and
    /// parameters outside their ranges; the error names the field.
    pub fn check(&self) -> Result<(), Error> {
        require(self.schema == SESSION_SCHEMA, "schema", &self.schema, SESSION_SCHEMA)?;
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
        self.protocol.check()
    }
}

/// The number that a code ends with; 0 without one, or with one beyond 32 bits.
fn number_at_end(code: &str) -> u32 {
    let letters = code.trim_end_matches(|c: char| c.is_ascii_digit());
    code[letters.len()..].parse().unwrap_or(0)
}

impl Display {
    fn check(&self) -> Result<(), Error> {
        let positive =
            |field, value: f64| require(value.is_finite() && value > 0.0, field, value, "a finite number above 0");
        positive("display.width_px", self.width_px.into())?;
        positive("display.height_px", self.height_px.into())?;
        positive("display.scale_factor", self.scale_factor)?;
        self.px_per_degree.map_or(Ok(()), |value| positive("display.px_per_degree", value))?;
        let Some(luminance) = self.luminance else {
            return Ok(());
        };
        positive("display.luminance.gamma", luminance.gamma)?;
        require(
            luminance.white_cd_m2.is_finite()
                && luminance.black_cd_m2 >= 0.0
                && luminance.black_cd_m2 < luminance.white_cd_m2,
            "display.luminance",
            format!("{} to {} cd/m2", luminance.black_cd_m2, luminance.white_cd_m2),
            "0 or more for black and a larger finite number for white",
        )
    }
}
