//! The JSON beside an events table: what the pictures were shown by, and every column.
//!
//! BIDS recommends the key `TaskName` too; bids-validator 1.15.0 takes it for a column's description and calls it
//! an error. The task's label is in the file's name.

use scumble_psychophysics::{Display, SessionHeader};
use serde::{
    Serialize,
    ser::{SerializeMap, Serializer},
};

use crate::column::{Column, describe};

/// Lengths in BIDS are metres.
const MM_PER_M: f64 = 1000.0;

/// The sidecar of a session's events.
pub(super) struct EventsSidecar<'a, R> {
    pub(super) header: &'a SessionHeader,
    pub(super) columns: &'a [Column<R>],
}

/// BIDS' keys for the program and the screen; what is not known is left out.
#[derive(Serialize)]
#[serde(rename_all = "PascalCase")]
struct StimulusPresentation<'a> {
    software_name: &'a str,
    software_version: &'a str,
    /// Metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    screen_distance: Option<f64>,
    /// Hertz.
    #[serde(skip_serializing_if = "Option::is_none")]
    screen_refresh_rate: Option<f64>,
    /// Physical pixels, width and height.
    #[serde(skip_serializing_if = "Option::is_none")]
    screen_resolution: Option<[u32; 2]>,
    /// Metres, width and height.
    #[serde(skip_serializing_if = "Option::is_none")]
    screen_size: Option<[f64; 2]>,
}

impl<'a> StimulusPresentation<'a> {
    fn of(header: &'a SessionHeader) -> Self {
        let display = header.display.as_ref();
        Self {
            software_name: &header.software.program,
            software_version: &header.software.program_version,
            screen_distance: display.and_then(|display| Some(display.viewing_distance_mm? / MM_PER_M)),
            screen_refresh_rate: display.and_then(|display| display.refresh_hz),
            screen_resolution: display.map(|display| [display.width_px, display.height_px]),
            screen_size: display.and_then(screen_size_m),
        }
    }
}

/// From the resolution and the size of a pixel.
fn screen_size_m(display: &Display) -> Option<[f64; 2]> {
    let px_per_m = display.px_per_mm? * MM_PER_M;
    Some([display.width_px, display.height_px].map(|side_px| f64::from(side_px) / px_per_m))
}

impl<R> Serialize for EventsSidecar<'_, R> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("StimulusPresentation", &StimulusPresentation::of(self.header))?;
        describe(self.columns, &mut map)?;
        map.end()
    }
}
