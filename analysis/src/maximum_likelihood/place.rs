//! Coordinates of a psychometric function, and the derivatives of its likelihood in them.
//!
//! `p = g + A (1 - exp(-u))`, `A = 1 - g - l`, `u = exp(v)`, `v = ln w + ln10 b (x - q)`. The coordinates are a place `q`
//! on the intensity axis, the slope `b` and the lapse rate `l`. Where `q` is the location, `w = 1`; where it is the
//! intensity at which the share `c` of answers is correct, `w = ln(A / (1 - c - l))`.

use std::f64::consts::LN_10;

use nalgebra::{Matrix3, Vector3};

use super::Count;
use crate::weibull::Weibull;

/// Indices of the coordinates.
pub(super) const PLACE: usize = 0;
pub(super) const SLOPE: usize = 1;
pub(super) const LAPSE: usize = 2;

/// Beyond it `exp(-u)` is below 1e-304 and the function is flat.
const EXPONENT_MOST: f64 = 700.0;

/// What the first coordinate is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Place {
    /// Location of the Weibull function.
    Location,
    /// Intensity at which this share of answers is correct.
    Correct(f64),
}

impl Place {
    /// `ln w` with its first two derivatives in the lapse rate; `None` where the function never gets to the place.
    fn ln_w(self, guess: f64, lapse: f64) -> Option<[f64; 3]> {
        let Self::Correct(share) = self else { return Some([0.0; 3]) };
        let (amplitude, short) = (1.0 - guess - lapse, 1.0 - share - lapse);
        if share <= guess || short <= 0.0 {
            return None;
        }
        let w = libm::log(amplitude / short);
        let first = (short.recip() - amplitude.recip()) / w;
        let second = (short.powi(-2) - amplitude.powi(-2)) / w - first * first;
        Some([libm::log(w), first, second])
    }

    /// The coordinates of a function.
    pub(super) fn coordinates(self, weibull: &Weibull) -> Option<Vector3<f64>> {
        let [ln_w, ..] = self.ln_w(weibull.guess, weibull.lapse)?;
        Some(Vector3::new(weibull.location + ln_w / (LN_10 * weibull.slope), weibull.slope, weibull.lapse))
    }

    /// The function at coordinates; `None` where there is none.
    pub(super) fn weibull(self, at: &Vector3<f64>, guess: f64) -> Option<Weibull> {
        let (slope, lapse) = (at[SLOPE], at[LAPSE]);
        let [ln_w, ..] = self.ln_w(guess, lapse)?;
        let location = at[PLACE] - ln_w / (LN_10 * slope);
        location.is_finite().then_some(Weibull { location, slope, guess, lapse })
    }

    /// Gradient of `ln L` and its negated Hessian in the coordinates.
    ///
    /// `dp = A exp(-u) u dv`, `d2p = A exp(-u) u (d2v + dv dv' (1 - u))`, and in the lapse rate, through `A`, `-F` more
    /// of the first and `-exp(-u) u dv` more of the second, once for each index that it is.
    pub(super) fn derivatives(self, counts: &[Count], weibull: &Weibull) -> Option<(Vector3<f64>, Matrix3<f64>)> {
        let [_, w_rise, w_bend] = self.ln_w(weibull.guess, weibull.lapse)?;
        let place = self.coordinates(weibull)?[PLACE];
        let amplitude = 1.0 - weibull.guess - weibull.lapse;
        let d2v = Matrix3::new(0.0, -LN_10, 0.0, -LN_10, 0.0, 0.0, 0.0, 0.0, w_bend);
        let (mut gradient, mut information) = (Vector3::zeros(), Matrix3::zeros());
        for count in counts {
            let u = weibull.exponent(count.x).min(EXPONENT_MOST);
            let unseen = libm::exp(-u);
            let dv = Vector3::new(-LN_10 * weibull.slope, LN_10 * (count.x - place), w_rise);
            let mut dp = dv * (amplitude * unseen * u);
            dp[LAPSE] -= 1.0 - unseen;
            let mut d2p = (d2v + dv * dv.transpose() * (1.0 - u)) * (amplitude * unseen * u);
            for index in 0..3 {
                d2p[(index, LAPSE)] -= unseen * u * dv[index];
                d2p[(LAPSE, index)] -= unseen * u * dv[index];
            }

            let [correct, wrong] = weibull.answers(count.x);
            let ratio = |weight: f64, probability: f64| if weight == 0.0 { 0.0 } else { weight / probability };
            let (hit, miss) = (ratio(count.correct, correct), ratio(count.total - count.correct, wrong));
            gradient += dp * (hit - miss);
            information += dp * dp.transpose() * (ratio(hit, correct) + ratio(miss, wrong)) - d2p * (hit - miss);
        }
        Some((gradient, information))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::maximum_likelihood::log_likelihood;

    const FUNCTION: Weibull = Weibull { location: 0.1, slope: 2.5, guess: 0.25, lapse: 0.05 };

    #[test]
    fn the_place_of_a_share_is_the_inverse_of_the_function() {
        let place = Place::Correct(0.82);
        let at = place.coordinates(&FUNCTION).unwrap();
        assert!((at[PLACE] - FUNCTION.x_at_correct(0.82).unwrap()).abs() < 1e-14);
        assert!((place.weibull(&at, 0.25).unwrap().location - FUNCTION.location).abs() < 1e-14);
        assert_eq!(Place::Correct(0.96).coordinates(&FUNCTION), None);
        assert_eq!(Place::Correct(0.2).coordinates(&FUNCTION), None);
    }

    #[test]
    fn the_derivatives_are_those_of_the_likelihood() {
        let count = |x, correct| Count { x, correct, total: 40.0 };
        let counts = [count(-0.3, 12.0), count(0.0, 25.0), count(0.2, 33.0), count(0.4, 38.0)];
        for place in [Place::Location, Place::Correct(0.82)] {
            let at = place.coordinates(&FUNCTION).unwrap();
            let (gradient, information) = place.derivatives(&counts, &FUNCTION).unwrap();
            for index in 0..3 {
                let moved = |by: f64| {
                    let mut to = at;
                    to[index] += by;
                    place.weibull(&to, 0.25).unwrap()
                };
                let ln_likelihood = |by: f64| log_likelihood(&counts, &moved(by));
                let numeric = (ln_likelihood(1e-6) - ln_likelihood(-1e-6)) / 2e-6;
                assert!(
                    (gradient[index] - numeric).abs() < 1e-5 * numeric.abs().max(1.0),
                    "{place:?} {index}: {numeric}"
                );
                let gradient_at = |by: f64| place.derivatives(&counts, &moved(by)).unwrap().0;
                let bend = (gradient_at(-1e-6) - gradient_at(1e-6)) / 2e-6;
                let off = (information.column(index) - bend).amax();
                assert!(off < 1e-5 * bend.amax(), "{place:?} {index}: {information} against {bend}");
            }
        }
    }
}
