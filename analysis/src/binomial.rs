//! Draws of a binomial count that a seed determines for good.
//!
//! The distribution is tabulated: from the mode both ways by the ratio of neighbours, `P(k + 1) / P(k) = (n - k) / (k + 1)
//! p / (1 - p)`, until a term is nothing beside the mode's. A draw is the inverse of the table's running sum. Basic arithmetic
//! alone, so the same bits everywhere.

/// Terms below this share of the mode's are left out: what they would add is below the rounding of the sum.
const TERM_LEAST: f64 = 1e-18;

/// The table of a binomial distribution.
pub(crate) struct Binomial {
    /// Count of the first entry.
    first: f64,
    /// Running sums of the terms, the mode's being 1.
    sums: Vec<f64>,
}

impl Binomial {
    /// Of `total` answers, a whole number, each correct with probability `correct` and wrong with `wrong`, which are at
    /// least 0 and add up to 1. The table has about 18 standard deviations.
    pub fn new(total: f64, [correct, wrong]: [f64; 2]) -> Self {
        let mode = ((total + 1.0) * correct).floor().clamp(0.0, total);
        let mut below = Vec::new();
        let (mut k, mut term) = (mode, 1.0);
        while k > 0.0 {
            term *= k / (total - k + 1.0) * (wrong / correct);
            if term < TERM_LEAST {
                break;
            }
            k -= 1.0;
            below.push(term);
        }
        let first = k;
        let mut terms: Vec<f64> = below.into_iter().rev().collect();
        terms.push(1.0);
        (k, term) = (mode, 1.0);
        while k < total {
            term *= (total - k) / (k + 1.0) * (correct / wrong);
            if term < TERM_LEAST {
                break;
            }
            k += 1.0;
            terms.push(term);
        }
        let mut sum = 0.0;
        let running = |term: f64| {
            sum += term;
            sum
        };
        Self { first, sums: terms.into_iter().map(running).collect() }
    }

    /// The count at which the distribution function reaches `unit`, uniform in 0..1.
    pub fn draw(&self, unit: f64) -> f64 {
        let sum = self.sums[self.sums.len() - 1];
        let index = self.sums.partition_point(|below| *below <= unit * sum);
        self.first + index.min(self.sums.len() - 1) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A unit draw for each of `count` equal parts of 0..1.
    fn stratified(table: &Binomial, count: usize) -> Vec<f64> {
        (0..count).map(|index| table.draw((index as f64 + 0.5) / count as f64)).collect()
    }

    #[test]
    fn the_draws_of_small_counts_have_the_closed_form_shares() {
        let draws = stratified(&Binomial::new(3.0, [0.25, 0.75]), 64_000);
        for (k, share) in [(0.0, 27.0 / 64.0), (1.0, 27.0 / 64.0), (2.0, 9.0 / 64.0), (3.0, 1.0 / 64.0)] {
            let found = draws.iter().filter(|draw| **draw == k).count();
            assert_eq!(found, (64_000.0 * share) as usize, "{k}");
        }
    }

    #[test]
    fn mean_and_variance_are_those_of_the_distribution_up_to_a_billion_answers() {
        for (total, p) in [(10.0, 0.5), (90.0, 0.99), (1e5, 0.73), (1e9, 0.82), (1e9, 1e-9)] {
            let draws = stratified(&Binomial::new(total, [p, 1.0 - p]), 200_000);
            let mean = draws.iter().sum::<f64>() / 200_000.0;
            let variance = draws.iter().map(|draw| (draw - mean).powi(2)).sum::<f64>() / 200_000.0;
            let expected = total * p * (1.0 - p);
            assert!((mean - total * p).abs() < 1e-3 * expected.sqrt() + 1e-12 * total, "{total} {p}: {mean}");
            assert!((variance / expected - 1.0).abs() < 2e-3, "{total} {p}: {variance} is not {expected}");
            assert!(draws.iter().all(|draw| (0.0..=total).contains(draw) && draw.fract() == 0.0));
        }
    }

    #[test]
    fn the_certain_and_the_impossible_are_drawn_always_and_never() {
        for unit in [0.0, 0.5, 1.0 - f64::EPSILON] {
            assert_eq!(Binomial::new(7.0, [1.0, 0.0]).draw(unit), 7.0);
            assert_eq!(Binomial::new(7.0, [0.0, 1.0]).draw(unit), 0.0);
        }
    }
}
