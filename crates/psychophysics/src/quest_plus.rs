//! QUEST+: the Bayesian staircase for threshold, slope and lapse together (Watson 2017, Journal of
//! Vision 17(3):10).
//!
//! The posterior lives on the grid of thresholds x slopes x lapses. Its thresholds, their prior, the
//! psychometric function, the threshold's definition and the update are QUEST's; slopes and lapses
//! are equally likely at first. With one slope and one lapse the posterior is QUEST's.
//!
//! The next placement is the intensity whose response is expected to leave the least entropy. A
//! response is binary, so the expected loss of entropy is the mutual information of the response and
//! the parameters,
//!
//! `I(x) = H(sum_k w_k p_k(x)) - sum_k w_k H(p_k(x))`, `H(p) = -p ln p - (1 - p) ln(1 - p)`,
//!
//! with `w_k` the posterior and `p_k(x)` the probability of a response 1 under parameters k. H of the
//! tabulated p is tabulated too, so that an intensity costs two scalar products and one logarithm
//! pair. Among equal intensities the lowest is taken.
//!
//! A deviation from the paper: its lapse is the share of wrong answers at high intensity; this
//! crate's is Psychtoolbox's share of blind answers, `delta`, of which `1 - gamma` are wrong.

use serde::{Deserialize, Serialize};

use crate::error::{Error, require};
use crate::grid::{Grid, Shown};
use crate::likelihood::{Likelihood, window};
use crate::posterior::Posterior;
use crate::psychometric::Psychometric;

/// Widest distance of two intensities that are compared, log10. The best intensity is then at most
/// half of it off; a test shows what that costs: less than a twentieth of the information at a slope of 3.5.
const INTENSITY_STEP_LOG10: f64 = 0.05;

/// Largest grid of thresholds x slopes x lapses: beyond it a placement takes seconds.
const POINTS_MAX: usize = 100_000;

/// Parameters of one QUEST+.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct QuestPlusConfig {
    /// Centre of the threshold's prior and of the table.
    pub prior_centre_log10: f64,
    /// Standard deviation of the threshold's prior; one much larger than the table is a uniform prior.
    pub prior_sd_log10: f64,
    /// Probability of a response 1 at the threshold.
    pub threshold_probability: f64,
    /// Probability of a response 1 by guessing.
    pub guess_probability: f64,
    /// Slopes of the psychometric function, rising.
    pub slopes_per_log10: Vec<f64>,
    /// Shares of blind responses, rising.
    pub lapse_probabilities: Vec<f64>,
    /// Step of the table of thresholds.
    pub table_step_log10: f64,
    /// Width of the table of thresholds; it reaches half of it to either side of the centre.
    pub table_width_log10: f64,
}

/// The joint posterior of threshold, slope and lapse.
#[derive(Clone, Debug, PartialEq)]
pub struct QuestPlus {
    config: QuestPlusConfig,
    posterior: Posterior,
    /// The posterior's thresholds, summed over slopes and lapses.
    threshold: Vec<f64>,
    /// H of each likelihood's values.
    entropies: Vec<Vec<f64>>,
}

impl QuestPlusConfig {
    /// Slope, then lapse, of each psychometric function: the lapse runs fastest.
    fn psychometrics(&self) -> impl Iterator<Item = Psychometric> + '_ {
        self.slopes_per_log10.iter().flat_map(|beta| {
            self.lapse_probabilities.iter().map(|delta| Psychometric {
                beta: *beta,
                delta: *delta,
                gamma: self.guess_probability,
                threshold_probability: self.threshold_probability,
            })
        })
    }

    fn grid(&self) -> Grid {
        Grid::new(self.prior_centre_log10, self.table_step_log10, self.table_width_log10)
    }

    fn check(&self) -> Result<(), Error> {
        Grid::check(
            ("prior_centre_log10", self.prior_centre_log10),
            ("table_step_log10", self.table_step_log10),
            ("table_width_log10", self.table_width_log10),
        )?;
        let sd = self.prior_sd_log10;
        require(sd.is_finite() && sd > 0.0, "prior_sd_log10", sd, "a finite number above 0")?;
        let lists = [("slopes_per_log10", &self.slopes_per_log10), ("lapse_probabilities", &self.lapse_probabilities)];
        for (field, list) in lists {
            require(!list.is_empty(), field, "empty", "at least one value")?;
            let rises = list.windows(2).all(|pair| pair[0] < pair[1]);
            require(rises, field, format!("{list:?}"), "values that rise, none of them twice")?;
        }
        let points = self.grid().len() * self.slopes_per_log10.len() * self.lapse_probabilities.len();
        require(points <= POINTS_MAX, "points of the grid", points, "at most 100000 thresholds x slopes x lapses")?;
        self.psychometrics().try_for_each(|psychometric| psychometric.check())
    }
}

impl QuestPlus {
    /// The prior. Errors name the parameter that is out of its range.
    pub fn new(config: QuestPlusConfig) -> Result<Self, Error> {
        config.check()?;
        let grid = config.grid();
        let likelihoods = config.psychometrics().map(|psychometric| Likelihood::new(&psychometric, &grid));
        let likelihoods = likelihoods.collect::<Result<_, _>>()?;
        Ok(Self::with_likelihoods(config, likelihoods))
    }

    fn with_likelihoods(config: QuestPlusConfig, likelihoods: Vec<Likelihood>) -> Self {
        let entropies = likelihoods.iter().map(|likelihood| likelihood.values().iter().map(|p| entropy(*p)).collect());
        let entropies = entropies.collect();
        let posterior = Posterior::new(config.grid(), config.prior_sd_log10, likelihoods);
        let threshold = posterior.threshold();
        Self { config, posterior, threshold, entropies }
    }

    /// Multiplies the posterior by the likelihood of `response` at the intensity that was *shown*.
    ///
    /// A NaN or infinite intensity and a response that no parameters explain are errors; the
    /// posterior is then unchanged.
    pub fn update(&mut self, intensity: f64, response: bool) -> Result<Shown, Error> {
        let shown = self.posterior.update(intensity, response)?;
        self.threshold = self.posterior.threshold();
        Ok(shown)
    }

    /// The intensity to show next: the one with the most [`information`](Self::information) among
    /// table points at most 0.05 log10 apart, the centre among them.
    pub fn placement(&self) -> f64 {
        let grid = self.posterior.grid();
        let stride = ((INTENSITY_STEP_LOG10 / grid.step + 1e-9) as usize).max(1);
        let points: Vec<usize> = (grid.half % stride..grid.len()).step_by(stride).collect();
        let mut best = (0, f64::NEG_INFINITY);
        for (point, information) in points.iter().zip(self.information_at(&points)) {
            if information > best.1 {
                best = (*point, information);
            }
        }
        grid.centre + grid.offset(best.0)
    }

    /// Entropy in nats that a response at this intensity, rounded to the table, is expected to take
    /// from the posterior: 0 to ln 2. NaN counts as the table's lowest intensity.
    pub fn information(&self, intensity: f64) -> f64 {
        let (point, _) = self.posterior.grid().nearest(intensity);
        self.information_at(&[point])[0]
    }

    /// Mean of the threshold.
    pub fn mean(&self) -> f64 {
        self.posterior.grid().mean(&self.threshold)
    }

    /// Standard deviation of the threshold.
    pub fn sd(&self) -> f64 {
        self.posterior.grid().sd(&self.threshold)
    }

    /// Quantile of the threshold; `order` is clamped to 0..=1.
    pub fn quantile(&self, order: f64) -> f64 {
        self.posterior.grid().quantile(&self.threshold, order)
    }

    /// Posterior mean of the slope, per log10 unit.
    pub fn mean_slope_per_log10(&self) -> f64 {
        mean(&self.config.slopes_per_log10, &self.slope_posterior())
    }

    /// Posterior mean of the share of blind responses.
    pub fn mean_lapse_probability(&self) -> f64 {
        mean(&self.config.lapse_probabilities, &self.lapse_posterior())
    }

    /// Probability of each threshold of the table; sums to 1.
    pub fn threshold_posterior(&self) -> &[f64] {
        &self.threshold
    }

    /// Probability of each slope of the configuration; sums to 1.
    pub fn slope_posterior(&self) -> Vec<f64> {
        let lapses = self.config.lapse_probabilities.len();
        self.function_posterior().chunks(lapses).map(|of_slope| of_slope.iter().sum()).collect()
    }

    /// Probability of each lapse of the configuration; sums to 1.
    pub fn lapse_posterior(&self) -> Vec<f64> {
        let lapses = self.config.lapse_probabilities.len();
        let functions = self.function_posterior();
        (0..lapses).map(|lapse| functions.iter().skip(lapse).step_by(lapses).sum()).collect()
    }

    /// Probability of each slope, lapse and threshold; the threshold runs fastest, the slope slowest.
    pub fn posterior(&self) -> &[f64] {
        self.posterior.weights()
    }

    /// The parameters.
    pub fn config(&self) -> &QuestPlusConfig {
        &self.config
    }

    /// The table behind it.
    pub(crate) fn table(&self) -> &Posterior {
        &self.posterior
    }

    /// The information at table points. One psychometric function after the other, so that its tables
    /// stay in the processor's nearest cache for all of the points.
    fn information_at(&self, points: &[usize]) -> Vec<f64> {
        let mut sums = vec![(0.0, 0.0); points.len()];
        let functions = self.posterior.by_function().zip(self.posterior.likelihoods()).zip(&self.entropies);
        for ((weights, likelihood), entropies) in functions {
            for ((success, entropy_after), point) in sums.iter_mut().zip(points) {
                let (p, h) = scalar_products(weights, likelihood.at(*point), window(entropies, *point));
                *success += p;
                *entropy_after += h;
            }
        }
        sums.into_iter().map(|(success, entropy_after)| entropy(success) - entropy_after).collect()
    }

    fn function_posterior(&self) -> Vec<f64> {
        self.posterior.by_function().map(|weights| weights.iter().sum()).collect()
    }
}

/// `-p ln p - (1 - p) ln(1 - p)`, 0 at and beyond the ends.
fn entropy(p: f64) -> f64 {
    let term = |p: f64| if p > 0.0 { -p * libm::log(p) } else { 0.0 };
    term(p) + term(1.0 - p)
}

/// Sums of `weights a` and `weights b`, in interleaved parts that do not wait for one another.
fn scalar_products(weights: &[f64], a: &[f64], b: &[f64]) -> (f64, f64) {
    const LANES: usize = 8;
    let ((weights, rest), (a, a_rest), (b, b_rest)) =
        (weights.as_chunks::<LANES>(), a.as_chunks::<LANES>(), b.as_chunks::<LANES>());
    let mut sums = ([0.0; LANES], [0.0; LANES]);
    for ((weights, a), b) in weights.iter().zip(a).zip(b) {
        for lane in 0..LANES {
            sums.0[lane] += weights[lane] * a[lane];
            sums.1[lane] += weights[lane] * b[lane];
        }
    }
    let tail = |values: &[f64]| rest.iter().zip(values).map(|(weight, value)| weight * value).sum::<f64>();
    (sums.0.iter().sum::<f64>() + tail(a_rest), sums.1.iter().sum::<f64>() + tail(b_rest))
}

fn mean(values: &[f64], weights: &[f64]) -> f64 {
    values.iter().zip(weights).map(|(value, weight)| value * weight).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Watson 2017 works in decibels, 20 a log10 unit, with thresholds and intensities from -40 to 0,
    /// guessing 0.5, and the threshold where the Weibull function's exponent is 1 (`x_threshold` 0).
    /// His lapse is the share of wrong answers, half of this crate's.
    fn watson(slopes: &[f64], watsons_lapses: &[f64]) -> QuestPlus {
        let config = QuestPlusConfig {
            prior_centre_log10: -1.0,
            prior_sd_log10: 1e9,
            threshold_probability: 0.8,
            guess_probability: 0.5,
            slopes_per_log10: slopes.to_vec(),
            lapse_probabilities: watsons_lapses.iter().map(|lapse| 2.0 * lapse).collect(),
            table_step_log10: 0.05,
            table_width_log10: 2.0,
        };
        let grid = config.grid();
        let likelihoods = config.psychometrics().map(|curve| Likelihood::shifted(&curve, 0.0, &grid)).collect();
        QuestPlus::with_likelihoods(config, likelihoods)
    }

    /// Placements in decibels for these responses (1 correct), each at its placement.
    fn placements_db(quest_plus: &mut QuestPlus, responses: &str) -> Vec<i32> {
        let place = |response| {
            let placement = quest_plus.placement();
            quest_plus.update(placement, response == '1').unwrap();
            (20.0 * placement).round() as i32
        };
        responses.chars().map(place).collect()
    }

    /// Threshold in decibels, slope and Watson's lapse of the highest point of the posterior.
    fn mode(quest_plus: &QuestPlus) -> (i32, f64, f64) {
        let points = quest_plus.posterior().iter().enumerate();
        let (best, _) = points.max_by(|a, b| a.1.total_cmp(b.1)).unwrap();
        let config = quest_plus.config();
        let (function, threshold) = (best / 41, best % 41);
        let lapses = config.lapse_probabilities.len();
        let slope = config.slopes_per_log10[function / lapses];
        (threshold as i32 - 40, slope, config.lapse_probabilities[function % lapses] / 2.0)
    }

    #[test]
    fn watsons_example_of_a_threshold_is_met_trial_by_trial() {
        // Watson 2017, "Estimation of contrast threshold {1, 1, 2}".
        let mut quest_plus = watson(&[3.5], &[0.02]);
        let placements = placements_db(&mut quest_plus, "11110011111111011011011111111111");
        let expected = [
            -18, -22, -25, -28, -30, -22, -13, -15, -16, -18, -19, -20, -21, -22, -23, -19, -20, -20, -18, -18, -19,
            -17, -17, -18, -18, -18, -19, -19, -19, -19, -19, -19,
        ];
        assert_eq!(placements, expected);
        assert_eq!(mode(&quest_plus), (-20, 3.5, 0.02));
    }

    #[test]
    fn watsons_example_of_threshold_and_slope_is_met_trial_by_trial() {
        // Watson 2017, "Implementation".
        let mut quest_plus = watson(&[2.0, 3.0, 4.0, 5.0], &[0.02]);
        let responses = "1011111111111011011101111011111111111011001111010111011111111111";
        let placements = placements_db(&mut quest_plus, responses);
        let expected = [
            -18, -22, -12, -13, -15, -16, -17, -18, -19, -21, -24, -25, -26, -27, -21, -22, -23, -20, -20, -20, -21,
            -19, -19, -20, -20, -20, -19, -19, -19, -19, -19, -20, -20, -20, -20, -20, -21, -21, -20, -20, -20, -19,
            -18, -18, -19, -19, -19, -18, -18, -17, -18, -18, -18, -17, -17, -17, -17, -17, -17, -17, -18, -18, -18,
            -18,
        ];
        assert_eq!(placements, expected);
        assert_eq!(mode(&quest_plus), (-20, 3.0, 0.02));
    }

    #[test]
    fn watsons_example_of_threshold_slope_and_lapse_is_met_trial_by_trial() {
        // Watson 2017, "Estimation of contrast threshold, slope, and lapse {1, 3, 2}".
        let mut quest_plus = watson(&[2.0, 3.0, 4.0, 5.0], &[0.0, 0.01, 0.02, 0.03, 0.04]);
        let responses = "1111001111111101011111110111111110111111111011101111111101111110".to_owned()
            + "1111111111111010111101101111111011111111111111101110100111101111";
        let placements = placements_db(&mut quest_plus, &responses);
        let expected = [
            -18, -22, -25, -28, -30, -21, -12, -14, -15, -16, -18, -19, -20, -22, -23, -18, -19, -16, -17, -17, -18,
            -18, -18, -19, -19, -17, -17, -18, -18, -18, -18, -19, -19, -20, -18, -18, -18, -18, -18, -19, -19, -19,
            -19, -20, -18, -18, -18, -18, -18, -18, -18, -18, -18, -19, -19, -19, -20, -18, -18, -18, -18, -19, -19,
            -19, -18, -18, -18, -18, -19, -19, -19, -19, -19, -19, -19, -19, -20, -21, -19, -19, -19, -19, -19, -19,
            -19, -18, -19, -19, -16, -16, -16, -16, -16, -16, 0, 0, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19,
            -19, -19, -19, -19, -21, -21, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19,
            -19,
        ];
        assert_eq!(placements, expected);
        assert_eq!(mode(&quest_plus), (-20, 5.0, 0.04));
    }
}
