//! From the median person's threshold to the ratio that hides the texels from most viewers.
//!
//! `log10 c(v, d) = m + z(v) s + log10(w(d0) / w(d)) / b` with `w(d) = -ln(1 - d / (1 - e))`.
//!
//! `v` share of viewers, `d` probability that one of them sees the artifact on a trial, `m` mean
//! log10 ratio at the threshold, `d0` detection at the threshold (0.64 at 82 % correct), `s`
//! standard deviation between people, `z` normal quantile, `b` slope of the psychometric function,
//! `e` share of trials on which a person does not look. Detection counts those trials as unseen, so that
//! `d = (p - guess) / (1 - guess)` of the answers that are correct.
//!
//! `s^2 = S^2 - V`: the variance of the people's means less the mean variance `V` of their
//! measurement errors, at least 0. Interval: the limits of the three terms are combined by MOVER
//! (Zou and Donner 2008): `L = q - sqrt(sum (term - its lower limit)^2)`, `U` likewise. Limits of `m`:
//! Student's t. Limits of `s`: chi-squared limits of `S^2`, less `V`. Limits of `b`: an assumption
//! ([`SLOPE_CI95`]), because a fixed-slope study does not measure it.
//!
//! Assumes log-normal thresholds: far quantiles (99 % of viewers) lean on that, not on data.

use std::f64::consts::LN_10;

use statrs::distribution::{ChiSquared, ContinuousCDF, Normal};

use crate::{Error, estimate::MeanOverPeople};

/// Shares of viewers for which a ratio is reported.
pub const VIEWERS: [f64; 4] = [0.50, 0.90, 0.95, 0.99];

/// Detection probabilities for which a ratio is reported: Kreuzer's threshold (82 % correct with
/// two alternatives, seen on 64 % of trials), and seen on one trial in ten.
pub const DETECTIONS: [f64; 2] = [0.64, 0.10];

/// Factors on the assumed slope that bound it in 19 of 20 people: slopes of contrast and
/// position detection in the literature lie within a factor of about the square root of two of 3.5.
pub const SLOPE_CI95: [f64; 2] = [std::f64::consts::FRAC_1_SQRT_2, std::f64::consts::SQRT_2];

/// 97.5 % quantile of the standard normal distribution.
const NORMAL_975: f64 = 1.959_963_984_540_054;

/// A group of people, as the curve needs it; log10 units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Population {
    /// Mean over people of the log10 ratio at threshold.
    pub thresholds: MeanOverPeople,
    /// Mean variance of one person's measurement, log10 units squared.
    pub measurement_variance: f64,
    /// Detection probability at the threshold.
    pub detection_at_threshold: f64,
    /// Slope of the psychometric function, per decade.
    pub slope: f64,
    /// Share of trials answered blindly.
    pub blind_share: f64,
}

/// The ratio that hides the artifact from `viewers` at `detection`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PopulationPoint {
    /// Share of viewers who see the artifact at most that often.
    pub viewers: f64,
    /// Probability of seeing it on one trial.
    pub detection: f64,
    /// Ratio, radius in texels.
    pub ratio: f64,
    /// Standard error of the ratio: half of its interval in the logarithm, by the normal quantile.
    pub standard_error: f64,
    /// 95 % interval of the ratio.
    pub ci95: [f64; 2],
}

impl Population {
    /// Standard deviation between people without measurement noise, log10 units, at least 0.
    pub fn between_sd(&self) -> f64 {
        without_noise(self.thresholds.standard_deviation.powi(2), self.measurement_variance)
    }

    /// 95 % limits of [`Self::between_sd`], log10 units.
    ///
    /// # Errors
    /// Never for a [`MeanOverPeople`] of at least two people.
    pub fn between_sd_ci95(&self) -> Result<[f64; 2], Error> {
        let degrees = (self.thresholds.people - 1) as f64;
        let chi_squared =
            ChiSquared::new(degrees).map_err(|reason| Error::CannotFit(format!("chi-squared: {reason}")))?;
        let squares = degrees * self.thresholds.standard_deviation.powi(2);
        let limit = |quantile| {
            let variance = squares / chi_squared.inverse_cdf(quantile);
            without_noise(variance, self.measurement_variance)
        };
        Ok([limit(0.975), limit(0.025)])
    }

    /// The ratio for `viewers` and `detection`, both inside 0..1, `viewers` at least one half.
    ///
    /// # Errors
    /// Names the argument that is out of range.
    pub fn ratio(&self, viewers: f64, detection: f64) -> Result<PopulationPoint, Error> {
        check("viewers", viewers, (0.5..1.0).contains(&viewers), "at least 0.5 and below 1")?;
        let seeing = 1.0 - self.blind_share;
        let allowed = "above 0 and below the share of trials that are looked at";
        check("detection", detection, detection > 0.0 && detection < seeing, allowed)?;
        let z = Normal::standard().inverse_cdf(viewers);
        let seen = |probability: f64| -(-probability / seeing).ln_1p();
        let decades = (seen(self.detection_at_threshold) / seen(detection)).log10();
        let shifts = SLOPE_CI95.map(|factor| decades / (self.slope * factor));

        let median = [self.thresholds.mean, self.thresholds.ci95[0], self.thresholds.ci95[1]];
        let [lower_sd, upper_sd] = self.between_sd_ci95()?;
        let spread = [z * self.between_sd(), z * lower_sd, z * upper_sd];
        let shift = [decades / self.slope, shifts[0].min(shifts[1]), shifts[0].max(shifts[1])];

        let terms = [median, spread, shift];
        let middle: f64 = terms.iter().map(|term| term[0]).sum();
        let reach =
            |limit: usize| -> f64 { terms.iter().map(|term| (term[limit] - term[0]).powi(2)).sum::<f64>().sqrt() };
        let (below, above) = (reach(1), reach(2));
        let ratio = 10_f64.powf(middle);
        Ok(PopulationPoint {
            viewers,
            detection,
            ratio,
            standard_error: ratio * LN_10 * (below + above) / 2.0 / NORMAL_975,
            ci95: [10_f64.powf(middle - below), 10_f64.powf(middle + above)],
        })
    }

    /// The ratios of all [`DETECTIONS`] x [`VIEWERS`].
    ///
    /// # Errors
    /// As [`Self::ratio`].
    pub fn curve(&self) -> Result<Vec<PopulationPoint>, Error> {
        DETECTIONS
            .iter()
            .flat_map(|&detection| VIEWERS.iter().map(move |&viewers| (viewers, detection)))
            .map(|(viewers, detection)| self.ratio(viewers, detection))
            .collect()
    }
}

fn without_noise(total_variance: f64, noise_variance: f64) -> f64 {
    (total_variance - noise_variance).max(0.0).sqrt()
}

fn check(name: &'static str, value: f64, good: bool, allowed: &'static str) -> Result<(), Error> {
    if good {
        return Ok(());
    }
    Err(Error::Argument { name, value: value.to_string(), allowed })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ten people with the mean log10 3.47 and the standard deviation 0.1 exactly.
    fn population(measurement_variance: f64) -> Population {
        let offset = 0.1 * (9.0_f64 / 10.0).sqrt();
        let values: Vec<f64> =
            (0..10).map(|person| 3.47_f64.log10() + if person % 2 == 0 { offset } else { -offset }).collect();
        Population {
            thresholds: MeanOverPeople::of(&values).unwrap(),
            measurement_variance,
            detection_at_threshold: 0.64,
            slope: 3.5,
            blind_share: 0.0,
        }
    }

    #[test]
    fn the_curve_has_the_known_values_at_between_person_sd_one_tenth() {
        let population = population(0.0);
        for (viewers, detection, expected) in [(0.5, 0.64, 3.47), (0.5, 0.1, 6.64), (0.95, 0.1, 9.70)] {
            let point = population.ratio(viewers, detection).unwrap();
            assert!((point.ratio - expected).abs() < 0.01, "{point:?} is not {expected}");
        }
    }

    #[test]
    fn the_median_at_the_threshold_has_the_t_interval() {
        let population = population(0.0);
        let point = population.ratio(0.5, 0.64).unwrap();
        let expected = population.thresholds.ci95.map(|limit| 10_f64.powf(limit));
        assert!((point.ci95[0] - expected[0]).abs() < 1e-9);
        assert!((point.ci95[1] - expected[1]).abs() < 1e-9);
    }

    #[test]
    fn blind_trials_hardly_move_the_curve() {
        let population = Population { blind_share: 0.01, ..population(0.0) };
        let point = population.ratio(0.5, 0.64).unwrap();
        assert!((point.ratio - 3.47).abs() < 1e-9, "the threshold itself does not move");
        let point = population.ratio(0.5, 0.1).unwrap();
        assert!((point.ratio - 6.654).abs() < 0.001, "{point:?}");
        assert!(population.ratio(0.5, 0.995).is_err(), "nobody looks that often");
    }

    #[test]
    fn measurement_noise_is_taken_out_of_the_spread_and_never_leaves_a_negative_variance() {
        assert!((population(0.0036).between_sd() - 0.08).abs() < 1e-12);
        assert_eq!(population(0.5).between_sd(), 0.0);
        let point = population(0.5).ratio(0.99, 0.64).unwrap();
        assert!(point.ci95[0] <= point.ratio && point.ratio <= point.ci95[1]);
    }

    #[test]
    fn more_viewers_and_rarer_detection_never_need_a_smaller_ratio() {
        let curve = population(0.001).curve().unwrap();
        for pair in curve.windows(2) {
            assert!(pair[1].ratio > pair[0].ratio || pair[1].detection != pair[0].detection);
        }
        assert!(curve[4].ratio > curve[0].ratio);
    }

    #[test]
    fn a_share_of_all_viewers_is_refused() {
        assert!(population(0.0).ratio(1.0, 0.1).is_err());
        assert!(population(0.0).ratio(0.9, 0.0).is_err());
    }
}
