//! Shares of a rectangle, such as a window or a panel of light. Lengths in any one unit, shares are 0 to 1.

use glam::DVec2;

/// An axis-aligned rectangle of finite area above 0: `min` is below `max` in x and y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle {
    /// Lower corner.
    pub min: DVec2,
    /// Upper corner.
    pub max: DVec2,
}

impl Rectangle {
    fn size(&self) -> DVec2 {
        self.max - self.min
    }
}

/// Share of `light` on the side of a straight edge to which `normal` (of any length above 0) points; the edge passes
/// the light's middle at the signed `distance` of the normal's length 1, positive when the middle is inside.
///
/// With the projections `a >= b` of the half sides onto the normal, the share's density over the distance is a
/// trapezoid: 0 beyond `a + b`, flat within `a - b`. Its integral, from symmetry for `t = |distance|`:
/// ```text
/// t <= a - b          1/2 + t / (2 a)
/// a - b < t < a + b   1 - (a + b - t)^2 / (8 a b)
/// t >= a + b          1
/// ```
/// and one minus that for a negative distance.
#[must_use]
pub fn half_plane_under_rectangle(light: &Rectangle, normal: DVec2, distance: f64) -> f64 {
    let projected = (0.5 * light.size() * normal.normalize()).abs();
    let (a, b) = (projected.max_element(), projected.min_element());
    let t = distance.abs();
    let share = if t <= a - b {
        0.5 + 0.5 * t / a
    } else if t < a + b {
        1.0 - (a + b - t).powi(2) / (8.0 * a * b)
    } else {
        1.0
    };
    if distance < 0.0 { 1.0 - share } else { share }
}

/// Share of `light` in another rectangle of parallel sides: the product of the overlaps along x and along y.
#[must_use]
pub fn rectangle_under_rectangle(light: &Rectangle, shape: &Rectangle) -> f64 {
    let overlap = (light.max.min(shape.max) - light.min.max(shape.min)).max(DVec2::ZERO);
    overlap.element_product() / light.size().element_product()
}

#[cfg(test)]
mod tests {
    use super::super::counting::{Uniform, assert_standard, z_score};
    use super::*;

    const LIGHT: Rectangle = Rectangle { min: DVec2::new(-1.0, 0.5), max: DVec2::new(2.0, 1.5) };
    const FAR: f64 = 1e6;

    fn middle() -> DVec2 {
        0.5 * (LIGHT.min + LIGHT.max)
    }

    /// A point of the light.
    fn on_light(random: &mut Uniform) -> DVec2 {
        DVec2::new(random.between(LIGHT.min.x, LIGHT.max.x), random.between(LIGHT.min.y, LIGHT.max.y))
    }

    #[test]
    fn an_edge_through_the_middle_halves_the_light_whatever_its_direction() {
        for turn in 0..32 {
            let normal = 3.0 * DVec2::from_angle(f64::from(turn) * 0.2);
            assert_eq!(half_plane_under_rectangle(&LIGHT, normal, 0.0), 0.5);
            assert_eq!(half_plane_under_rectangle(&LIGHT, normal, 2.0), 1.0);
            assert_eq!(half_plane_under_rectangle(&LIGHT, normal, -2.0), 0.0);
            for distance in [0.1, 0.5, 0.9, 1.3] {
                let [inside, outside] = [distance, -distance].map(|d| half_plane_under_rectangle(&LIGHT, normal, d));
                assert!((inside + outside - 1.0).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn an_edge_parallel_to_a_side_is_a_long_rectangle() {
        for i in -10..=10 {
            let distance = 0.2 * f64::from(i);
            for axis in [DVec2::X, DVec2::Y] {
                // Inside is where axis . (p - middle) + distance > 0.
                let edge = axis * (middle().dot(axis) - distance) - (DVec2::ONE - axis) * FAR;
                let half_plane = Rectangle { min: edge, max: DVec2::splat(FAR) };
                let expected = rectangle_under_rectangle(&LIGHT, &half_plane);
                assert!((half_plane_under_rectangle(&LIGHT, axis, distance) - expected).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn the_share_of_a_slanted_edge_has_no_jump_where_its_pieces_meet() {
        let normal = DVec2::new(0.6, 0.8);
        // Half sides 1.5 and 0.5 project to 0.9 and 0.4.
        for meeting in [0.5, 1.3] {
            let [before, after] = [-1e-9, 1e-9].map(|step| half_plane_under_rectangle(&LIGHT, normal, meeting + step));
            assert!((before - after).abs() < 1e-8, "{meeting}");
        }
    }

    #[test]
    fn a_rectangle_has_the_share_of_its_overlap() {
        assert_eq!(rectangle_under_rectangle(&LIGHT, &LIGHT), 1.0);
        let beside = Rectangle { min: DVec2::new(2.0, 0.5), max: DVec2::new(3.0, 1.5) };
        assert_eq!(rectangle_under_rectangle(&LIGHT, &beside), 0.0);
        let corner = Rectangle { min: DVec2::new(0.5, 1.0), max: DVec2::splat(9.0) };
        assert_eq!(rectangle_under_rectangle(&LIGHT, &corner), 0.25);
        let inside = Rectangle { min: DVec2::new(0.0, 0.75), max: DVec2::new(1.0, 1.25) };
        assert!((rectangle_under_rectangle(&LIGHT, &inside) - 1.0 / 6.0).abs() < 1e-15);
    }

    #[test]
    fn every_share_is_the_one_that_counting_finds() {
        let mut random = Uniform::new(3);
        let mut scores = Vec::new();
        for _ in 0..30 {
            let normal = DVec2::from_angle(random.between(0.0, 6.3));
            let distance = random.between(-0.9, 0.9);
            scores.push(z_score(half_plane_under_rectangle(&LIGHT, normal, distance), || {
                (on_light(&mut random) - middle()).dot(normal) + distance > 0.0
            }));
            let min = DVec2::new(random.between(-1.5, 1.5), random.between(0.2, 1.2));
            let shape = Rectangle { min, max: min + DVec2::new(random.between(0.3, 2.0), random.between(0.3, 1.0)) };
            scores.push(z_score(rectangle_under_rectangle(&LIGHT, &shape), || {
                let p = on_light(&mut random);
                p.cmpge(shape.min).all() && p.cmple(shape.max).all()
            }));
        }
        assert_standard(&scores);
    }
}
