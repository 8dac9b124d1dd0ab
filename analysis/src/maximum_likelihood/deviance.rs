//! How likely counts are under a function, and how far from it each of them lies.
//!
//! The deviance residual of a level with `k` correct of `n` is `sign(k/n - p) sqrt(d)`, `d = 2 [k ln(k / (n p)) +
//! (n - k) ln((n - k) / (n (1 - p)))]`; the deviance is the sum of the `d` (Wichmann & Hill 2001, Eqs. 6 and 10).

use super::Count;
use crate::weibull::Weibull;

/// `weight ln(probability)`, with `0 ln 0 = 0`.
fn term(weight: f64, probability: f64) -> f64 {
    if weight == 0.0 { 0.0 } else { weight * libm::log(probability) }
}

/// `k ln(correct) + (n - k) ln(wrong)`.
fn bernoulli(count: &Count, [correct, wrong]: [f64; 2]) -> f64 {
    term(count.correct, correct) + term(count.total - count.correct, wrong)
}

/// A level's share of the deviance, at least 0.
fn part(count: &Count, [correct, wrong]: [f64; 2]) -> f64 {
    let over = |observed: f64, probability: f64| observed / (count.total * probability);
    let ratios = [over(count.correct, correct), over(count.total - count.correct, wrong)];
    (2.0 * bernoulli(count, ratios)).max(0.0)
}

/// `ln L` without binomial coefficients.
pub fn log_likelihood(counts: &[Count], weibull: &Weibull) -> f64 {
    counts.iter().map(|count| bernoulli(count, weibull.answers(count.x))).sum()
}

/// `ln L` where the probabilities of a correct and of a wrong answer are the same at every level.
pub(crate) fn constant_log_likelihood(counts: &[Count], answers: [f64; 2]) -> f64 {
    counts.iter().map(|count| bernoulli(count, answers)).sum()
}

/// Twice the log likelihood ratio against the saturated model, which has a probability for each level.
pub(crate) fn deviance(counts: &[Count], weibull: &Weibull) -> f64 {
    counts.iter().map(|count| part(count, weibull.answers(count.x))).sum()
}

/// The deviance where the probabilities of a correct and of a wrong answer are the same at every level.
pub(crate) fn constant_deviance(counts: &[Count], answers: [f64; 2]) -> f64 {
    counts.iter().map(|count| part(count, answers)).sum()
}

/// The deviance residual of each level: positive where more answers were correct than the function expects. About
/// standard normal under the function where a level has many answers.
pub fn deviance_residuals(counts: &[Count], weibull: &Weibull) -> Vec<f64> {
    let residual = |count: &Count| {
        let answers = weibull.answers(count.x);
        let size = part(count, answers).sqrt();
        if count.correct < answers[0] * count.total { -size } else { size }
    };
    counts.iter().map(residual).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const FUNCTION: Weibull = Weibull { location: 0.0, slope: 3.5, guess: 0.5, lapse: 0.01 };

    #[test]
    fn a_residual_is_its_closed_form_with_its_sign() {
        // p = 0.5 + 0.49 (1 - 1/e) at x = 0.
        let p: f64 = 0.5 + 0.49 * (1.0 - (-1.0_f64).exp());
        for correct in [20.0_f64, 48.0] {
            let d = 2.0
                * (correct * (correct / (50.0 * p)).ln()
                    + (50.0 - correct) * ((50.0 - correct) / (50.0 * (1.0 - p))).ln());
            let [found] = deviance_residuals(&[Count { x: 0.0, correct, total: 50.0 }], &FUNCTION)[..] else {
                panic!()
            };
            assert!((found - (correct / 50.0 - p).signum() * d.sqrt()).abs() < 1e-12, "{found}");
        }
    }

    #[test]
    fn the_squares_of_the_residuals_add_up_to_the_deviance_which_is_the_likelihood_ratio() {
        let count = |x, correct| Count { x, correct, total: 40.0 };
        let counts = [count(-0.3, 19.0), count(0.0, 33.0), count(0.2, 40.0), count(0.4, 0.0)];
        let squares: f64 = deviance_residuals(&counts, &FUNCTION).iter().map(|residual| residual * residual).sum();
        let saturated: f64 = counts
            .iter()
            .map(|count| constant_log_likelihood(&[*count], [count.correct / 40.0, 1.0 - count.correct / 40.0]))
            .sum();
        assert!((squares - deviance(&counts, &FUNCTION)).abs() < 1e-12);
        assert!((squares - 2.0 * (saturated - log_likelihood(&counts, &FUNCTION))).abs() < 1e-10);
    }
}
