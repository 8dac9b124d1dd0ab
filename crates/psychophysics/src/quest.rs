//! QUEST: the Bayesian staircase (Watson & Pelli 1983), equal to Psychtoolbox's to 1e-9.
//!
//! The posterior of the threshold T lives on a table of points `T_i = t_guess + i grain`,
//! `i = -m ..= m`. The prior is `exp(-(i grain / t_guess_sd)^2 / 2)`, normalised to 1. A response at
//! intensity `x` multiplies the posterior by the likelihood `p(x - T_i)` or `1 - p(x - T_i)`; x is
//! first rounded to the table, `shift = round((x - t_guess) / grain)`, half away from zero, and
//! clamped to `-m ..= m` where it lies outside.
//!
//! * `x_threshold` is the linear interpolation of the tabulated psychometric function at the
//!   threshold probability, as Psychtoolbox computes it (4e-6 above the closed form).
//! * The next placement is the posterior's quantile of order `quantile_order`, which minimises the
//!   expected variance (Pelli 1987; the formula is at [`quantile_order`]).
//! * Quantiles interpolate the cumulative sum linearly, and the sum at a point includes that point:
//!   the prior's median is `t_guess - grain / 2`.
//!
//! A deviation from Psychtoolbox's default: the posterior is normalised after every response. The
//! summaries are the same; without it the posterior underflows after some 3,000 responses.
//!
//! It does not estimate the slope, and its spread knows nothing of a wrong prior: see
//! [`Convergence`](crate::Convergence).

use crate::error::Error;
use crate::psychometric::Psychometric;
use crate::quest_config::QuestConfig;

/// The posterior of one threshold and what is needed to update it.
#[derive(Clone, Debug, PartialEq)]
pub struct Quest {
    config: QuestConfig,
    posterior: Vec<f64>,
    /// Probability of a response 1 at `x - T = i grain`, `i = -2m ..= 2m`.
    success: Vec<f64>,
    x_threshold: f64,
    quantile_order: f64,
}

/// What an update did beside the update.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Placement {
    /// The intensity lay on the table.
    OnTable,
    /// The intensity lay off the table; the likelihood of the table's end was used.
    OffTable,
}

impl Quest {
    /// The prior. Errors name the parameter that is out of its range.
    pub fn new(config: QuestConfig) -> Result<Self, Error> {
        config.check()?;
        let half = config.half_points();
        let offset = |i: usize, centre: usize| (i as f64 - centre as f64) * config.grain;

        let mut posterior: Vec<f64> =
            (0..=2 * half).map(|i| (-0.5 * (offset(i, half) / config.t_guess_sd).powi(2)).exp()).collect();
        let total: f64 = posterior.iter().sum();
        posterior.iter_mut().for_each(|value| *value /= total);

        let psychometric = config.psychometric();
        let offsets: Vec<f64> = (0..=4 * half).map(|i| offset(i, 2 * half)).collect();
        let x_threshold = tabulated_x_threshold(&psychometric, &offsets)?;
        let success: Vec<f64> = offsets.iter().map(|x| psychometric.unshifted(x + x_threshold)).collect();
        let quantile_order = quantile_order(success[0], success[success.len() - 1]);
        Ok(Self { config, posterior, success, x_threshold, quantile_order })
    }

    /// Multiplies the posterior by the likelihood of `response` at the intensity that was *shown*,
    /// which is the placement only where the display could show it.
    ///
    /// A NaN or infinite intensity and a response that no threshold explains are errors; the
    /// posterior is then unchanged.
    pub fn update(&mut self, intensity: f64, response: bool) -> Result<Placement, Error> {
        if !intensity.is_finite() {
            return Err(Error::parameter("intensity", intensity, "a finite number"));
        }
        let half = self.config.half_points() as f64;
        let steps = ((intensity - self.config.t_guess) / self.config.grain).round();
        let shift = steps.clamp(-half, half);
        let first = (2.0 * half + shift + half) as usize;
        let likelihood = |i: usize| {
            let success = self.success[first - i];
            if response { success } else { 1.0 - success }
        };
        let mut posterior: Vec<f64> =
            self.posterior.iter().enumerate().map(|(i, prior)| prior * likelihood(i)).collect();
        let total: f64 = posterior.iter().sum();
        if total.is_nan() || total <= 0.0 {
            return Err(Error::ImpossibleResponse { intensity, response });
        }
        posterior.iter_mut().for_each(|value| *value /= total);
        self.posterior = posterior;
        Ok(if shift == steps { Placement::OnTable } else { Placement::OffTable })
    }

    /// Mean of the posterior.
    pub fn mean(&self) -> f64 {
        self.config.t_guess + self.mean_offset()
    }

    /// The first point at which the posterior is highest.
    pub fn mode(&self) -> f64 {
        let mut best = 0;
        for (i, value) in self.posterior.iter().enumerate() {
            if *value > self.posterior[best] {
                best = i;
            }
        }
        self.config.t_guess + self.offset(best)
    }

    /// Standard deviation of the posterior.
    pub fn sd(&self) -> f64 {
        let mean = self.mean_offset();
        let variance: f64 =
            self.posterior.iter().enumerate().map(|(i, weight)| weight * (self.offset(i) - mean).powi(2)).sum();
        variance.sqrt()
    }

    /// Quantile of the posterior; `order` is clamped to 0..=1, and orders beyond the first or the
    /// last point give that point.
    pub fn quantile(&self, order: f64) -> f64 {
        let total: f64 = self.posterior.iter().sum();
        let wanted = order.clamp(0.0, 1.0) * total;
        let mut sum = 0.0;
        let mut below: Option<(f64, f64)> = None;
        for (i, value) in self.posterior.iter().enumerate() {
            // A plateau of the cumulative sum is represented by its first point.
            if *value <= 0.0 || sum + value <= sum {
                continue;
            }
            sum += value;
            let x = self.offset(i);
            if sum >= wanted {
                let (sum_below, x_below) = below.unwrap_or((0.0, x));
                let part = (wanted - sum_below) / (sum - sum_below);
                return self.config.t_guess + x_below + part * (x - x_below);
            }
            below = Some((sum, x));
        }
        self.config.t_guess + below.map_or(0.0, |(_, x)| x)
    }

    /// The intensity to show next.
    pub fn placement(&self) -> f64 {
        self.quantile(self.quantile_order)
    }

    /// Order of the quantile that [`placement`](Self::placement) gives.
    pub fn quantile_order(&self) -> f64 {
        self.quantile_order
    }

    /// Shift of the psychometric function that puts its threshold probability at 0.
    pub fn x_threshold(&self) -> f64 {
        self.x_threshold
    }

    /// The parameters.
    pub fn config(&self) -> &QuestConfig {
        &self.config
    }

    /// Probability of each table point, which sum to 1.
    pub fn posterior(&self) -> &[f64] {
        &self.posterior
    }

    /// The threshold of each table point.
    pub fn thresholds(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.posterior.len()).map(|i| self.config.t_guess + self.offset(i))
    }

    fn offset(&self, i: usize) -> f64 {
        (i as f64 - self.config.half_points() as f64) * self.config.grain
    }

    fn mean_offset(&self) -> f64 {
        self.posterior.iter().enumerate().map(|(i, weight)| weight * self.offset(i)).sum()
    }
}

/// Linear interpolation of the tabulated psychometric function at the threshold probability.
fn tabulated_x_threshold(psychometric: &Psychometric, offsets: &[f64]) -> Result<f64, Error> {
    let wanted = psychometric.threshold_probability;
    let values: Vec<f64> = offsets.iter().map(|x| psychometric.unshifted(*x)).collect();
    let above = values.partition_point(|value| *value < wanted);
    if above == 0 || above == values.len() {
        return Err(Error::parameter(
            "range",
            offsets[offsets.len() - 1] - offsets[0],
            "a table that reaches the threshold probability",
        ));
    }
    let (low, high) = (values[above - 1], values[above]);
    let part = (wanted - low) / (high - low);
    Ok(offsets[above - 1] + part * (offsets[above] - offsets[above - 1]))
}

/// Order of the quantile at which a trial is expected to tell most, from the ends of the
/// psychometric function (Psychtoolbox's QuestRecompute, after Pelli 1987):
/// `e = 1 / (1 + exp((h(p_high) - h(p_low)) / (p_low - p_high)))`, `h(p) = p ln p + (1 - p) ln(1 - p)`,
/// `order = (e - p_low) / (p_high - p_low)`.
fn quantile_order(p_low: f64, p_high: f64) -> f64 {
    // Keeps the logarithms finite at probabilities 0 and 1, as in the source.
    const TINY: f64 = 1e-14;
    let entropy = (p_high * (p_high + TINY).ln() - p_low * (p_low + TINY).ln())
        + ((1.0 - p_high + TINY) * (1.0 - p_high + TINY).ln() - (1.0 - p_low + TINY) * (1.0 - p_low + TINY).ln());
    let best = 1.0 / (1.0 + (entropy / (p_low - p_high)).exp());
    (best - p_low) / (p_high - p_low)
}
