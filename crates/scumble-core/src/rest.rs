//! A map that nobody on screen is shadowed by needs no fine texels: it rests at a small size until a shadow is seen.
//!
//! It keeps its rung of the ladder meanwhile ([`TexelPolicy`](crate::TexelPolicy)) and returns to it at once. What the small
//! map loses is a caster narrower than its texels, which is found only when it is wide enough to be drawn; so it is small,
//! not the smallest: [`Settings::side_at_rest`].
//!
//! Coarse texels can show a shadow at the border of the picture that the fine map does not have. A rest that such a shadow
//! ends would begin again and again, so one whose shadow is gone before a new rest could begin makes the next wait twice as
//! long: a loop of this kind ends less often the longer it runs.

use glam::DVec2;

use crate::policy::{finest_rung, texel};
use crate::settings::Settings;

/// Most times that the wait is doubled: at 60 pictures a second years.
const DOUBLINGS_MAX: u32 = 31;

/// Whether one map rests.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rest {
    pictures_lit: u32,
    pictures_shadowed: u32,
    was_woken: bool,
    doublings: u32,
}

impl Rest {
    /// Takes note of a picture that was measured under the map: whether all that it shows was lit.
    pub fn saw(&mut self, is_lit: bool, settings: &Settings) {
        if !is_lit {
            self.was_woken |= self.is_resting(settings);
            self.pictures_shadowed = self.pictures_shadowed.saturating_add(1);
            self.pictures_lit = 0;
            return;
        }
        if self.pictures_shadowed > 0 {
            let is_its_own = self.was_woken && self.pictures_shadowed < settings.shrink_after_frames.max(1);
            self.doublings = if is_its_own { (self.doublings + 1).min(DOUBLINGS_MAX) } else { 0 };
            self.was_woken = false;
            self.pictures_shadowed = 0;
        }
        self.pictures_lit = self.pictures_lit.saturating_add(1);
    }

    /// Whether all was lit for as many pictures as it takes.
    #[must_use]
    pub fn is_resting(&self, settings: &Settings) -> bool {
        let patience = settings.shrink_after_frames.max(1).saturating_mul(1 << self.doublings);
        self.pictures_lit >= patience
    }

    /// The texel to draw with, in metres at the reference plane, of a map that measures `extent_world` there and has
    /// `texel_world` when it does not rest.
    #[must_use]
    pub fn texel(&self, texel_world: DVec2, extent_world: DVec2, settings: &Settings) -> DVec2 {
        if !self.is_resting(settings) {
            return texel_world;
        }
        let most = settings.side_at_rest.max(settings.floor);
        texel_world.max(extent_world.map(|extent| texel(finest_rung(extent, most))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const FINE: DVec2 = DVec2::splat(1.0 / 2000.0);

    fn across(rest: &Rest, settings: &Settings) -> f64 {
        1.0 / rest.texel(FINE, DVec2::ONE, settings).x
    }

    fn resting(settings: &Settings) -> Rest {
        let mut rest = Rest::default();
        (0..settings.shrink_after_frames).for_each(|_| rest.saw(true, settings));
        rest
    }

    #[test]
    fn thirty_lit_pictures_make_a_map_small_and_one_shadow_brings_its_texel_back_at_once() {
        let settings = Settings::default();
        let mut rest = Rest::default();
        for _ in 0..29 {
            rest.saw(true, &settings);
            assert_eq!(rest.texel(FINE, DVec2::ONE, &settings), FINE);
        }
        rest.saw(true, &settings);
        assert!((200.0..=255.0).contains(&across(&rest, &settings)), "{}", across(&rest, &settings));
        rest.saw(false, &settings);
        assert_eq!(rest.texel(FINE, DVec2::ONE, &settings), FINE);
    }

    #[test]
    fn a_map_that_is_small_already_keeps_its_texel() {
        let settings = Settings::default();
        let coarse = DVec2::splat(0.02);
        assert_eq!(resting(&settings).texel(coarse, DVec2::ONE, &settings), coarse);
        let never = Settings { side_at_rest: settings.cap, ..settings };
        assert_eq!(resting(&never).texel(FINE, DVec2::ONE, &never), FINE);
    }

    #[test]
    fn a_shadow_that_only_the_small_map_has_ends_its_rest_ever_more_rarely() {
        let settings = Settings::default();
        let (mut rest, mut wakes) = (Rest::default(), 0);
        for _ in 0..30_000 {
            let was_resting = rest.is_resting(&settings);
            wakes += u32::from(was_resting);
            rest.saw(!was_resting, &settings);
        }
        // The waits of 30, 60, 120 ... pictures add up to 30,000 after ten.
        assert!((1..=10).contains(&wakes), "{wakes}");
    }

    #[test]
    fn a_shadow_that_stays_makes_the_wait_what_it_was() {
        let settings = Settings::default();
        let mut rest = Rest::default();
        let mut pictures_to_rest = |shadowed: u32| {
            (0..shadowed).for_each(|_| rest.saw(false, &settings));
            let wait = (1..).find(|_| {
                rest.saw(true, &settings);
                rest.is_resting(&settings)
            });
            wait.unwrap_or(0)
        };
        assert_eq!([0, 2, 2, 100].map(&mut pictures_to_rest), [30, 60, 120, 30]);
    }

    proptest! {
        #[test]
        fn pictures_that_settle_give_a_texel_that_settles(
            start in prop::collection::vec(any::<bool>(), 0..300),
            settled: bool,
            extent in 0.01..100.0_f64,
        ) {
            let settings = Settings::default();
            let mut rest = Rest::default();
            start.iter().for_each(|&is_lit| rest.saw(is_lit, &settings));
            // 300 pictures double the wait ten times at most, and each takes the wait before it: 8 times 30 at the last.
            (0..300).for_each(|_| rest.saw(settled, &settings));
            let extent = DVec2::new(extent, 2.0 * extent);
            let texel = rest.texel(FINE, extent, &settings);
            for _ in 0..100 {
                rest.saw(settled, &settings);
                prop_assert_eq!(rest.texel(FINE, extent, &settings), texel);
            }
            prop_assert!(texel.cmpge(FINE).all());
            prop_assert!(settled || texel == FINE);
            prop_assert!(!settled || (extent / texel).max_element() <= 255.0 * (1.0 + 1e-6));
        }
    }
}
