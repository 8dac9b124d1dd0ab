//! What can be wrong with a stimulus.

/// Why a picture cannot be made: what was found and what is allowed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// A field of [`Stimulus`](crate::Stimulus) is out of its range.
    #[error("{field} is {value}; allowed is {allowed}")]
    Field {
        /// The field's name.
        field: &'static str,
        /// The value found.
        value: f64,
        /// The range that is allowed, in words.
        allowed: &'static str,
    },
    /// The picture's size is zero or too large.
    #[error("a picture of {width_px} x {height_px} pixels; allowed is 1 to {max} a side", max = crate::MAX_SIDE_PX)]
    Size {
        /// Width asked for.
        width_px: u32,
        /// Height asked for.
        height_px: u32,
    },
    /// A kernel of taps, under which no radius hides the texels.
    #[error("a kernel of 25 taps; allowed are disc, box, gauss2 and gauss3")]
    Taps,
    /// The searched ratios hold no reference filter.
    #[error(
        "the pictures differ by {levels} levels at the ratio 64; allowed is a tolerance above that, not {tolerance}"
    )]
    Reference {
        /// Levels allowed.
        tolerance: f64,
        /// Levels found.
        levels: f64,
    },
    /// The measured table is not that of a display.
    #[error("{0}")]
    Table(String),
}
