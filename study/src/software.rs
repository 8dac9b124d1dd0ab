//! This program, as the header of a session names it.

use scumble_psychophysics::Software;

/// Name and version of this program.
pub(crate) fn software() -> Software {
    Software::of("scumble-study", env!("CARGO_PKG_VERSION"))
}
