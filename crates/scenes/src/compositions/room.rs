//! `room`: a reading corner under a hanging lamp: a table with a book, a bench, a deck chair, a shelf against the wall.
//! Contact under every foot, soft edges on the walls, one lamp within the picture.

use super::ASPECT;
use crate::model::{Placement, load_asset, place};
use crate::shapes::{cuboid, shade};
use crate::{Error, Mesh, Scene};
use glam::{DVec3, Vec3};
use scumble_core::{Camera, Light};
use std::path::Path;

const OAK: Vec3 = Vec3::new(0.45, 0.28, 0.15);
/// Where the lamp hangs: in the opening of its shade, which so shades nothing below.
const LAMP: DVec3 = DVec3::new(0.1, 2.12, 0.2);

/// Composes the room.
pub fn room(assets: &Path) -> Result<Scene, Error> {
    let plaster = Vec3::new(0.64, 0.58, 0.50);
    let mut meshes = vec![
        cuboid("floor", DVec3::new(-2.6, -0.1, -1.7), DVec3::new(3.2, 0.0, 2.4), Vec3::new(0.38, 0.27, 0.19)),
        cuboid("back wall", DVec3::new(-2.6, 0.0, -1.8), DVec3::new(3.2, 2.9, -1.7), plaster),
        cuboid("side wall", DVec3::new(-2.7, -0.1, -1.8), DVec3::new(-2.6, 2.9, 2.4), plaster),
        shade("lamp shade", LAMP + DVec3::Y * 0.02, [0.24, 0.10], 0.24, Vec3::new(0.62, 0.50, 0.30)),
        cuboid(
            "lamp cord",
            LAMP + DVec3::new(-0.006, 0.2, -0.006),
            DVec3::new(LAMP.x + 0.006, 2.9, LAMP.z + 0.006),
            Vec3::splat(0.05),
        ),
    ];
    meshes.extend(table(DVec3::new(0.1, 0.0, 0.1)));
    meshes.extend(shelf(DVec3::new(-1.55, 0.0, -1.52)));
    meshes.extend(place(&load_asset(assets, "pianoBench")?, &[Placement::at(0.05, 0.98, 0.25)]));
    meshes.extend(place(&load_asset(assets, "deckChair")?, &[Placement::at(1.55, 0.35, -0.75)]));
    meshes.push(cuboid(
        "picture",
        DVec3::new(0.25, 1.25, -1.70),
        DVec3::new(1.25, 1.95, -1.67),
        Vec3::new(0.16, 0.24, 0.30),
    ));

    Ok(Scene {
        name: "room".to_owned(),
        meshes,
        camera: Camera {
            eye: DVec3::new(2.2, 2.0, 4.9),
            target: DVec3::new(-0.1, 0.95, -0.2),
            up: DVec3::Y,
            vertical_fov: 0.60,
            aspect: ASPECT,
            near: 0.1,
            far: 20.0,
        },
        light: Light::Spot { position: LAMP, direction: DVec3::NEG_Y, cone_half_angle: 1.2, radius_world: 0.06 },
        pcf_radius_world: 0.03,
    })
}

/// A table of 1.3 x 0.75 x 0.75 m about `foot`, with a book and a bowl's worth of boxes on it.
fn table(foot: DVec3) -> Vec<Mesh> {
    let part = |name: &str, min: [f64; 3], max: [f64; 3], color: Vec3| {
        cuboid(name, foot + DVec3::from_array(min), foot + DVec3::from_array(max), color)
    };
    let mut parts = vec![
        part("table top", [-0.65, 0.71, -0.38], [0.65, 0.75, 0.38], OAK),
        part("book", [-0.42, 0.75, -0.08], [-0.18, 0.79, 0.22], Vec3::new(0.45, 0.10, 0.08)),
        part("box", [0.25, 0.75, -0.2], [0.40, 0.93, -0.05], Vec3::new(0.16, 0.30, 0.30)),
    ];
    for (x, z) in [(-0.60, -0.33), (0.60, -0.33), (-0.60, 0.33), (0.60, 0.33)] {
        parts.push(part("table leg", [x - 0.03, 0.0, z - 0.03], [x + 0.03, 0.71, z + 0.03], OAK));
    }
    parts
}

/// A shelf of four boards, 0.9 x 1.7 x 0.3 m about `foot`, with books that lean on nothing.
fn shelf(foot: DVec3) -> Vec<Mesh> {
    let part = |name: &str, min: [f64; 3], max: [f64; 3], color: Vec3| {
        cuboid(name, foot + DVec3::from_array(min), foot + DVec3::from_array(max), color)
    };
    let mut parts = vec![
        part("shelf side", [-0.47, 0.0, -0.15], [-0.45, 1.7, 0.15], OAK),
        part("shelf side", [0.45, 0.0, -0.15], [0.47, 1.7, 0.15], OAK),
    ];
    for board in [0.08, 0.60, 1.12, 1.66] {
        parts.push(part("board", [-0.45, board, -0.15], [0.45, board + 0.025, 0.15], OAK));
    }
    // Height, thickness and colour by turns: three periods without a common factor never repeat on a board.
    let colors = [Vec3::new(0.42, 0.12, 0.09), Vec3::new(0.12, 0.20, 0.30), Vec3::new(0.50, 0.40, 0.20)];
    for (board, count) in [(0.105, 14_usize), (0.625, 11), (1.145, 16)] {
        let mut x = -0.44;
        for i in 0..count {
            let (thickness, height) = (0.03 + 0.008 * (i % 4) as f64, 0.26 + 0.03 * (i % 5) as f64);
            parts.push(part("book", [x, board, -0.12], [x + thickness, board + height, 0.09], colors[i % 3]));
            x += thickness + 0.002;
        }
    }
    parts
}
