//! QUEST: the Bayesian staircase (Watson & Pelli 1983), equal to Psychtoolbox's to 1e-9.
//!
//! The posterior of the threshold T lives on a table of points `T_i = t_guess + i grain`,
//! `i = -m ..= m`. The prior is `exp(-(i grain / t_guess_sd)^2 / 2)`, normalised to 1. A response at
//! intensity `x` multiplies the posterior by the likelihood `p(x - T_i)` or `1 - p(x - T_i)`; x is
//! first rounded to the table, `shift = round((x - t_guess) / grain)`, half away from zero, and
//! clamped to `-m ..= m` where it lies outside.
//!
//! The next placement follows the [`PlacementRule`]; by default it is the posterior's quantile of
//! order `quantile_order`, which minimises the expected variance (Pelli 1987; the formula is at
//! [`quantile_order`]).
//!
//! A deviation from Psychtoolbox's default: the posterior is normalised after every response. The
//! summaries are the same; without it the posterior underflows after some 3,000 responses.
//!
//! It does not estimate the slope (see [`BetaPosterior`](crate::BetaPosterior) and
//! [`QuestPlus`](crate::QuestPlus)), and its spread knows nothing of a wrong prior (see
//! [`Convergence`](crate::Convergence)).

use crate::error::{Error, require};
use crate::grid::Shown;
use crate::likelihood::Likelihood;
use crate::posterior::Posterior;
use crate::quest_config::{PlacementRule, QuestConfig};

/// The posterior of one threshold and what is needed to update it.
#[derive(Clone, Debug, PartialEq)]
pub struct Quest {
    config: QuestConfig,
    posterior: Posterior,
    quantile_order: f64,
}

impl Quest {
    /// The prior. Errors name the parameter that is out of its range.
    pub fn new(config: QuestConfig) -> Result<Self, Error> {
        config.check()?;
        let grid = config.grid();
        let likelihood = Likelihood::new(&config.psychometric(), &grid)?;
        let values = likelihood.values();
        let quantile_order = quantile_order(values[values.len() - 1], values[0]);
        Ok(Self { config, posterior: Posterior::new(grid, config.t_guess_sd, vec![likelihood]), quantile_order })
    }

    /// Multiplies the posterior by the likelihood of `response` at the intensity that was *shown*,
    /// which is the placement only where the display could show it.
    ///
    /// A NaN or infinite intensity and a response that no threshold explains are errors; the
    /// posterior is then unchanged.
    pub fn update(&mut self, intensity: f64, response: bool) -> Result<Shown, Error> {
        self.posterior.update(intensity, response)
    }

    /// Mean of the posterior.
    pub fn mean(&self) -> f64 {
        self.posterior.grid().mean(self.posterior())
    }

    /// The first point at which the posterior is highest.
    pub fn mode(&self) -> f64 {
        self.posterior.grid().mode(self.posterior())
    }

    /// Standard deviation of the posterior.
    pub fn sd(&self) -> f64 {
        self.posterior.grid().sd(self.posterior())
    }

    /// Quantile of the posterior; `order` is clamped to 0..=1, and orders beyond the first or the
    /// last point give that point.
    pub fn quantile(&self, order: f64) -> f64 {
        self.posterior.grid().quantile(self.posterior(), order)
    }

    /// The intensity to show next.
    pub fn placement(&self) -> f64 {
        match self.config.placement {
            PlacementRule::Quantile => self.quantile(self.quantile_order),
            PlacementRule::Mean => self.mean(),
            PlacementRule::Mode => self.mode(),
        }
    }

    /// Order of the quantile that [`PlacementRule::Quantile`] takes.
    pub fn quantile_order(&self) -> f64 {
        self.quantile_order
    }

    /// Shift of the psychometric function that puts its threshold probability at 0.
    pub fn x_threshold(&self) -> f64 {
        self.posterior.likelihoods()[0].x_threshold
    }

    /// Probability of a response 1 at an intensity `offset` above the threshold (Psychtoolbox's
    /// QuestP): the table interpolated linearly, and its end value beyond the table; NaN for NaN.
    pub fn probability(&self, offset: f64) -> f64 {
        self.posterior.likelihoods()[0].probability(offset)
    }

    /// The response of a person with this threshold to this intensity (Psychtoolbox's
    /// QuestSimulate): 1 where [`probability`](Self::probability) exceeds `uniform`, a random number
    /// from 0 to below 1 that the caller draws. NaN, infinity and other random numbers are errors.
    pub fn simulate(&self, intensity: f64, threshold: f64, uniform: f64) -> Result<bool, Error> {
        require(intensity.is_finite(), "intensity", intensity, "a finite number")?;
        require(threshold.is_finite(), "threshold", threshold, "a finite number")?;
        require((0.0..1.0).contains(&uniform), "uniform", uniform, "0 to below 1")?;
        Ok(self.probability(intensity - threshold) > uniform)
    }

    /// The parameters.
    pub fn config(&self) -> &QuestConfig {
        &self.config
    }

    /// Probability of each table point, which sum to 1.
    pub fn posterior(&self) -> &[f64] {
        self.posterior.weights()
    }

    /// The threshold of each table point.
    pub fn thresholds(&self) -> impl Iterator<Item = f64> + '_ {
        let grid = self.posterior.grid();
        (0..grid.len()).map(|i| grid.centre + grid.offset(i))
    }

    /// The table behind it.
    pub(crate) fn table(&self) -> &Posterior {
        &self.posterior
    }
}

/// Order of the quantile at which a trial is expected to tell most, from the ends of the
/// psychometric function (Psychtoolbox's QuestRecompute, after Pelli 1987):
/// `e = 1 / (1 + exp((h(p_high) - h(p_low)) / (p_low - p_high)))`, `h(p) = p ln p + (1 - p) ln(1 - p)`,
/// `order = (e - p_low) / (p_high - p_low)`.
fn quantile_order(p_low: f64, p_high: f64) -> f64 {
    // Keeps the logarithms finite at probabilities 0 and 1, as in the source.
    const TINY: f64 = 1e-14;
    let entropy = (p_high * libm::log(p_high + TINY) - p_low * libm::log(p_low + TINY))
        + ((1.0 - p_high + TINY) * libm::log(1.0 - p_high + TINY)
            - (1.0 - p_low + TINY) * libm::log(1.0 - p_low + TINY));
    let best = 1.0 / (1.0 + libm::exp(entropy / (p_low - p_high)));
    (best - p_low) / (p_high - p_low)
}
