//! How straight a filtered edge looks: the curves of equal shadow, and how far they are from a line.
//!
//! "The user evaluates the dissimilarity in their curvature to identify artifacts" (Kreuzer 2017,
//! section 4.1.2). The iso-contour of level `f` is where the filtered silhouette has coverage `f`.
//! Lengths are in texels. Along the axis of a silhouette (the diagonal of a stair, the level of a
//! step, a line itself) at the place `s` the contour has the offset `d(s)`, the distance across the
//! axis, up, from the contour of the same level of the straight edge along the axis:
//!
//! ```text
//! F(s e + (d0 + d(s)) n) = f,     d0: half plane(-d0) = f,     e, n: along the axis, across it
//! ```
//!
//! `F` falls along `n`, and the silhouette lies between two lines along its axis, at most
//! [`MAX_OFFSET`] away; so there is one `d(s)`, it lies between those lines, and a bracketing search
//! finds it to 1e-11. The search is the ITP method (Oliveira and Takahashi 2020), which needs no more
//! steps than bisection.
//!
//! The offset of a stair has the period `sqrt 2` and a mean that is not 0 for levels other than 1/2
//! (the steps widen the penumbra); of a step it goes from -1/2 to 1/2.

use std::f64::consts::SQRT_2;

use crate::filter::Filter;
use crate::search::{falling_root, larger, peak};
use crate::{Error, Kernel, Silhouette};

/// No silhouette is further from the line along its axis: a double step by 1 / sqrt 2, a step 1/2.
const MAX_OFFSET: f64 = 0.75;

/// Width of the interval in which a place of a contour is known at the end, in texels.
const PRECISION: f64 = 1e-11;

/// A hard edge is the limit of small radii; below this one no place of interest changes by 1e-5.
const SMALLEST_RADIUS: f64 = 1e-6;

/// Places in a stair's period, and across the transition of a step, at which a tilt is measured:
/// those of the table of reference.
const PERIOD_PLACES: usize = 720;
const TRANSITION_PLACES: usize = 2401;

/// Half of the transition's part that is searched for the tilt, in radii of the kernel's core: a
/// little more than the part of the axis on which the contour of a step moves.
const TRANSITION_RADII: f64 = 1.3;

/// One curve of equal shadow of a filtered silhouette.
#[derive(Clone, Copy, Debug)]
pub struct IsoContour {
    silhouette: Silhouette,
    kernel: Kernel,
    radius_texels: f64,
    level: f64,
    axis_slope: f64,
    /// Place of the axis's own contour, across the axis: `d0`.
    line_across: f64,
}

impl IsoContour {
    /// The contour at which `level` of `kernel` lies in shadow.
    ///
    /// `radius_texels` is the ratio r / a, at least 0; `level` lies between 0 and 1 and is neither.
    pub fn of(silhouette: Silhouette, kernel: Kernel, radius_texels: f64, level: f64) -> Result<Self, Error> {
        let refuse = |field, value, allowed| Err(Error::Field { field, value, allowed });
        if !(radius_texels >= 0.0 && radius_texels.is_finite()) {
            return refuse("radius_texels", radius_texels, "a finite length of at least 0");
        }
        if !(level > 0.0 && level < 1.0) {
            return refuse("level", level, "a number between 0 and 1");
        }
        let axis_slope = match silhouette {
            Silhouette::Stair | Silhouette::DoubleStep => 1.0,
            Silhouette::Step => 0.0,
            Silhouette::Line { slope } => slope,
        };
        let radius_texels = radius_texels.max(SMALLEST_RADIUS);
        let mut contour = IsoContour { silhouette, kernel, radius_texels, level, axis_slope, line_across: 0.0 };
        let reach = contour.reach();
        contour.line_across = contour.across(Silhouette::Line { slope: axis_slope }, 0.0, [-reach, reach]);
        Ok(contour)
    }

    /// Distance of the contour from the straight one, across the axis, at `along` from the origin.
    pub fn offset(&self, along: f64) -> f64 {
        let between = [self.line_across - MAX_OFFSET, self.line_across + MAX_OFFSET];
        self.across(self.silhouette, along, between) - self.line_across
    }

    /// Largest distance, across the axis, from the contour of the line of this slope through the
    /// origin: the true edge, which has slope 1 for a stair, `1 / W` for a step and `1 - 1 / W` for a
    /// double step in a picture of W texels.
    ///
    /// Over a period of a stair; of a step on both sides as far as W / 2. Exact to 1e-6 where the
    /// contour has no feature below a thousandth of the kernel.
    pub fn deviation(&self, line_slope: f64) -> f64 {
        let tangent = (line_slope - self.axis_slope) / (1.0 + line_slope * self.axis_slope);
        let distance = |along: f64| (self.offset(along) - tangent * along).abs();
        let places = match self.silhouette {
            Silhouette::Stair => self.period(),
            _ => self.around_origin((0.5 / tangent.abs()).min(self.reach() + 2.0)),
        };
        let spacing = places[1] - places[0];
        let best = places.iter().map(|&along| (along, distance(along))).reduce(larger);
        best.map_or(0.0, |(along, at_best)| peak(distance, along - spacing, along + spacing).1.max(at_best))
    }

    /// Steepest angle between the contour and the axis, 0 to pi / 2.
    ///
    /// Of chords, each across two of the places at which it is measured: 1 / 360 of a stair's period,
    /// about a thousandth of the kernel for a step. A shorter look at a kink can be steeper, but not
    /// what an eye or a display resolves.
    pub fn tilt(&self) -> f64 {
        let places = match self.silhouette {
            Silhouette::Stair => self.period(),
            Silhouette::DoubleStep => self.around_origin(TRANSITION_RADII * self.core_radius() + 2.0 * SQRT_2),
            Silhouette::Step | Silhouette::Line { .. } => self.around_origin(TRANSITION_RADII * self.core_radius()),
        };
        let offsets: Vec<f64> = places.iter().map(|&along| self.offset(along)).collect();
        let rise = offsets.windows(3).map(|three| (three[2] - three[0]).abs()).fold(0.0, f64::max);
        libm::atan2(rise, places[2] - places[0])
    }

    /// A period of a stair, and one place more at each end.
    fn period(&self) -> Vec<f64> {
        (0..PERIOD_PLACES + 2).map(|place| (place as f64 - 1.0) * SQRT_2 / PERIOD_PLACES as f64).collect()
    }

    /// Places from `-half` to `half`, the origin among them.
    fn around_origin(&self, half: f64) -> Vec<f64> {
        let middle = (TRANSITION_PLACES / 2) as f64;
        (0..TRANSITION_PLACES).map(|place| (place as f64 - middle) / middle * half).collect()
    }

    /// Where across the axis, between two places, `silhouette` has this contour's level.
    fn across(&self, silhouette: Silhouette, along: f64, [low, high]: [f64; 2]) -> f64 {
        let run = 1.0 / (1.0 + self.axis_slope * self.axis_slope).sqrt();
        let rise = self.axis_slope * run;
        let at = |across: f64| {
            let [x, y] = [run * along - rise * across, rise * along + run * across];
            silhouette.coverage(self.kernel, self.radius_texels, x, y) - self.level
        };
        falling_root(at, low, high, PRECISION)
    }

    /// Distance beyond which nothing of the kernel is left.
    fn reach(&self) -> f64 {
        Filter::new(self.kernel, self.radius_texels).reach()
    }

    /// Radius within which the kernel has nearly all of its weight: three standard deviations of a
    /// Gaussian, 99.7 % in each direction.
    fn core_radius(&self) -> f64 {
        match self.kernel {
            Kernel::GaussianHalf => 1.5 * self.radius_texels,
            Kernel::Disc | Kernel::Box | Kernel::GaussianThird => self.radius_texels,
            Kernel::Poisson25 | Kernel::Poisson25Rotated => self.reach(),
        }
    }
}
