//! The texts of the administrator's window.

mod english;
mod german;

use scumble_psychophysics::{Condition, Reason};

use crate::desk::{Activity, Barrier, Chart, MinutesLeft, Point, Round, Status, Tally};

pub(super) use english::ENGLISH;
pub(super) use german::GERMAN;

/// See [`super::Words::desk`].
///
/// A function takes what is to be said and gives whole sentences, since languages build them differently.
pub(crate) struct DeskWords {
    pub(crate) title: &'static str,

    // Before the panel, where it is on the participant's screen.
    pub(crate) in_charge: &'static str,
    pub(crate) in_charge_text: &'static str,
    pub(crate) in_charge_on: &'static str,
    pub(crate) in_charge_back: &'static str,

    // Header.
    pub(crate) activity: fn(Activity) -> String,
    /// Whole minutes since the session began.
    pub(crate) elapsed: fn(u32) -> String,
    pub(crate) saved: &'static str,
    pub(crate) waiting: fn(&str) -> String,
    /// Why the program cannot go on.
    pub(crate) stopped: fn(&str) -> String,
    /// Display that the session is shown on, where it is not the one that it began on.
    pub(crate) other_display: fn(&str) -> String,
    pub(crate) dark: &'static str,
    pub(crate) light: &'static str,

    // Progress.
    pub(crate) round: fn(&Round) -> String,
    pub(crate) condition: fn(&Condition) -> String,
    pub(crate) round_state: fn(&Round) -> String,
    pub(crate) trials: fn(&Status) -> String,
    pub(crate) minutes_left: fn(Option<MinutesLeft>) -> String,
    pub(crate) lines: fn(Tally) -> String,
    pub(crate) catch_trials: fn(Tally) -> String,
    pub(crate) missed_frames: fn(u32) -> String,

    // Charts.
    /// Texel size in pixels.
    pub(crate) texel: fn(f64) -> String,
    pub(crate) x_axis: &'static str,
    pub(crate) y_axis: &'static str,
    pub(crate) estimate: fn(&Chart) -> String,
    pub(crate) point: fn(&Point) -> String,
    pub(crate) verdict: fn(&Chart) -> String,
    pub(crate) reason: fn(&Reason) -> String,
    pub(crate) legend_two: &'static str,
    pub(crate) legend_one: &'static str,

    // Orders.
    pub(crate) pause: &'static str,
    pub(crate) resume: &'static str,
    pub(crate) repeat_practice: &'static str,
    pub(crate) repeat_round: &'static str,
    pub(crate) stop: &'static str,
    /// Round that was to be repeated.
    pub(crate) round_was_over: fn(u32) -> String,
    pub(crate) barrier: fn(Barrier) -> &'static str,
    /// Round, and number of its answers.
    pub(crate) ask_repeat_round: fn(u32, u32) -> String,
    pub(crate) ask_stop: fn(&Status) -> String,
    pub(crate) yes_repeat_round: &'static str,
    pub(crate) yes_stop: &'static str,
    pub(crate) cancel: &'static str,

    // Notes.
    pub(crate) note: &'static str,
    pub(crate) note_hint: &'static str,
    pub(crate) add_note: &'static str,
    /// Seconds since the session began, and the text.
    pub(crate) noted: fn(f64, &str) -> String,
    pub(crate) no_notes: &'static str,
}

/// A value and the limit that it misses, with as many decimals as it takes to tell them apart: "0.30, at most 0.30"
/// would be no reason.
fn apart(value: f64, limit: f64, decimals: usize) -> [String; 2] {
    let written = |decimals: usize| [value, limit].map(|number| format!("{number:.decimals$}"));
    (decimals..decimals + 6).map(written).find(|[value, limit]| value != limit).unwrap_or_else(|| written(decimals))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_next_to_its_limit_is_told_from_it() {
        assert_eq!(apart(0.41, 0.3, 2), ["0.41", "0.30"]);
        assert_eq!(apart(0.3004, 0.3, 2), ["0.3004", "0.3000"]);
    }
}
