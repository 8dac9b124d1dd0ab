//! The posterior of the threshold under one or several psychometric functions, and Bayes' rule on it.
//!
//! The weight `w_ki` is the probability of psychometric function k and threshold `T_i`, given the
//! responses. Before the first response the functions are equally likely and the threshold has the
//! prior `exp(-((T_i - centre) / sd)^2 / 2)`, normalised to 1. A response at intensity `x` multiplies
//! each weight by `p_k(x - T_i)` or `1 - p_k(x - T_i)`; the weights are then normalised. x is first
//! rounded to the table and clamped to it.

use crate::error::Error;
use crate::grid::{Grid, Shown, sum_by_index};
use crate::likelihood::Likelihood;

/// Responses between two normalisations in [`Posterior::threshold_after`]. A response lowers the
/// highest weight at most by the smallest `1 - p` above 0, 1e-16, so that 16 responses stay above the
/// smallest number, 1e-308.
const RESPONSES_PER_NORMALISATION: usize = 16;

/// Weights of every psychometric function and threshold.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Posterior {
    grid: Grid,
    likelihoods: Vec<Likelihood>,
    /// Of the thresholds; sums to 1.
    prior: Vec<f64>,
    /// One stretch of thresholds a psychometric function; sums to 1.
    weights: Vec<f64>,
}

impl Posterior {
    /// The prior, with at least one psychometric function and `prior_sd` above 0.
    pub(crate) fn new(grid: Grid, prior_sd: f64, likelihoods: Vec<Likelihood>) -> Self {
        let density = |i: usize| {
            let deviation = grid.offset(i) / prior_sd;
            libm::exp(-0.5 * deviation * deviation)
        };
        let mut prior: Vec<f64> = (0..grid.len()).map(density).collect();
        normalise(&mut prior);
        let weights = repeat(&prior, likelihoods.len());
        Self { grid, likelihoods, prior, weights }
    }

    /// Bayes' rule. Errors, which leave the weights as they were: an intensity that is NaN or
    /// infinite, and a response whose probability is zero everywhere.
    pub(crate) fn update(&mut self, intensity: f64, response: bool) -> Result<Shown, Error> {
        let (point, shown) = self.locate(intensity)?;
        let total: f64 = self
            .weights
            .chunks(self.grid.len())
            .zip(&self.likelihoods)
            .map(|(weights, likelihood)| probability_of(response, weights, likelihood.at(point)))
            .sum();
        if total.is_nan() || total <= 0.0 {
            return Err(Error::ImpossibleResponse { intensity, response });
        }
        for (weights, likelihood) in self.weights.chunks_mut(self.grid.len()).zip(&self.likelihoods) {
            multiply(weights, response, 1.0 / total, likelihood.at(point));
        }
        Ok(shown)
    }

    /// Weights of the thresholds that these responses alone leave of the prior, summed over the
    /// psychometric functions; sums to 1. Errors as in [`update`](Self::update).
    pub(crate) fn threshold_after(&self, responses: &[(f64, bool)]) -> Result<Vec<f64>, Error> {
        let mut weights = repeat(&self.prior, self.likelihoods.len());
        for batch in responses.chunks(RESPONSES_PER_NORMALISATION) {
            for (intensity, response) in batch {
                let (point, _) = self.locate(*intensity)?;
                for (weights, likelihood) in weights.chunks_mut(self.grid.len()).zip(&self.likelihoods) {
                    multiply(weights, *response, 1.0, likelihood.at(point));
                }
            }
            let total = normalise(&mut weights);
            if total.is_nan() || total <= 0.0 {
                let (intensity, response) = batch[batch.len() - 1];
                return Err(Error::ImpossibleResponse { intensity, response });
            }
        }
        Ok(self.marginal(&weights))
    }

    /// The thresholds.
    pub(crate) fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The psychometric functions.
    pub(crate) fn likelihoods(&self) -> &[Likelihood] {
        &self.likelihoods
    }

    /// One stretch of thresholds a psychometric function; all together sum to 1.
    pub(crate) fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The weights of each psychometric function.
    pub(crate) fn by_function(&self) -> std::slice::Chunks<'_, f64> {
        self.weights.chunks(self.grid.len())
    }

    /// Weights of the thresholds, summed over the psychometric functions.
    pub(crate) fn threshold(&self) -> Vec<f64> {
        self.marginal(&self.weights)
    }

    fn marginal(&self, weights: &[f64]) -> Vec<f64> {
        let mut stretches = weights.chunks(self.grid.len());
        let mut sums = stretches.next().unwrap_or_default().to_vec();
        for stretch in stretches {
            sums.iter_mut().zip(stretch).for_each(|(sum, weight)| *sum += weight);
        }
        sums
    }

    fn locate(&self, intensity: f64) -> Result<(usize, Shown), Error> {
        if !intensity.is_finite() {
            return Err(Error::parameter("intensity", intensity, "a finite number"));
        }
        Ok(self.grid.nearest(intensity))
    }
}

/// Sum of the weights times the likelihood of the response.
fn probability_of(response: bool, weights: &[f64], success: &[f64]) -> f64 {
    let success = &success[..weights.len()];
    if response {
        sum_by_index(weights, |i, weight| weight * success[i])
    } else {
        sum_by_index(weights, |i, weight| weight * (1.0 - success[i]))
    }
}

/// Multiplies the weights by `scale` and the likelihood of the response.
fn multiply(weights: &mut [f64], response: bool, scale: f64, success: &[f64]) {
    let pairs = weights.iter_mut().zip(success);
    if response {
        pairs.for_each(|(weight, success)| *weight *= success * scale);
    } else {
        pairs.for_each(|(weight, success)| *weight *= (1.0 - success) * scale);
    }
}

/// Divides by the sum and returns it.
fn normalise(weights: &mut [f64]) -> f64 {
    let total = sum_by_index(weights, |_, weight| weight);
    weights.iter_mut().for_each(|weight| *weight /= total);
    total
}

/// `count` equally likely copies.
fn repeat(prior: &[f64], count: usize) -> Vec<f64> {
    let mut weights = prior.repeat(count);
    weights.iter_mut().for_each(|weight| *weight /= count as f64);
    weights
}
