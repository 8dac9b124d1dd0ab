//! The psychometric function: how often a person is right at an intensity.
//!
//! `p(x) = delta gamma + (1 - delta) (1 - (1 - gamma) exp(-10^(beta (x - T + x_threshold))))`
//!
//! `x` is the intensity in log10 units, `T` the threshold, `gamma` the share of right answers by
//! guessing, `delta` the share of trials answered blindly, `beta` the slope (10^x has a Weibull
//! distribution function with exponent beta). `x_threshold` shifts the curve so that `p(T)` is the
//! threshold probability. Source: Watson & Pelli 1983, in the parameterisation of Psychtoolbox's
//! QuestCreate.
//!
//! The experiment's intensity is `x = log10(texel / radius) = -log10(ratio)`: finding the filtered
//! line among two pictures gets harder as the radius grows, so p rises with x.

use crate::error::{Error, require};

/// The psychometric function without its threshold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Psychometric {
    /// Slope, per log10 unit.
    pub beta: f64,
    /// Share of trials that are answered blindly.
    pub delta: f64,
    /// Share of right answers by guessing.
    pub gamma: f64,
    /// Probability of a right answer at the threshold.
    pub threshold_probability: f64,
}

impl Psychometric {
    /// Refuses parameters outside their ranges and a threshold probability that the curve misses.
    pub fn check(&self) -> Result<(), Error> {
        require(self.beta.is_finite() && self.beta > 0.0, "beta", self.beta, "a finite slope above 0")?;
        require((0.0..1.0).contains(&self.delta), "delta", self.delta, "0 to below 1")?;
        require((0.0..1.0).contains(&self.gamma), "gamma", self.gamma, "0 to below 1")?;
        require(
            self.threshold_probability > self.floor() && self.threshold_probability < self.ceiling(),
            "threshold probability",
            self.threshold_probability,
            "strictly between gamma and 1 - delta (1 - gamma), the ends of the psychometric function",
        )
    }

    /// Probability of a right answer at an intensity `offset` above the threshold, 0 to 1.
    pub fn probability(&self, offset: f64) -> f64 {
        self.unshifted(offset + self.x_threshold())
    }

    /// The shift that puts the threshold probability at offset 0, in closed form:
    /// `log10(ln((1 - delta)(1 - gamma) / (1 - delta + delta gamma - p))) / beta`.
    pub fn x_threshold(&self) -> f64 {
        let amplitude = (1.0 - self.delta) * (1.0 - self.gamma);
        let rest = self.ceiling() - self.threshold_probability;
        libm::log10(libm::log(amplitude / rest)) / self.beta
    }

    /// The curve with `T - x_threshold = 0`.
    pub(crate) fn unshifted(&self, x: f64) -> f64 {
        let seen = 1.0 - (1.0 - self.gamma) * libm::exp(-libm::pow(10.0, self.beta * x));
        self.delta * self.gamma + (1.0 - self.delta) * seen
    }

    /// Probability of a right answer far below the threshold.
    pub fn floor(&self) -> f64 {
        self.delta * self.gamma + (1.0 - self.delta) * self.gamma
    }

    /// Probability of a right answer far above the threshold.
    pub fn ceiling(&self) -> f64 {
        self.delta * self.gamma + (1.0 - self.delta)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KREUZER: Psychometric = Psychometric { beta: 3.5, delta: 0.01, gamma: 0.5, threshold_probability: 0.82 };

    #[test]
    fn the_closed_form_shift_is_the_published_one() {
        // tests/data/quest_reference_meta.json: xThreshold_analytic.
        assert!((KREUZER.x_threshold() - 0.004839437105186521).abs() < 1e-14);
    }

    #[test]
    fn the_threshold_probability_is_reached_at_the_threshold() {
        assert!((KREUZER.probability(0.0) - 0.82).abs() < 1e-14);
    }

    #[test]
    fn the_curve_rises_from_guessing_to_one_less_the_slips() {
        assert!((KREUZER.probability(-9.0) - 0.5).abs() < 1e-14);
        assert!((KREUZER.probability(9.0) - 0.995).abs() < 1e-14);
        let values: Vec<f64> = (-100..=100).map(|i| KREUZER.probability(f64::from(i) * 0.01)).collect();
        assert!(values.windows(2).all(|pair| pair[0] <= pair[1]));
    }

    #[test]
    fn a_threshold_probability_that_guessing_reaches_is_refused() {
        let at_floor = Psychometric { threshold_probability: 0.5, ..KREUZER };
        assert!(at_floor.check().unwrap_err().to_string().contains("threshold probability is 0.5"));
        for beta in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(Psychometric { beta, ..KREUZER }.check().is_err());
        }
    }
}
