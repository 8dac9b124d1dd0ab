//! How much of a filter kernel lies in a quadrant or a half plane, in closed form.
//!
//! A silhouette made of axis-aligned steps is a union of quadrants, a line is a half plane, so these
//! two functions are all that an exact filtered shadow edge needs. Lengths are in units of the
//! kernel's radius `r`, the kernel has weight 1 and is centred at the origin.
//!
//! With `S(t) = (t sqrt(1 - t^2) + asin t) / 2`, the antiderivative of the unit circle's height, the
//! disc has the half plane `H(t) = 1/2 + 2 S(t) / pi` and, for a corner inside the disc, the
//! quadrant `Q(u, v) = 1/4 + (u v + S(u) + S(v)) / pi` (its mixed derivative is the disc's density
//! `1 / pi`, and it vanishes on the lower left arc). The square and the Gaussian are products of two
//! one-dimensional distributions. Derived for this project; checked against brute force.

use std::f64::consts::PI;

use statrs::function::erf::erfc;

/// The kernel that averages the hard shadow; `r` is its radius, half its width.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kernel {
    /// Uniform in the disc of radius r: what a percentage-closer filter with a Poisson disc tends to.
    Disc,
    /// Uniform in the axis-aligned square of side 2 r.
    Box,
    /// Gaussian of standard deviation r / 2, not cut off.
    GaussianHalf,
    /// Gaussian of standard deviation r / 3, not cut off.
    GaussianThird,
}

impl Kernel {
    /// Every kernel, under the name that tables and command lines use.
    pub const NAMED: [(&'static str, Kernel); 4] = [
        ("disc", Kernel::Disc),
        ("box", Kernel::Box),
        ("gauss2", Kernel::GaussianHalf),
        ("gauss3", Kernel::GaussianThird),
    ];

    /// The kernel of a name in [`Kernel::NAMED`].
    pub fn from_name(name: &str) -> Option<Kernel> {
        Kernel::NAMED.iter().find(|(known, _)| *known == name).map(|&(_, kernel)| kernel)
    }

    /// Distance beyond which nothing of the kernel is left, in radii.
    ///
    /// Exact for disc and box; for a Gaussian nine standard deviations, beyond which lies 1e-19.
    pub fn reach(self) -> f64 {
        match self {
            Kernel::Disc => 1.0,
            Kernel::Box => std::f64::consts::SQRT_2,
            Kernel::GaussianHalf | Kernel::GaussianThird => 9.0 * self.sigma(),
        }
    }

    /// Weight of the part left of `u` and below `v`. Infinite arguments are limits.
    pub fn quadrant(self, u: f64, v: f64) -> f64 {
        match self {
            Kernel::Disc => disc_quadrant(u, v),
            Kernel::Box => uniform_below(u) * uniform_below(v),
            Kernel::GaussianHalf | Kernel::GaussianThird => {
                normal_below(u / self.sigma()) * normal_below(v / self.sigma())
            }
        }
    }

    /// Weight of the half plane that contains the origin at depth `depth` behind its edge (negative:
    /// the origin is outside); `normal` is the unit normal of the edge.
    pub fn half_plane(self, depth: f64, normal: [f64; 2]) -> f64 {
        match self {
            Kernel::Disc => disc_below(depth),
            Kernel::Box => box_half_plane(depth, normal),
            Kernel::GaussianHalf | Kernel::GaussianThird => normal_below(depth / self.sigma()),
        }
    }

    /// Standard deviation of a Gaussian, in radii; 1 for the others, which do not ask.
    fn sigma(self) -> f64 {
        match self {
            Kernel::GaussianHalf => 1.0 / 2.0,
            Kernel::GaussianThird => 1.0 / 3.0,
            Kernel::Disc | Kernel::Box => 1.0,
        }
    }
}

/// Antiderivative of `sqrt(1 - t^2)` that is 0 at 0; constant outside the circle.
fn circle_antiderivative(t: f64) -> f64 {
    let t = t.clamp(-1.0, 1.0);
    // (1 - t)(1 + t) keeps the digits that 1 - t^2 loses near the rim.
    0.5 * (t * ((1.0 - t) * (1.0 + t)).sqrt() + t.asin())
}

/// Weight of the unit disc below `t`.
fn disc_below(t: f64) -> f64 {
    0.5 + circle_antiderivative(t) * 2.0 / PI
}

/// Weight of the unit disc left of `u` and below `v`.
fn disc_quadrant(u: f64, v: f64) -> f64 {
    if u * u + v * v < 1.0 {
        return 0.25 + (u * v + circle_antiderivative(u) + circle_antiderivative(v)) / PI;
    }
    // The corner is outside, so the two edges do not cross inside the disc.
    match (u > 0.0, v > 0.0) {
        (true, true) => disc_below(u) + disc_below(v) - 1.0,
        (true, false) => disc_below(v),
        (false, true) => disc_below(u),
        (false, false) => 0.0,
    }
}

/// Weight of the uniform density on [-1, 1] below `t`.
fn uniform_below(t: f64) -> f64 {
    (0.5 * (t + 1.0)).clamp(0.0, 1.0)
}

/// Weight of the standard normal density below `t`.
fn normal_below(t: f64) -> f64 {
    0.5 * erfc(-t / std::f64::consts::SQRT_2)
}

/// Weight of the square [-1, 1]^2 behind an edge: the distribution function of the trapezoid that
/// two uniform densities of half widths |n_x| and |n_y| make.
fn box_half_plane(depth: f64, normal: [f64; 2]) -> f64 {
    let [wide, narrow] = match normal.map(f64::abs) {
        [x, y] if x >= y => [x, y],
        [x, y] => [y, x],
    };
    let distance = depth.abs();
    let above_half = if distance >= wide + narrow {
        0.5
    } else if distance <= wide - narrow {
        distance / (2.0 * wide)
    } else {
        0.5 - (wide + narrow - distance).powi(2) / (8.0 * wide * narrow)
    };
    0.5 + above_half.copysign(depth)
}
