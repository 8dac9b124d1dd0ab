//! Where a rising function of a distance crosses zero: the end of an interval.

use argmin::{
    core::{CostFunction, Executor, State},
    solver::brent::BrentRoot,
};

use crate::Error;

/// Steps after which Brent's method is given up; bisection alone halves a bracket 60 times.
const STEPS_MOST: u64 = 60;

/// The distance, within `precision`, at which `beyond` stops being negative; `beyond(0)` is negative. Brackets of doubled
/// distances from `first` on are tried; `None` when it is still negative at `farthest`.
///
/// # Errors
/// Those of `beyond`.
pub(crate) fn crossing(
    beyond: impl Fn(f64) -> Result<f64, Error>,
    first: f64,
    farthest: f64,
    precision: f64,
) -> Result<Option<f64>, Error> {
    if farthest <= 0.0 {
        return Ok(None);
    }
    let (mut inside, mut outside) = (0.0, first.min(farthest));
    loop {
        let height = beyond(outside)?;
        if height == 0.0 {
            return Ok(Some(outside));
        }
        if height > 0.0 {
            break;
        }
        if outside >= farthest {
            return Ok(None);
        }
        (inside, outside) = (outside, farthest.min(2.0 * outside));
    }
    let root = Executor::new(Root(&beyond), BrentRoot::new(inside, outside, precision))
        .configure(|state| state.max_iters(STEPS_MOST))
        .ctrlc(false)
        .run()
        .map_err(|reason| Error::CannotFit(format!("no end of an interval: {reason}")))?;
    Ok(root.state().get_best_param().copied())
}

struct Root<F>(F);

impl<F: Fn(f64) -> Result<f64, Error>> CostFunction for Root<F> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, at: &f64) -> Result<f64, argmin::core::Error> {
        Ok((self.0)(*at)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crossing_is_found_wherever_the_first_step_ends() {
        for first in [0.01, 1.0, 1.5, 40.0] {
            let found = crossing(|distance| Ok(distance * distance - 2.0), first, 100.0, 1e-9).unwrap().unwrap();
            assert!((found - 2.0_f64.sqrt()).abs() < 1e-8, "{first}: {found}");
        }
    }

    #[test]
    fn a_function_that_stays_below_zero_has_none() {
        assert_eq!(crossing(|distance| Ok(-1.0 / (1.0 + distance)), 0.1, 3.0, 1e-9).unwrap(), None);
        assert_eq!(crossing(|distance| Ok(distance + 2.0), 0.1, -1.0, 1e-9).unwrap(), None);
    }

    #[test]
    fn what_goes_wrong_on_the_way_is_handed_on() {
        let refusal = crossing(|_| Err(Error::CannotFit("no height".to_owned())), 0.1, 3.0, 1e-9);
        assert!(refusal.unwrap_err().to_string().contains("no height"));
    }
}
