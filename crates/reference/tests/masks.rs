//! Light through a surface that a mask cuts out, whose shadow is known.
//!
//! The sheet is a square of 8 x 8 texels, there and missing like the fields of a chessboard. Bilinear alpha is a half on
//! the borders of such texels and nowhere else, so that the sheet is 32 exact squares.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod common;

use std::sync::Arc;

use common::sun;
use glam::{DVec2, DVec3, UVec2, Vec3};
use scumble_reference::{LightTruth, Rays, Receiver, polygon_under_disc};
use scumble_scenes::{AlphaMask, AlphaTexture, Mesh, Scene, Wrap, ground};

/// Texels per side of the sheet.
const FIELDS: u32 = 8;
/// Side of a field, and height of the sheet.
const FIELD: f64 = 0.1;
const HEIGHT: f64 = 1.0;

/// Whether a field is there.
fn is_black(column: u32, row: u32) -> bool {
    (column + row).is_multiple_of(2)
}

/// The corner of a field on the sheet, in x and z.
fn corner(column: u32, row: u32) -> DVec2 {
    (DVec2::new(f64::from(column), f64::from(row)) - f64::from(FIELDS) / 2.0) * FIELD
}

/// The sheet over the ground, under a sun in the zenith.
fn scene() -> Scene {
    let alphas = (0..FIELDS * FIELDS).map(|i| if is_black(i % FIELDS, i / FIELDS) { 255 } else { 0 }).collect();
    let texture = AlphaTexture { size: UVec2::splat(FIELDS), alphas, wrap: [Wrap::Clamp; 2], cutoff: 0.5 };
    let side = f64::from(FIELDS) * FIELD;
    let sheet = ground("sheet", HEIGHT * DVec3::Y, side, Vec3::ONE);
    let place = |p: &Vec3| glam::Vec2::new(p.x, p.z) / side as f32 + 0.5;
    let mask = AlphaMask { uvs: sheet.positions.iter().map(place).collect(), texture: Arc::new(texture) };
    let sheet = Mesh { mask: Some(mask), ..sheet };
    common::scene(sun(DVec3::NEG_Y), vec![ground("ground", DVec3::ZERO, 8.0, Vec3::ONE), sheet])
}

/// Points of the ground under the sheet and beside it.
fn receivers() -> Vec<Receiver> {
    let per_side = 40;
    let along = |i: u32| 1.2 * ((f64::from(i) + 0.37) / f64::from(per_side) - 0.5);
    let receiver = |i: u32| {
        let pixel = [i % per_side, i / per_side];
        Receiver { position: DVec3::new(along(pixel[0]), 0.0, along(pixel[1])).as_vec3(), normal: Vec3::Y, pixel }
    };
    (0..per_side * per_side).map(receiver).collect()
}

/// The sun without the share that the black fields cover, seen from a receiver.
fn visibility(receiver: &Receiver, radius: f64) -> f64 {
    let below = DVec2::new(f64::from(receiver.position.x), f64::from(receiver.position.z));
    let covered = |(column, row)| {
        let corners = [(0, 0), (1, 0), (1, 1), (0, 1)];
        polygon_under_disc(&corners.map(|(x, y)| (corner(column + x, row + y) - below) / radius))
    };
    let fields = (0..FIELDS).flat_map(|row| (0..FIELDS).map(move |column| (column, row)));
    1.0 - fields.filter(|&(column, row)| is_black(column, row)).map(covered).sum::<f64>()
}

#[test]
fn the_light_through_a_chessboard_is_the_sum_of_its_fields_within_the_standard_error() {
    let rays = Rays::new(&scene());
    for samples in [128, 1024] {
        let truth = LightTruth::new(&rays, &sun(DVec3::NEG_Y), samples).unwrap();
        let scores: Vec<f64> = receivers()
            .iter()
            .map(|receiver| {
                let (found, exact) = (truth.at(receiver), visibility(receiver, HEIGHT * 0.1_f64.tan()));
                (f64::from(found.visibility) - exact) / f64::from(found.standard_error)
            })
            .collect();
        let count = scores.len() as f64;
        let spread = (scores.iter().map(|z| z * z).sum::<f64>() / count).sqrt();
        let mean = scores.iter().sum::<f64>() / count;
        let beyond = scores.iter().filter(|z| z.abs() > 3.0).count();
        assert!(spread < 1.1 && mean.abs() < 0.1, "{samples} samples: mean {mean}, spread {spread}");
        // Of a normal law 4 of 1600, with three standard deviations of that count.
        assert!(beyond <= 10, "{samples} samples: {beyond}");
    }
}
