//! Axis-aligned boxes in world space: the scene's bounds.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::error::{Error, finite};

/// All points between two corners. A box whose minimum is above its maximum in any axis holds no point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Aabb {
    /// Smallest coordinates, in metres.
    pub min: DVec3,
    /// Largest coordinates, in metres.
    pub max: DVec3,
}

impl Aabb {
    /// The box of no point, the start of every union.
    pub const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The smallest box around `points`; [`Aabb::EMPTY`] around none.
    #[must_use]
    pub fn from_points(points: impl IntoIterator<Item = DVec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |all, p| Self { min: all.min.min(p), max: all.max.max(p) })
    }

    /// Whether the box holds no point. A box of zero size holds one.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.min.cmpgt(self.max).any()
    }

    /// The middle; without meaning for an empty box.
    #[must_use]
    pub fn center(&self) -> DVec3 {
        self.min + 0.5 * (self.max - self.min)
    }

    /// Lengths of the three sides, in metres.
    #[must_use]
    pub fn size(&self) -> DVec3 {
        self.max - self.min
    }

    /// The eight corners; bit 0 of the index chooses x, bit 1 y, bit 2 z.
    #[must_use]
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            DVec3::new(
                if i & 1 == 0 { self.min.x } else { self.max.x },
                if i & 2 == 0 { self.min.y } else { self.max.y },
                if i & 4 == 0 { self.min.z } else { self.max.z },
            )
        })
    }

    /// The smallest box around both.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Refuses NaN, and infinite sides of a box that is not empty.
    ///
    /// # Errors
    /// [`Error::Vector`] names the corner.
    pub(crate) fn checked(&self) -> Result<Self, Error> {
        if self.min.is_nan() || !self.is_empty() {
            finite("min of the scene's bounds", self.min)?;
        }
        if self.max.is_nan() || !self.is_empty() {
            finite("max of the scene's bounds", self.max)?;
        }
        Ok(*self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_around_no_points_is_empty_and_a_box_around_one_is_not() {
        assert!(Aabb::from_points([]).is_empty());
        let point = Aabb::from_points([DVec3::ONE]);
        assert!(!point.is_empty());
        assert_eq!(point.size(), DVec3::ZERO);
    }

    #[test]
    fn the_corners_of_a_box_span_it() {
        let bounds = Aabb { min: DVec3::new(-1.0, 2.0, 3.0), max: DVec3::new(4.0, 5.0, 7.0) };
        assert_eq!(Aabb::from_points(bounds.corners()), bounds);
        assert_eq!(bounds.center(), DVec3::new(1.5, 3.5, 5.0));
    }

    #[test]
    fn nan_in_the_bounds_is_refused_by_name() {
        let bounds = Aabb { min: DVec3::ZERO, max: DVec3::new(1.0, f64::NAN, 1.0) };
        assert!(bounds.checked().unwrap_err().to_string().contains("max of the scene's bounds"));
        assert!(Aabb::EMPTY.checked().is_ok());
    }
}
