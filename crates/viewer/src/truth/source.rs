//! Which truth is asked for, and how often rays are sent for it.

use anyhow::{Result, ensure};
use scumble::{Filter, Light};
use scumble_core::{Fit, Taps};
use scumble_reference::{Estimate, KernelTruth, LightTruth, Rays, Receiver};
use scumble_scenes::Mesh;

use crate::cli::{Method, Truth, TruthOf};
use crate::truth::key::{Key, KeyBuilder};

/// Samples of the light by default: an error of about 1 % in the middle of a penumbra.
pub const LIGHT_SAMPLES: u32 = 256;
/// Most taps of a filter: throwing the darts of more takes longer than the rays.
const TAPS_MAX: u32 = 1024;

/// How often rays are sent for a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Samples {
    /// Taps of the filter.
    Kernel(u32),
    /// Points of the light.
    Light(u32),
}

impl Samples {
    /// Of the command line, checked before any work.
    pub fn of(options: &Truth) -> Result<Self> {
        match (options.truth, options.samples) {
            (TruthOf::Kernel, samples) => {
                let taps = samples.unwrap_or(Self::of_method(options.method).number());
                ensure!((1..=TAPS_MAX).contains(&taps), "--samples {taps}: the kernel truth has 1 to {TAPS_MAX} taps");
                Ok(Self::Kernel(taps))
            }
            (TruthOf::Light, samples) => {
                let samples = samples.unwrap_or(LIGHT_SAMPLES);
                let allowed = LightTruth::SAMPLES;
                ensure!(allowed.contains(&samples), "--samples {samples}: the light truth takes one of {allowed:?}");
                Ok(Self::Light(samples))
            }
        }
    }

    /// As many taps as the renderer's filter has; of VSM, which has none, enough.
    pub fn of_method(method: Method) -> Self {
        let taps = match method {
            Method::None | Method::Pcf | Method::Pcss => Taps::FILTER,
            Method::Vsm => Taps::SQUARE,
        };
        Self::Kernel(taps as u32)
    }

    /// Points of the light, `None` for a filter.
    pub fn of_light(self) -> Option<u32> {
        match self {
            Self::Kernel(_) => None,
            Self::Light(samples) => Some(samples),
        }
    }

    /// Rays a pixel; a filter with a blocker search sends some more.
    pub fn number(self) -> u32 {
        match self {
            Self::Kernel(number) | Self::Light(number) => number,
        }
    }
}

/// What answers for a receiver.
pub enum Source<'a> {
    /// The light has no view, so all is lit.
    Open,
    /// A filter over the exact hard shadow.
    Kernel(KernelTruth<'a>),
    /// The light itself.
    Light(LightTruth<'a>, &'a Light),
}

impl<'a> Source<'a> {
    /// `fit` says where a filter's radii are measured, and is `None` where the light sees nothing; a truth of the light
    /// needs none.
    pub fn new(
        rays: &'a Rays,
        light: &'a Light,
        fit: Option<&'a Fit>,
        filter: Filter,
        samples: Samples,
    ) -> Result<Self> {
        match samples {
            Samples::Light(samples) => Ok(Self::Light(LightTruth::new(rays, light, samples)?, light)),
            Samples::Kernel(taps) => Ok(match fit {
                None => Self::Open,
                Some(fit) => {
                    let taps = Taps::of(&filter, taps as usize);
                    Self::Kernel(KernelTruth { taps, ..KernelTruth::new(rays, fit, filter) })
                }
            }),
        }
    }

    /// Visibility of receivers, on all cores. A filter is no sample of anything: its standard error is 0.
    pub fn estimates(&self, receivers: &[Receiver], progress: impl Fn(usize) + Sync) -> Vec<Estimate> {
        let exact = |visibility| Estimate { visibility, standard_error: 0.0 };
        match self {
            Self::Open => vec![exact(1.0); receivers.len()],
            Self::Kernel(truth) => truth.visibility(receivers, progress).into_iter().map(exact).collect(),
            Self::Light(truth, _) => truth.visibility(receivers, progress),
        }
    }

    /// By what the truth of these receivers among these meshes is found again.
    pub fn key(&self, meshes: &[Mesh], receivers: &[Receiver]) -> Key {
        let key = KeyBuilder::new().meshes(meshes).receivers(receivers);
        match self {
            Self::Open => key.text("open"),
            Self::Kernel(truth) => {
                key.text("kernel").text(&format!("{:?} {:?}", truth.filter, truth.fit)).taps(&truth.taps)
            }
            Self::Light(truth, light) => key.text("light").text(&format!("{light:?} {}", truth.samples())),
        }
        .finish()
    }
}
