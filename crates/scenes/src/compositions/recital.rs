//! `recital`: a grand piano and its bench on a stage under one spot lamp: a large body on thin legs.

use super::ASPECT;
use crate::model::{Placement, load_asset, place};
use crate::shapes::cuboid;
use crate::{Error, Scene};
use glam::{DVec3, Vec3};
use scumble_core::{Camera, Light};
use std::path::Path;

/// Turns the keyboard to the left, so that lid and strings are seen from the side of the audience.
const PIANO_YAW: f64 = -0.75;

/// Composes the recital.
pub fn recital(assets: &Path) -> Result<Scene, Error> {
    let mut meshes = vec![
        cuboid("stage", DVec3::new(-6.0, -0.2, -2.2), DVec3::new(6.0, 0.0, 3.0), Vec3::new(0.50, 0.33, 0.20)),
        cuboid("wall", DVec3::new(-6.0, -0.2, -2.3), DVec3::new(6.0, 3.2, -2.2), Vec3::new(0.58, 0.55, 0.52)),
    ];
    meshes.extend(place(&load_asset(assets, "pianoAQueue")?, &[Placement::at(0.0, 0.0, PIANO_YAW)]));
    meshes.extend(place(
        &load_asset(assets, "pianoBench")?,
        &[Placement::at(1.05 * PIANO_YAW.sin(), 1.05 * PIANO_YAW.cos(), PIANO_YAW)],
    ));

    let lamp = DVec3::new(-2.2, 3.6, 2.0);
    Ok(Scene {
        name: "recital".to_owned(),
        meshes,
        camera: Camera {
            eye: DVec3::new(1.2, 1.8, 4.4),
            target: DVec3::new(0.25, 0.6, 0.0),
            up: DVec3::Y,
            vertical_fov: 0.60,
            aspect: ASPECT,
            near: 0.1,
            far: 20.0,
        },
        light: Light::Spot {
            position: lamp,
            direction: (DVec3::new(0.2, 0.3, -0.2) - lamp).normalize(),
            cone_half_angle: 0.58,
            radius_world: 0.15,
        },
        pcf_radius_world: 0.03,
    })
}
