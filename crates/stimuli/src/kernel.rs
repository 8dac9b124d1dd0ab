//! The kernels that average the hard shadow, by name.

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
    /// The 25 taps of the drop-in renderer ([`scumble_core::Taps`]) in the disc of radius r, each a
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
