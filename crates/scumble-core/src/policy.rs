//! From a demand to a size that a map can have, frame by frame.
//!
//! Demand: the smallest radius r on screen, at the reference plane; `N = c (L / r)` texels in x and y apart. A size is
//! a rung of a ladder of a quarter octave, `{1, 1.189, 1.414, 1.682} 2^k` rounded up to multiples of 8: on average 1.19
//! times the area that was asked for, where powers of two give 2.16. It grows at once, since too few texels show. It
//! shrinks when the demand stayed 20 % below for 30 frames, to the largest demand of these, by an octave at most
//! (Kreuzer 2017, 6.2 restricts the rate): sizes that change every frame make silhouettes wobble.
//!
//! When the cap binds the size says what it achieves: `c_effective = N r / L`, and `r_min = c L / N`, the smallest
//! radius whose texels it hides.

use glam::DVec2;

use crate::error::Error;
use crate::relation::{Relation, whole_texels};
use crate::settings::Settings;

/// Sizes are multiples of this many texels.
const MULTIPLE: u32 = 8;

/// What the screen asks of a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Demand {
    /// The smallest filter radius on screen, in metres at the reference plane; see
    /// [`Settings::demand_radius_world`](crate::Settings::demand_radius_world).
    Radius(f64),
    /// No penumbra on screen: the size stays, or is the smallest when there is none yet.
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
    /// Whether the demand asks for more than the cap.
    pub capped: bool,
}

/// The sizes that a map can have, smallest first.
#[derive(Clone, Debug, PartialEq)]
pub struct Ladder {
    rungs: Vec<u32>,
}

impl Ladder {
    /// The rungs from `floor` to `cap`; the ends are rounded to multiples of 8, up and down, and are rungs themselves.
    #[must_use]
    pub fn new(floor: u32, cap: u32) -> Self {
        let top = (cap / MULTIPLE * MULTIPLE).max(MULTIPLE);
        let bottom = floor.next_multiple_of(MULTIPLE).clamp(MULTIPLE, top);
        let quarter_octaves =
            (0..).map(|i: i32| whole_texels((f64::from(i) / 4.0).exp2(), u32::MAX).next_multiple_of(MULTIPLE));
        let between = quarter_octaves.skip_while(|&n| n <= bottom).take_while(|&n| n < top);
        let mut rungs: Vec<u32> = std::iter::once(bottom).chain(between).chain([top]).collect();
        rungs.dedup();
        Self { rungs }
    }

    /// All sizes, smallest first.
    #[must_use]
    pub fn rungs(&self) -> &[u32] {
        &self.rungs
    }

    /// Index of the smallest rung that holds `resolution` texels; the last when none does.
    #[must_use]
    pub fn rung(&self, resolution: f64) -> usize {
        let texels = whole_texels(resolution, u32::MAX);
        self.rungs.partition_point(|&n| n < texels).min(self.rungs.len() - 1)
    }

    /// The size at an index.
    #[must_use]
    pub fn texels(&self, rung: usize) -> u32 {
        self.rungs[rung]
    }

    fn top(&self) -> u32 {
        self.rungs[self.rungs.len() - 1]
    }
}

/// The state of one axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Axis {
    rung: Option<usize>,
    frames_below: u32,
    largest_below: f64,
}

/// The state of one map's size.
#[derive(Clone, Debug, PartialEq)]
pub struct SizePolicy {
    settings: Settings,
    ladder: Ladder,
    axes: [Axis; 2],
}

impl SizePolicy {
    /// A map without a size yet.
    ///
    /// # Errors
    /// As [`Settings::checked`].
    pub fn new(settings: &Settings) -> Result<Self, Error> {
        let settings = settings.checked()?;
        let ladder = Ladder::new(settings.floor, settings.cap);
        Ok(Self { settings, ladder, axes: [Axis::default(); 2] })
    }

    /// The sizes that this policy chooses from.
    #[must_use]
    pub fn ladder(&self) -> &Ladder {
        &self.ladder
    }

    /// The size for the next frame, of a map whose box measures `extent_world` at the reference plane.
    ///
    /// # Errors
    /// As [`Relation::resolution`]; the state is then as before.
    pub fn next(&mut self, extent_world: DVec2, demand: Demand) -> Result<Size, Error> {
        let relation = self.settings.relation;
        match demand {
            Demand::Radius(radius_world) => {
                let radius = clamped(radius_world, self.settings.radius_min_world);
                let wanted =
                    [relation.resolution(extent_world.x, radius)?, relation.resolution(extent_world.y, radius)?];
                for (axis, n) in self.axes.iter_mut().zip(wanted) {
                    axis.step(n, &self.ladder, &self.settings);
                }
                Ok(size_achieved(self.texels(), extent_world, Some(radius), &relation, self.ladder.top()))
            }
            Demand::Nothing => {
                // Checks the extents, which the answer depends on.
                relation.resolution(extent_world.x, 0.0)?;
                relation.resolution(extent_world.y, 0.0)?;
                for axis in &mut self.axes {
                    *axis = Axis { rung: Some(axis.rung.unwrap_or(0)), ..Axis::default() };
                }
                Ok(size_achieved(self.texels(), extent_world, None, &relation, self.ladder.top()))
            }
        }
    }

    fn texels(&self) -> [u32; 2] {
        self.axes.map(|axis| self.ladder.texels(axis.rung.unwrap_or(0)))
    }
}

impl Axis {
    /// Grows at once; shrinks late, and not far.
    fn step(&mut self, wanted: f64, ladder: &Ladder, settings: &Settings) {
        let target = ladder.rung(wanted);
        let Some(rung) = self.rung.filter(|&rung| rung >= target) else {
            *self = Self { rung: Some(target), ..Self::default() };
            return;
        };
        if wanted > (1.0 - settings.shrink_below) * f64::from(ladder.texels(rung)) {
            *self = Self { rung: Some(rung), ..Self::default() };
            return;
        }
        self.frames_below += 1;
        self.largest_below = self.largest_below.max(wanted);
        if self.frames_below >= settings.shrink_after_frames {
            let lowest = rung.saturating_sub(settings.shrink_rungs as usize);
            *self = Self { rung: Some(ladder.rung(self.largest_below).max(lowest)), ..Self::default() };
        }
    }
}

/// The larger of two radii; keeps NaN and a minus sign, for the relation to refuse.
fn clamped(radius: f64, least: f64) -> f64 {
    if radius.is_nan() || radius.is_sign_negative() { radius } else { radius.max(least) }
}

/// What a size achieves against a demand, or by itself.
#[must_use]
pub fn size_achieved(
    texels: [u32; 2],
    extent_world: DVec2,
    radius_world: Option<f64>,
    relation: &Relation,
    cap: u32,
) -> Size {
    let texel = (extent_world / DVec2::new(f64::from(texels[0]), f64::from(texels[1]))).max_element();
    let wanted =
        |extent: f64, radius: f64| whole_texels(relation.resolution(extent, radius).unwrap_or(f64::INFINITY), u32::MAX);
    let capped = radius_world.is_some_and(|r| wanted(extent_world.max_element(), r) > cap);
    Size {
        texels,
        c_effective: radius_world.map_or(relation.ratio(), |r| r / texel),
        radius_min_world: relation.radius_from_texel(texel),
        capped,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn policy() -> SizePolicy {
        SizePolicy::new(&Settings::default()).unwrap()
    }

    /// The demand that asks for `n` texels across one metre.
    fn asking(n: f64) -> Demand {
        Demand::Radius(3.47 / n)
    }

    #[test]
    fn the_ladder_is_a_quarter_octave_rounded_up_to_eights() {
        let ladder = Ladder::new(8, 4096);
        let start = [8, 16, 24, 32, 40, 48, 56, 64, 80, 96, 112, 128, 160, 184, 216, 256];
        assert_eq!(ladder.rungs()[..start.len()], start);
        assert_eq!(ladder.rungs()[ladder.rungs().len() - 5..], [2048, 2440, 2904, 3448, 4096]);
        assert_eq!(Ladder::new(8, 1001).top(), 1000);
        assert_eq!(Ladder::new(8, 8).rungs(), [8]);
        assert_eq!(Ladder::new(100, 110).rungs(), [104]);
    }

    #[test]
    fn the_ladder_costs_a_fifth_more_area_than_was_asked() {
        let ladder = Ladder::new(8, 4096);
        let overshoot = |i: u32| {
            // Evenly in log2 from 128 to 4096, where the multiple of 8 hardly counts.
            let n = 128.0 * (f64::from(i) / 1000.0 * 5.0).exp2();
            (f64::from(ladder.texels(ladder.rung(n))) / n).powi(2)
        };
        let mean = (0..1000).map(overshoot).sum::<f64>() / 1000.0;
        assert!((mean - 1.19).abs() < 0.03, "{mean}");
    }

    #[test]
    fn a_size_grows_at_once_and_shrinks_after_thirty_frames_by_an_octave_at_most() {
        let mut policy = policy();
        let mut next = |n: f64| policy.next(DVec2::ONE, asking(n)).unwrap().texels[0];
        assert_eq!(next(100.0), 112);
        assert_eq!(next(1500.0), 1728);
        for _ in 0..29 {
            assert_eq!(next(1000.0), 1728);
        }
        assert_eq!(next(1000.0), 1024);
        for _ in 0..29 {
            assert_eq!(next(100.0), 1024);
        }
        assert_eq!(next(100.0), 512);
    }

    #[test]
    fn a_demand_that_comes_back_keeps_the_size() {
        let mut policy = policy();
        let mut next = |n: f64| policy.next(DVec2::ONE, asking(n)).unwrap().texels[0];
        assert_eq!(next(1000.0), 1024);
        for frame in 0..200 {
            assert_eq!(next(if frame % 29 == 28 { 1000.0 } else { 200.0 }), 1024);
        }
    }

    #[test]
    fn shrinking_keeps_what_the_last_frames_asked_for() {
        let mut policy = policy();
        policy.next(DVec2::ONE, asking(1000.0)).unwrap();
        let mut last = 0;
        for frame in 0..30 {
            last = policy.next(DVec2::ONE, asking(if frame == 10 { 700.0 } else { 600.0 })).unwrap().texels[0];
        }
        assert_eq!(last, 728);
    }

    #[test]
    fn the_axes_have_their_own_sizes() {
        let size = policy().next(DVec2::new(4.0, 1.0), asking(100.0)).unwrap();
        assert_eq!(size.texels, [432, 112]);
    }

    #[test]
    fn a_bound_cap_says_what_it_achieves() {
        let size = policy().next(DVec2::new(100.0, 10.0), Demand::Radius(0.02)).unwrap();
        assert!(size.capped);
        assert_eq!(size.texels[0], 4096);
        assert!((size.c_effective - 4096.0 * 0.02 / 100.0).abs() < 1e-12);
        assert!((size.radius_min_world - 3.47 * 100.0 / 4096.0).abs() < 1e-12);
        let met = policy().next(DVec2::ONE, asking(100.0)).unwrap();
        assert!(!met.capped && met.c_effective >= 3.47 && met.radius_min_world <= 3.47 / 100.0);
        let hard = policy().next(DVec2::ONE, Demand::Radius(0.0)).unwrap();
        assert!(hard.capped && hard.texels == [4096, 4096]);
        let exact = policy().next(DVec2::ONE, asking(4096.0)).unwrap();
        assert!(!exact.capped);
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
    fn no_penumbra_keeps_the_size_or_starts_with_the_smallest() {
        let mut policy = policy();
        assert_eq!(policy.next(DVec2::ONE, Demand::Nothing).unwrap().texels, [8, 8]);
        policy.next(DVec2::ONE, asking(500.0)).unwrap();
        for _ in 0..100 {
            assert_eq!(policy.next(DVec2::ONE, Demand::Nothing).unwrap().texels, [512, 512]);
        }
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
        let mut policy = SizePolicy::new(&settings).unwrap();
        assert_eq!(policy.next(DVec2::ONE, Demand::Radius(0.0)).unwrap().texels, [256, 256]);
        assert!(policy.next(DVec2::ONE, Demand::Radius(-0.0)).is_err());
    }

    proptest! {
        #[test]
        fn a_demand_that_settles_gives_a_size_that_settles(start in prop::collection::vec(7.0..9000.0_f64, 0..60), settled in 7.0..9000.0_f64) {
            let mut policy = policy();
            for n in start {
                policy.next(DVec2::ONE, asking(n)).unwrap();
            }
            // From the cap down: at most 9 octaves, 30 frames each.
            for _ in 0..300 {
                policy.next(DVec2::ONE, asking(settled)).unwrap();
            }
            let size = policy.next(DVec2::ONE, asking(settled)).unwrap();
            for _ in 0..100 {
                prop_assert_eq!(policy.next(DVec2::ONE, asking(settled)).unwrap(), size);
            }
            prop_assert!(size.capped || size.c_effective >= 3.47 * (1.0 - 2e-6));
            // Nothing is left over but the band in which it does not shrink, and the ladder.
            let n = f64::from(size.texels[0]);
            prop_assert!(size.capped || n * 0.8 <= settled || n == f64::from(policy.ladder().texels(policy.ladder().rung(settled))));
        }
    }
}
