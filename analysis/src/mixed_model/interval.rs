//! Quantities of a fitted model with intervals.

use super::{MixedFit, Profiled, Quantity};
use crate::Error;

/// A quantity that the answers bound on both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// The most likely value.
    pub value: f64,
    /// 95 % interval.
    pub ci95: [f64; 2],
    /// Half of the interval's width over Student's `t(0.975, people - 1)`.
    pub standard_error: f64,
}

impl Interval {
    /// The quantity's interval.
    ///
    /// # Errors
    /// It has no end within a factor of 1000.
    pub fn of(fit: &MixedFit, quantity: Quantity) -> Result<Self, Error> {
        let Profiled { value, ends } = fit.interval(quantity)?;
        let [Some(low), Some(high)] = ends else {
            return Err(Error::CannotFit(format!(
                "the answers of {} people do not bound the ratio within a factor of 1000",
                fit.people()
            )));
        };
        let student = fit.model.student_t()?;
        Ok(Self { value, ci95: [low, high], standard_error: (high - low) / 2.0 / student })
    }
}
