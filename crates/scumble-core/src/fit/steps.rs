//! Boxes that stay where they are while the view creeps, so that what was drawn into a map stays right.
//!
//! On the lattice alone a box takes up or drops a line of texels with every texel that the view moves, and its depth range
//! ends where the view does. Here its sides are on every so many lines, and its depths on steps of their own: it changes
//! when the view has moved by a share of the box. A box has no memory, so equal views have equal boxes.

use glam::DVec2;

use super::Fit;
use crate::light::Light;

/// Largest step as a share of the box, and of the octave of its depth range. A 16th redraws a map of 1,000 texels after 32
/// of them at least half of the time, and costs 5 % of texels a side on average.
const STEP: f64 = 1.0 / 16.0;

impl Fit {
    /// What a box may grow by on steps: a step on either side, and the texels of the lattice. Choose the texel of a box
    /// with this much more extent, and it has no more texels than were allowed.
    pub const STEPS_ROOM: f64 = 1.0 + 3.0 * STEP;

    /// As [`Fit::on_lattice`], and the box on steps.
    #[must_use]
    pub fn on_steps(&self, texel_world: DVec2, least: u32) -> (Self, [u32; 2]) {
        let (on, _) = self.on_lattice(texel_world, 1);
        let sides = [on.center - 0.5 * on.extent_world, on.center + 0.5 * on.extent_world];
        let [min, max] = sides.map(|side| (side / texel_world).round());
        let step = ((max - min) * STEP).map(|texels| octave(texels).max(1.0));
        let (min, max) = ((min / step).floor() * step, (max / step).ceil() * step);
        let widened = self.with_box(0.5 * (min + max) * texel_world, (max - min) * texel_world);
        let (mut on, texels) = widened.on_lattice(texel_world, least);
        on.step_depth();
        (on, texels)
    }

    /// Widens the depth range to its steps. The near plane of a lamp is its reference plane, and stays.
    fn step_depth(&mut self) {
        let step = octave(self.depth_far - self.depth_near) * STEP;
        self.depth_far = (self.depth_far / step).ceil() * step;
        if let Light::Directional { .. } = self.light {
            self.depth_near = (self.depth_near / step).floor() * step;
        }
    }
}

/// The largest power of two that is not above a positive number.
fn octave(number: f64) -> f64 {
    number.log2().floor().exp2()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::aabb::Aabb;
    use crate::camera::Camera;
    use crate::fit::fit;
    use crate::fit::tests_support::{observer, room};
    use glam::{DMat4, DVec3};
    use proptest::prelude::*;

    const SUN: Light = Light::Directional { direction: DVec3::new(0.4, -1.0, 0.3), half_angle: 0.01 };

    fn lights() -> [Light; 2] {
        let lamp = Light::Spot {
            position: DVec3::new(0.0, 6.0, 0.0),
            direction: DVec3::NEG_Y,
            cone_half_angle: 0.6,
            radius_world: 0.1,
        };
        [SUN, lamp]
    }

    /// Matrices of the boxes of a camera that moves sideways by `step` metres a frame.
    fn matrices(light: &Light, step: f64, boxed: impl Fn(&Fit) -> Fit) -> Vec<DMat4> {
        let of_frame = |frame: i32| {
            let aside = DVec3::X * (f64::from(frame) * step);
            let camera = Camera { eye: observer().eye + aside, target: observer().target + aside, ..observer() };
            boxed(&fit(&camera, &room(), light, true).unwrap().unwrap()).clip_from_world()
        };
        (0..200).map(of_frame).collect()
    }

    fn changes(matrices: &[DMat4]) -> usize {
        matrices.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }

    #[test]
    fn a_view_that_creeps_keeps_its_box_but_for_a_few_steps() {
        let texel = DVec2::splat(0.01);
        for light in lights() {
            let every = changes(&matrices(&light, 0.001, |fit| fit.on_lattice(texel, 8).0));
            let few = changes(&matrices(&light, 0.001, |fit| fit.on_steps(texel, 8).0));
            assert!(few <= 10 && few * 4 <= every, "{few} of {every}: {light:?}");
        }
    }

    #[test]
    fn a_box_on_steps_holds_the_box_on_the_lattice_and_all_of_its_depths() {
        for light in lights() {
            for texel in [0.003, 0.02, 0.3] {
                let texel = DVec2::new(texel, 1.3 * texel);
                let fit = fit(&observer(), &room(), &light, true).unwrap().unwrap();
                let (on, texels) = fit.on_steps(texel, 8);
                let (lattice, _) = fit.on_lattice(texel, 8);
                let (apart, room) =
                    ((on.center - lattice.center).abs(), 0.5 * (on.extent_world - lattice.extent_world));
                assert!((apart.cmple(room + 1e-9)).all(), "{apart} {room}");
                assert!(on.depth_far >= fit.depth_far && on.depth_near <= fit.depth_near);
                assert!(on.depth_far - on.depth_near <= 1.2 * (lattice.depth_far - lattice.depth_near));
                let exact = on.extent_world / texel;
                assert!((exact - exact.round()).abs().max_element() < 1e-6, "whole texels");
                assert_eq!(texels.map(f64::from), exact.round().to_array());
                if let Light::Spot { .. } = light {
                    assert_eq!(on.reference_depth(), fit.reference_depth());
                }
            }
        }
    }

    proptest! {
        #[test]
        fn no_box_on_steps_has_more_texels_than_its_room_allows(
            across in 1.0..4000.0_f64,
            at in -1e4..1e4_f64,
            cap in 16u32..4096,
        ) {
            let scene = Aabb { min: DVec3::splat(-1.0), max: DVec3::splat(1.0) };
            let fit = fit(&observer(), &scene, &SUN, false).unwrap().unwrap();
            let texel = fit.extent_world * Fit::STEPS_ROOM / across.min(f64::from(cap - 1));
            let (_, texels) = fit.with_box(fit.center + at * texel, fit.extent_world).on_steps(texel, 8);
            prop_assert!(texels.iter().all(|&side| side <= cap), "{:?} {}", texels, cap);
        }
    }
}
