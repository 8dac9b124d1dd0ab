//! Several maps under one budget: all give way by the same rungs of the ladder.
//!
//! Each map has the texel that its demand asks for ([`TexelPolicy`](crate::TexelPolicy), which a budget leaves without a
//! cap). Where they do not fit together, every texel is made coarser by one common factor `2^(k/4)`, so that all maps keep the
//! same share of the ratio that hides their texels: `c_effective = c 2^(-k/4)`. A map that its cap has taken further is
//! left where it is, and one at its floor gives no more; so none gives way while another has more than it.
//!
//! k is the smallest with which the maps fit. It falls again when they would fit with a tenth more room, so that boxes that
//! breathe do not switch all texels at once. Whether maps fit is the caller's to say, who packs them.

use glam::DVec2;

use crate::policy::{ROOM, finest_rung, rung_of, texel};

/// Most rungs that maps give way: from the largest cap there is, 32,768 texels, below the least floor, 8.
const RUNGS_MAX: u32 = 52;

/// How far maps have given way, between frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Budget {
    rungs: u32,
}

impl Budget {
    /// Rungs of the ladder, quarters of an octave, by which all maps give way.
    #[must_use]
    pub fn rungs(&self) -> u32 {
        self.rungs
    }

    /// The next frame's. `fits(rungs, growth)` says whether the maps fit when they give way by so many rungs and their boxes
    /// are `growth` times as wide and high; it must hold for a growth of 1 when it holds for more. `None` where they do not
    /// fit however far they give way.
    #[must_use]
    pub fn next(&self, fits: impl Fn(u32, f64) -> bool) -> Option<Self> {
        let from = |first: u32, growth: f64| (first..=RUNGS_MAX).find(|&rungs| fits(rungs, growth));
        let least = from(0, 1.0)?;
        let with_room = from(least, 1.0 + ROOM).unwrap_or(RUNGS_MAX);
        Some(Self { rungs: from(self.rungs.clamp(least, with_room), 1.0).unwrap_or(least) })
    }
}

/// The texel of a map that gives way, in metres, of one that asks for `texel_world` of the ladder and measures
/// `extent_world`: coarser by so many rungs, but no finer than `cap` texels across allow and no coarser than `floor` texels
/// need.
#[must_use]
pub fn given_way(texel_world: DVec2, extent_world: DVec2, rungs: u32, cap: u32, floor: u32) -> DVec2 {
    let axis = |texel_world: f64, extent: f64| {
        let asked = rung_of(texel_world);
        let least = finest_rung(extent, floor);
        texel(asked.saturating_sub_unsigned(rungs).max(least).min(asked).min(finest_rung(extent, cap)))
    };
    DVec2::new(axis(texel_world.x, extent_world.x), axis(texel_world.y, extent_world.y))
}

/// Most texels that a box takes wherever it lies on its lattice, and at least `least`; see
/// [`Fit::on_lattice`](crate::Fit::on_lattice).
#[must_use]
pub fn texels_at_most(extent_world: DVec2, texel_world: DVec2, least: u32) -> [u32; 2] {
    (extent_world / texel_world).to_array().map(|across| (across.ceil() as u32 + 1).max(least))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const CAP: u32 = 2048;
    const FLOOR: u32 = 8;

    /// A map of one metre that asks for this many texels.
    fn asking(n: f64) -> DVec2 {
        DVec2::splat(texel(rung_of(1.0 / n)))
    }

    fn area(texels: &[DVec2], extents: &[DVec2]) -> f64 {
        let of = |(texel, extent): (&DVec2, &DVec2)| {
            let [width, height] = texels_at_most(*extent, *texel, FLOOR);
            f64::from(width) * f64::from(height)
        };
        texels.iter().zip(extents).map(of).sum()
    }

    /// What maps get whose area is limited.
    fn shared(state: &Budget, asked: &[DVec2], extents: &[DVec2], most: f64) -> Option<(Budget, Vec<DVec2>)> {
        let given = |rungs: u32, growth: f64| -> Vec<DVec2> {
            asked.iter().zip(extents).map(|(&a, &e)| given_way(a, growth * e, rungs, CAP, FLOOR)).collect()
        };
        let grown = |growth: f64| extents.iter().map(|&extent| growth * extent).collect::<Vec<_>>();
        let next = state.next(|rungs, growth| area(&given(rungs, growth), &grown(growth)) <= most)?;
        Some((next, given(next.rungs(), 1.0)))
    }

    #[test]
    fn maps_that_fit_get_what_they_ask_for() {
        let (asked, extents) = ([asking(100.0), asking(400.0)], [DVec2::ONE; 2]);
        let (state, given) = shared(&Budget::default(), &asked, &extents, 500.0 * 500.0).unwrap();
        assert_eq!((state.rungs(), given), (0, asked.to_vec()));
    }

    #[test]
    fn maps_that_do_not_fit_give_way_by_one_factor() {
        let (asked, extents) = ([asking(128.0), asking(1024.0)], [DVec2::ONE; 2]);
        let (state, given) = shared(&Budget::default(), &asked, &extents, 300.0 * 300.0).unwrap();
        // 2^(7/4) = 3.36 leaves 304 texels of 1024, and 38 of 128: a rung too many. 2^2 leaves 256 and 32.
        assert_eq!(state.rungs(), 8);
        assert_eq!(given, [4.0 * asked[0], 4.0 * asked[1]]);
    }

    #[test]
    fn a_map_at_its_floor_gives_no_more_and_one_at_its_cap_waits_for_the_others() {
        let (asked, extents) = ([asking(10.0), asking(16_384.0)], [DVec2::ONE; 2]);
        let given = |rungs| [0, 1].map(|i| given_way(asked[i], extents[i], rungs, CAP, FLOOR).x);
        let (small, capped) = (texel(finest_rung(1.0, FLOOR)), texel(finest_rung(1.0, CAP)));
        assert_eq!(given(0), [asked[0].x, capped]);
        assert_eq!(given(8), [small, capped]);
        assert!(given(20)[1] > capped && given(20)[0] == small);
    }

    #[test]
    fn what_cannot_fit_is_said() {
        assert_eq!(shared(&Budget::default(), &[asking(100.0); 3], &[DVec2::ONE; 3], 100.0), None);
    }

    #[test]
    fn boxes_that_breathe_do_not_switch_texels() {
        let asked = [asking(500.0), asking(900.0)];
        let (mut state, mut switches, mut last) = (Budget::default(), 0, None);
        for frame in 0..400 {
            let extents = [DVec2::splat(1.0 + 0.04 * (f64::from(frame) * 0.3).sin()), DVec2::ONE];
            let (next, _) = shared(&state, &asked, &extents, 600.0 * 600.0).unwrap();
            switches += u32::from(last.is_some_and(|last| last != next.rungs()));
            (state, last) = (next, Some(next.rungs()));
        }
        assert!(switches <= 1, "{switches}");
    }

    proptest! {
        #[test]
        fn maps_stay_under_the_budget_keep_their_order_and_none_gives_way_while_another_has_more(
            sides in prop::collection::vec((4.0..20_000.0_f64, 0.1..10.0_f64), 1..24),
            before in 0..40_u32,
            most in 40.0..4000.0_f64,
        ) {
            let extents: Vec<DVec2> = sides.iter().map(|&(_, aspect)| DVec2::new(1.0, aspect)).collect();
            let asked: Vec<DVec2> = sides.iter().map(|&(n, _)| asking(n)).collect();
            let Some((_, given)) = shared(&Budget { rungs: before }, &asked, &extents, most * most) else {
                prop_assert!(most < 60.0);
                return Ok(());
            };
            prop_assert!(area(&given, &extents) <= most * most);
            // What a map has of what it asked for, in rungs: 0 is all.
            let has = |i: usize| rung_of(given[i].x) - rung_of(asked[i].x);
            let is_free = |i: usize| given[i].x < texel(finest_rung(1.0, FLOOR)) && given[i].x > texel(finest_rung(1.0, CAP));
            for i in 0..given.len() {
                prop_assert!(given[i].cmpge(asked[i]).all());
                for j in 0..given.len() {
                    prop_assert!(asked[i].x > asked[j].x || given[i].x <= given[j].x);
                    prop_assert!(!is_free(i) || !is_free(j) || has(i) == has(j));
                    // More than another has only what is at its floor.
                    prop_assert!(has(i) <= has(j) || given[i].x >= texel(finest_rung(1.0, FLOOR)) || !is_free(j));
                }
            }
        }

        #[test]
        fn sizes_settle_at_once_when_what_is_asked_for_does(
            sides in prop::collection::vec(4.0..20_000.0_f64, 1..12),
            before in 0..40_u32,
        ) {
            let asked: Vec<DVec2> = sides.iter().map(|&n| asking(n)).collect();
            let extents = vec![DVec2::ONE; asked.len()];
            let (first, given) = shared(&Budget { rungs: before }, &asked, &extents, 1000.0 * 1000.0).unwrap();
            prop_assert_eq!(shared(&first, &asked, &extents, 1000.0 * 1000.0), Some((first, given)));
        }
    }
}
