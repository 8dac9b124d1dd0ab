//! Simulated people who differ: log-normal thresholds about a median person of any kind.
//!
//! `log10 ratio_i = log10 median_ratio + between_sd_log10 z_i`, z standard normal. The median
//! person's ratio is the target of an analysis; the arithmetic mean of the ratios is larger, by 3 %
//! at an SD of 0.1 log10.

use crate::draw::{Draw, Purpose};
use crate::error::{Error, require};
use crate::observer::{Observer, ObserverModel};

/// Simulated people of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cohort {
    /// The median person.
    pub median: ObserverModel,
    /// Standard deviation between people, log10 of the ratio.
    pub between_sd_log10: f64,
    /// Person and answers follow from it.
    pub seed: u64,
}

impl Cohort {
    /// Person `index`, the same for the same cohort and index.
    pub fn person(&self, index: u32) -> Result<Observer, Error> {
        let sd = self.between_sd_log10;
        require(sd.is_finite() && sd >= 0.0, "between_sd_log10", sd, "a finite number of at least 0")?;
        let mut draw = Draw::new(self.seed, Purpose::Person, index);
        let model = self.median.with_thresholds_times(libm::exp10(sd * draw.normal()));
        Observer::new(model, draw.bits32().into())
    }

    /// Seed of person `index`'s session.
    pub fn session_seed(&self, index: u32) -> u64 {
        let mut draw = Draw::new(self.seed, Purpose::Person, index);
        draw.normal();
        draw.bits32();
        draw.bits32().into()
    }
}
