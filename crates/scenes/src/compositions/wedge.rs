//! `wedge`: the straight edge of a plate over a plane, under a sun in the zenith: a shadow whose every value is known.
//!
//! With the plate's underside `h` above the plane and a sun of half angle `alpha`, the penumbra is a band of width
//! `2 h tan(alpha)` about the edge's foot. At the signed distance `d` from it, `x = d / (h tan(alpha))` in -1..=1, the
//! plane sees the share of a disc on one side of a chord:
//!
//! ```text
//! V(x) = 1/2 + (x sqrt(1 - x^2) + asin(x)) / pi
//! ```
//!
//! The plate reaches further than the penumbra is wide to all other sides of the picture's middle.

use super::ASPECT;
use crate::shapes::ground;
use crate::{Error, Mesh, Scene};
use glam::{DAffine3, DVec3, Vec3};
use scumble_core::{Camera, Light};
use std::path::Path;

/// Height of the plate over the plane, metres.
const HEIGHT: f64 = 1.0;
/// Turn of the edge out of the axes, radians: 1 in 10, so that every texel's row has its steps.
const SLANT: f64 = 0.1;
/// Side of the plane, metres; the plate is a square of this side too.
const SIDE: f64 = 8.0;

/// A plate without thickness, 1 m over a plane, under a sun of half angle 5 degrees. Needs no assets.
pub fn wedge(_assets: &Path) -> Result<Scene, Error> {
    let plate = ground("plate", DVec3::new(-SIDE / 2.0, HEIGHT, 0.0), SIDE, Vec3::new(0.55, 0.22, 0.12));
    let turned: Mesh = plate.transformed(&DAffine3::from_rotation_y(SLANT));
    Ok(Scene {
        name: "wedge".to_owned(),
        meshes: vec![ground("ground", DVec3::ZERO, SIDE, Vec3::splat(0.55)), turned],
        camera: Camera {
            eye: DVec3::new(1.15, 0.85, 1.5),
            target: DVec3::new(0.02, 0.0, -0.15),
            up: DVec3::Y,
            vertical_fov: 0.60,
            aspect: ASPECT,
            near: 0.1,
            far: 30.0,
        },
        light: Light::Directional { direction: DVec3::NEG_Y, half_angle: 5f64.to_radians() },
        pcf_radius_world: 0.0875,
    })
}
