//! From loose triangles to a mesh with one unit normal per position.
//!
//! Normals given by the file are kept. Where there are none, a corner's normal is the area-weighted mean of its
//! neighbours: `n = sum_f A_f n_f` over the faces `f` that share the corner's position and whose normal is within the
//! crease angle of the corner's own face. Positions are shared when all three coordinates are equal, so that seams of
//! a file's own indices do not show. The two sides of a doubled face are 180 degrees apart and never mix.

use glam::{DVec3, Vec2, Vec3};
use std::collections::HashMap;

/// Edges sharper than this stay sharp, 40 degrees: above a 12-sided pole (30), below a bevel (45).
const CREASE_COS: f64 = 0.766_044_443;

/// Triangles as a file gives them.
#[derive(Debug, Default)]
pub struct Loose {
    /// Corners of each triangle. All finite, and with area.
    pub corners: Vec<[Vec3; 3]>,
    /// Normals given at the corners, of any length; zero where the file gives none. As many as `corners`.
    pub normals: Vec<[Vec3; 3]>,
    /// Texture coordinates at the corners; as many as `corners`, or none.
    pub uvs: Vec<[Vec2; 3]>,
}

/// Triangles by indices.
#[derive(Debug, Default)]
pub struct Indexed {
    /// Corners.
    pub positions: Vec<Vec3>,
    /// Of length 1, one a position.
    pub normals: Vec<Vec3>,
    /// One a position, or none.
    pub uvs: Vec<Vec2>,
    /// Three indices into `positions` each.
    pub triangles: Vec<[u32; 3]>,
}

/// Gives every corner its normal and shares the corners that agree in position, normal and texture coordinate.
pub fn index(loose: &Loose) -> Indexed {
    let faces: Vec<DVec3> = loose.corners.iter().map(area_normal).collect();
    let around = faces_around_positions(loose);

    let mut known: HashMap<[u32; 8], u32> = HashMap::new();
    let mut indexed = Indexed::default();
    for (face, (corners, given)) in loose.corners.iter().zip(&loose.normals).enumerate() {
        let mut triangle = [0; 3];
        for (corner, (slot, (&position, &given))) in triangle.iter_mut().zip(corners.iter().zip(given)).enumerate() {
            let normal = given
                .as_dvec3()
                .try_normalize()
                .unwrap_or_else(|| creased(face, &around[&bits(position)], &faces))
                .as_vec3();
            let uv = loose.uvs.get(face).map(|uvs| uvs[corner]);
            let ([x, y, z], [nx, ny, nz]) = (bits(position), bits(normal));
            let [u, v] = uv.unwrap_or_default().to_array().map(f32::to_bits);
            *slot = *known.entry([x, y, z, nx, ny, nz, u, v]).or_insert_with(|| {
                indexed.positions.push(position);
                indexed.normals.push(normal);
                indexed.uvs.extend(uv);
                indexed.positions.len() as u32 - 1
            });
        }
        indexed.triangles.push(triangle);
    }
    indexed
}

/// The face's normal with twice its area as length.
fn area_normal(&[a, b, c]: &[Vec3; 3]) -> DVec3 {
    let [a, b, c] = [a, b, c].map(|p| p.as_dvec3());
    (b - a).cross(c - a)
}

fn faces_around_positions(loose: &Loose) -> HashMap<[u32; 3], Vec<usize>> {
    let mut around: HashMap<[u32; 3], Vec<usize>> = HashMap::new();
    for (face, corners) in loose.corners.iter().enumerate() {
        for &corner in corners {
            around.entry(bits(corner)).or_default().push(face);
        }
    }
    around
}

/// The area-weighted mean normal of the faces within the crease angle of `face`, itself included.
fn creased(face: usize, neighbours: &[usize], faces: &[DVec3]) -> DVec3 {
    let own = faces[face].normalize();
    neighbours
        .iter()
        .map(|&other| faces[other])
        .filter(|other| other.dot(own) >= CREASE_COS * other.length())
        .sum::<DVec3>()
        .try_normalize()
        .unwrap_or(own)
}

/// A key under which equal vectors are equal; `+ 0.0` makes one zero of two.
fn bits(v: Vec3) -> [u32; 3] {
    v.to_array().map(|x| (x + 0.0).to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn without_normals(corners: Vec<[Vec3; 3]>) -> Loose {
        let normals = vec![[Vec3::ZERO; 3]; corners.len()];
        Loose { corners, normals, uvs: Vec::new() }
    }

    /// Two unit triangles that share the edge from the origin to +z, the second turned by `angle` out of the plane.
    fn roof(angle: f32) -> Loose {
        let turned = Vec3::new(angle.cos(), -angle.sin(), 0.0);
        without_normals(
            vec![[Vec3::ZERO, Vec3::Z, Vec3::X * -1.0], [Vec3::ZERO, turned, Vec3::Z]]
                .into_iter()
                .map(|[a, b, c]| [a, c, b])
                .collect(),
        )
    }

    #[test]
    fn a_flat_edge_is_smooth_and_a_sharp_edge_is_doubled() {
        assert_eq!(index(&roof(0.5)).positions.len(), 4);
        assert_eq!(index(&roof(0.8)).positions.len(), 6);
    }

    #[test]
    fn a_smooth_edge_has_the_mean_normal() {
        let Indexed { positions, normals, .. } = index(&roof(0.5));
        let at_edge = positions.iter().position(|&p| p == Vec3::Z).unwrap();
        let mean = Vec3::new(0.25f32.sin(), 0.25f32.cos(), 0.0);
        let same_or_opposite = normals[at_edge].dot(mean).abs();
        assert!((same_or_opposite - 1.0).abs() < 1e-6);
    }

    #[test]
    fn the_two_sides_of_a_doubled_face_keep_opposite_normals() {
        let side = [Vec3::ZERO, Vec3::X, Vec3::Z];
        let other = [Vec3::ZERO, Vec3::Z, Vec3::X];
        let Indexed { normals, triangles, .. } = index(&without_normals(vec![side, other]));
        let [front, back] = [0, 1].map(|t: usize| normals[triangles[t][0] as usize]);
        assert_eq!(front, -back);
    }

    #[test]
    fn given_normals_are_kept_at_unit_length() {
        let loose = Loose {
            corners: vec![[Vec3::ZERO, Vec3::X, Vec3::Z]],
            normals: vec![[Vec3::new(3.0, 0.0, 4.0), Vec3::ZERO, Vec3::Y * 1e-20]],
            uvs: Vec::new(),
        };
        let Indexed { normals, triangles, .. } = index(&loose);
        let [a, b, c] = triangles[0].map(|i| normals[i as usize]);
        assert_eq!(a, Vec3::new(0.6, 0.0, 0.8));
        assert_eq!(b, Vec3::NEG_Y);
        assert_eq!(c, Vec3::Y);
    }

    #[test]
    fn a_seam_of_texture_coordinates_doubles_its_corners() {
        let uvs = [[Vec2::ZERO, Vec2::Y, Vec2::X], [Vec2::ZERO, Vec2::X, Vec2::Y]];
        let seamless = Loose { uvs: uvs.to_vec(), ..roof(0.5) };
        let indexed = index(&seamless);
        assert_eq!((indexed.positions.len(), indexed.uvs.len()), (4, 4));
        let torn = Loose { uvs: vec![uvs[0], uvs[1].map(|uv| uv + 2.0)], ..roof(0.5) };
        assert_eq!(index(&torn).uvs.len(), 6);
    }
}
