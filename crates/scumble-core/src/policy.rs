//! From a demand to a texel that a map can keep, frame by frame.
//!
//! Demand: the radius r that [`Statistic`](crate::Statistic) picks of those on screen, at the reference plane; it asks for texels of `a = r / c`. A map's texel is a
//! rung of a ladder of a quarter octave, `2^(-k/4)` metres, on average 1.19 times as many texels as were asked for, where
//! powers of two give 2.16. The ladder is of texels and not of sizes: while the rung stays, so does the lattice of
//! texels in the world ([`Fit::on_lattice`](crate::Fit::on_lattice)), and a camera that moves changes only how much of it
//! the map holds. The rung gets finer at once, since texels show. It gets coarser when the demand stayed 20 % below for
//! 30 frames, to the finest demand of these, by an octave at most (Kreuzer 2017, 6.2 restricts the rate): texels that
//! change every frame make silhouettes wobble.
//!
//! When the cap binds, the rung is the finest with which the map holds its box. A rung that had to give way comes back
//! when there is a tenth more room, so that a box that breathes does not switch rungs. The size says what it achieves:
//! `c_effective = r / a`, and `r_min = c a`, the smallest radius whose texels it hides.

use glam::DVec2;

use crate::error::{Error, positive};
use crate::relation::{ROUNDING_SLACK, Relation};
use crate::settings::Settings;

/// Rungs of the ladder in an octave.
const RUNGS_PER_OCTAVE: f64 = 4.0;

/// Share by which a box may grow before a rung that the cap took away, and gave back, is taken away again.
pub(crate) const ROOM: f64 = 0.1;

/// What the screen asks of a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Demand {
    /// The filter radius on screen that decides, in metres at the reference plane; see
    /// [`Settings::demand_radius_world`](crate::Settings::demand_radius_world).
    Radius(f64),
    /// No penumbra on screen: the size stays, or is the smallest when there is none yet. Where nothing is in shadow, see
    /// [`Rest`](crate::Rest).
    Nothing,
}

impl Demand {
    /// The demand of an atomic minimum over the bits of positive radii (Kreuzer 2017, Eq. 5.12), which keep their order
    /// as u32. Its start value, the bits of infinity, means that nothing was written; so does all above it, NaN and
    /// negative numbers.
    #[must_use]
    pub fn from_minimum_bits(bits: u32) -> Self {
        if bits < f32::INFINITY.to_bits() { Self::Radius(f64::from(f32::from_bits(bits))) } else { Self::Nothing }
    }
}

/// A size, and what it achieves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Texels in x and y.
    pub texels: [u32; 2],
    /// Radius of the demand in texels of this size, the smaller of x and y: at least c unless `capped`. Without a
    /// demand, c.
    pub c_effective: f64,
    /// Smallest radius whose texels this size hides, in metres at the reference plane.
    pub radius_min_world: f64,
    /// Whether the demand asks for more texels than these.
    pub capped: bool,
}

/// The state of one axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Axis {
    rung: Option<i32>,
    frames_below: u32,
    finest_below: i32,
}

/// The state of one map's texel.
#[derive(Clone, Debug, PartialEq)]
pub struct TexelPolicy {
    settings: Settings,
    axes: [Axis; 2],
}

impl TexelPolicy {
    /// A map without a texel yet. Under a [budget](Settings::budget_bytes) its texels are what it asks for, whatever the cap;
    /// [`given_way`](crate::given_way) is for that.
    ///
    /// # Errors
    /// As [`Settings::checked`].
    pub fn new(settings: &Settings) -> Result<Self, Error> {
        let mut settings = settings.checked()?;
        if settings.budget_bytes.is_some() {
            settings.cap = Settings::CAP_MAX;
        }
        Ok(Self { settings, axes: [Axis::default(); 2] })
    }

    /// Width and height of the texel for the next frame, in metres at the reference plane, of a map whose box measures
    /// `extent_world` there. The box on the texel's lattice has at most the cap's texels a side.
    ///
    /// # Errors
    /// An extent that is not finite and above 0, or a radius that is negative, -0, NaN or infinite; the state is then as
    /// before.
    pub fn next(&mut self, extent_world: DVec2, demand: Demand) -> Result<DVec2, Error> {
        let extents = [positive("extent_world.x", extent_world.x)?, positive("extent_world.y", extent_world.y)?];
        let wanted = match demand {
            Demand::Radius(radius_world) => {
                let radius = clamped(radius_world, self.settings.radius_min_world);
                // Refuses what is no radius.
                self.settings.relation.resolution(extent_world.x, radius)?;
                Some(self.settings.relation.texel_from_radius(radius))
            }
            Demand::Nothing => None,
        };
        for (axis, extent) in self.axes.iter_mut().zip(extents) {
            axis.step(extent, wanted, &self.settings);
        }
        Ok(DVec2::from_array(self.axes.map(|axis| texel(axis.rung.unwrap_or(0)))))
    }
}

impl Axis {
    /// Finer at once; coarser late and not far, but for the cap. `wanted` is a texel in metres, `None` for any.
    fn step(&mut self, extent: f64, wanted: Option<f64>, settings: &Settings) {
        let fits = finest_rung(extent, settings.cap);
        let Some(rung) = self.rung else {
            let rung = wanted.map_or_else(|| finest_rung(extent, settings.floor), coarsest_rung);
            *self = Self { rung: Some(rung.min(fits)), ..Self::default() };
            return;
        };
        let stays = Self { rung: Some(rung.min(fits)), ..Self::default() };
        let Some(wanted) = wanted else {
            *self = stays;
            return;
        };
        let target = coarsest_rung(wanted);
        let refined = target.min(finest_rung(extent * (1.0 + ROOM), settings.cap));
        let is_below = rung <= fits && wanted * (1.0 - settings.shrink_below) >= texel(rung);
        *self = if refined > rung {
            Self { rung: Some(refined), ..Self::default() }
        } else if is_below {
            self.below(rung, target, settings)
        } else {
            stays
        };
    }

    /// After one more frame whose demand is well below.
    fn below(self, rung: i32, target: i32, settings: &Settings) -> Self {
        let finest_below = if self.frames_below == 0 { target } else { self.finest_below.max(target) };
        let frames_below = self.frames_below + 1;
        if frames_below < settings.shrink_after_frames {
            return Self { rung: Some(rung), frames_below, finest_below };
        }
        let coarsest = rung.saturating_sub_unsigned(settings.shrink_rungs);
        Self { rung: Some(finest_below.max(coarsest)), ..Self::default() }
    }
}

/// Side of a rung's texel, metres.
pub(crate) fn texel(rung: i32) -> f64 {
    (-f64::from(rung) / RUNGS_PER_OCTAVE).exp2()
}

/// The rung whose texel is nearest to this one.
pub(crate) fn rung_of(texel: f64) -> i32 {
    (-RUNGS_PER_OCTAVE * texel.log2()).round() as i32
}

/// The coarsest rung whose texel is at most this large; the last there is for a texel of 0.
fn coarsest_rung(texel: f64) -> i32 {
    (-RUNGS_PER_OCTAVE * texel.log2() - ROUNDING_SLACK).ceil() as i32
}

/// The finest rung with which a box has no more than `most` texels, wherever it lies on the lattice: one less across.
pub(crate) fn finest_rung(extent: f64, most: u32) -> i32 {
    (RUNGS_PER_OCTAVE * (f64::from(most - 1) / extent).log2() + ROUNDING_SLACK).floor() as i32
}

/// The larger of two radii; keeps NaN and a minus sign, for the relation to refuse.
fn clamped(radius: f64, least: f64) -> f64 {
    if radius.is_nan() || radius.is_sign_negative() { radius } else { radius.max(least) }
}

/// What a size achieves against a demand, or by itself, of a map that measures `extent_world`.
#[must_use]
pub fn size_achieved(texels: [u32; 2], extent_world: DVec2, radius_world: Option<f64>, relation: &Relation) -> Size {
    let texel = (extent_world / DVec2::new(f64::from(texels[0]), f64::from(texels[1]))).max_element();
    let least = texel * (1.0 - 2.0 * ROUNDING_SLACK);
    Size {
        texels,
        c_effective: radius_world.map_or(relation.ratio(), |r| r / texel),
        radius_min_world: relation.radius_from_texel(texel),
        capped: radius_world.is_some_and(|r| relation.texel_from_radius(r) < least),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn policy() -> TexelPolicy {
        TexelPolicy::new(&Settings::default()).unwrap()
    }

    /// The demand that asks for `n` texels across one metre.
    fn asking(n: f64) -> Demand {
        Demand::Radius(3.47 / n)
    }

    /// Texels across one metre.
    fn per_metre(policy: &mut TexelPolicy, demand: Demand) -> f64 {
        policy.next(DVec2::ONE, demand).unwrap().x.recip()
    }

    /// Rungs from `n` texels a metre down.
    fn rung(n: f64, down: i32) -> f64 {
        texel(coarsest_rung(1.0 / n) - down).recip()
    }

    #[test]
    fn a_texel_is_the_largest_rung_of_a_quarter_octave_that_is_small_enough() {
        for (asked, given) in [
            (512.0, 512.0),
            (513.0, 512.0 * 2f64.powf(0.25)),
            (600.0, 512.0 * 2f64.powf(0.25)),
            (700.0, 512.0 * 2f64.sqrt()),
        ] {
            let found = per_metre(&mut policy(), asking(asked));
            assert!((found / given - 1.0).abs() < 1e-9, "{asked}: {found}");
        }
    }

    #[test]
    fn the_ladder_costs_a_fifth_more_area_than_was_asked() {
        let overshoot = |i: u32| {
            let n = 128.0 * (f64::from(i) / 1000.0 * 4.9).exp2();
            (per_metre(&mut policy(), asking(n)) / n).powi(2)
        };
        let mean = (0..1000).map(overshoot).sum::<f64>() / 1000.0;
        assert!((mean - 1.19).abs() < 0.03, "{mean}");
    }

    #[test]
    fn a_texel_gets_finer_at_once_and_coarser_after_thirty_frames_by_an_octave_at_most() {
        let mut policy = policy();
        let mut next = |n: f64| per_metre(&mut policy, asking(n));
        assert_eq!(next(100.0), rung(100.0, 0));
        let fine = next(1500.0);
        assert_eq!(fine, rung(1500.0, 0));
        for _ in 0..29 {
            assert_eq!(next(1000.0), fine);
        }
        assert_eq!(next(1000.0), rung(1000.0, 0));
        for _ in 0..29 {
            assert_eq!(next(100.0), rung(1000.0, 0));
        }
        assert_eq!(next(100.0), rung(1000.0, 4));
    }

    #[test]
    fn a_demand_that_comes_back_keeps_the_texel() {
        let mut policy = policy();
        let mut next = |n: f64| per_metre(&mut policy, asking(n));
        let first = next(1000.0);
        for frame in 0..200 {
            assert_eq!(next(if frame % 29 == 28 { 1000.0 } else { 200.0 }), first);
        }
    }

    #[test]
    fn getting_coarser_keeps_what_the_last_frames_asked_for() {
        let mut policy = policy();
        per_metre(&mut policy, asking(1000.0));
        let mut last = 0.0;
        for frame in 0..30 {
            last = per_metre(&mut policy, asking(if frame == 10 { 700.0 } else { 600.0 }));
        }
        assert_eq!(last, rung(700.0, 0));
    }

    #[test]
    fn a_box_that_changes_its_extent_keeps_its_texel_below_the_cap() {
        let mut policy = policy();
        let first = policy.next(DVec2::ONE, asking(100.0)).unwrap();
        for i in 1..200 {
            let extent = DVec2::new(1.0 + 0.1 * f64::from(i), 1.0 + 0.15 * f64::from(i % 90));
            assert_eq!(policy.next(extent, asking(100.0)).unwrap(), first);
        }
    }

    #[test]
    fn a_bound_cap_takes_the_finest_rung_that_holds_the_box_and_says_what_it_achieves() {
        let extent = DVec2::new(100.0, 10.0);
        let texel = policy().next(extent, Demand::Radius(0.02)).unwrap();
        let across = extent / texel;
        assert!(across.x <= 4095.0 && across.x > 4095.0 / 1.19, "{across}");
        assert!(texel.y <= 0.02 / 3.47);
        let size = size_achieved([4000, 2000], extent, Some(0.02), &Relation::published());
        assert!(size.capped);
        assert!((size.c_effective - 4000.0 * 0.02 / 100.0).abs() < 1e-12);
        assert!((size.radius_min_world - 3.47 * 100.0 / 4000.0).abs() < 1e-12);
        let met = size_achieved([100, 100], DVec2::ONE, Some(3.47 / 100.0), &Relation::published());
        assert!(!met.capped && met.c_effective >= 3.47 * (1.0 - 1e-9));
        assert_eq!(
            policy().next(DVec2::ONE, Demand::Radius(0.0)).unwrap(),
            policy().next(DVec2::ONE, asking(1e9)).unwrap()
        );
    }

    #[test]
    fn a_box_that_breathes_at_the_cap_switches_its_rung_once() {
        let mut policy = policy();
        let limit = 4095.0 / rung(4000.0, 0);
        let mut switches = 0;
        let mut last = policy.next(DVec2::splat(limit), asking(1e9)).unwrap();
        for frame in 0..400 {
            let breath = 1.0 + 0.04 * (f64::from(frame) * 0.3).sin();
            let next = policy.next(DVec2::splat(limit * breath), asking(1e9)).unwrap();
            switches += u32::from(next != last);
            last = next;
        }
        assert!(switches <= 1, "{switches}");
    }

    #[test]
    fn the_bits_of_a_radius_are_a_demand_and_what_sorts_above_infinity_is_none() {
        assert_eq!(Demand::from_minimum_bits(0.25_f32.to_bits()), Demand::Radius(0.25));
        assert_eq!(Demand::from_minimum_bits(0), Demand::Radius(0.0));
        for nothing in [f32::INFINITY, f32::NAN, -1.0, -0.0, f32::NEG_INFINITY] {
            assert_eq!(Demand::from_minimum_bits(nothing.to_bits()), Demand::Nothing, "{nothing}");
        }
    }

    #[test]
    fn no_penumbra_keeps_the_texel_or_starts_with_the_smallest_size() {
        let mut policy = policy();
        assert!(per_metre(&mut policy, Demand::Nothing) <= 7.0);
        let some = per_metre(&mut policy, asking(500.0));
        for _ in 0..100 {
            assert_eq!(per_metre(&mut policy, Demand::Nothing), some);
        }
        // A box that grows beyond the cap takes the texel with it.
        let wide = policy.next(DVec2::splat(1e3), Demand::Nothing).unwrap();
        assert!(1e3 / wide.x <= 4095.0);
    }

    #[test]
    fn a_demand_without_meaning_is_refused_and_changes_nothing() {
        let mut policy = policy();
        policy.next(DVec2::ONE, asking(500.0)).unwrap();
        let before = policy.clone();
        for radius in [f64::NAN, -1.0, -0.0, f64::INFINITY] {
            assert!(policy.next(DVec2::ONE, Demand::Radius(radius)).is_err(), "{radius}");
        }
        for extent in [DVec2::ZERO, DVec2::new(1.0, f64::NAN)] {
            assert!(policy.next(extent, asking(100.0)).is_err());
            assert!(policy.next(extent, Demand::Nothing).is_err());
        }
        assert_eq!(policy, before);
    }

    #[test]
    fn the_smallest_radius_bounds_the_demand() {
        let settings = Settings { radius_min_world: 3.47 / 256.0, ..Settings::default() };
        let mut policy = TexelPolicy::new(&settings).unwrap();
        assert!((per_metre(&mut policy, Demand::Radius(0.0)) / 256.0 - 1.0).abs() < 1e-9);
        assert!(policy.next(DVec2::ONE, Demand::Radius(-0.0)).is_err());
    }

    #[test]
    fn scenes_of_any_scale_have_the_same_texels_across() {
        for scale in [1e-30, 1e-6, 1e6, 1e36] {
            let texel = policy().next(DVec2::splat(scale), Demand::Radius(0.01 * scale)).unwrap();
            let across = scale / texel.x;
            assert!((347.0 * (1.0 - 1e-5)..347.0 * 1.19).contains(&across), "{scale}: {across}");
        }
    }

    proptest! {
        #[test]
        fn a_demand_that_settles_gives_a_texel_that_settles(start in prop::collection::vec(7.0..9000.0_f64, 0..60), settled in 7.0..9000.0_f64) {
            let mut policy = policy();
            for n in start {
                policy.next(DVec2::ONE, asking(n)).unwrap();
            }
            // From the cap down: at most 9 octaves, 30 frames each.
            for _ in 0..300 {
                policy.next(DVec2::ONE, asking(settled)).unwrap();
            }
            let n = per_metre(&mut policy, asking(settled));
            for _ in 0..100 {
                prop_assert_eq!(per_metre(&mut policy, asking(settled)), n);
            }
            // Enough but for the cap, and nothing left over but the band in which it does not get coarser, and the ladder.
            prop_assert!(n >= settled * (1.0 - 2e-6) || n * 1.19 * (1.0 + ROOM) >= 4095.0);
            prop_assert!(n * 0.8 <= settled * (1.0 + 1e-6) || n <= rung(settled, 0) * (1.0 + 1e-9));
        }

        #[test]
        fn no_box_has_more_texels_than_the_cap(extents in prop::collection::vec(0.001..1000.0_f64, 1..40), n in 1.0..1e6_f64) {
            let mut policy = policy();
            for extent in extents {
                let texel = policy.next(DVec2::splat(extent), asking(n)).unwrap();
                prop_assert!(extent / texel.x <= 4095.0 * (1.0 + 1e-6));
            }
        }
    }
}
