//! What the screen asks of a map: the largest texel that every pixel of the penumbra allows, as a histogram.
//!
//! ```text
//! texel = max(r / c, pixel footprint, floor)
//! ```
//! in metres at the light's reference plane, r the filter's radius there. Bins are quarter octaves, the ladder of the
//! policy; bin k holds texels of 2^(k/4) m up to the next. The largest size of the run measures, which sees the narrowest
//! penumbrae. Texels are lengths, so that maps of any extent and number stand beside it.

use std::collections::BTreeMap;

use anyhow::Result;
use scumble::scumble_core::pixel_footprint_world;
use scumble::{Plan, Settings, View};
use serde::{Deserialize, Serialize};

use crate::bench::comparison::Screen;
use crate::bench::row::Key;
use crate::stage::Stage;
use crate::variant::Variant;

/// Bins of an octave.
const BINS_PER_OCTAVE: f64 = 4.0;

/// The texels that a screen asks for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DemandHistogram {
    /// Scene and filter, and the size that measured.
    #[serde(flatten)]
    pub key: Key,
    /// Quarter octave k and the number of pixels in it, from the finest texel up; no bin is empty.
    pub bins: Vec<(i32, u64)>,
}

impl DemandHistogram {
    /// Of the penumbra under a variant; `radii` are those of the filter before its lower clamp.
    pub fn of(stage: &Stage, variant: &Variant, screen: &Screen, penumbra: &[bool], radii: &[f32]) -> Result<Self> {
        let mut bins = BTreeMap::new();
        let settings = settings_of_run(stage, variant);
        for pixel in asked(stage, variant.plan()?, screen, penumbra, radii) {
            let demand = settings.demand_radius_world(pixel.radius_world, pixel.footprint_world);
            *bins.entry(bin(settings.relation.texel_from_radius(demand))).or_default() += 1;
        }
        Ok(Self { key: Key::of(&stage.setup.scene.name, &variant.case), bins: bins.into_iter().collect() })
    }

    /// Smallest texel of a bin, metres.
    pub fn texel_world(bin: i32) -> f64 {
        (f64::from(bin) / BINS_PER_OCTAVE).exp2()
    }
}

/// A pixel of the penumbra under the map that it reads.
pub struct Asked<'a> {
    /// The map.
    pub view: &'a View,
    /// Radius of the filter before its lower clamp, metres at the reference plane.
    pub radius_world: f64,
    /// Width of the pixel, metres at the reference plane.
    pub footprint_world: f64,
}

/// The pixels of the penumbra that are filtered and have a map, with what they ask of it.
pub fn asked<'a>(
    stage: &'a Stage,
    plan: &'a Plan,
    screen: &'a Screen,
    penumbra: &'a [bool],
    radii: &'a [f32],
) -> impl Iterator<Item = Asked<'a>> {
    let camera = &stage.setup.scene.camera;
    let pixels = screen.surfaces.iter().zip(radii).zip(penumbra).filter(|(_, inside)| **inside);
    pixels.filter_map(move |((surface, &radius), _)| {
        let position = surface.filter(|_| radius > 0.0)?.position.as_dvec3();
        let view = plan.view_at(0, position)?;
        let footprint_world = pixel_footprint_world(camera, &view.fit, position, screen.size_px[1]);
        Some(Asked { view, radius_world: f64::from(radius), footprint_world })
    })
}

/// The settings of a variant under the relation of the run, which judges all sizes.
pub fn settings_of_run(stage: &Stage, variant: &Variant) -> Settings {
    Settings { relation: stage.setup.relation, ..variant.settings().clone() }
}

fn bin(texel_world: f64) -> i32 {
    (texel_world.log2() * BINS_PER_OCTAVE).floor() as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_texel_is_in_the_bin_that_begins_below_it() {
        for texel in [1e-6, 0.013, 0.5, 0.99, 1.0, 1.19, 7.3, 1e6] {
            let bin = bin(texel);
            assert!(DemandHistogram::texel_world(bin) <= texel && texel < DemandHistogram::texel_world(bin + 1));
        }
    }
}
