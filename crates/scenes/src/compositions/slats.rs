//! `slats`: a blind before the sun. Parallel edges at a regular pitch, nearer to the floor below than to the wall, so
//! that the stripes run together where the penumbra becomes as wide as the pitch.

use super::ASPECT;
use crate::shapes::cuboid;
use crate::{Error, Mesh, Scene};
use glam::{DAffine3, DVec3, Vec3};
use scumble_core::{Camera, Light};
use std::path::Path;

/// Slats of the blind, at a pitch of 7 cm.
const SLATS: u32 = 24;
const PITCH: f64 = 0.07;
/// Height of the lowest slat's middle, metres.
const LOWEST: f64 = 0.36;
/// Slats are 5 cm wide, as the common blinds are, and 4 mm thick.
const HALF_WIDTH: f64 = 0.025;
const HALF_THICKNESS: f64 = 0.002;
/// Half of the blind's length, metres.
const HALF_LENGTH: f64 = 1.2;
/// The blind's plane, metres.
const X: f64 = -1.4;
/// Turn of the slats about their length, radians, so that the sun passes between them.
const TILT: f64 = -0.30;

/// Composes the blind. Needs no assets.
pub fn slats(_assets: &Path) -> Result<Scene, Error> {
    let white = Vec3::new(0.70, 0.68, 0.63);
    let wood = Vec3::new(0.42, 0.27, 0.16);
    let top = LOWEST + PITCH * f64::from(SLATS);
    let slat = cuboid(
        "slat",
        DVec3::new(-HALF_WIDTH, -HALF_THICKNESS, -HALF_LENGTH),
        DVec3::new(HALF_WIDTH, HALF_THICKNESS, HALF_LENGTH),
        white,
    );
    let bar = |name: &str, y: [f64; 2], z: [f64; 2]| {
        cuboid(name, DVec3::new(X - 0.04, y[0], z[0]), DVec3::new(X + 0.04, y[1], z[1]), wood)
    };
    let mut meshes: Vec<Mesh> = vec![
        cuboid("floor", DVec3::new(-2.2, -0.1, -1.9), DVec3::new(2.6, 0.0, 2.2), Vec3::new(0.50, 0.44, 0.37)),
        cuboid("wall", DVec3::new(-2.2, -0.1, -2.0), DVec3::new(2.6, 2.6, -1.9), Vec3::new(0.62, 0.60, 0.56)),
        bar("left post", [0.0, top + 0.08], [HALF_LENGTH, HALF_LENGTH + 0.08]),
        bar("right post", [0.0, top + 0.08], [-HALF_LENGTH - 0.08, -HALF_LENGTH]),
        bar("head rail", [top, top + 0.08], [-HALF_LENGTH, HALF_LENGTH]),
        bar("sill", [LOWEST - 0.14, LOWEST - 0.06], [-HALF_LENGTH, HALF_LENGTH]),
    ];
    meshes.extend((0..SLATS).map(|i| {
        let middle = DVec3::new(X, LOWEST + PITCH * f64::from(i), 0.0);
        slat.clone().transformed(&(DAffine3::from_translation(middle) * DAffine3::from_rotation_z(TILT)))
    }));

    Ok(Scene {
        name: "slats".to_owned(),
        meshes,
        camera: Camera {
            eye: DVec3::new(1.9, 1.75, 2.35),
            target: DVec3::new(-0.25, 0.42, -0.75),
            up: DVec3::Y,
            vertical_fov: 0.66,
            aspect: ASPECT,
            near: 0.1,
            far: 30.0,
        },
        light: Light::Directional {
            direction: DVec3::new(0.72, -0.60, -0.42).normalize(),
            half_angle: 1f64.to_radians(),
        },
        pcf_radius_world: 0.02,
    })
}
