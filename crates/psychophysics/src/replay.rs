//! Resuming a session: its recorded answers are fed to a new state machine.
//!
//! What the machine shows is compared with what the record says was shown. Draws must be equal bit
//! for bit; radii may differ by a relative 1e-9, as the logarithms of two platforms do in the last
//! digit, and QUEST then learns from the recorded radius. On one platform every state of every QUEST
//! is therefore rebuilt bit for bit, and on another one the same record still leads to the same
//! thresholds.

use crate::error::Error;
use crate::event::{Answered, Event};
use crate::experiment::{Experiment, Stage};
use crate::header::SessionHeader;
use crate::trial::Trial;

/// Relative difference of radii that counts as equal.
const RADIUS_TOLERANCE: f64 = 1e-9;

impl Experiment {
    /// The session as it stood after `events`.
    ///
    /// Errors name the first event that the header's seed and protocol do not lead to.
    pub fn resume(header: &SessionHeader, events: &[Event]) -> Result<Self, Error> {
        header.check()?;
        let mut experiment = Self::new(header.protocol.clone(), header.seed)?;
        for (index, event) in events.iter().enumerate() {
            if let Event::Trial(answered) | Event::Practice(answered) = event {
                experiment.replay(index, event, answered)?;
            }
            let ends = matches!(event, Event::End(_));
            if ends && *experiment.stage() != Stage::Finished {
                return Err(differs(index, "the end", experiment.stage().name()));
            }
        }
        Ok(experiment)
    }

    fn replay(&mut self, index: usize, event: &Event, answered: &Answered) -> Result<(), Error> {
        while matches!(self.stage(), Stage::Instructions | Stage::Feedback { .. } | Stage::Rest { .. }) {
            self.proceed()?;
        }
        let recorded = &answered.trial;
        let expected = match (self.stage(), event) {
            (Stage::Practice(expected), Event::Practice(_)) | (Stage::Trial(expected), Event::Trial(_)) => expected,
            (stage, Event::Practice(_)) => {
                return Err(differs(index, "practice", stage.name()));
            }
            (stage, _) => return Err(differs(index, "a trial", stage.name())),
        };
        if !is_same(expected, recorded) {
            return Err(differs(index, describe(recorded), describe(expected)));
        }
        if answered.correct != recorded.is_correct(answered.answer) {
            return Err(differs(index, format!("correct {}", answered.correct), format!("{}", !answered.correct)));
        }
        self.answer_shown(*recorded, answered.answer, answered.response_time_secs).map(|_| ())
    }
}

fn differs(index: usize, found: impl Into<String>, allowed: impl Into<String>) -> Error {
    Error::Replay { index, found: found.into(), allowed: allowed.into() }
}

/// Equality but for the last digits of the radii.
fn is_same(expected: &Trial, recorded: &Trial) -> bool {
    let close = |a: f64, b: f64| (a - b).abs() <= RADIUS_TOLERANCE * a.abs();
    let mut with_recorded_radii = *expected;
    with_recorded_radii.placement_radius_px = recorded.placement_radius_px;
    with_recorded_radii.radius_px = recorded.radius_px;
    with_recorded_radii.left.radius_px = recorded.left.radius_px;
    with_recorded_radii.right.radius_px = recorded.right.radius_px;
    with_recorded_radii == *recorded
        && close(expected.placement_radius_px, recorded.placement_radius_px)
        && close(expected.radius_px, recorded.radius_px)
        && recorded.left.radius_px == recorded.radius_px
        && recorded.right.radius_px == recorded.radius_px
}

fn describe(trial: &Trial) -> String {
    format!(
        "trial {} of round {}: {:?}, contrast {}, texel {} px, radius {} px, line {:?}, phase {}",
        trial.number,
        trial.round,
        trial.condition.pattern,
        trial.condition.contrast,
        trial.condition.texel_px,
        trial.radius_px,
        trial.line_side,
        trial.left.phase
    )
}
