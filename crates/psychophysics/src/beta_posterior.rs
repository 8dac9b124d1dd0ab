//! Do the responses fit the slope that QUEST assumed? Threshold and slope re-analysed together
//! (Psychtoolbox's QuestBetaAnalysis, Pelli 1999).
//!
//! The responses are fed to 16 tables that differ in beta alone, `beta_k = 2^(k/4)`, k = 1 ..= 16, on
//! a grid of step 0.02 and width 5 about QUEST's guess. A beta's weight is the joint posterior at that
//! beta's mean threshold, which leaves out how wide the threshold's posterior is; `probability` holds
//! the joint posterior summed over the thresholds beside it. The estimate of beta is
//! `1 / mean(1 / beta)`: beta is skewed to large values, its inverse nearly symmetric.
//!
//! A diagnostic, not a measurement: some 1,000 responses fix beta to 10 % at QUEST's placements, 40
//! hardly at all. For slopes that steer the placements see [`QuestPlus`](crate::QuestPlus).

use crate::error::Error;
use crate::grid::Grid;
use crate::likelihood::Likelihood;
use crate::posterior::Posterior;
use crate::psychometric::Psychometric;
use crate::quest_config::QuestConfig;

/// Number of slopes, four an octave, as in the source.
const BETAS: u32 = 16;

/// Step of the table of thresholds, as in the source.
const STEP: f64 = 0.02;

/// Width of the table of thresholds, as in the source.
const WIDTH: f64 = 5.0;

/// What the responses say of each slope.
#[derive(Clone, Debug, PartialEq)]
pub struct BetaPosterior {
    rows: Vec<BetaRow>,
}

/// One slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BetaRow {
    /// The slope.
    pub beta: f64,
    /// Mean threshold at this slope.
    pub threshold_mean: f64,
    /// Standard deviation of the threshold at this slope.
    pub threshold_sd: f64,
    /// Joint posterior of this slope and its mean threshold, relative to the other slopes; sums to 1.
    pub weight: f64,
    /// Posterior probability of this slope, the slopes equally likely at first; sums to 1.
    pub probability: f64,
}

impl BetaPosterior {
    /// Re-analyses the responses `(intensity shown, response)` of a QUEST with these parameters; its
    /// slope is not used. Errors: a parameter out of its range, and responses that QUEST refuses.
    pub fn new(config: &QuestConfig, responses: &[(f64, bool)]) -> Result<Self, Error> {
        config.check()?;
        let grid = Grid::new(config.t_guess, STEP, WIDTH);
        let betas: Vec<f64> = (1..=BETAS).map(|k| libm::exp2(f64::from(k) / 4.0)).collect();
        let curves = betas.iter().map(|beta| Psychometric { beta: *beta, ..config.psychometric() });
        let likelihoods = curves.map(|curve| Likelihood::new(&curve, &grid)).collect::<Result<_, _>>()?;
        let mut posterior = Posterior::new(grid, config.t_guess_sd, likelihoods);
        for (intensity, response) in responses {
            posterior.update(*intensity, *response)?;
        }
        let rows: Vec<BetaRow> =
            betas.into_iter().zip(posterior.by_function()).map(|(beta, joint)| row(&grid, beta, joint)).collect();
        let total: f64 = rows.iter().map(|row| row.weight).sum();
        Ok(Self { rows: rows.into_iter().map(|row| BetaRow { weight: row.weight / total, ..row }).collect() })
    }

    /// Every slope, rising.
    pub fn rows(&self) -> &[BetaRow] {
        &self.rows
    }

    /// The estimate of beta, `1 / mean(1 / beta)`.
    pub fn estimate(&self) -> f64 {
        1.0 / self.mean_of(|beta| 1.0 / beta)
    }

    /// Mean of beta.
    pub fn mean(&self) -> f64 {
        self.mean_of(|beta| beta)
    }

    /// Standard deviation of beta.
    pub fn sd(&self) -> f64 {
        let mean = self.mean();
        self.mean_of(|beta| (beta - mean) * (beta - mean)).sqrt()
    }

    /// Standard deviation of `1 / beta`.
    pub fn inverse_sd(&self) -> f64 {
        let mean = self.mean_of(|beta| 1.0 / beta);
        self.mean_of(|beta| (1.0 / beta - mean) * (1.0 / beta - mean)).sqrt()
    }

    /// The slope of the highest weight.
    pub fn mode(&self) -> &BetaRow {
        let first = &self.rows[0];
        self.rows.iter().fold(first, |best, row| if row.weight > best.weight { row } else { best })
    }

    fn mean_of(&self, of: impl Fn(f64) -> f64) -> f64 {
        self.rows.iter().map(|row| row.weight * of(row.beta)).sum()
    }
}

/// Summaries of one slope's joint posterior, its weight not normalised.
fn row(grid: &Grid, beta: f64, joint: &[f64]) -> BetaRow {
    let probability: f64 = joint.iter().sum();
    if probability == 0.0 {
        // No response sequence leaves this slope possible; the source drops it.
        return BetaRow { beta, threshold_mean: f64::NAN, threshold_sd: f64::NAN, weight: 0.0, probability };
    }
    let given_beta: Vec<f64> = joint.iter().map(|weight| weight / probability).collect();
    let threshold_mean = grid.mean(&given_beta);
    let weight = joint[grid.nearest(threshold_mean).0];
    BetaRow { beta, threshold_mean, threshold_sd: grid.sd(&given_beta), weight, probability }
}
