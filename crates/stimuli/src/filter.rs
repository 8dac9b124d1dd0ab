//! A kernel as a mean of closed-form densities.
//!
//! Disc, square and Gaussian are one density. The 25 taps of a renderer compare the four texels around
//! each tap bilinearly: the texels are constant squares of side 1, and bilinear weights are the areas
//! of those squares under a unit square around the tap, so one tap is exactly the square density of
//! radius 1/2 there, and the filter the mean of 25 of them. A line gets the same taps and squares, so
//! that nothing but the steps tells it from an artifact.

use std::sync::LazyLock;

use scumble_core::Taps;

use crate::Kernel;
use crate::density::Density;

/// Filter taps of the drop-in, in the unit disc.
static TAPS: LazyLock<Vec<[f64; 2]>> =
    LazyLock::new(|| Taps::default().filter.iter().map(|tap| [tap.x, tap.y]).collect());

/// Half the side of the square that one bilinear comparison averages, in texels.
const TAP_RADIUS: f64 = 0.5;

/// A kernel at its size; lengths in texels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Filter {
    /// What lies around every tap.
    pub(crate) density: Density,
    taps: &'static [[f64; 2]],
    radius: f64,
    turn: [f64; 2],
}

impl Filter {
    /// `kernel` with a radius in texels; taps are not turned.
    pub(crate) fn new(kernel: Kernel, radius: f64) -> Self {
        let (density, taps) = match kernel {
            Kernel::Disc => (Density::Disc { radius }, [[0.0; 2]].as_slice()),
            Kernel::Box => (Density::Box { radius }, [[0.0; 2]].as_slice()),
            Kernel::GaussianHalf => (Density::Gaussian { sigma: radius / 2.0 }, [[0.0; 2]].as_slice()),
            Kernel::GaussianThird => (Density::Gaussian { sigma: radius / 3.0 }, [[0.0; 2]].as_slice()),
            Kernel::Poisson25 | Kernel::Poisson25Rotated => (Density::Box { radius: TAP_RADIUS }, TAPS.as_slice()),
        };
        Self { density, taps, radius, turn: [1.0, 0.0] }
    }

    /// The taps turned counter-clockwise by an angle in radians.
    pub(crate) fn turned(self, angle: f64) -> Self {
        Self { turn: [libm::cos(angle), libm::sin(angle)], ..self }
    }

    /// Distance beyond which nothing of the kernel is left.
    pub(crate) fn reach(&self) -> f64 {
        let spread = if self.taps.len() > 1 { self.radius } else { 0.0 };
        spread + self.density.reach()
    }

    /// Weight of the half plane that contains the origin at depth `depth` behind its edge; `normal` is
    /// the unit normal of the edge, out of the half plane.
    pub(crate) fn half_plane(&self, depth: f64, normal: [f64; 2]) -> f64 {
        self.mean(|[dx, dy]| self.density.half_plane(depth - normal[0] * dx - normal[1] * dy, normal))
    }

    /// Mean of what a function gives for the taps' offsets.
    pub(crate) fn mean(&self, of: impl Fn([f64; 2]) -> f64) -> f64 {
        let offsets = self.offsets();
        let taps = offsets.len() as f64;
        offsets.map(of).sum::<f64>() / taps
    }

    /// Offsets of the taps.
    pub(crate) fn offsets(&self) -> impl ExactSizeIterator<Item = [f64; 2]> {
        let &Self { radius, turn: [cos, sin], taps, .. } = self;
        taps.iter().map(move |&[x, y]| [radius * (cos * x - sin * y), radius * (sin * x + cos * y)])
    }
}
