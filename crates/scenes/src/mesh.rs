//! Triangles of one colour, and the few operations that put a model into a scene.

use crate::AlphaMask;
use glam::{DAffine3, DMat3, DVec3, Vec3};
use scumble_core::Aabb;

/// Triangles of one colour, in world space and metres once they are part of a [`crate::Scene`].
///
/// Promised by the loaders, relied on by everybody else: every position is finite, every normal has length 1,
/// there is one normal per position and one texture coordinate in a mask, every index is in range, and no triangle has zero area in `f32`.
/// Not promised: closed surfaces, consistent winding, single faces.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// The object and material in the file, for messages and overlays.
    pub name: String,
    /// Corners.
    pub positions: Vec<Vec3>,
    /// Shading normals, one per position.
    pub normals: Vec<Vec3>,
    /// Three indices into `positions` each.
    pub triangles: Vec<[u32; 3]>,
    /// Diffuse reflectance, linear sRGB, each 0..=1.
    pub linear_color: Vec3,
    /// What is cut out of it, as leaves are of their cards; `None` where nothing is.
    pub mask: Option<AlphaMask>,
}

impl Mesh {
    /// The smallest box around all positions; `None` for a mesh without positions.
    pub fn bounds(&self) -> Option<Aabb> {
        bounds_of(std::slice::from_ref(self))
    }

    /// The mesh with every position moved by `world_from_model`, normals turned along (inverse transpose).
    #[must_use]
    pub fn transformed(mut self, world_from_model: &DAffine3) -> Self {
        let linear = world_from_model.matrix3;
        let normal_from_model = inverse_transpose(&linear);
        for position in &mut self.positions {
            *position = world_from_model.transform_point3(position.as_dvec3()).as_vec3();
        }
        for normal in &mut self.normals {
            *normal = (normal_from_model * normal.as_dvec3()).normalize_or(DVec3::Y).as_vec3();
        }

        // A mirroring transform would turn the triangles inside out.
        if linear.determinant() < 0.0 {
            for triangle in &mut self.triangles {
                triangle.swap(1, 2);
            }
        }
        self
    }

    /// The mesh in another colour.
    #[must_use]
    pub fn colored(mut self, linear_color: Vec3) -> Self {
        self.linear_color = linear_color;
        self
    }
}

/// The smallest box around all positions of all meshes; `None` when there are none.
pub fn bounds_of(meshes: &[Mesh]) -> Option<Aabb> {
    let bounds = Aabb::from_points(meshes.iter().flat_map(|mesh| &mesh.positions).map(|p| p.as_dvec3()));
    (!bounds.is_empty()).then_some(bounds)
}

/// `transpose(inverse(m))` up to a positive factor, defined for singular `m` too: the cofactor matrix with the sign of
/// the determinant, so that the normals of a mirrored mesh keep pointing outwards.
fn inverse_transpose(m: &DMat3) -> DMat3 {
    let cofactors = DMat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis));
    if m.determinant() < 0.0 { cofactors * -1.0 } else { cofactors }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::cuboid;

    /// Every triangle's winding agrees with its normals.
    fn winding_agrees(mesh: &Mesh) -> bool {
        mesh.triangles.iter().all(|&[a, b, c]| {
            let [a, b, c] = [a, b, c].map(|i| i as usize);
            let face = (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
            face.dot(mesh.normals[a]) > 0.0
        })
    }

    #[test]
    fn a_mirrored_box_keeps_its_outside_outside() {
        let mirror = DAffine3::from_scale(DVec3::new(-2.0, 1.0, 0.5));
        let mesh = cuboid("box", DVec3::ZERO, DVec3::ONE, Vec3::ONE);
        assert!(winding_agrees(&mesh));
        let mirrored = mesh.transformed(&mirror);
        assert!(winding_agrees(&mirrored));
        let bounds = mirrored.bounds().unwrap();
        assert_eq!(bounds.min, DVec3::new(-2.0, 0.0, 0.0));
        assert_eq!(bounds.max, DVec3::new(0.0, 1.0, 0.5));
    }

    #[test]
    fn normals_of_a_flattened_box_stay_perpendicular() {
        let tilt = DAffine3::from_scale(DVec3::new(1.0, 0.1, 1.0)) * DAffine3::from_rotation_z(0.5);
        let mesh = cuboid("box", -DVec3::ONE, DVec3::ONE, Vec3::ONE).transformed(&tilt);
        for &[a, b, _] in &mesh.triangles {
            let edge = mesh.positions[b as usize] - mesh.positions[a as usize];
            assert!(edge.dot(mesh.normals[a as usize]).abs() < 1e-6);
        }
    }

    #[test]
    fn no_positions_have_no_bounds() {
        assert!(bounds_of(&[]).is_none());
    }
}
