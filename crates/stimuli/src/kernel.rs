//! The kernels that average the hard shadow, and how much of each lies in a quadrant and in a half
//! plane, in closed form.
//!
//! A silhouette made of axis-aligned steps is a union of quadrants, a line is a half plane, so these
//! two functions are all that an exact filtered shadow edge needs. A [`Filter`] is a kernel at its
//! size; it has weight 1, is centred at the origin, and its lengths are in texels of the shadow map.
//!
//! With `S(t) = (t sqrt(1 - t^2) + asin t) / 2`, the antiderivative of the unit circle's height, the
//! unit disc has the half plane `H(t) = 1/2 + 2 S(t) / pi` and, for a corner inside the disc, the
//! quadrant `Q(u, v) = 1/4 + (u v + S(u) + S(v)) / pi` (its mixed derivative is the disc's density
//! `1 / pi`, and it vanishes on the lower left arc). The square and the Gaussian are products of two
//! one-dimensional distributions. Derived for this project; checked against brute force.
//!
//! The 25 taps of a renderer compare the four texels around each tap bilinearly. The texels are
//! constant squares of side 1, and bilinear weights are the areas of those squares under a unit
//! square around the tap, so one tap is exactly the square kernel of radius 1/2 there: no sampling.

use std::f64::consts::{FRAC_1_SQRT_2, PI, SQRT_2};
use std::sync::LazyLock;

use scumble_core::Taps;
use serde::{Deserialize, Serialize};

/// The kernel that averages the hard shadow; `r` is its radius, half its width.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Kernel {
    /// Uniform in the disc of radius r: what a percentage-closer filter with many taps tends to.
    #[serde(rename = "disc")]
    Disc,
    /// Uniform in the square of side 2 r along the shadow map's axes.
    #[serde(rename = "box")]
    Box,
    /// Gaussian of standard deviation r / 2, not cut off.
    #[serde(rename = "gauss2")]
    GaussianHalf,
    /// Gaussian of standard deviation r / 3, not cut off.
    #[serde(rename = "gauss3")]
    GaussianThird,
    /// The 25 taps of the drop-in renderer ([`Taps::FILTER`]) in the disc of radius r, each a
    /// bilinear comparison, which spans one texel whatever the radius: 0 is not hard.
    #[serde(rename = "poisson25")]
    Poisson25,
    /// The same taps, turned at every pixel by [`scumble_core::rotation_angle`], as the drop-in does.
    #[serde(rename = "poisson25_rotated")]
    Poisson25Rotated,
}

impl Kernel {
    /// Every kernel, under the name that files, tables and command lines use.
    pub const NAMED: [(&'static str, Kernel); 6] = [
        ("disc", Kernel::Disc),
        ("box", Kernel::Box),
        ("gauss2", Kernel::GaussianHalf),
        ("gauss3", Kernel::GaussianThird),
        ("poisson25", Kernel::Poisson25),
        ("poisson25_rotated", Kernel::Poisson25Rotated),
    ];

    /// The kernel of a name in [`Kernel::NAMED`].
    pub fn from_name(name: &str) -> Option<Kernel> {
        Kernel::NAMED.iter().find(|(known, _)| *known == name).map(|&(_, kernel)| kernel)
    }
}

/// Filter taps of the drop-in, in the unit disc.
static TAPS: LazyLock<Vec<[f64; 2]>> =
    LazyLock::new(|| Taps::default().filter.iter().map(|tap| [tap.x, tap.y]).collect());

/// Half the side of the square that one bilinear comparison averages, in texels.
const TAP_RADIUS: f64 = 0.5;

/// Standard deviations of a Gaussian beyond which nothing is left: 1e-19 of it lies there.
const GAUSSIAN_REACH: f64 = 9.0;

/// A kernel at its size; lengths in texels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Filter {
    Disc { radius: f64 },
    Box { radius: f64 },
    Gaussian { sigma: f64 },
    Taps { radius: f64, turn: [f64; 2] },
}

impl Filter {
    /// `kernel` with a radius in texels; taps are not turned.
    pub(crate) fn new(kernel: Kernel, radius: f64) -> Self {
        match kernel {
            Kernel::Disc => Filter::Disc { radius },
            Kernel::Box => Filter::Box { radius },
            Kernel::GaussianHalf => Filter::Gaussian { sigma: radius / 2.0 },
            Kernel::GaussianThird => Filter::Gaussian { sigma: radius / 3.0 },
            Kernel::Poisson25 | Kernel::Poisson25Rotated => Filter::Taps { radius, turn: [1.0, 0.0] },
        }
    }

    /// Taps turned counter-clockwise by an angle in radians; other kernels as they are.
    pub(crate) fn turned(self, angle: f64) -> Self {
        match self {
            Filter::Taps { radius, .. } => Filter::Taps { radius, turn: [libm::cos(angle), libm::sin(angle)] },
            other => other,
        }
    }

    /// Distance beyond which nothing of the kernel is left.
    pub(crate) fn reach(self) -> f64 {
        match self {
            Filter::Disc { radius } => radius,
            Filter::Box { radius } => SQRT_2 * radius,
            Filter::Gaussian { sigma } => GAUSSIAN_REACH * sigma,
            Filter::Taps { radius, .. } => radius + SQRT_2 * TAP_RADIUS,
        }
    }

    /// Weight of the part left of `u` and below `v`. Infinite arguments are limits.
    pub(crate) fn quadrant(self, u: f64, v: f64) -> f64 {
        match self {
            Filter::Disc { radius } => disc_quadrant(in_units(u, radius), in_units(v, radius)),
            Filter::Box { radius } => box_quadrant(u, v, radius),
            Filter::Gaussian { sigma } => normal_below(in_units(u, sigma)) * normal_below(in_units(v, sigma)),
            Filter::Taps { radius, turn } => {
                mean_over_taps(radius, turn, |[x, y]| box_quadrant(u - x, v - y, TAP_RADIUS))
            }
        }
    }

    /// Weight of the half plane that contains the origin at depth `depth` behind its edge (negative:
    /// the origin is outside); `normal` is the unit normal of the edge, out of the half plane.
    pub(crate) fn half_plane(self, depth: f64, normal: [f64; 2]) -> f64 {
        match self {
            Filter::Disc { radius } => disc_below(in_units(depth, radius)),
            Filter::Box { radius } => box_half_plane(in_units(depth, radius), normal),
            Filter::Gaussian { sigma } => normal_below(in_units(depth, sigma)),
            Filter::Taps { radius, turn } => mean_over_taps(radius, turn, |[x, y]| {
                box_half_plane((depth - normal[0] * x - normal[1] * y) / TAP_RADIUS, normal)
            }),
        }
    }
}

/// `length` in units of `unit`, which may be 0: a point's two sides and its middle.
fn in_units(length: f64, unit: f64) -> f64 {
    if length == 0.0 { 0.0 } else { length / unit }
}

/// Mean of `weight` over the offsets of the taps.
fn mean_over_taps(radius: f64, [cos, sin]: [f64; 2], weight: impl Fn([f64; 2]) -> f64) -> f64 {
    let turned = |&[x, y]: &[f64; 2]| [radius * (cos * x - sin * y), radius * (sin * x + cos * y)];
    TAPS.iter().map(|tap| weight(turned(tap))).sum::<f64>() / TAPS.len() as f64
}

/// Antiderivative of `sqrt(1 - t^2)` that is 0 at 0; constant outside the circle.
fn circle_antiderivative(t: f64) -> f64 {
    let t = t.clamp(-1.0, 1.0);
    // (1 - t)(1 + t) keeps the digits that 1 - t^2 loses near the rim.
    0.5 * (t * ((1.0 - t) * (1.0 + t)).sqrt() + libm::asin(t))
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

/// Weight of the square of half side `radius` left of `u` and below `v`.
fn box_quadrant(u: f64, v: f64, radius: f64) -> f64 {
    uniform_below(in_units(u, radius)) * uniform_below(in_units(v, radius))
}

/// Weight of the uniform density on [-1, 1] below `t`.
fn uniform_below(t: f64) -> f64 {
    (0.5 * (t + 1.0)).clamp(0.0, 1.0)
}

/// Weight of the standard normal density below `t`.
fn normal_below(t: f64) -> f64 {
    0.5 * libm::erfc(-t * FRAC_1_SQRT_2)
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
        let rest = wide + narrow - distance;
        0.5 - rest * rest / (8.0 * wide * narrow)
    };
    0.5 + above_half.copysign(depth)
}
