//! Simulated people who differ: log-normal thresholds about a median person.
//!
//! `log10 ratio_i = log10 median_ratio + between_sd_log10 z_i`, z standard normal. The median
//! person's ratio is the target of an analysis; the arithmetic mean of the ratios is larger, by 3 %
//! at an SD of 0.1 log10.

use crate::draw::{Draw, Purpose};
use crate::error::{Error, require};
use crate::observer::{ObserverParameters, WeibullObserver};

/// A population of simulated people.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Population {
    /// The median person.
    pub median: ObserverParameters,
    /// Standard deviation between people, log10 of the ratio.
    pub between_sd_log10: f64,
    /// Person and answers follow from it.
    pub seed: u64,
}

impl Population {
    /// Person `index`, the same for the same population and index.
    pub fn person(&self, index: u32) -> Result<WeibullObserver, Error> {
        require(
            self.between_sd_log10.is_finite() && self.between_sd_log10 >= 0.0,
            "between_sd_log10",
            self.between_sd_log10,
            "a finite number of at least 0",
        )?;
        let mut draw = Draw::new(self.seed, Purpose::Person, index);
        let deviation_log10 = self.between_sd_log10 * draw.normal();
        let parameters = ObserverParameters { ratio: self.median.ratio * libm::exp10(deviation_log10), ..self.median };
        WeibullObserver::new(parameters, draw.bits32().into())
    }

    /// Seed of person `index`'s session.
    pub fn session_seed(&self, index: u32) -> u64 {
        let mut draw = Draw::new(self.seed, Purpose::Person, index);
        draw.normal();
        draw.bits32();
        draw.bits32().into()
    }
}
