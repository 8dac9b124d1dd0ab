//! The six faces of a point light: pyramids of 90 degrees about the axes of the world, one map each.
//!
//! A point belongs to the face of the axis along which it is farthest from the light, so the faces share no point but on
//! their borders. All have the same reference plane: a length there is the same angle on both sides of a border.

use glam::DVec3;

/// How much a face reaches beyond its border, as a tangent: a point that f32 puts on the wrong side still has a place in the
/// map. f32 errs by 6e-8 of a coordinate, so this is good up to 1,000 times as far from the shaders' origin as from the light.
pub(crate) const OVERLAP: f64 = 1e-4;

/// One face, by the axis of the world that it looks along.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    /// Along x.
    PositiveX,
    /// Against x.
    NegativeX,
    /// Along y.
    PositiveY,
    /// Against y.
    NegativeY,
    /// Along z.
    PositiveZ,
    /// Against z.
    NegativeZ,
}

impl Face {
    /// All of them, in the order of their maps.
    pub const ALL: [Self; 6] =
        [Self::PositiveX, Self::NegativeX, Self::PositiveY, Self::NegativeY, Self::PositiveZ, Self::NegativeZ];

    /// Place in [`Face::ALL`].
    #[must_use]
    pub fn index(self) -> u32 {
        self as u32
    }

    /// The axis, unit length.
    #[must_use]
    pub fn axis(self) -> DVec3 {
        match self {
            Self::PositiveX => DVec3::X,
            Self::NegativeX => DVec3::NEG_X,
            Self::PositiveY => DVec3::Y,
            Self::NegativeY => DVec3::NEG_Y,
            Self::PositiveZ => DVec3::Z,
            Self::NegativeZ => DVec3::NEG_Z,
        }
    }

    /// The face of a point at `ray` from the light, of any length: that of the longest component, on a border x before y
    /// before z; a component of zero counts as positive. Twin: `shadow_face_of` of the shaders.
    #[must_use]
    pub fn of(ray: DVec3) -> Self {
        let size = ray.abs();
        let (axis, along) = if size.x >= size.y && size.x >= size.z {
            (0, ray.x)
        } else if size.y >= size.z {
            (2, ray.y)
        } else {
            (4, ray.z)
        };
        Self::ALL[axis + usize::from(along < 0.0)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::tests_support::rays;

    #[test]
    fn every_direction_belongs_to_the_face_whose_axis_is_nearest() {
        for ray in rays() {
            let nearest = Face::ALL.into_iter().max_by(|a, b| a.axis().dot(ray).total_cmp(&b.axis().dot(ray)));
            assert_eq!(Some(Face::of(ray)), nearest, "{ray}");
        }
    }

    #[test]
    fn on_a_border_x_comes_before_y_before_z() {
        assert_eq!(Face::of(DVec3::new(1.0, 1.0, -1.0)), Face::PositiveX);
        assert_eq!(Face::of(DVec3::new(0.5, -1.0, 1.0)), Face::NegativeY);
        assert_eq!(Face::of(DVec3::ZERO), Face::PositiveX);
    }

    #[test]
    fn a_face_has_its_place_in_the_list() {
        assert!((0..).zip(Face::ALL).all(|(index, face)| face.index() == index));
    }
}
