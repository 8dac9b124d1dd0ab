//! Right answers against expected ones, by how plain the artifact was and by when it was shown.

use super::answered::{Answered, Half};
use crate::mixed_model::{MixedParameters, PersonAnswers};

/// Detection probabilities at which the bands end: one half, and 0.8, beyond which the function is flat again.
pub const BAND_ENDS: [f64; 2] = [0.5, 0.8];

/// Least variance of a band: that of one fair coin. Else one slip among plain artifacts would decide.
const VARIANCE_LEAST: f64 = 0.25;

/// Answers that are counted together.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Band {
    /// Number of answers.
    pub answers: f64,
    /// Right ones.
    pub right: f64,
    /// Right ones that the model expects.
    pub expected: f64,
    /// Variance of their number: `sum p (1 - p)`.
    pub variance: f64,
}

impl Band {
    pub(super) fn plus(&self, other: &Self) -> Self {
        Self {
            answers: self.answers + other.answers,
            right: self.right + other.right,
            expected: self.expected + other.expected,
            variance: self.variance + other.variance,
        }
    }

    /// With expectation and variance of cohorts whose right answers were off by `differences` from what their own model
    /// expects: a threshold that is estimated from the same answers draws the bands' edges with it.
    pub(super) fn against(&self, differences: &[f64]) -> Self {
        let count = differences.len() as f64;
        let mean = differences.iter().sum::<f64>() / count;
        let variance = differences.iter().map(|difference| (difference - mean).powi(2)).sum::<f64>() / (count - 1.0);
        Self { expected: self.expected + mean, variance, ..*self }
    }

    /// Pearson's term.
    pub(super) fn square(&self) -> f64 {
        (self.right - self.expected).powi(2) / self.variance.max(VARIANCE_LEAST)
    }
}

/// One person's answers, counted twice over, or the sum over people.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Counted {
    /// From hidden to plain.
    pub bands: [Band; 3],
    /// First halves of the staircases, then second ones.
    pub halves: [Band; 2],
}

impl Counted {
    /// Counts against what the model expects of the person at the most probable threshold; `gathered` are the same answers.
    pub fn of(answered: &Answered, gathered: &PersonAnswers, shared: &MixedParameters) -> Self {
        let threshold = shared.threshold_of(gathered);
        let mut counted = Self::default();
        for &(x, correct, half) in &answered.answers {
            let detection = shared.detection(x + threshold);
            let expected = answered.guess + (1.0 - answered.guess) * detection;
            let variance = expected * (1.0 - expected);
            let answer = Band { answers: 1.0, right: f64::from(u8::from(correct)), expected, variance };
            let band = &mut counted.bands[BAND_ENDS.iter().filter(|end| detection >= **end).count()];
            *band = band.plus(&answer);
            if let Some(half) = half {
                let half = &mut counted.halves[usize::from(half == Half::Late)];
                *half = half.plus(&answer);
            }
        }
        counted
    }

    pub fn plus(&self, other: &Self) -> Self {
        Self {
            bands: std::array::from_fn(|index| self.bands[index].plus(&other.bands[index])),
            halves: std::array::from_fn(|index| self.halves[index].plus(&other.halves[index])),
        }
    }

    /// Pearson's sum over the bands.
    pub fn chi_square(&self) -> f64 {
        self.bands.iter().map(Band::square).sum()
    }

    /// Late answers less early ones, right less expected, in standard deviations of independent answers.
    pub fn drift(&self) -> f64 {
        let [early, late] = self.halves;
        let difference = (late.right - late.expected) - (early.right - early.expected);
        difference / (early.variance + late.variance).max(VARIANCE_LEAST).sqrt()
    }
}
