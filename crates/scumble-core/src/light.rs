//! The light: where it shines, and how large it is.
//!
//! Light space is a rigid motion of the world: right-handed, the light looks along -z. Depth is the distance along the
//! light's direction, positive away from the light; a spot's depth starts at its position, a directional light's at the
//! plane through the world's origin. A point light has a light space for each of its [faces](crate::Face).

use glam::dcamera::rh::view;
use glam::{DMat4, DVec3};
use serde::{Deserialize, Serialize};

use crate::error::{Error, check, direction, finite, not_negative};
use crate::face::{Face, OVERLAP};
use crate::polyhedron::HalfSpace;

/// Sides of the pyramid around a spot's cone. Circumscribed: it lets in at most 1 / cos(pi / 16) - 1 = 2 % beyond the
/// cone, and nothing at the four sides of the map.
const CONE_SIDES: u32 = 16;

/// A light with a size.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Light {
    /// Parallel light from a disc at infinity, such as the sun.
    Directional {
        /// Direction of travel, away from the source; any length.
        direction: DVec3,
        /// Half the angle that the disc spans, in radians (the sun: 0.0047).
        half_angle: f64,
    },
    /// A disc that shines into a cone, such as a lamp.
    Spot {
        /// Middle of the disc, in metres.
        position: DVec3,
        /// Axis of the cone, away from the source; any length.
        direction: DVec3,
        /// Angle between the axis and the cone's side, in radians, at most [`Light::CONE_HALF_ANGLE_MAX`].
        cone_half_angle: f64,
        /// Radius of the disc, in metres.
        radius_world: f64,
    },
    /// A sphere that shines to all sides, such as a bulb. It has a map for each of six [faces](crate::Face).
    Point {
        /// Middle of the sphere, in metres.
        position: DVec3,
        /// Radius of the sphere, in metres. It is taken for the disc that it shows to the receiver.
        radius_world: f64,
        /// What is farther away along an axis of the world has no shadow, in metres; infinite for none. A shorter reach lets
        /// nearer things cast: see [`Fit::depth_near`](crate::Fit::depth_near).
        reach_world: f64,
    },
}

impl Light {
    /// Widest cone of a spot: a plane picture of 1.4 rad (80 degrees) to each side is 11.6 times as wide as far.
    pub const CONE_HALF_ANGLE_MAX: f64 = 1.4;

    /// The light with its direction normalised.
    ///
    /// # Errors
    /// Names a value that is not finite, a direction of no length, or an angle or a radius out of range.
    pub fn checked(&self) -> Result<Self, Error> {
        match *self {
            Self::Directional { direction: travel, half_angle } => {
                let allowed = "an angle in radians from 0 to below pi / 2";
                let holds = half_angle.is_sign_positive() && half_angle < std::f64::consts::FRAC_PI_2;
                check("the light's half_angle", half_angle, holds, allowed)?;
                Ok(Self::Directional { direction: direction("the light's direction", travel)?, half_angle })
            }
            Self::Spot { position, direction: axis, cone_half_angle, radius_world } => {
                finite("the light's position", position)?;
                not_negative("the light's radius_world", radius_world)?;
                let holds = cone_half_angle > 0.0 && cone_half_angle <= Self::CONE_HALF_ANGLE_MAX;
                check(
                    "the light's cone_half_angle",
                    cone_half_angle,
                    holds,
                    "an angle in radians above 0, at most 1.4",
                )?;
                let axis = direction("the light's direction", axis)?;
                Ok(Self::Spot { position, direction: axis, cone_half_angle, radius_world })
            }
            Self::Point { position, radius_world, reach_world } => {
                finite("the light's position", position)?;
                not_negative("the light's radius_world", radius_world)?;
                check("the light's reach_world", reach_world, reach_world > 0.0, "a number above 0, or infinity")?;
                Ok(*self)
            }
        }
    }

    /// Direction in which the light (a spot's axis) shines, as given; of a point light that of its last face, against z.
    #[must_use]
    pub fn direction(&self) -> DVec3 {
        self.direction_of(None)
    }

    /// The same of a face of a point light.
    pub(crate) fn direction_of(&self, face: Option<Face>) -> DVec3 {
        match *self {
            Self::Directional { direction, .. } | Self::Spot { direction, .. } => direction,
            Self::Point { .. } => face.unwrap_or(Face::NegativeZ).axis(),
        }
    }

    /// Where the light is, in metres; `None` of a directional light.
    #[must_use]
    pub fn position(&self) -> Option<DVec3> {
        match *self {
            Self::Directional { .. } => None,
            Self::Spot { position, .. } | Self::Point { position, .. } => Some(position),
        }
    }

    /// World to light space, of a point light to that of its last face. The orientation depends on the light alone, so
    /// texels keep theirs while the observer moves (course of Eisemann et al., 3.2.1). The world's y is up in the map, or z
    /// where the light shines within 8 degrees of y.
    #[must_use]
    pub fn light_from_world(&self) -> DMat4 {
        self.light_from_world_of(None)
    }

    /// The same of a face of a point light.
    pub(crate) fn light_from_world_of(&self, face: Option<Face>) -> DMat4 {
        let eye = self.position().unwrap_or(DVec3::ZERO);
        let along = self.direction_of(face).normalize();
        let up = if along.y.abs() > 0.99 { DVec3::Z } else { DVec3::Y };
        view::look_to_mat4(eye, along, up)
    }

    /// The light's volume L about `origin`: all of space for a directional light, a pyramid of 16 sides around the cone
    /// for a spot, a face's pyramid as far as it reaches for a point light.
    pub(crate) fn half_spaces(&self, face: Option<Face>, origin: DVec3) -> Vec<HalfSpace> {
        let world_from_light = self.light_from_world_of(face).transpose();
        let side = |through: DVec3, inward| HalfSpace::through(through, world_from_light.transform_vector3(inward));
        match *self {
            Self::Directional { .. } => Vec::new(),
            Self::Spot { position, cone_half_angle, .. } => {
                let side_of_cone = |i: u32| {
                    let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / f64::from(CONE_SIDES)).sin_cos();
                    side(position - origin, DVec3::new(-cos, -sin, -cone_half_angle.tan()))
                };
                (0..CONE_SIDES).map(side_of_cone).collect()
            }
            Self::Point { position, reach_world, .. } => {
                let apex = position - origin;
                let mut sides: Vec<HalfSpace> = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y]
                    .map(|out| side(apex, -out - DVec3::Z * (1.0 + OVERLAP)))
                    .to_vec();
                if reach_world.is_finite() {
                    sides.push(side(apex + reach_world * self.direction_of(face), DVec3::Z));
                }
                sides
            }
        }
    }

    /// Direction towards the light from `position_world`, unit length.
    #[must_use]
    pub fn towards_light(&self, position_world: DVec3) -> DVec3 {
        match *self {
            Self::Directional { direction, .. } => -direction.normalize(),
            Self::Spot { position, direction, .. } => (position - position_world).normalize_or(-direction.normalize()),
            Self::Point { position, .. } => (position - position_world).normalize_or(DVec3::Y),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::tests_support::rays;

    #[test]
    fn the_light_looks_along_minus_z_of_a_rigid_right_handed_light_space() {
        for direction in [DVec3::NEG_Y, DVec3::Y, DVec3::X, DVec3::NEG_Z, DVec3::new(0.3, -2.0, 0.7)] {
            let light = Light::Directional { direction, half_angle: 0.01 };
            let m = light.light_from_world();
            assert!((m.transform_vector3(direction.normalize()) - DVec3::NEG_Z).length() < 1e-12);
            assert!((m.determinant() - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_spot_lets_in_its_cone_and_little_more() {
        let axis = DVec3::new(0.2, -1.0, 0.4);
        let light = Light::Spot { position: DVec3::ONE, direction: axis, cone_half_angle: 0.5, radius_world: 0.1 };
        let sides = light.half_spaces(None, DVec3::ZERO);
        let across = axis.any_orthogonal_vector().normalize();
        for turn in 0..64 {
            let around = glam::DQuat::from_axis_angle(axis.normalize(), f64::from(turn) * 0.1) * across;
            let at = |angle: f64| DVec3::ONE + 3.0 * (axis.normalize() + angle.tan() * around);
            assert!(sides.iter().all(|s| s.distance(at(0.499)) > 0.0));
            assert!(sides.iter().any(|s| s.distance(at(0.512)) < 0.0));
        }
    }

    #[test]
    fn a_face_lets_in_its_own_directions_as_far_as_the_light_reaches() {
        let light = Light::Point { position: DVec3::ONE, radius_world: 0.1, reach_world: 4.0 };
        for ray in rays() {
            let ray = ray / ray.abs().max_element();
            // Between a face and its neighbours the overlap is of both.
            if ray.abs().to_array().iter().filter(|side| **side > 1.0 - 2.0 * OVERLAP).count() > 1 {
                continue;
            }
            for face in Face::ALL {
                let holds = |p: DVec3| light.half_spaces(Some(face), DVec3::NEG_X).iter().all(|s| s.distance(p) >= 0.0);
                assert_eq!(holds(light.position().unwrap() + 3.9 * ray + DVec3::X), face == Face::of(ray), "{ray}");
                assert!(!holds(light.position().unwrap() + 4.1 * ray + DVec3::X));
            }
        }
    }

    #[test]
    fn a_light_out_of_range_is_refused_by_name() {
        let sun = |direction, half_angle| Light::Directional { direction, half_angle };
        let lamp = |cone_half_angle, radius_world| Light::Spot {
            position: DVec3::ZERO,
            direction: DVec3::X,
            cone_half_angle,
            radius_world,
        };
        let bulb = |radius_world, reach_world| Light::Point { position: DVec3::ZERO, radius_world, reach_world };
        assert!(bulb(0.0, f64::INFINITY).checked().is_ok());
        let wrong = [
            (sun(DVec3::ZERO, 0.1), "direction"),
            (sun(DVec3::new(f64::NAN, 0.0, 1.0), 0.1), "direction"),
            (sun(DVec3::X, -0.1), "half_angle"),
            (sun(DVec3::X, f64::NAN), "half_angle"),
            (lamp(0.0, 0.1), "cone_half_angle"),
            (lamp(1.5, 0.1), "cone_half_angle"),
            (lamp(0.5, f64::INFINITY), "radius_world"),
            (bulb(-0.1, 5.0), "radius_world"),
            (bulb(0.1, 0.0), "reach_world"),
            (bulb(0.1, f64::NAN), "reach_world"),
        ];
        for (light, name) in wrong {
            assert!(light.checked().unwrap_err().to_string().contains(name), "{name}");
        }
    }

    #[test]
    fn a_direction_of_any_length_is_normalised() {
        for scale in [1e-300, 1.0, 1e300] {
            let light = Light::Directional { direction: DVec3::new(0.0, -3.0, 4.0) * scale, half_angle: 0.0 };
            let direction = light.checked().unwrap().direction();
            assert!((direction - DVec3::new(0.0, -0.6, 0.8)).length() < 1e-12);
        }
    }
}
