//! The standard normal distribution.
//!
//! `Phi(z) = erfc(-z / sqrt 2) / 2` with the complementary error function of libm, which keeps the
//! relative accuracy of the left tail; its inverse by bisection, which needs no further function.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// Left of it Phi is 0 in double precision.
const LEFT_END: f64 = -39.0;

/// Probability of a standard normal deviate below `z`; infinite arguments are limits.
pub(crate) fn below(z: f64) -> f64 {
    0.5 * libm::erfc(-z * FRAC_1_SQRT_2)
}

/// Density at `z`.
pub(crate) fn density(z: f64) -> f64 {
    libm::exp(-0.5 * z * z) / (2.0 * PI).sqrt()
}

/// The z with `below(z) = probability`; infinite at 0 and 1.
pub(crate) fn quantile(probability: f64) -> f64 {
    if probability > 0.5 {
        return -quantile(1.0 - probability);
    }
    if probability <= 0.0 {
        return f64::NEG_INFINITY;
    }
    let (mut low, mut high) = (LEFT_END, 0.0);
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return high;
        }
        if below(middle) < probability { low = middle } else { high = middle }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tabulated_values_of_the_distribution_and_its_inverse() {
        // Abramowitz & Stegun, tables 26.1 and 26.5.
        for (z, p) in
            [(0.0, 0.5), (1.0, 0.841_344_746_068_543), (-2.0, 0.022_750_131_948_179), (3.0, 0.998_650_101_968_370)]
        {
            assert!((below(z) - p).abs() < 1e-15, "{z}");
            assert!((quantile(p) - z).abs() < 1e-12, "{z}");
        }
        assert!((quantile(0.975) - 1.959_963_984_540_054).abs() < 1e-14);
        assert!((density(1.0) - 0.241_970_724_519_143).abs() < 1e-15);
    }

    #[test]
    fn the_inverse_inverts_in_the_tails_too() {
        for exponent in 1..300 {
            let p = libm::exp10(-f64::from(exponent));
            assert!((below(quantile(p)) / p - 1.0).abs() < 1e-10, "{p}");
        }
        assert_eq!(quantile(0.0), f64::NEG_INFINITY);
        assert_eq!(quantile(1.0), f64::INFINITY);
        assert_eq!(quantile(0.25), -quantile(0.75));
    }
}
