//! The Weibull psychometric function in log intensity, and its inverse.
//!
//! `p(x) = g + (1 - g - l) F(x)` with `F(x) = 1 - exp(-10^(b (x - t)))`.
//!
//! `x` intensity in log10 units, `t` location in the same units (where `F = 1 - 1/e`), `b` slope (per decade), `g` guess
//! rate, `l` lapse rate (upper asymptote `1 - l`).
//! `F` is the probability that the artifact is *seen*; `p` is the probability of a *correct* answer.
//! Source: Watson and Pelli 1983, Eq. 1, written with the upper asymptote `1 - l`. QUEST's own form mixes with weight
//! `delta`: `p = delta g + (1 - delta)(g + (1 - g) F)`. That is this function with `l = delta (1 - g)`.
//!
//! Exponentials and logarithms are libm's: a fit, and all that is drawn from it, has the same bits on every machine.

use std::f64::consts::{LN_2, LN_10};

/// A Weibull psychometric function.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weibull {
    /// Location `t`, log10 units: the intensity at which 63.2 % of the artifacts are seen.
    pub location: f64,
    /// Slope `b`, per decade.
    pub slope: f64,
    /// Probability of a correct answer without seeing anything.
    pub guess: f64,
    /// One minus the upper asymptote.
    pub lapse: f64,
}

impl Weibull {
    /// `10^(b (x - t))`, the exponent of `F`.
    pub(crate) fn exponent(&self, x: f64) -> f64 {
        libm::exp(LN_10 * self.slope * (x - self.location))
    }

    /// Probability that the artifact is seen at intensity `x`.
    pub fn detection(&self, x: f64) -> f64 {
        -libm::expm1(-self.exponent(x))
    }

    /// Probability of a correct answer at intensity `x`.
    pub fn correct(&self, x: f64) -> f64 {
        self.guess + (1.0 - self.guess - self.lapse) * self.detection(x)
    }

    /// Probabilities of a correct and of a wrong answer at intensity `x`, each with all its digits where it is small.
    pub(crate) fn answers(&self, x: f64) -> [f64; 2] {
        let exponent = self.exponent(x);
        let [seen, unseen] = if exponent < LN_2 {
            let seen = -libm::expm1(-exponent);
            [seen, 1.0 - seen]
        } else {
            let unseen = libm::exp(-exponent);
            [1.0 - unseen, unseen]
        };
        let amplitude = 1.0 - self.guess - self.lapse;
        [self.guess + amplitude * seen, self.lapse + amplitude * unseen]
    }

    /// Intensity at which the artifact is seen with probability `detection`; `None` outside of the open interval 0..1.
    pub fn x_at_detection(&self, detection: f64) -> Option<f64> {
        let inside = detection > 0.0 && detection < 1.0;
        inside.then(|| self.location + libm::log10(-libm::log1p(-detection)) / self.slope)
    }

    /// Intensity at which the answer is correct with probability `probability`; `None` where the function never takes
    /// that value.
    pub fn x_at_correct(&self, probability: f64) -> Option<f64> {
        self.x_at_detection((probability - self.guess) / (1.0 - self.guess - self.lapse))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const QUEST: Weibull = Weibull { location: 0.0, slope: 3.5, guess: 0.5, lapse: 0.005 };

    #[test]
    fn the_inverse_returns_the_probability() {
        for probability in [0.51, 0.6, 0.75, 0.82, 0.99] {
            let x = QUEST.x_at_correct(probability).unwrap();
            assert!((QUEST.correct(x) - probability).abs() < 1e-12);
        }
        assert_eq!(QUEST.x_at_correct(0.4), None);
        assert_eq!(QUEST.x_at_correct(0.999), None);
    }

    #[test]
    fn the_probabilities_of_both_answers_keep_their_digits_where_they_are_small() {
        for x in [-1.0, -0.2, -0.05, 0.0, 0.2] {
            let [correct, wrong] = QUEST.answers(x);
            assert!((correct - QUEST.correct(x)).abs() < 1e-15 && (correct + wrong - 1.0).abs() < 1e-15);
        }
        let certain = Weibull { guess: 0.0, lapse: 0.0, ..QUEST };
        assert!((certain.answers(0.6)[1].ln() + certain.exponent(0.6)).abs() < 1e-10);
        assert!((certain.answers(-9.0)[0] / certain.exponent(-9.0) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_threshold_of_quest_is_its_closed_form() {
        assert!(
            (QUEST.x_at_correct(0.82).unwrap() - 0.004839437105186521).abs() < 1e-12,
            "xThreshold_analytic of the QUEST tables"
        );
    }
}
