//! Does an adaptive size pay? Its time and error against the curve of the fixed sizes of the same scene and method.
//!
//! The fixed sizes, in the order of their texels, are joined by lines in log time and log error:
//! ```text
//! equal-time error:  what the curve's error is at the adaptive time, and the adaptive error over it
//! equal-error time:  what the curve's time is at the adaptive error, and the adaptive time over it
//! ```
//! A ratio below 1 is in favour of the adaptive size. Times scatter, so the curve may pass a value more than once; then the
//! least answer counts, which is the fixed sizes' best. Outside of the curve there is no answer: it is not extended.

use std::fmt;

use crate::bench::row::{Key, Row};

/// An adaptive row against the fixed ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Trade {
    /// Of the adaptive row.
    pub key: Key,
    /// Adaptive error over the curve's at equal time; `None` outside of the curve.
    pub error_ratio: Option<f64>,
    /// Adaptive time over the curve's at equal error; `None` outside of the curve.
    pub time_ratio: Option<f64>,
}

/// Every adaptive row that has a time, an error above 0 and two fixed sizes at least to compare with.
pub fn trades(rows: &[Row]) -> Vec<Trade> {
    rows.iter().filter(|row| row.key.is_adaptive()).filter_map(|row| trade(row, rows)).collect()
}

fn trade(row: &Row, rows: &[Row]) -> Option<Trade> {
    let is_fixed = |other: &&Row| !other.key.is_adaptive() && other.key.is_beside(&row.key);
    let mut fixed: Vec<&Row> = rows.iter().filter(is_fixed).collect();
    fixed.sort_by_key(|row| row.texels);
    let curve: Vec<[f64; 2]> = fixed.into_iter().filter_map(logarithms).collect();
    let [time, error] = logarithms(row)?;
    let swapped: Vec<[f64; 2]> = curve.iter().map(|&[time, error]| [error, time]).collect();
    (curve.len() >= 2).then(|| Trade {
        key: row.key.clone(),
        error_ratio: least_at(&curve, time).map(|fixed| (error - fixed).exp()),
        time_ratio: least_at(&swapped, error).map(|fixed| (time - fixed).exp()),
    })
}

/// Natural logarithms of the total time and of the error; `None` where there is no such.
fn logarithms(row: &Row) -> Option<[f64; 2]> {
    let (time, error) = (row.total_ms()?, row.error()?);
    (time > 0.0 && error > 0.0).then(|| [time.ln(), error.ln()])
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
        let words = |ratio: Option<f64>| ratio.map_or("outside of the curve".into(), |ratio| format!("x {ratio:.2}"));
        let (error, time) = (words(self.error_ratio), words(self.time_ratio));
        write!(formatter, "{} against fixed sizes: error at equal time {error}, ", self.key)?;
        write!(formatter, "time at equal error {time}")
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

    #[test]
    fn a_power_law_is_met_between_its_points() {
        let trade = of(40.0, 1.0 / 60.0);
        assert!((trade.error_ratio.unwrap() - 40.0 / 60.0).abs() < 1e-12, "{trade}");
        assert!((trade.time_ratio.unwrap() - 40.0 / 60.0).abs() < 1e-12, "{trade}");
    }

    #[test]
    fn outside_of_the_curve_there_is_no_answer() {
        let trade = of(5.0, 0.5);
        assert_eq!((trade.error_ratio, trade.time_ratio), (None, None));
        assert!(trade.to_string().contains("outside of the curve"));
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
