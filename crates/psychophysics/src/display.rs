//! What the pictures were shown on.

use scumble_stimuli::Transfer;
use serde::{Deserialize, Serialize};

use crate::error::{Error, require};

/// The display, as far as it is known.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Display {
    /// Name of the monitor.
    pub monitor: Option<String>,
    /// Width in physical pixels.
    pub width_px: u32,
    /// Height in physical pixels.
    pub height_px: u32,
    /// Physical pixels per logical point. Pictures are shown texel for physical pixel whatever it is.
    pub scale_factor: f64,
    /// Refreshes per second.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub refresh_hz: Option<f64>,
    /// Width and height of the participant's window in physical pixels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub window_px: Option<[u32; 2]>,
    /// Physical pixels per degree of visual angle at the participant's distance.
    pub px_per_degree: Option<f64>,
    /// Physical pixels per millimetre, measured on the screen.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub px_per_mm: Option<f64>,
    /// From the participant's eyes to the screen.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub viewing_distance_mm: Option<f64>,
    /// Measured light: levels and luminances in candela per square metre. The pictures are drawn for it.
    #[serde(default, alias = "luminance", skip_serializing_if = "Option::is_none")]
    pub luminance_table: Option<Vec<(u8, f64)>>,
    /// The level that was matched by eye to a field of black and white rows, half of white's light; a display
    /// as sRGB has it shows 188.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gamma_check_level: Option<u8>,
}

impl Display {
    pub(crate) fn check(&self) -> Result<(), Error> {
        let positive =
            |field, value: f64| require(value.is_finite() && value > 0.0, field, value, "a finite number above 0");
        positive("display.width_px", self.width_px.into())?;
        positive("display.height_px", self.height_px.into())?;
        positive("display.scale_factor", self.scale_factor)?;
        let known = [
            ("display.refresh_hz", self.refresh_hz),
            ("display.px_per_degree", self.px_per_degree),
            ("display.px_per_mm", self.px_per_mm),
            ("display.viewing_distance_mm", self.viewing_distance_mm),
        ];
        for (field, value) in known {
            value.map_or(Ok(()), |value| positive(field, value))?;
        }
        for side in self.window_px.into_iter().flatten() {
            positive("display.window_px", side.into())?;
        }
        self.transfer().map(drop)
    }

    /// The light of the levels: the measured one, else sRGB's.
    pub(crate) fn transfer(&self) -> Result<Transfer, Error> {
        match &self.luminance_table {
            Some(rows) => Transfer::from_table(rows).map_err(|error| {
                Error::parameter("display.luminance_table", error, "levels and luminances that increase from 0 to 255")
            }),
            None => Ok(Transfer::srgb()),
        }
    }
}
