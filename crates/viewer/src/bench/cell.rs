//! How the tables of report.html and bench.md write a number; what was not measured is `-`.

/// With so many digits behind the point.
pub fn number(value: Option<f64>, digits: usize) -> String {
    value.map_or("-".into(), |value| format!("{value:.digits$}"))
}

/// What one number is of another: `0.82`.
pub fn ratio(value: Option<f64>) -> String {
    number(value, 2)
}

/// A share of 0 to 1: `25 %`.
pub fn percent(share: Option<f64>) -> String {
    share.map_or("-".into(), |share| format!("{:.0} %", 100.0 * share))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_not_measured_is_a_dash() {
        assert_eq!([number(Some(0.12345), 4), ratio(Some(1.0)), percent(Some(0.254))], ["0.1235", "1.00", "25 %"]);
        assert_eq!([number(None, 4), ratio(None), percent(None)], ["-"; 3]);
    }
}
