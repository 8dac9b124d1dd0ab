//! Fits that tests of several modules share.

use glam::DVec3;

use super::{Fit, fit};
use crate::{Aabb, Camera, Light};

pub(crate) fn room() -> Aabb {
    Aabb { min: DVec3::new(-2.0, -0.5, -3.0), max: DVec3::new(3.0, 2.5, 2.0) }
}

pub(crate) fn observer() -> Camera {
    Camera {
        eye: DVec3::new(1.5, 1.2, 4.0),
        target: DVec3::new(0.2, 0.1, 0.0),
        up: DVec3::Y,
        vertical_fov: 0.6,
        aspect: 1.4,
        near: 0.1,
        far: 60.0,
    }
}

pub(crate) fn sun() -> Light {
    Light::Directional { direction: DVec3::new(0.4, -1.0, -0.3), half_angle: 0.05 }
}

pub(crate) fn lamp() -> Light {
    Light::Spot {
        position: DVec3::new(-0.5, 4.0, 0.5),
        direction: DVec3::new(0.2, -1.0, -0.2),
        cone_half_angle: 0.8,
        radius_world: 0.2,
    }
}

pub(crate) fn bulb() -> Light {
    Light::Point { position: DVec3::new(0.4, 1.3, -0.6), radius_world: 0.1, reach_world: f64::INFINITY }
}

pub(crate) fn sun_over_room() -> Fit {
    fit(&observer(), &room(), &sun(), true).unwrap().unwrap()
}

pub(crate) fn lamp_over_room() -> Fit {
    fit(&observer(), &room(), &lamp(), true).unwrap().unwrap()
}

/// Vectors to all sides, within half a unit along each axis.
pub(crate) fn rays() -> impl Iterator<Item = DVec3> {
    (1..1000).map(|i| {
        let t = f64::from(i);
        let along = |step: f64| (t * step).fract() - 0.5;
        DVec3::new(along(0.618_033_9), along(0.754_877_7), along(0.569_840_3))
    })
}
