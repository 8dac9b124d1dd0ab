//! The trials between the staircases': lines alone and artifacts that everyone sees.
//!
//! A person's false alarm rate is `(f + 1/2) / (n + 1)` for `f` of `n` lines taken for artifacts
//! (log-linear correction, Hautus 1995): neither 0 nor 1, whatever the counts.

use std::ops::Add;

use scumble_psychophysics::{Answered, Role};

/// How often each kind was shown, and how often it was taken for an artifact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Checks {
    /// Lines alone.
    pub lines: u32,
    /// Lines alone that were called artifacts.
    pub false_alarms: u32,
    /// Artifacts that everyone sees.
    pub catches: u32,
    /// Those of them that were answered rightly.
    pub catches_seen: u32,
}

impl Checks {
    /// Counts answers.
    pub fn of(answers: &[&Answered]) -> Self {
        let mut checks = Self::default();
        for answered in answers {
            let correct = u32::from(answered.correct);
            match answered.trial.role {
                Role::Line => {
                    checks.lines += 1;
                    checks.false_alarms += 1 - correct;
                }
                Role::Catch => {
                    checks.catches += 1;
                    checks.catches_seen += correct;
                }
                Role::Practice | Role::Measure => {}
            }
        }
        checks
    }

    /// The corrected false alarm rate; `None` without lines.
    pub fn false_alarm_rate(&self) -> Option<f64> {
        let rate = (f64::from(self.false_alarms) + 0.5) / (f64::from(self.lines) + 1.0);
        (self.lines > 0).then_some(rate)
    }
}

impl Add for Checks {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            lines: self.lines + other.lines,
            false_alarms: self.false_alarms + other.false_alarms,
            catches: self.catches + other.catches,
            catches_seen: self.catches_seen + other.catches_seen,
        }
    }
}
