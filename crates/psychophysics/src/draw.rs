//! Random draws that a seed determines for good, on every platform and in every version.
//!
//! ChaCha with 8 rounds, its key the seed, a stream a purpose and a trial. A trial's draws so depend
//! on the seed and its number alone, not on what was drawn before. Numbers are made from the raw
//! 64-bit words here, because a library's distributions may change between versions.

use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// What a stream is for; the number is part of the stream's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// Order of the rounds.
    Rounds = 0,
    /// Order of the staircases of a round.
    Interleaving = 1,
    /// Pictures of a trial.
    Pictures = 2,
    /// Pictures of a practice trial.
    Practice = 3,
    /// A simulated person's answers.
    Answer = 4,
    /// A simulated person's answers in practice.
    PracticeAnswer = 5,
    /// Differences between simulated people.
    Person = 6,
    /// What a trial is for.
    Roles = 7,
}

/// A stream of random numbers.
pub(crate) struct Draw(ChaCha8Rng);

impl Draw {
    /// The stream of `seed` for `purpose` number `number`.
    pub(crate) fn new(seed: u64, purpose: Purpose, number: u32) -> Self {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        let mut generator = ChaCha8Rng::from_seed(key);
        generator.set_stream((purpose as u64) << 32 | u64::from(number));
        Self(generator)
    }

    /// Uniform in 0..1, a multiple of 2^-53.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A fair coin.
    pub(crate) fn coin(&mut self) -> bool {
        self.0.next_u64() >> 63 == 1
    }

    /// 32 random bits: seeds that every JSON reader keeps exactly.
    pub(crate) fn bits32(&mut self) -> u32 {
        (self.0.next_u64() >> 32) as u32
    }

    /// Uniform in 0..count; the bias of the multiplication is below 2^-50 for the counts here.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        ((u128::from(self.0.next_u64()) * count as u128) >> 64) as usize
    }

    /// A standard normal deviate (Box & Muller 1958).
    pub(crate) fn normal(&mut self) -> f64 {
        let radius = (-2.0 * libm::log(1.0 - self.unit())).sqrt();
        radius * libm::cos(std::f64::consts::TAU * self.unit())
    }

    /// A random order (Fisher & Yates).
    pub(crate) fn shuffle<T>(&mut self, values: &mut [T]) {
        for last in (1..values.len()).rev() {
            values.swap(last, self.below(last + 1));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_seed_purpose_and_number_give_equal_draws_and_others_do_not() {
        let first = |seed, purpose, number| Draw::new(seed, purpose, number).bits32();
        let reference = first(7, Purpose::Pictures, 3);
        assert_eq!(reference, first(7, Purpose::Pictures, 3));
        assert_ne!(reference, first(8, Purpose::Pictures, 3));
        assert_ne!(reference, first(7, Purpose::Practice, 3));
        assert_ne!(reference, first(7, Purpose::Pictures, 4));
    }

    #[test]
    fn unit_draws_have_the_moments_of_the_uniform_distribution() {
        let mut draw = Draw::new(1, Purpose::Answer, 0);
        let values: Vec<f64> = (0..20_000).map(|_| draw.unit()).collect();
        let mean = values.iter().sum::<f64>() / 20_000.0;
        // Standard error 0.289 / sqrt(20000) = 0.002.
        assert!((mean - 0.5).abs() < 0.008, "{mean}");
        assert!(values.iter().all(|value| (0.0..1.0).contains(value)));
    }

    #[test]
    fn normal_draws_have_mean_0_and_variance_1() {
        let mut draw = Draw::new(1, Purpose::Person, 0);
        let values: Vec<f64> = (0..20_000).map(|_| draw.normal()).collect();
        let mean = values.iter().sum::<f64>() / 20_000.0;
        let variance = values.iter().map(|v| v * v).sum::<f64>() / 20_000.0;
        assert!(mean.abs() < 0.03, "{mean}");
        assert!((variance - 1.0).abs() < 0.04, "{variance}");
    }

    #[test]
    fn every_order_of_three_comes_up_equally_often() {
        let mut counts = std::collections::HashMap::new();
        for number in 0..6000 {
            let mut order = [0, 1, 2];
            Draw::new(5, Purpose::Rounds, number).shuffle(&mut order);
            *counts.entry(order).or_insert(0) += 1;
        }
        assert_eq!(counts.len(), 6);
        // Standard deviation of a count sqrt(6000 x 5/36) = 29.
        assert!(counts.values().all(|count| (880..=1120).contains(count)), "{counts:?}");
    }
}
