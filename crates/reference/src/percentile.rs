//! The 99th percentile by nearest rank: the smallest value that at least 99 % of the values do not exceed.

/// Of values in ascending order; `None` of none.
pub(crate) fn p99(ascending: &[f64]) -> Option<f64> {
    // In integers, because 0.99 * 100 is above 99 in floating point.
    let rank = (99 * ascending.len()).div_ceil(100);
    rank.checked_sub(1).map(|index| ascending[index])
}

#[cfg(test)]
mod tests {
    use super::p99;

    #[test]
    fn one_of_a_hundred_may_be_larger() {
        let values: Vec<f64> = (1..=100).map(f64::from).collect();
        assert_eq!(
            (p99(&values), p99(&values[..50]), p99(&values[..1]), p99(&[])),
            (Some(99.0), Some(50.0), Some(1.0), None)
        );
    }
}
