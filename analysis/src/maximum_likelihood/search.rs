//! The most likely function: the best of a coarse grid, then Newton steps with the analytic Hessian, damped until the
//! likelihood grows (Levenberg 1944).
//!
//! Slope and lapse rate stay in their ranges: at an end beyond which the likelihood grows they are held.

use nalgebra::{Matrix3, Vector3};

use super::{
    Count, LAPSE_LARGEST, Model, Parameter, SLOPE_RANGE, log_likelihood,
    place::{LAPSE, PLACE, Place, SLOPE},
};
use crate::weibull::Weibull;

/// Slopes of the grid: the published ones, a flat and a steep one.
const GRID_SLOPES: [f64; 7] = [0.5, 1.0, 2.0, 3.5, 6.0, 12.0, 30.0];

/// Lapse rates of the grid.
const GRID_LAPSES: [f64; 2] = [0.005, 0.06];

/// Places of the grid beside each level, decades times the slope: those at which the level lies on the rise of the
/// function, from seen but for 5e-5 to unseen but for 3 %. Elsewhere the likelihood of a steep function is flat and shows
/// no way.
const GRID_RISE: [f64; 6] = [-1.0, -0.5, 0.0, 0.5, 1.0, 1.5];

/// Places of the grid that are closer, decades times the slope, are one.
const GRID_CLOSEST: f64 = 0.4;

/// A step that gains fewer nats is the last one: the next would gain the square of it.
const GAIN_SETTLED: f64 = 1e-12;

/// Two `ln L` that differ by less, as a share of their size and at least of 1e6, are equal: a thousand times the rounding
/// of a sum.
const ROUNDING: f64 = 1e-12;

/// Steps after which a search ends where it is. From the grid a search takes about ten.
const STEPS_MOST: usize = 200;

/// The first damping, the factor of the next, and where a search gives up because no step gains.
const DAMPING_FIRST: f64 = 1e-3;
const DAMPING_FACTOR: f64 = 10.0;
const DAMPING_MOST: f64 = 1e12;

/// Curvature that stands in for none in the damping.
const CURVATURE_LEAST: f64 = 1e-9;

/// A function and how likely it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Maximum {
    /// The function.
    pub weibull: Weibull,
    /// `ln L` without binomial coefficients, finite.
    pub ln_likelihood: f64,
}

impl Maximum {
    /// `None` where the counts are impossible.
    fn at(counts: &[Count], weibull: Weibull) -> Option<Self> {
        let ln_likelihood = log_likelihood(counts, &weibull);
        ln_likelihood.is_finite().then_some(Self { weibull, ln_likelihood })
    }

    /// Whether `ln_likelihood` is at most `drop` nats lower, but for rounding.
    pub fn is_within(&self, drop: f64, ln_likelihood: f64) -> bool {
        self.ln_likelihood - ln_likelihood <= drop + ROUNDING * self.ln_likelihood.abs().max(1e6)
    }
}

/// What is held and what is sought.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Search {
    /// Guess rate.
    pub guess: f64,
    /// What the place is.
    pub place: Place,
    /// The place, log10 units.
    pub at: Parameter,
    /// Slope per decade.
    pub slope: Parameter,
    /// Lapse rate.
    pub lapse: Parameter,
}

impl Search {
    /// For the function of a model.
    pub fn of(model: &Model) -> Self {
        let Model { guess, lapse, slope } = *model;
        Self { guess, place: Place::Location, at: Parameter::Free, slope, lapse }
    }

    /// The most likely function from the grid, or from `near` with what is held put in where that is likelier; `None`
    /// where every function makes the counts impossible.
    pub fn highest(&self, counts: &[Count], near: Option<&Weibull>) -> Option<Maximum> {
        let near = near.and_then(|weibull| self.place.coordinates(weibull));
        let starts = self.grid(counts).into_iter().chain(near.map(|at| self.with_held(at)));
        let functions = starts.filter_map(|at| Maximum::at(counts, self.place.weibull(&at, self.guess)?));
        let start = functions.max_by(|a, b| a.ln_likelihood.total_cmp(&b.ln_likelihood))?;
        Some(self.climb(counts, start))
    }

    /// `ln L`'s gradient and negated Hessian at a function, and what is free there; what is held has no gradient and
    /// unit curvature.
    pub fn derivatives(&self, counts: &[Count], weibull: &Weibull) -> Option<(Vector3<f64>, Matrix3<f64>, [bool; 3])> {
        let (mut gradient, mut information) = self.place.derivatives(counts, weibull)?;
        let mut free = [self.at, self.slope, self.lapse].map(|parameter| parameter == Parameter::Free);
        free[SLOPE] &= is_inside(weibull.slope, SLOPE_RANGE, gradient[SLOPE]);
        free[LAPSE] &= is_inside(weibull.lapse, [0.0, LAPSE_LARGEST], gradient[LAPSE]);
        for index in (0..3).filter(|&index| !free[index]) {
            gradient[index] = 0.0;
            information.row_mut(index).fill(0.0);
            information.column_mut(index).fill(0.0);
            information[(index, index)] = 1.0;
        }
        Some((gradient, information, free))
    }

    /// Damped Newton ascent, until a full step gains nothing.
    fn climb(&self, counts: &[Count], start: Maximum) -> Maximum {
        let mut top = start;
        let mut damping = 0.0;
        for _ in 0..STEPS_MOST {
            let Some((gradient, information, _)) = self.derivatives(counts, &top.weibull) else { break };
            let curvature = information.diagonal().map(|curvature| curvature.abs().max(CURVATURE_LEAST));
            let damped = information + Matrix3::from_diagonal(&(curvature * damping));
            let step = damped.cholesky().map(|factor| factor.solve(&gradient));
            let reached = step.and_then(|step| Maximum::at(counts, self.moved(&top.weibull, &step)?));
            let settled = damping == 0.0 && step.is_some_and(|step| step.dot(&gradient) < GAIN_SETTLED);
            match reached {
                Some(reached) if settled => return reached,
                Some(reached) if reached.ln_likelihood >= top.ln_likelihood => {
                    top = reached;
                    damping = if damping <= DAMPING_FIRST { 0.0 } else { damping / DAMPING_FACTOR };
                }
                _ => damping = DAMPING_FIRST.max(damping * DAMPING_FACTOR),
            }
            if damping > DAMPING_MOST {
                break;
            }
        }
        top
    }

    /// The function a step away, slope and lapse rate kept in their ranges.
    fn moved(&self, weibull: &Weibull, step: &Vector3<f64>) -> Option<Weibull> {
        let mut at = self.place.coordinates(weibull)? + step;
        if self.slope == Parameter::Free {
            at[SLOPE] = at[SLOPE].clamp(SLOPE_RANGE[0], SLOPE_RANGE[1]);
        }
        if self.lapse == Parameter::Free {
            at[LAPSE] = at[LAPSE].clamp(0.0, LAPSE_LARGEST);
        }
        self.place.weibull(&at, self.guess)
    }

    /// Coordinates with what is held put in.
    fn with_held(&self, mut at: Vector3<f64>) -> Vector3<f64> {
        for (index, parameter) in [(PLACE, self.at), (SLOPE, self.slope), (LAPSE, self.lapse)] {
            if let Parameter::Fixed(value) = parameter {
                at[index] = value;
            }
        }
        at
    }

    /// A coarse set of coordinates.
    fn grid(&self, counts: &[Count]) -> Vec<Vector3<f64>> {
        let candidates = |parameter, grid: &[f64]| match parameter {
            Parameter::Fixed(value) => vec![value],
            Parameter::Free => grid.to_vec(),
        };
        let lapses = candidates(self.lapse, &GRID_LAPSES);
        let mut grid = Vec::new();
        for slope in candidates(self.slope, &GRID_SLOPES) {
            for place in candidates(self.at, &places(counts, slope)) {
                grid.extend(lapses.iter().map(|&lapse| Vector3::new(place, slope, lapse)));
            }
        }
        grid
    }
}

/// Locations of the grid for a slope.
fn places(counts: &[Count], slope: f64) -> Vec<f64> {
    let beside = |count: &Count| GRID_RISE.map(|rise| count.x + rise / slope);
    let mut places: Vec<f64> = counts.iter().flat_map(beside).collect();
    places.sort_by(f64::total_cmp);
    places.dedup_by(|next, kept| *next - *kept < GRID_CLOSEST / slope);
    places
}

/// Whether a value may move the way it is drawn.
fn is_inside(value: f64, [lowest, highest]: [f64; 2], gradient: f64) -> bool {
    (value > lowest || gradient > 0.0) && (value < highest || gradient < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slope_of_any_steepness_finds_the_place_that_fits_two_levels() {
        // Nothing of one answer, five of six: any steep function can have 5/6 at the second level.
        let counts = [Count { x: 0.0, correct: 0.0, total: 1.0 }, Count { x: 0.2, correct: 5.0, total: 6.0 }];
        let best = 5.0 * (5.0_f64 / 6.0).ln() + (1.0_f64 / 6.0).ln();
        for slope in [40.0, 55.0, 80.0, 100.0] {
            let slope = Parameter::Fixed(slope);
            let search = Search::of(&Model { guess: 0.0, lapse: Parameter::Fixed(0.1), slope });
            let found = search.highest(&counts, None).unwrap();
            assert!((found.ln_likelihood - best).abs() < 1e-6, "{slope:?}: {found:?}");
        }
    }

    #[test]
    fn a_lapse_rate_that_the_data_drive_out_of_its_range_is_held_at_the_end() {
        let row = |x, correct| Count { x, correct, total: 50.0 };
        let search = Search::of(&Model { guess: 0.5, lapse: Parameter::Free, slope: Parameter::Free });
        for (last, end) in [(50.0, 0.0), (30.0, LAPSE_LARGEST)] {
            let counts = [row(-0.2, 26.0), row(0.0, 33.0), row(0.2, 38.0), row(0.6, last), row(0.8, last)];
            assert_eq!(search.highest(&counts, None).unwrap().weibull.lapse, end);
        }
    }
}
