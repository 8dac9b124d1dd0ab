//! What a participant may tell about themselves; everything may stay unsaid.

use serde::{Deserialize, Serialize};

use crate::error::{Error, require};

/// What a participant told; `None` where they did not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Demographics {
    /// In years, 1 to 120.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub age_years: Option<u32>,
    /// As told.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gender: Option<Gender>,
    /// The hand that writes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub handedness: Option<Handedness>,
    /// Sight during the session.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub vision: Option<Vision>,
    /// Experience with computer graphics; all of Kreuzer's participants were experts (2017, 4.3).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub graphics_experience: Option<Experience>,
}

/// A participant's gender.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Gender {
    /// Female.
    Female,
    /// Male.
    Male,
    /// Another one.
    Other,
}

/// The hand that writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Handedness {
    /// The left one.
    Left,
    /// The right one.
    Right,
    /// Either.
    Both,
}

/// A participant's sight during the session.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Vision {
    /// Normal without a correction.
    Normal,
    /// Corrected to normal, by glasses or lenses that are worn.
    Corrected,
    /// Below normal.
    Impaired,
}

/// Experience with computer graphics.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Experience {
    /// None.
    None,
    /// Some.
    Some,
    /// An expert's.
    Expert,
}

impl Demographics {
    /// Refuses an age out of its range; the error names the field.
    pub fn check(&self) -> Result<(), Error> {
        let age_years = self.age_years.unwrap_or(1);
        require((1..=120).contains(&age_years), "demographics.age_years", age_years, "1 to 120, or no such key")
    }
}
