//! Where texels are seen: the share of the penumbra whose demand the map that a pixel reads does not meet.
//!
//! ```text
//! share = #{demand < c a} / #{r > 0}      demand = max(r, c pixel footprint, floors), see [`Settings::demand_radius_world`]
//! ```
//! r: radius of the filter, a: texel of the map, both in metres at the reference plane; c: ratio of the run's relation
//! (Kreuzer 2017, Eq. 5.1). A texel that is no larger than a pixel is none that is seen. A pixel without a radius found no
//! occluder and has no edge to hide.

use anyhow::Result;
use scumble::Settings;

use crate::bench::comparison::Screen;
use crate::bench::demand::{asked, settings_of_run};
use crate::cli::Method;
use crate::stage::Stage;
use crate::variant::Variant;

/// Rounding that does not make a radius of exactly c texels a violation.
const SLACK: f64 = 1e-4;

/// The share, 0 to 1, under the maps of a variant; `None` where nothing is filtered. `radii` are those of the filter before
/// its lower clamp.
pub fn violation_share(
    stage: &Stage,
    variant: &Variant,
    screen: &Screen,
    penumbra: &[bool],
    radii: &[f32],
) -> Result<Option<f64>> {
    let settings = settings_of_run(stage, variant);
    let (mut count, mut violations) = (0u64, 0u64);
    for pixel in asked(stage, variant.plan()?, screen, penumbra, radii) {
        // Only PCSS widens what is narrower than its least radius.
        let radius_least = if variant.case.method == Method::Pcss { pixel.view.radius_min_world } else { 0.0 };
        let demand = settings.demand_radius_world(pixel.radius_world.max(radius_least), pixel.footprint_world);
        count += 1;
        violations += u64::from(is_seen(pixel.view.texel_world().max_element(), demand, &settings));
    }
    Ok((count > 0).then(|| violations as f64 / count as f64))
}

/// Whether a texel is larger than a demand hides.
fn is_seen(texel_world: f64, demand_radius_world: f64, settings: &Settings) -> bool {
    demand_radius_world < settings.relation.radius_from_texel(texel_world) * (1.0 - SLACK)
}

#[cfg(test)]
mod tests {
    use super::*;
    use scumble::scumble_core::Relation;

    #[test]
    fn a_filter_of_c_texels_hides_them_and_a_narrower_one_those_that_are_no_larger_than_a_pixel() {
        let settings = Settings { relation: Relation::exact(2.5).unwrap(), ..Settings::default() };
        let is_seen =
            |radius: f64, footprint: f64| is_seen(0.1, settings.demand_radius_world(radius, footprint), &settings);
        assert!(!is_seen(0.25, 0.0) && !is_seen(0.25 * (1.0 - 0.5 * SLACK), 0.0) && !is_seen(1.0, 0.0));
        assert!(is_seen(0.2499, 0.0) && is_seen(0.01, 0.0) && is_seen(0.01, 0.05));
        assert!(!is_seen(0.01, 0.1 / settings.footprint_kappa));
    }
}
