//! From one number per person to a number for all people, with its interval.
//!
//! With `y_i` the number of person `i`, `n` people, `s` their standard deviation:
//! mean `m = sum y_i / n`, standard error `s / sqrt n`, interval `m -+ t(0.975, n - 1) s / sqrt n`
//! (Student 1908). Exact for normal `y_i`; thresholds are normal in log10, so ratios and radii are
//! averaged as logarithms, and `10^m` is the **median** person's ratio, not the mean of the ratios.

use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::Error;

/// A mean over people with its precision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanOverPeople {
    /// Mean of the people's numbers.
    pub mean: f64,
    /// Standard deviation between the people, measurement noise included.
    pub standard_deviation: f64,
    /// Standard error of the mean.
    pub standard_error: f64,
    /// 95 % interval of the mean.
    pub ci95: [f64; 2],
    /// Number of people.
    pub people: usize,
}

impl MeanOverPeople {
    /// Mean and t interval of `values`, one per person, all finite.
    ///
    /// # Errors
    /// Fewer than two people, or no difference between them: no interval follows from that.
    pub fn of(values: &[f64]) -> Result<Self, Error> {
        let people = values.len();
        if people < 2 {
            return Err(Error::CannotFit(format!(
                "an interval over people needs at least 2 people with thresholds, found {people}"
            )));
        }
        let mean = values.iter().sum::<f64>() / people as f64;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        let standard_deviation = (squares / (people - 1) as f64).sqrt();
        let standard_error = standard_deviation / (people as f64).sqrt();
        if !standard_error.is_finite() || standard_error <= 1e-12 * mean.abs().max(1.0) {
            return Err(Error::CannotFit(format!(
                "the thresholds of {people} people are identical: they are copies, not people"
            )));
        }
        let reach = student(people - 1)?.inverse_cdf(0.975) * standard_error;
        Ok(Self { mean, standard_deviation, standard_error, ci95: [mean - reach, mean + reach], people })
    }

    /// Two-sided p value of "the mean is `expected`".
    pub fn p_value(&self, expected: f64) -> f64 {
        let t = (self.mean - expected) / self.standard_error;
        student(self.people - 1).map_or(f64::NAN, |student| 2.0 * student.sf(t.abs()))
    }
}

fn student(degrees: usize) -> Result<StudentsT, Error> {
    StudentsT::new(0.0, 1.0, degrees as f64).map_err(|reason| Error::CannotFit(format!("Student's t: {reason}")))
}

/// One point of a line: texel size and the radius at threshold, pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SizePoint {
    /// Texel size, pixels.
    pub texel_px: f64,
    /// Radius at threshold, pixels.
    pub radius_px: f64,
}

/// Slope of the least-squares line `r = c a` through the origin: `c = sum a r / sum a^2`.
///
/// Kreuzer 2017, Eq. 5.1, fits it to radii averaged over people. Large texels weigh with the square
/// of their size, although the error of a radius also grows with its size.
pub fn line_through_origin(points: &[SizePoint]) -> Option<f64> {
    let products: f64 = points.iter().map(|p| p.texel_px * p.radius_px).sum();
    let squares: f64 = points.iter().map(|p| p.texel_px.powi(2)).sum();
    (squares > 0.0).then(|| products / squares)
}

/// Intercept and slope of the least-squares line `y = y0 + k x`; `None` below two different `x`.
pub fn line(points: &[(f64, f64)]) -> Option<(f64, f64)> {
    let count = points.len() as f64;
    let mean_x = points.iter().map(|(x, _)| x).sum::<f64>() / count;
    let mean_y = points.iter().map(|(_, y)| y).sum::<f64>() / count;
    let spread: f64 = points.iter().map(|(x, _)| (x - mean_x).powi(2)).sum();
    if points.len() < 2 || spread <= 0.0 {
        return None;
    }
    let slope = points.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum::<f64>() / spread;
    Some((mean_y - slope * mean_x, slope))
}

/// Exponent `g` of `r = c a^g` for one person: slope of `log10 r` on `log10 a`.
pub fn exponent(points: &[SizePoint]) -> Option<f64> {
    let logs: Vec<_> = points.iter().map(|p| (p.texel_px.log10(), p.radius_px.log10())).collect();
    line(&logs).map(|(_, slope)| slope)
}

/// Intercept, pixels, of the line of radius over texel size for one person.
pub fn intercept_px(points: &[SizePoint]) -> Option<f64> {
    let pixels: Vec<_> = points.iter().map(|p| (p.texel_px, p.radius_px)).collect();
    line(&pixels).map(|(intercept, _)| intercept)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(radius: impl Fn(f64) -> f64) -> Vec<SizePoint> {
        [5.0, 10.0, 20.0].map(|a| SizePoint { texel_px: a, radius_px: radius(a) }).to_vec()
    }

    #[test]
    fn the_interval_is_the_textbook_one() {
        // Mean 3, s = sqrt 2.5, t(0.975, 4) = 2.776445105.
        let mean = MeanOverPeople::of(&[1.0, 2.0, 3.0, 4.0, 5.0]).unwrap();
        let reach = 2.776_445_105 * (2.5_f64 / 5.0).sqrt();
        assert!((mean.mean - 3.0).abs() < 1e-12);
        assert!((mean.ci95[1] - 3.0 - reach).abs() < 1e-8);
        assert!((mean.p_value(3.0 + reach) - 0.05).abs() < 1e-8);
    }

    #[test]
    fn one_person_and_copies_of_one_person_are_refused() {
        for values in [&[][..], &[0.5], &[0.5, 0.5, 0.5]] {
            assert!(matches!(MeanOverPeople::of(values), Err(Error::CannotFit(_))));
        }
    }

    #[test]
    fn a_proportional_relation_has_slope_c_exponent_one_and_no_intercept() {
        let points = points(|a| 3.47 * a);
        assert!((line_through_origin(&points).unwrap() - 3.47).abs() < 1e-12);
        assert!((exponent(&points).unwrap() - 1.0).abs() < 1e-12);
        assert!(intercept_px(&points).unwrap().abs() < 1e-12);
    }

    #[test]
    fn a_power_law_gives_its_exponent_and_an_offset_gives_its_intercept() {
        assert!((exponent(&points(|a| 3.0 * a.powf(0.8))).unwrap() - 0.8).abs() < 1e-12);
        assert!((intercept_px(&points(|a| 4.0 + 3.0 * a)).unwrap() - 4.0).abs() < 1e-12);
    }

    #[test]
    fn one_size_has_no_exponent() {
        assert_eq!(exponent(&points(|a| a)[..1]), None);
        assert_eq!(line_through_origin(&[]), None);
    }
}
