//! Intervals by profile likelihood: of everything that follows from the model's parameters.
//!
//! A quantity is held at a value while all else is maximised; the interval holds the values whose deviance
//! `2 (l_max - l(value))` stays below a cut. For a normal mean with `n` people and unknown spread the deviance is
//! `n ln(1 + t^2 / (n - 1))`, so the cut is that at Student's `t(0.975, n - 1)`: exact where the measurement of a person
//! is, and a little wide where it is not.

use std::{
    cell::{Cell, RefCell},
    f64::consts::LN_10,
};

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::{
    Coordinates, MixedModel, blind_rise,
    fit::{Maximum, SCALES, maximise},
    parameters_of, sd_rise,
};
use crate::{Error, assumptions::DETECTION_AT_THRESHOLD, crossing::crossing};

/// Precision of an end of an interval, log10 units: 0.02 % of a ratio.
const END_PRECISION: f64 = 1e-4;

/// Distance at which an end is looked for first, log10 units: about twice the standard error of ten people's ratio.
const FIRST: f64 = 0.1;

/// Farthest that an end is sought: a factor of 1000.
const FARTHEST: f64 = 3.0;

/// A quantity that follows from the parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quantity {
    /// log10 of the ratio that hides the artifact from viewers: `m + z s + log10(w(d0) / w(d)) / b` with `w(d) = -ln(1 - d / (1 - e))`.
    Log10Ratio {
        /// Standard normal quantile of the share of viewers.
        z: f64,
        /// Probability that one of them detects it in a trial.
        detection: f64,
    },
    /// `log10 s`.
    Log10BetweenSd,
    /// `log10 b`.
    Log10Slope,
}

impl Quantity {
    /// The median person's log10 ratio at the threshold.
    pub const MEDIAN: Self = Self::Log10Ratio { z: 0.0, detection: DETECTION_AT_THRESHOLD };

    /// Its value.
    pub(crate) fn value(&self, at: &Coordinates) -> f64 {
        match *self {
            Self::Log10Ratio { z, detection } => {
                let parameters = parameters_of(at);
                at[0] + z * parameters.between_sd + decades(detection, parameters.blind_share).0 / parameters.slope
            }
            Self::Log10BetweenSd => at[1] / LN_10,
            Self::Log10Slope => at[2] / LN_10,
        }
    }

    /// Coordinate that gives way while the quantity is held.
    fn held(&self) -> usize {
        match self {
            Self::Log10Ratio { .. } => 0,
            Self::Log10BetweenSd => 1,
            Self::Log10Slope => 2,
        }
    }

    /// The coordinates with the free ones at `free` and the quantity at `value`.
    pub(super) fn place(&self, value: f64, free: &[f64; 3]) -> Coordinates {
        let held = self.held();
        let mut at = [0.0; 4];
        for (index, coordinate) in (0..4).filter(|&index| index != held).zip(free) {
            at[index] = *coordinate;
        }
        at[held] += match self {
            Self::Log10Ratio { .. } => value - self.value(&at),
            Self::Log10BetweenSd | Self::Log10Slope => value * LN_10,
        };
        at
    }

    /// Gradient over the free coordinates while the quantity is held.
    pub(super) fn free_gradient(&self, at: &Coordinates, full: &Coordinates) -> [f64; 3] {
        let mut gradient = *full;
        if let Self::Log10Ratio { z, detection } = *self {
            let parameters = parameters_of(at);
            let (decades, rise) = decades(detection, parameters.blind_share);
            gradient[1] -= z * sd_rise(parameters.between_sd) * full[0];
            gradient[2] += decades / parameters.slope * full[0];
            gradient[3] -= rise * blind_rise(parameters.blind_share) / parameters.slope * full[0];
        }
        free_of(&gradient, self.held())
    }
}

/// `log10(w(d0) / w(d))` and its derivative in the blind share.
fn decades(detection: f64, blind_share: f64) -> (f64, f64) {
    let seeing = 1.0 - blind_share;
    let w = |d: f64| -(-d / seeing).ln_1p();
    let rise = |d: f64| d / (seeing * seeing * (1.0 - d / seeing)) / w(d);
    let of = DETECTION_AT_THRESHOLD;
    ((w(of) / w(detection)).log10(), (rise(of) - rise(detection)) / LN_10)
}

fn free_of(at: &Coordinates, held: usize) -> [f64; 3] {
    std::array::from_fn(|index| at[if index < held { index } else { index + 1 }])
}

/// A quantity with its 95 % interval; an end is `None` where the answers do not bound it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Profiled {
    /// The most likely value.
    pub value: f64,
    /// The ends.
    pub ends: [Option<f64>; 2],
}

impl MixedModel {
    /// Student's `t(0.975, people - 1)`.
    pub(crate) fn student_t(&self) -> Result<f64, Error> {
        let degrees = self.people.len() as f64 - 1.0;
        let student =
            StudentsT::new(0.0, 1.0, degrees).map_err(|reason| Error::CannotFit(format!("Student's t: {reason}")))?;
        Ok(student.inverse_cdf(0.975))
    }

    /// Deviance at which an interval of level 95 % ends.
    fn cut(&self) -> Result<f64, Error> {
        let people = self.people.len() as f64;
        Ok(people * (self.student_t()?.powi(2) / (people - 1.0)).ln_1p())
    }

    /// The quantity's interval about the most likely parameters.
    ///
    /// # Errors
    /// The search for a maximum failed.
    pub(crate) fn profile(&self, quantity: Quantity, top: &Maximum<4>) -> Result<Profiled, Error> {
        let value = quantity.value(&top.at);
        let ends = [-1.0, 1.0].map(|direction| self.end(quantity, top, direction));
        let [lower, upper] = ends;
        Ok(Profiled { value, ends: [lower?, upper?] })
    }

    /// The end of the interval in a direction; `None` where there is none.
    fn end(&self, quantity: Quantity, top: &Maximum<4>, direction: f64) -> Result<Option<f64>, Error> {
        let cut = self.cut()?;
        let value = quantity.value(&top.at);
        let held = quantity.held();
        let scales = free_of(&SCALES, held);
        let start = Cell::new(free_of(&top.at, held));
        let known = RefCell::new(vec![(0.0, -cut.sqrt())]);
        // Negative inside of the interval, and close to linear in the quantity.
        let beyond = |distance: f64| -> Result<f64, Error> {
            if let Some((_, value)) = known.borrow().iter().find(|(known, _)| *known == distance) {
                return Ok(*value);
            }
            let there = value + direction * distance;
            let found = maximise(start.get(), scales, self.people.len(), |free| {
                let at = quantity.place(there, free);
                let (value, gradient) = self.objective(&at);
                (value, quantity.free_gradient(&at, &gradient))
            })?;
            start.set(found.at);
            let height = (2.0 * (top.value - found.value)).max(0.0).sqrt() - cut.sqrt();
            known.borrow_mut().push((distance, height));
            Ok(height)
        };
        let distance = crossing(beyond, FIRST, FARTHEST, END_PRECISION)?;
        Ok(distance.map(|distance| value + direction * distance))
    }
}
