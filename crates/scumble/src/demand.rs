//! What is asked of a map: what the screen was measured to need, or what the bounds say.
//!
//! Without a measurement it is the radius itself (PCF), the settings' smallest radius (PCSS), 0 (one tap), so a PCSS map
//! starts at the cap unless `radius_min_world` or `texel_floor_world` bound it.

use scumble_core::{Demand, Filter, Fit, Light, RadiusHistogram, Settings, Statistic};

use crate::counters::BlockCounts;
use crate::uniforms::MapDemand;

/// How to read what is found under a map when it comes back and the fit is another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    scale: f64,
    first_bin: u32,
}

impl Reading {
    /// Of a map that is measured.
    pub fn of(fit: &Fit) -> Self {
        Self { scale: measure_scale(fit), first_bin: first_bin(fit) }
    }

    /// What the bits that came back say.
    pub fn found(&self, demand: &MapDemand, [lit, umbra, mixed]: [u32; 3], statistic: Statistic) -> Found {
        let histogram = RadiusHistogram::new(self.first_bin, &demand.counts);
        Found {
            radius_per_scale: self.per_scale(statistic.demand(demand.minimum_bits, &histogram)),
            is_lit: demand.shadowed == 0,
            blocks: Some(BlockCounts { lit, umbra, mixed }),
        }
    }

    /// What the demand alone says.
    pub fn found_demand(&self, demand: Demand) -> Found {
        Found { radius_per_scale: self.per_scale(demand), is_lit: false, blocks: None }
    }

    fn per_scale(&self, demand: Demand) -> Option<f64> {
        match demand {
            Demand::Radius(radius_world) => Some(radius_world / self.scale),
            Demand::Nothing => None,
        }
    }
}

/// What was found on screen under one map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// The radius that counts: over the reference depth of a spot, radius for other lights; `None` for no penumbra.
    pub radius_per_scale: Option<f64>,
    /// Whether everything is known to see all of the light.
    pub is_lit: bool,
    /// By kind; `None` where they were not counted.
    pub blocks: Option<BlockCounts>,
}

/// First bin of the histogram of the radii under a map.
pub fn first_bin(fit: &Fit) -> u32 {
    RadiusHistogram::first_bin(fit.extent_world.max_element())
}

/// What is asked of a map of this fit; `measured` is `None` before the first measurement.
pub fn demand(settings: &Settings, filter: &Filter, fit: &Fit, measured: Option<Found>) -> Demand {
    match measured.map(|found| found.radius_per_scale) {
        Some(Some(radius_per_scale)) => Demand::Radius(radius_per_scale * measure_scale(fit)),
        Some(None) => Demand::Nothing,
        None => {
            let radius = filter.fixed_radius_world().unwrap_or(0.0);
            Demand::Radius(settings.demand_radius_world(radius, 0.0))
        }
    }
}

/// What a measured radius is divided by to outlive its fit: the reference depth of a lamp, 1 otherwise.
pub fn measure_scale(fit: &Fit) -> f64 {
    match fit.light {
        Light::Directional { .. } => 1.0,
        Light::Spot { .. } | Light::Point { .. } => fit.reference_depth(),
    }
}

/// What the slices or faces of one light are asked for, of demands with the extents of their maps in metres. A slice without a
/// penumbra is lent the demand of the nearest slice that has one: what enters it comes from there. It gets that slice's
/// texel, but no more texels. Else a slice that nothing has been in yet would stay at the size it started with.
pub fn lent(asked: &[(Demand, f64)]) -> Vec<Demand> {
    let radius_of = |slice: usize| match asked.get(slice) {
        Some(&(Demand::Radius(radius), extent)) => Some((radius, extent)),
        _ => None,
    };
    let of_slice = |(slice, &(demand, extent)): (usize, &(Demand, f64))| {
        if demand != Demand::Nothing {
            return demand;
        }
        let others = (1..asked.len()).flat_map(|apart| [Some(slice + apart), slice.checked_sub(apart)]);
        let lender = others.flatten().find_map(radius_of);
        lender.map_or(Demand::Nothing, |(radius, its)| Demand::Radius(radius * (extent / its).max(1.0)))
    };
    asked.iter().enumerate().map(of_slice).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOTHING: Demand = Demand::Nothing;

    #[test]
    fn a_slice_without_a_penumbra_is_lent_the_texel_of_its_neighbour_but_no_more_texels() {
        let asked = [(NOTHING, 5.0), (Demand::Radius(0.1), 10.0), (NOTHING, 40.0)];
        assert_eq!(lent(&asked), [Demand::Radius(0.1), Demand::Radius(0.1), Demand::Radius(0.4)]);
    }

    #[test]
    fn of_two_neighbours_the_farther_one_lends() {
        let asked = [(Demand::Radius(0.1), 10.0), (NOTHING, 20.0), (Demand::Radius(0.3), 40.0)];
        assert_eq!(lent(&asked)[1], Demand::Radius(0.3));
    }

    #[test]
    fn one_map_alone_and_a_view_without_a_penumbra_are_asked_for_nothing() {
        assert_eq!(lent(&[(NOTHING, 1.0)]), [NOTHING]);
        assert_eq!(lent(&[(NOTHING, 1.0), (NOTHING, 2.0)]), [NOTHING, NOTHING]);
        assert_eq!(lent(&[]), []);
    }
}
