//! How much longer a session takes: the fewest and the most trials that may follow, at this person's pace.

use scumble_psychophysics::{Event, Progress, Protocol};

/// Fewest durations that make a pace; below, the first trials' hesitation would be extrapolated.
const DURATIONS_MIN: usize = 5;

/// Minutes until the end, without the rests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MinutesLeft {
    pub(crate) at_least: f64,
    pub(crate) at_most: f64,
}

impl MinutesLeft {
    /// `None` while there are too few trials to know the pace.
    pub(crate) fn of(progress: &Progress, protocol: &Protocol, events: &[Event]) -> Option<Self> {
        let secs = median(&mut durations_secs(events))?;
        // Lines and catch trials come between the trials that are counted.
        let secs = secs / protocol.measured_share();
        let minutes = |trials: u32| f64::from(trials.saturating_sub(progress.trials)) * secs / 60.0;
        Some(Self { at_least: minutes(progress.trials_at_least), at_most: minutes(progress.trials_at_most) })
    }
}

/// From pictures to the next pictures, wherever no other event lies between them; practice, with its feedback, is
/// slower and left out.
fn durations_secs(events: &[Event]) -> Vec<f64> {
    let onset_secs = |event: &Event| {
        let answered = event.answered().filter(|answered| answered.trial.round > 0)?;
        Some(answered.timing?.onset_secs)
    };
    events.windows(2).filter_map(|pair| Some(onset_secs(&pair[1])? - onset_secs(&pair[0])?)).collect()
}

fn median(durations: &mut [f64]) -> Option<f64> {
    if durations.len() < DURATIONS_MIN {
        return None;
    }
    durations.sort_by(f64::total_cmp);
    Some(durations[durations.len() / 2])
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;

    #[test]
    fn the_pace_is_the_median_of_at_least_five_trials() {
        assert_eq!(median(&mut [1.0, 2.0, 3.0, 90.0]), None);
        assert_eq!(median(&mut [1.0, 4.0, 2.0, 90.0, 3.0]), Some(3.0));
    }
}
