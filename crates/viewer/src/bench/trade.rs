//! Does an adaptive size pay? Its time and error against the curve of the fixed sizes of the same scene and method.
//!
//! The fixed sizes, in the order of their texels, are joined by lines in log time and log error:
//! ```text
//! equal-time error:  what the curve's error is at the adaptive time, and the adaptive error over it
//! equal-error time:  what the curve's time is at the adaptive error, and the adaptive time over it
//! ```
//! A ratio below 1 is in favour of the adaptive size. Times scatter, so the curve may pass a value more than once; then the
//! least answer counts, which is the fixed sizes' best. The curve is not extended: outside of it the answer is on which
//! side of all fixed sizes the adaptive one lies.

use std::fmt;

use crate::bench::row::{Key, Row};

/// A change below this is none: medians of 15 frames on a busy machine scatter by 3 to 4 %.
const EVEN: f64 = 0.05;

/// Where an adaptive value lies on the curve of the fixed sizes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// Adaptive over fixed.
    Ratio(f64),
    /// Below every fixed size.
    BelowAll,
    /// Above every fixed size.
    AboveAll,
}

/// An adaptive row against the fixed ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Trade {
    /// Of the adaptive row.
    pub key: Key,
    /// Error at equal time; a place outside is that of the time.
    pub error_at_equal_time: Place,
    /// Time at equal error; a place outside is that of the error.
    pub time_at_equal_error: Place,
}

/// What a trade comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// No fixed size is as accurate in this time.
    Pays,
    /// Within 5 % of a fixed size.
    Even,
    /// A fixed size does better.
    DoesNotPay,
    /// Cheaper and coarser than every fixed size, or dearer and finer.
    Elsewhere,
}

impl Place {
    /// The ratio, or on which side it lies.
    pub fn words(self, below: &str, above: &str) -> String {
        match self {
            Self::Ratio(ratio) => format!("{ratio:.2}"),
            Self::BelowAll => below.into(),
            Self::AboveAll => above.into(),
        }
    }
}

impl Trade {
    /// The error at equal time, for a table.
    pub fn error_words(&self) -> String {
        self.error_at_equal_time.words("faster than all", "slower than all")
    }

    /// The time at equal error, for a table.
    pub fn time_words(&self) -> String {
        self.time_at_equal_error.words("finer than all", "coarser than all")
    }

    /// The time decides where the curve has the adaptive error, else the error where it has the adaptive time.
    pub fn verdict(&self) -> Verdict {
        match (self.time_at_equal_error, self.error_at_equal_time) {
            (Place::Ratio(ratio), _) | (Place::BelowAll | Place::AboveAll, Place::Ratio(ratio)) => match ratio {
                ratio if ratio < 1.0 - EVEN => Verdict::Pays,
                ratio if ratio > 1.0 + EVEN => Verdict::DoesNotPay,
                _ => Verdict::Even,
            },
            (Place::BelowAll, Place::BelowAll) => Verdict::Pays,
            (Place::AboveAll, Place::AboveAll) => Verdict::DoesNotPay,
            (Place::AboveAll, Place::BelowAll) | (Place::BelowAll, Place::AboveAll) => Verdict::Elsewhere,
        }
    }
}

/// Every adaptive row that has a time, an error above 0 and two fixed sizes at least to compare with.
pub fn trades(rows: &[Row]) -> Vec<Trade> {
    rows.iter().filter(|row| row.key.is_adaptive()).filter_map(|row| trade(row, rows)).collect()
}

fn trade(row: &Row, rows: &[Row]) -> Option<Trade> {
    let is_fixed = |other: &&Row| other.key.is_fixed() && other.key.is_beside(&row.key);
    let mut fixed: Vec<&Row> = rows.iter().filter(is_fixed).collect();
    fixed.sort_by_key(|row| row.texels);
    let curve: Vec<[f64; 2]> = fixed.into_iter().filter_map(logarithms).collect();
    let [time, error] = logarithms(row)?;
    let swapped: Vec<[f64; 2]> = curve.iter().map(|&[time, error]| [error, time]).collect();
    (curve.len() >= 2).then(|| Trade {
        key: row.key.clone(),
        error_at_equal_time: place(&curve, time, error),
        time_at_equal_error: place(&swapped, error, time),
    })
}

/// Natural logarithms of the total time and of the error; `None` where there is no such.
fn logarithms(row: &Row) -> Option<[f64; 2]> {
    let (time, error) = (row.total_ms()?, row.error()?);
    (time > 0.0 && error > 0.0).then(|| [time.ln(), error.ln()])
}

/// Of the logarithm `y` at `x`.
fn place(curve: &[[f64; 2]], x: f64, y: f64) -> Place {
    match least_at(curve, x) {
        Some(fixed) => Place::Ratio((y - fixed).exp()),
        None if curve.iter().all(|point| x < point[0]) => Place::BelowAll,
        None => Place::AboveAll,
    }
}

/// The least y at which the joined points pass x.
fn least_at(curve: &[[f64; 2]], x: f64) -> Option<f64> {
    let segments =
        curve.windows(2).filter(|pair| (pair[0][0].min(pair[1][0])..=pair[0][0].max(pair[1][0])).contains(&x));
    let at = |pair: &[[f64; 2]]| {
        let [[x0, y0], [x1, y1]] = [pair[0], pair[1]];
        if x0 == x1 { y0.min(y1) } else { y0 + (y1 - y0) * (x - x0) / (x1 - x0) }
    };
    segments.map(at).min_by(f64::total_cmp)
}

impl fmt::Display for Trade {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} against fixed sizes: ", self.key)?;
        match self.error_at_equal_time {
            Place::Ratio(ratio) => write!(formatter, "x {ratio:.2} the error in equal time, ")?,
            Place::BelowAll => formatter.write_str("faster than all of them, ")?,
            Place::AboveAll => formatter.write_str("slower than all of them, ")?,
        }
        match self.time_at_equal_error {
            Place::Ratio(ratio) => write!(formatter, "x {ratio:.2} the time for equal error"),
            Place::BelowAll => formatter.write_str("more accurate than all of them"),
            Place::AboveAll => formatter.write_str("less accurate than all of them"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::examples::row;

    /// Fixed sizes whose error falls as 1 / time: a line in logarithms.
    fn fixed() -> Vec<Row> {
        [("512", 10.0), ("1024", 20.0), ("2048", 80.0)].map(|(size, ms)| row("yard", "pcf", size, ms, 1.0 / ms)).into()
    }

    fn of(ms: f64, error: f64) -> Trade {
        let rows = [fixed(), vec![row("yard", "pcf", "adaptive", ms, error)]].concat();
        trades(&rows).remove(0)
    }

    fn ratio(place: Place) -> f64 {
        let Place::Ratio(ratio) = place else { panic!("{place:?}") };
        ratio
    }

    #[test]
    fn a_power_law_is_met_between_its_points() {
        let trade = of(40.0, 1.0 / 60.0);
        assert!((ratio(trade.error_at_equal_time) - 40.0 / 60.0).abs() < 1e-12, "{trade}");
        assert!((ratio(trade.time_at_equal_error) - 40.0 / 60.0).abs() < 1e-12, "{trade}");
        assert_eq!(trade.verdict(), Verdict::Pays);
        assert_eq!(
            (of(40.0, 1.0 / 41.0).verdict(), of(40.0, 1.0 / 30.0).verdict()),
            (Verdict::Even, Verdict::DoesNotPay)
        );
    }

    #[test]
    fn outside_of_the_curve_the_side_is_told() {
        for (ms, error, verdict, words) in [
            (5.0, 0.5, Verdict::Elsewhere, "faster than all of them, less accurate"),
            (5.0, 0.01, Verdict::Pays, "faster than all of them, more accurate"),
            (90.0, 0.5, Verdict::DoesNotPay, "slower than all of them, less accurate"),
            (90.0, 0.01, Verdict::Elsewhere, "slower than all of them, more accurate"),
            (5.0, 1.0 / 40.0, Verdict::Pays, "faster than all of them, x 0.12 the time"),
        ] {
            let trade = of(ms, error);
            assert_eq!(trade.verdict(), verdict);
            assert!(trade.to_string().contains(words), "{trade}");
        }
    }

    #[test]
    fn a_curve_that_turns_back_answers_with_its_best() {
        let curve = [[0.0, 3.0], [2.0, 2.0], [1.0, 1.0]];
        assert_eq!(least_at(&curve, 1.5), Some(1.5));
        assert_eq!(least_at(&[[1.0, 2.0], [1.0, 1.0]], 1.0), Some(1.0));
    }

    #[test]
    fn one_fixed_size_is_no_curve() {
        let rows = [row("yard", "pcf", "512", 10.0, 0.1), row("yard", "pcf", "adaptive", 10.0, 0.1)];
        assert!(trades(&rows).is_empty());
    }
}
