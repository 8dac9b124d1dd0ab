//! Numerical searches in one and two dimensions, without derivatives.

/// Where `function`, which falls from positive to negative between `low` and `high`, is 0, to `width`.
///
/// The ITP method (Oliveira and Takahashi 2020) with `k1 = 0.2 / (high - low)`, `k2 = 2`, `n0 = 1`:
/// a secant step, moved towards the middle, kept where bisection would still be in time.
pub(crate) fn falling_root(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64, width: f64) -> f64 {
    let (mut at_low, mut at_high) = (function(low), function(high));
    let push = 0.2 / (high - low);
    let bisections = libm::ceil(libm::log2((high - low) / width));
    let mut allowed_half_width = 0.5 * width * libm::exp2(bisections + 1.0);
    while high - low > width {
        // Interpolate.
        let middle = 0.5 * (low + high);
        let secant = (at_low * high - at_high * low) / (at_low - at_high);
        let secant = if secant.is_finite() { secant } else { middle };
        // Truncate.
        let to_middle = middle - secant;
        let shift = push * (high - low) * (high - low);
        let inner = if shift <= to_middle.abs() { secant + shift.copysign(to_middle) } else { middle };
        // Project.
        let slack = allowed_half_width - 0.5 * (high - low);
        let place = if (inner - middle).abs() <= slack { inner } else { middle - slack.copysign(to_middle) };
        let value = function(place);
        if value > 0.0 {
            (low, at_low) = (place, value);
        } else if value < 0.0 {
            (high, at_high) = (place, value);
        } else {
            return place;
        }
        allowed_half_width *= 0.5;
    }
    0.5 * (low + high)
}

/// The largest value of `function` between `low` and `high`, where it has one peak: golden section.
pub(crate) fn peak(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> (f64, f64) {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    // After 40 steps the interval is 4e-9 of what it was.
    const STEPS: usize = 40;
    let at = |place: f64| (place, function(place));
    let mut left = at(high - GOLDEN * (high - low));
    let mut right = at(low + GOLDEN * (high - low));
    for _ in 0..STEPS {
        if left.1 < right.1 {
            low = left.0;
            left = right;
            right = at(low + GOLDEN * (high - low));
        } else {
            high = right.0;
            right = left;
            left = at(high - GOLDEN * (high - low));
        }
    }
    larger(left, right)
}

/// Of two places with their values the one with the larger value, the first of equals.
pub(crate) fn larger<P>(first: (P, f64), second: (P, f64)) -> (P, f64) {
    if second.1 > first.1 { second } else { first }
}
