//! `yard`: an iron fence across the picture, a swing, a deck chair under a parasol; the sun stands low behind the
//! fence, so that its shadow runs towards the camera and widens on its way.

use super::ASPECT;
use crate::model::{Placement, load_asset, place};
use crate::shapes::cuboid;
use crate::{Error, Scene};
use glam::{DVec3, Vec3};
use scumble_core::{Camera, Light};
use std::path::Path;

/// Panels of the fence: four keep the scene near 95,000 triangles.
const PANELS: i32 = 4;
/// Distance of two panels, their width (1.796 m) less half a post.
const PANEL_PITCH: f64 = 1.74;

/// Composes the yard.
pub fn yard(assets: &Path) -> Result<Scene, Error> {
    let fence = load_asset(assets, "fence")?;
    let panels: Vec<Placement> = (0..PANELS)
        .map(|i| Placement::at((f64::from(i) - f64::from(PANELS - 1) / 2.0) * PANEL_PITCH, -1.6, 0.0))
        .collect();

    // A terrace that ends behind the fence and in front of the camera: what lies beyond would only widen the light's
    // view.
    let mut meshes =
        vec![cuboid("terrace", DVec3::new(-5.6, -0.15, -2.6), DVec3::new(6.0, 0.0, 4.4), Vec3::new(0.50, 0.46, 0.38))];
    meshes.extend(place(&fence, &panels));
    meshes.extend(place(&load_asset(assets, "childSwing")?, &[Placement::at(-1.7, 0.3, 0.35)]));
    meshes.extend(place(&load_asset(assets, "umbrella")?, &[Placement::at(1.7, 0.0, 0.0)]));
    meshes.extend(place(&load_asset(assets, "deckChair")?, &[Placement::at(1.5, 0.9, -0.4)]));

    Ok(Scene {
        name: "yard".to_owned(),
        meshes,
        camera: Camera {
            eye: DVec3::new(-0.6, 2.7, 6.6),
            target: DVec3::new(0.0, 0.55, 0.3),
            up: DVec3::Y,
            vertical_fov: 0.68,
            aspect: ASPECT,
            near: 0.1,
            far: 60.0,
        },
        light: Light::Directional {
            direction: DVec3::new(0.42, -0.52, 0.75).normalize(),
            half_angle: 2.5f64.to_radians(),
        },
        pcf_radius_world: 0.06,
    })
}
