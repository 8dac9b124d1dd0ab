//! How much of a kernel lies in a half plane and in a strip that ends, in closed form.
//!
//! A silhouette made of axis-aligned steps is a half plane less a strip at each riser, a line is a
//! half plane, so these functions are all that an exact filtered shadow edge needs. A density has
//! weight 1 and is centred at the origin; lengths are in texels of the shadow map.
//!
//! The disc, in units of its radius: with `S(t) = (t sqrt(1 - t^2) + asin t) / 2`, the antiderivative
//! of the circle's height, the half plane below t has `1/2 + 2 S(t) / pi`, and the quadrant left of u
//! and below v has
//!
//! ```text
//! Q(u, v) = 1/4 + (C(u, v) + S(u) + S(v)) / pi     C(u, v) = u v                                inside
//!                                                  C(u, v) = sign(u v) (S|u| + S|v| - pi / 4)   outside
//! ```
//!
//! Inside, the mixed derivative of Q is the disc's density `1 / pi`, and Q vanishes on the lower left
//! arc; outside, the two edges do not cross in the disc, and Q is 0, a half plane or the excess of two
//! over 1. The square and the Gaussian are products of two one-dimensional distributions. Derived for
//! this project; checked against brute force.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4, PI, SQRT_2};

/// Standard deviations of a Gaussian beyond which nothing is left: 1e-19 of it lies there.
const GAUSSIAN_REACH: f64 = 9.0;

/// A closed-form kernel at its size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Density {
    /// Uniform in a disc.
    Disc { radius: f64 },
    /// Uniform in the square of side 2 `radius`.
    Box { radius: f64 },
    /// Normal.
    Gaussian { sigma: f64 },
}

impl Density {
    /// Half the width of the axis-aligned square that holds the density.
    pub(crate) fn half_width(self) -> f64 {
        match self {
            Density::Disc { radius } | Density::Box { radius } => radius,
            Density::Gaussian { sigma } => GAUSSIAN_REACH * sigma,
        }
    }

    /// Radius of the disc that holds the density.
    pub(crate) fn reach(self) -> f64 {
        match self {
            Density::Box { radius } => SQRT_2 * radius,
            Density::Disc { .. } | Density::Gaussian { .. } => self.half_width(),
        }
    }

    /// Weight below `t` on one axis.
    pub(crate) fn below(self, t: f64) -> f64 {
        match self {
            Density::Disc { radius } => 0.5 + circle_antiderivative(in_units(t, radius)) * 2.0 / PI,
            Density::Box { radius } => (0.5 * (in_units(t, radius) + 1.0)).clamp(0.0, 1.0),
            Density::Gaussian { sigma } => 0.5 * libm::erfc(-in_units(t, sigma) * FRAC_1_SQRT_2),
        }
    }

    /// Weight left of `u` between `bottom` and `top`.
    pub(crate) fn strip(self, u: f64, bottom: f64, top: f64) -> f64 {
        let (left, away) = ((-u).max(0.0), bottom.max(-top).max(0.0));
        let reach = self.reach();
        if left * left + away * away > reach * reach {
            return 0.0;
        }
        match self {
            Density::Disc { .. } => {
                let [u, bottom, top] = [u, bottom, top].map(|length| self.disc_cut(length));
                let below = |v: DiscCut| u.crossed(v) + v.antiderivative;
                (below(top) - below(bottom)) / PI
            }
            Density::Box { .. } | Density::Gaussian { .. } => self.below(u) * (self.below(top) - self.below(bottom)),
        }
    }

    /// A cut at `t`, in units of the reach.
    pub(crate) fn disc_cut(self, t: f64) -> DiscCut {
        let at = in_units(t, self.reach()).clamp(-1.0, 1.0);
        DiscCut { at, antiderivative: circle_antiderivative(at) }
    }

    /// Weight of the half plane that contains the origin at depth `depth` behind its edge (negative:
    /// the origin is outside); `normal` is the unit normal of the edge.
    pub(crate) fn half_plane(self, depth: f64, normal: [f64; 2]) -> f64 {
        if depth.abs() > self.reach() {
            return if depth > 0.0 { 1.0 } else { 0.0 };
        }
        match self {
            Density::Disc { .. } | Density::Gaussian { .. } => self.below(depth),
            Density::Box { radius } => box_half_plane(in_units(depth, radius), normal),
        }
    }
}

/// A straight cut through the unit disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DiscCut {
    /// Where, -1 to 1; at the rim where it passes the disc.
    pub(crate) at: f64,
    /// S at this place.
    pub(crate) antiderivative: f64,
}

impl DiscCut {
    /// C of this cut and one across it.
    fn crossed(self, across: DiscCut) -> f64 {
        if self.at * self.at + across.at * across.at < 1.0 {
            return self.at * across.at;
        }
        let outside = self.antiderivative.abs() + across.antiderivative.abs() - FRAC_PI_4;
        if (self.at < 0.0) == (across.at < 0.0) { outside } else { -outside }
    }
}

/// `length` in units of `unit`, which may be 0: a point's two sides and its middle.
fn in_units(length: f64, unit: f64) -> f64 {
    if length == 0.0 { 0.0 } else { length / unit }
}

/// S: antiderivative of `sqrt(1 - t^2)` that is 0 at 0; constant outside the circle.
fn circle_antiderivative(t: f64) -> f64 {
    let t = t.clamp(-1.0, 1.0);
    // (1 - t)(1 + t) keeps the digits that 1 - t^2 loses near the rim.
    0.5 * (t * ((1.0 - t) * (1.0 + t)).sqrt() + libm::asin(t))
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
