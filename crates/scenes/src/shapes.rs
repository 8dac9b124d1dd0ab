//! Procedural shapes: the ground, the box and the lamp shade. Corners are doubled at edges, so that every face is flat-shaded.

use crate::Mesh;
use glam::{DVec3, Vec3};
use scumble_core::Aabb;

/// A horizontal square at height `center.y`, normal up, `size` metres on a side, two triangles.
pub fn ground(name: &str, center: DVec3, size: f64, linear_color: Vec3) -> Mesh {
    let half = size / 2.0;
    let corner = |x: f64, z: f64| center + DVec3::new(x * half, 0.0, z * half);
    let mut mesh = empty(name, linear_color);
    push_quad(&mut mesh, [corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0)]);
    mesh
}

/// An axis-aligned box between two corners, normals outwards, twelve triangles.
pub fn cuboid(name: &str, min: DVec3, max: DVec3, linear_color: Vec3) -> Mesh {
    // Indices into `Aabb::corners`, counter-clockwise from outside.
    const FACES: [[usize; 4]; 6] = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let corners = Aabb { min, max }.corners();
    let mut mesh = empty(name, linear_color);
    for face in FACES {
        push_quad(&mut mesh, face.map(|i| corners[i]));
    }
    mesh
}

/// The side of an upright cone cut off above, open at both ends, `radii` below and above, from `foot` up by `height`.
pub fn shade(name: &str, foot: DVec3, radii: [f64; 2], height: f64, linear_color: Vec3) -> Mesh {
    // A circle of 32 corners differs from its polygon by half a percent of the radius.
    const CORNERS: u32 = 32;
    let rim = |i: u32, radius: f64, y: f64| {
        let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / f64::from(CORNERS)).sin_cos();
        foot + DVec3::new(radius * sin, y, radius * cos)
    };
    let mut mesh = empty(name, linear_color);
    for i in 0..CORNERS {
        let below = [i, i + 1].map(|i| rim(i, radii[0], 0.0));
        let above = [i, i + 1].map(|i| rim(i, radii[1], height));
        push_quad(&mut mesh, [below[0], below[1], above[1], above[0]]);
    }
    mesh
}

fn empty(name: &str, linear_color: Vec3) -> Mesh {
    Mesh {
        name: name.to_owned(),
        positions: Vec::new(),
        normals: Vec::new(),
        triangles: Vec::new(),
        linear_color,
        mask: None,
    }
}

/// Appends a planar quad, counter-clockwise from the side of its normal.
fn push_quad(mesh: &mut Mesh, corners: [DVec3; 4]) {
    let first = mesh.positions.len() as u32;
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize().as_vec3();
    mesh.positions.extend(corners.map(|c| c.as_vec3()));
    mesh.normals.extend([normal; 4]);
    mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_is_closed_and_faces_outwards() {
        let mesh = cuboid("box", DVec3::ZERO, DVec3::new(1.0, 2.0, 3.0), Vec3::ONE);
        assert_eq!(mesh.triangles.len(), 12);

        // Divergence theorem: the signed volume of a closed outward surface is the volume.
        let volume: f32 = mesh
            .triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|i| mesh.positions[i as usize]);
                a.dot(b.cross(c)) / 6.0
            })
            .sum();
        assert!((volume - 6.0).abs() < 1e-5);
    }

    #[test]
    fn the_ground_faces_up() {
        let mesh = ground("ground", DVec3::new(1.0, -2.0, 3.0), 4.0, Vec3::ONE);
        assert!(mesh.normals.iter().all(|&n| n == Vec3::Y));
        let bounds = mesh.bounds().unwrap();
        assert_eq!(bounds.min, DVec3::new(-1.0, -2.0, 1.0));
        assert_eq!(bounds.max, DVec3::new(3.0, -2.0, 5.0));
    }
}
