//! The most likely parameters: limited-memory BFGS with the line search of Moré and Thuente, by argmin.

use std::cell::RefCell;

use argmin::{
    core::{CostFunction, Executor, Gradient, State},
    solver::{linesearch::MoreThuenteLineSearch, quasinewton::LBFGS},
};

use super::{Coordinates, MixedModel};
use crate::Error;

/// About one standard error of each coordinate in a study of ten people: the optimiser sees coordinates of one size.
pub(crate) const SCALES: Coordinates = [0.05, 0.3, 0.2, 1.0];

/// Steps after which a search that has not settled is given up.
const STEPS_MOST: u64 = 200;

/// Gradient, for one person, at which the search ends.
const GRADIENT_SETTLED: f64 = 3e-5;

/// Change of the objective, for one person, at which the search ends.
const VALUE_SETTLED: f64 = 1e-11;

/// Where the objective is largest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Maximum<const N: usize> {
    /// Place.
    pub at: [f64; N],
    /// The objective there.
    pub value: f64,
}

/// Maximises `objective`, which gives its value and gradient, from `start`; coordinate `i` varies by about `scales[i]`.
/// The objective is a sum over `people`: the search sees their mean, so that its first step has a sensible length.
///
/// # Errors
/// The search did not end at a finite place.
pub(crate) fn maximise<const N: usize>(
    start: [f64; N],
    scales: [f64; N],
    people: usize,
    objective: impl Fn(&[f64; N]) -> (f64, [f64; N]),
) -> Result<Maximum<N>, Error> {
    let failed = |reason: String| Error::CannotFit(format!("the likelihood has no maximum within reach: {reason}"));
    let people = people as f64;
    let unscaled = |scaled: &[f64]| -> [f64; N] { std::array::from_fn(|i| scaled[i] * scales[i]) };
    let problem = Scaled {
        evaluate: |scaled: &[f64]| {
            let (value, gradient) = objective(&unscaled(scaled));
            (-value / people, (0..N).map(|i| -gradient[i] * scales[i] / people).collect())
        },
        last: RefCell::new(None),
    };
    let start = (0..N).map(|i| start[i] / scales[i]).collect();
    let search = LBFGS::new(MoreThuenteLineSearch::new(), N.max(4))
        .with_tolerance_grad(GRADIENT_SETTLED)
        .and_then(|search| search.with_tolerance_cost(VALUE_SETTLED))
        .map_err(|reason| failed(reason.to_string()))?;
    let result = Executor::new(problem, search)
        .configure(|state| state.param(start).max_iters(STEPS_MOST))
        .ctrlc(false)
        .run()
        .map_err(|reason| failed(reason.to_string()))?;
    let found = result.state();
    let (Some(best), value) = (found.get_best_param(), -found.get_best_cost() * people) else {
        return Err(failed("the search gave no place".to_owned()));
    };
    let at = unscaled(best);
    if !value.is_finite() || at.iter().any(|coordinate| !coordinate.is_finite()) {
        return Err(failed(format!("the search ended at {at:?}")));
    }
    Ok(Maximum { at, value })
}

/// A function as the optimiser asks for it: value and gradient of one place come from one evaluation.
struct Scaled<F> {
    evaluate: F,
    last: RefCell<Option<Evaluated>>,
}

struct Evaluated {
    at: Vec<f64>,
    value: f64,
    gradient: Vec<f64>,
}

impl<F: Fn(&[f64]) -> (f64, Vec<f64>)> Scaled<F> {
    fn with<T>(&self, at: &[f64], read: impl Fn(&Evaluated) -> T) -> T {
        let mut last = self.last.borrow_mut();
        match &*last {
            Some(known) if known.at == at => read(known),
            _ => {
                let (value, gradient) = (self.evaluate)(at);
                read(last.insert(Evaluated { at: at.to_vec(), value, gradient }))
            }
        }
    }
}

impl<F: Fn(&[f64]) -> (f64, Vec<f64>)> CostFunction for Scaled<F> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, at: &Vec<f64>) -> Result<f64, argmin::core::Error> {
        self.with(at, |known| match known.value.is_finite() {
            true => Ok(known.value),
            false => Err(argmin::core::Error::msg(format!("the likelihood is not finite at {at:?}"))),
        })
    }
}

impl<F: Fn(&[f64]) -> (f64, Vec<f64>)> Gradient for Scaled<F> {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;

    fn gradient(&self, at: &Vec<f64>) -> Result<Vec<f64>, argmin::core::Error> {
        Ok(self.with(at, |known| known.gradient.clone()))
    }
}

impl MixedModel {
    /// The most likely coordinates.
    ///
    /// # Errors
    /// The answers do not bound them.
    pub(crate) fn most_likely(&self) -> Result<Maximum<4>, Error> {
        let [(_, ln_slope, _), (_, blind, _)] = self.priors();
        maximise([self.middle(), 0.1_f64.ln(), ln_slope, blind], SCALES, self.people.len(), |at| self.objective(at))
    }

    /// Where the answers lie: the mean of the ratios shown, log10, which staircases draw to the threshold.
    fn middle(&self) -> f64 {
        let counts = || self.people.iter().flat_map(|person| &person.counts);
        let (sum, total) =
            counts().fold((0.0, 0.0), |(sum, total), count| (sum - count.x * count.total, total + count.total));
        sum / total
    }
}
