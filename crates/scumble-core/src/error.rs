//! The crate's one error: which value was refused, what it was, and what is allowed.

/// Why a value was refused.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A number outside of what is allowed.
    #[error("{name} is {value:?}; allowed is {allowed}")]
    Number {
        /// The value's name, with its unit or space.
        name: &'static str,
        /// What was found.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// A vector outside of what is allowed.
    #[error("{name} is ({}, {}, {}); allowed is {allowed}", value.x, value.y, value.z)]
    Vector {
        /// The value's name, with its unit or space.
        name: &'static str,
        /// What was found.
        value: glam::DVec3,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// A point light where one map is made.
    #[error("the light is a point, which has six faces with a map each; allowed is a directional light or a spot")]
    PointLight,
    /// A field of a relation file that is missing or outside of what is allowed.
    #[error("relation file: field \"{field}\" is {found}; allowed is {allowed}")]
    Field {
        /// Path of the field, with dots.
        field: String,
        /// What the file holds there.
        found: String,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// A relation file that is no JSON, or whose fields have other types.
    #[error("relation file: {0}; allowed is JSON, whose numbers are finite")]
    Json(serde_json::Error),
}

// Not `#[from]`: the message holds the reason, which as a source would be told twice.
impl From<serde_json::Error> for Error {
    fn from(reason: serde_json::Error) -> Self {
        Self::Json(reason)
    }
}

/// Returns `value` when `holds`, else the error that names it.
pub(crate) fn check(name: &'static str, value: f64, holds: bool, allowed: &'static str) -> Result<f64, Error> {
    if holds { Ok(value) } else { Err(Error::Number { name, value, allowed }) }
}

/// A finite number above zero.
pub(crate) fn positive(name: &'static str, value: f64) -> Result<f64, Error> {
    check(name, value, value.is_finite() && value > 0.0, "a finite number above 0")
}

/// A finite number, zero included, with a positive sign.
pub(crate) fn not_negative(name: &'static str, value: f64) -> Result<f64, Error> {
    check(
        name,
        value,
        value.is_finite() && value.is_sign_positive(),
        "a finite number, 0 or above, without a minus sign",
    )
}

/// A vector of finite components.
pub(crate) fn finite(name: &'static str, value: glam::DVec3) -> Result<glam::DVec3, Error> {
    if value.is_finite() { Ok(value) } else { Err(Error::Vector { name, value, allowed: "three finite numbers" }) }
}

/// A direction, normalised; its length may be anything that is not zero.
pub(crate) fn direction(name: &'static str, value: glam::DVec3) -> Result<glam::DVec3, Error> {
    // Dividing by the largest component first keeps the squares from overflowing and from vanishing.
    let largest = value.abs().max_element();
    if value.is_finite() && largest > 0.0 {
        Ok((value / largest).normalize())
    } else {
        Err(Error::Vector { name, value, allowed: "a finite vector that is not zero" })
    }
}
