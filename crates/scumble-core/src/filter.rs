//! The estimators of visibility, one implementation for every source of depth.
//!
//! A source is a closure: a shadow map on the CPU (the twin of the shaders), or rays (the alias-free truth). Offsets
//! are lengths on the fit's reference plane, in metres; depths are light-space depths, in metres; visibility is 1 lit,
//! 0 dark.
//!
//! Percentage closer filtering: the mean of comparisons over a disc of taps, rotated per pixel (Kreuzer 2017, 5.1.3).
//! Percentage closer soft shadows, for a spot of radius `r_light`, receiver `z_r`, near plane `z_n` (5.8 to 5.11):
//! ```text
//! r_search = r_light (z_r - z_n) / z_r        z_b = mean depth of the taps in front of the receiver
//! r_filter = r_light (z_r - z_b) / z_b * z_n / z_r
//! ```
//! and for parallel light of half angle `h` the same triangles: `r_search = (z_r - z_n) tan h`, `r_filter = (z_r - z_b)
//! tan h`. All are radii; 5.8's `w` is the light's radius. The filter is no narrower than `radius_min_world` (6.2), nor
//! the search, since it must find what the filter reaches. Under a point light discs are those across the ray, which
//! [`ReceiverPlane::on_plane`] puts on the plane. "In front of the receiver" means of its tangent plane at the
//! tap.

use glam::DVec2;

use crate::bias::ReceiverPlane;
use crate::fit::Fit;
use crate::kernel::{poisson_disc, square_taps};
use crate::light::Light;
use crate::settings::Filter;

/// Depth of the nearest occluder that a lamp's search is made for, as a share of the receiver's depth: its penumbra is
/// four times the lamp in radius.
pub const SEARCH_SHARE: f64 = 0.2;

/// The taps of all filters, in the unit disc.
#[derive(Clone, Debug, PartialEq)]
pub struct Taps {
    /// Taps of the blocker search.
    pub blocker: Vec<DVec2>,
    /// Taps of the filter.
    pub filter: Vec<DVec2>,
}

impl Taps {
    /// Taps of the blocker search by default.
    pub const BLOCKER: usize = 16;
    /// Taps of the filter by default (Kreuzer 2017, 5.1.3).
    pub const FILTER: usize = 25;
    /// Seeds of the two discs, the best of the first 64 by their residual error on a straight edge.
    pub const SEEDS: [u64; 2] = [19, 47];

    /// Taps by default of a truth of variance shadow maps, whose kernel has no taps of its own: one in every 64th of the
    /// square along x and along y, so that an edge along either errs by 1/128 at most.
    pub const SQUARE: usize = 64;

    /// What stands for a filter's kernel over rays, `filter` taps of it: its disc, or for variance shadow maps its square.
    #[must_use]
    pub fn of(kind: &Filter, filter: usize) -> Self {
        match kind {
            Filter::Vsm { .. } => Self { blocker: Vec::new(), filter: square_taps(filter) },
            Filter::Hard | Filter::Pcf { .. } | Filter::Pcss => Self::new(Self::BLOCKER, filter),
        }
    }

    /// Number of taps of a filter by default.
    #[must_use]
    pub fn count_of(kind: &Filter) -> usize {
        match kind {
            Filter::Vsm { .. } => Self::SQUARE,
            Filter::Hard | Filter::Pcf { .. } | Filter::Pcss => Self::FILTER,
        }
    }

    /// Discs of these numbers of taps.
    #[must_use]
    pub fn new(blocker: usize, filter: usize) -> Self {
        let [blocker_seed, filter_seed] = Self::SEEDS;
        Self { blocker: poisson_disc(blocker, blocker_seed), filter: poisson_disc(filter, filter_seed) }
    }
}

impl Default for Taps {
    fn default() -> Self {
        Self::new(Self::BLOCKER, Self::FILTER)
    }
}

/// The occluders that a search found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blockers {
    /// z_b, mean depth of the taps in front of the receiver, in metres; of [`ReceiverPlane::depth_along_ray`].
    pub mean_depth: f64,
    /// Number of taps in front of the receiver, at least 1.
    pub count: usize,
    /// Number of taps.
    pub total: usize,
}

/// What a soft-shadow estimate found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoftShadow {
    /// 1 lit, 0 dark.
    pub visibility: f64,
    /// Occluders; `None` where the search found none, and all is lit.
    pub blockers: Option<Blockers>,
    /// Radius of the filter at the reference plane, in metres, after the lower clamp; 0 without occluders.
    pub radius_world: f64,
}

/// Offset of a tap: scaled to `radius_world` and turned by `rotation` radians.
#[must_use]
pub fn tap_offset(tap: DVec2, radius_world: f64, rotation: f64) -> DVec2 {
    DVec2::from_angle(rotation).rotate(tap) * radius_world
}

/// One comparison at the receiver. `lookup(offset, depth)` is 1 where nothing lies in front of `depth`.
pub fn hard(lookup: impl Fn(DVec2, f64) -> f64, plane: &ReceiverPlane) -> f64 {
    lookup(DVec2::ZERO, plane.depth_at(DVec2::ZERO))
}

/// Mean of the comparisons over a disc of `radius_world`; 1 without taps.
pub fn pcf(
    lookup: impl Fn(DVec2, f64) -> f64,
    taps: &[DVec2],
    radius_world: f64,
    rotation: f64,
    plane: &ReceiverPlane,
) -> f64 {
    if taps.is_empty() {
        return 1.0;
    }
    let lit: f64 = taps
        .iter()
        .map(|&tap| {
            let offset = plane.on_plane(tap_offset(tap, radius_world, rotation));
            lookup(offset, plane.depth_at(offset))
        })
        .sum();
    lit / taps.len() as f64
}

/// Mean depth of the taps in front of the receiver's plane (Kreuzer 2017, Eq. 5.9). `depth_at(offset)` is the depth of
/// the first surface, `None` where there is none.
pub fn blocker_search(
    depth_at: impl Fn(DVec2) -> Option<f64>,
    taps: &[DVec2],
    search_radius_world: f64,
    rotation: f64,
    plane: &ReceiverPlane,
) -> Option<Blockers> {
    let mut sum = 0.0;
    let mut count = 0;
    for &tap in taps {
        let offset = plane.on_plane(tap_offset(tap, search_radius_world, rotation));
        if let Some(depth) = depth_at(offset).filter(|&depth| depth < plane.depth_at(offset)) {
            sum += plane.depth_along_ray(depth, offset);
            count += 1;
        }
    }
    (count > 0).then(|| Blockers { mean_depth: sum / count as f64, count, total: taps.len() })
}

/// Radius around the receiver in which an occluder can shade it, at the reference plane, in metres (Eq. 5.8).
///
/// That is the filter's radius for an occluder at the near plane. Where a spot's near plane is close to it, as under a
/// ceiling, that is the whole lamp on a picture smaller than the lamp, and all taps miss the map; so occluders nearer
/// than [`SEARCH_SHARE`] of the receiver's depth are not searched to their full width.
#[must_use]
pub fn search_radius_world(fit: &Fit, receiver_depth: f64) -> f64 {
    let nearest = match fit.light {
        Light::Directional { .. } => fit.depth_near,
        Light::Spot { .. } | Light::Point { .. } => fit.depth_near.max(SEARCH_SHARE * receiver_depth),
    };
    filter_radius_world(fit, receiver_depth, nearest)
}

/// Radius of the filter that stands for the penumbra, at the reference plane, in metres (Eq. 5.10 and 5.11); 0 when the
/// blockers are no nearer to the light than the receiver.
#[must_use]
pub fn filter_radius_world(fit: &Fit, receiver_depth: f64, blocker_depth: f64) -> f64 {
    let gap = (receiver_depth - blocker_depth).max(0.0);
    match fit.light {
        Light::Directional { half_angle, .. } => gap * half_angle.tan(),
        Light::Spot { radius_world, .. } | Light::Point { radius_world, .. } => {
            radius_world * gap / blocker_depth * fit.reference_depth() / receiver_depth
        }
    }
}

/// Percentage closer soft shadows: search, radius, filter.
pub fn pcss(
    depth_at: impl Fn(DVec2) -> Option<f64>,
    lookup: impl Fn(DVec2, f64) -> f64,
    taps: &Taps,
    rotation: f64,
    fit: &Fit,
    plane: &ReceiverPlane,
    radius_min_world: f64,
) -> SoftShadow {
    let search = search_radius_world(fit, plane.depth).max(radius_min_world);
    let Some(blockers) = blocker_search(depth_at, &taps.blocker, search, rotation, plane) else {
        return SoftShadow { visibility: 1.0, blockers: None, radius_world: 0.0 };
    };
    let radius_world = filter_radius_world(fit, plane.depth, blockers.mean_depth).max(radius_min_world);
    let visibility = pcf(lookup, &taps.filter, radius_world, rotation, plane);
    SoftShadow { visibility, blockers: Some(blockers), radius_world }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Bias;
    use crate::fit::fit;
    use crate::fit::tests_support::{lamp_over_room, observer, room, sun_over_room};
    use crate::kernel::half_plane_under_disc;
    use glam::DVec3;

    fn plane(fit: &Fit, p: DVec3) -> ReceiverPlane {
        ReceiverPlane::new(fit, p, DVec3::Y, &Bias::without_texels(), DVec2::ZERO)
    }

    #[test]
    fn the_filter_of_a_straight_edge_is_the_closed_form() {
        let fit = sun_over_room();
        let receiver = plane(&fit, DVec3::ZERO);
        let taps = poisson_disc(1000, 1);
        for i in -10..=10 {
            let t = f64::from(i) / 10.0;
            let lookup = |offset: DVec2, _| f64::from(u8::from(offset.x > -0.3 * t));
            let filtered = pcf(lookup, &taps, 0.3, 0.7, &receiver);
            assert!((filtered - half_plane_under_disc(t)).abs() < 0.02, "{t} {filtered}");
        }
    }

    #[test]
    fn an_open_plane_is_lit_and_a_lid_above_it_darkens_it() {
        for fit in [sun_over_room(), lamp_over_room()] {
            let receiver = plane(&fit, DVec3::new(0.2, 0.0, 0.1));
            let itself = |offset: DVec2| Some(receiver.depth_at(offset) + receiver.bias_world);
            let lookup = |offset: DVec2, depth: f64| f64::from(u8::from(itself(offset).is_none_or(|d| d >= depth)));
            let open = pcss(itself, lookup, &Taps::default(), 1.0, &fit, &receiver, 0.01);
            assert_eq!((open.visibility, open.blockers, open.radius_world), (1.0, None, 0.0));
            let lid = receiver.depth - 0.5;
            let closed = pcss(
                |_| Some(lid),
                |_, depth| f64::from(u8::from(lid >= depth)),
                &Taps::default(),
                1.0,
                &fit,
                &receiver,
                0.0,
            );
            assert_eq!(closed.visibility, 0.0);
            let blockers = closed.blockers.unwrap();
            assert_eq!((blockers.count, blockers.total), (16, 16));
            assert!((blockers.mean_depth - lid).abs() < 1e-12);
            let expected = filter_radius_world(&fit, receiver.depth, lid);
            assert!((closed.radius_world - expected).abs() < 1e-12);
        }
    }

    #[test]
    fn the_radii_are_those_of_similar_triangles() {
        let fit = lamp_over_room();
        let Light::Spot { radius_world: light, .. } = fit.light else { unreachable!() };
        let (receiver, blocker) = (4.0, 2.5);
        // The penumbra at the receiver is the light's disc seen through the blocker; its rays from the light's middle
        // narrow it to the reference plane.
        let penumbra = light * (receiver - blocker) / blocker;
        let on_plane = penumbra * fit.depth_near / receiver;
        assert!((filter_radius_world(&fit, receiver, blocker) - on_plane).abs() < 1e-12);
        // A blocker on the near plane has the widest penumbra: what the search covers.
        let widest = filter_radius_world(&fit, receiver, fit.depth_near);
        assert!((search_radius_world(&fit, receiver) - widest).abs() < 1e-12);
        let sun = sun_over_room();
        let gap = 1.5;
        assert!((filter_radius_world(&sun, 2.0 + gap, 2.0) - gap * 0.05_f64.tan()).abs() < 1e-12);
        let near = sun.depth_near;
        assert_eq!(search_radius_world(&sun, near + 1.0), filter_radius_world(&sun, near + 1.0, near));
    }

    #[test]
    fn a_lamp_among_its_occluders_searches_a_penumbra_of_four_times_its_radius() {
        let inside = Light::Spot {
            position: DVec3::new(0.5, 2.0, -0.5),
            direction: DVec3::NEG_Y,
            cone_half_angle: 0.8,
            radius_world: 0.2,
        };
        let fit = fit(&observer(), &room(), &inside, true).unwrap().unwrap();
        let receiver = 2.3;
        assert!(fit.depth_near < 0.1 * SEARCH_SHARE * receiver);
        let at_receiver = search_radius_world(&fit, receiver) / fit.reference_from_depth(receiver);
        assert!((at_receiver - 4.0 * 0.2).abs() < 1e-12, "{at_receiver}");
    }

    #[test]
    fn a_blocker_at_or_behind_the_receiver_has_no_radius_but_the_smallest() {
        for fit in [sun_over_room(), lamp_over_room()] {
            assert_eq!(filter_radius_world(&fit, 3.0, 3.0), 0.0);
            assert_eq!(filter_radius_world(&fit, 3.0, 3.5), 0.0);
            assert_eq!(search_radius_world(&fit, fit.depth_near - 1e-3), 0.0);
        }
    }

    #[test]
    fn contact_is_filtered_with_the_smallest_radius() {
        let fit = sun_over_room();
        let receiver = plane(&fit, DVec3::ZERO);
        let touching = |_| Some(receiver.depth - 0.01);
        let shadow = pcss(touching, |_, _| 0.0, &Taps::default(), 0.0, &fit, &receiver, 0.04);
        assert_eq!(shadow.radius_world, 0.04);
    }

    #[test]
    fn a_hard_shadow_is_one_lookup_at_the_receiver() {
        let fit = sun_over_room();
        let receiver = plane(&fit, DVec3::ZERO);
        let lookups = std::cell::Cell::new(0);
        let lit = hard(
            |offset, depth| {
                lookups.set(lookups.get() + 1);
                assert_eq!((offset, depth), (DVec2::ZERO, receiver.depth_at(DVec2::ZERO)));
                1.0
            },
            &receiver,
        );
        assert_eq!((lit, lookups.get()), (1.0, 1));
    }
}
