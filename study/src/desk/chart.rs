//! One chart of convergence: the radii that a staircase showed, the answers, and what it made of them.

use scumble_psychophysics::{Answer, Answered, Estimate, Schedule, Track, Verdict};

/// One staircase as a chart.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Chart {
    pub(crate) texel_px: f64,
    /// Trials that it learned from, in order.
    pub(crate) points: Vec<Point>,
    /// 90 % interval of the ratio: of the prior, and after each trial.
    pub(crate) ratio_intervals90: Vec<(f64, f64)>,
    pub(crate) estimate: Estimate,
    pub(crate) verdict: Verdict,
    /// Whether it asks for no further trial.
    pub(crate) is_done: bool,
    pub(crate) trials_min: u32,
    pub(crate) trials_max: u32,
}

/// A trial on a chart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Point {
    /// Of the staircase, from 1.
    pub(crate) number: u32,
    /// In the session.
    pub(crate) trial_number: u32,
    /// As shown.
    pub(crate) radius_px: f64,
    /// Radius in texels.
    pub(crate) ratio: f64,
    pub(crate) answer: Answer,
    pub(crate) is_right: bool,
}

impl Chart {
    /// The chart of a track, given its answers that stand and its intervals.
    pub(crate) fn new(
        track: &Track,
        answers: &[&Answered],
        ratio_intervals90: &[(f64, f64)],
        schedule: &Schedule,
    ) -> Self {
        let texel_px = track.condition().texel_px;
        let point = |(index, answered): (usize, &&Answered)| Point {
            number: index as u32 + 1,
            trial_number: answered.trial.number,
            radius_px: answered.trial.radius_px,
            ratio: answered.trial.radius_px / texel_px,
            answer: answered.answer,
            is_right: answered.correct,
        };
        Self {
            texel_px,
            points: answers.iter().enumerate().map(point).collect(),
            ratio_intervals90: ratio_intervals90.to_vec(),
            estimate: track.estimate(),
            verdict: track.verdict(),
            is_done: track.is_done(),
            trials_min: schedule.trials_min,
            trials_max: schedule.trials_max,
        }
    }

    /// Number of its trials.
    pub(crate) fn trials(&self) -> u32 {
        self.points.len() as u32
    }
}
