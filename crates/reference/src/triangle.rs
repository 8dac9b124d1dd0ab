//! Triangles as rays meet them, and which triangles of a scene rays can meet.
//!
//! Loaders promise whole triangles ([`scumble_scenes::Mesh`]), other makers of scenes may not. A corner that is missing,
//! infinite or not a number makes its triangle no surface, and so does an area of zero. Rays pass through these, the rest
//! of the scene is met as if they were not there, and each mesh that has some is reported. Triangles that are there
//! twice are met as one.

use std::fmt;

use glam::{DVec3, Vec2, Vec3, Vec3A};
use obvhs::aabb::Aabb;
use scumble_scenes::{Mesh, Scene};

use crate::Hit;

/// Barycentric coordinates down to this count as inside: far above `f64` rounding, far below a `f32` position's.
pub const EDGE_TOLERANCE: f64 = 1e-10;
/// A triangle whose area is below this share of the product of its edges has none: far above the rounding of `f64`, far
/// below what `f32` positions can tell from a line.
const AREA_SHARE: f64 = 1e-12;

/// The triangles of a mesh that rays pass through.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Skipped {
    /// Name of the mesh.
    pub mesh: String,
    /// Triangles of the mesh.
    pub triangles: usize,
    /// Those with a corner that is missing, infinite or not a number.
    pub broken: usize,
    /// Those without an area.
    pub flat: usize,
}

impl fmt::Display for Skipped {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { mesh, triangles, broken, flat } = self;
        write!(
            formatter,
            "mesh {mesh}: of {triangles} triangles {broken} have a corner that is no finite point and {flat} have no area; \
             rays pass through these"
        )
    }
}

/// A triangle in the local coordinates of the rays.
#[derive(Clone)]
pub struct Triangle {
    corner: DVec3,
    edges: [DVec3; 2],
    shading_normals: [Vec3; 3],
    mesh: u32,
}

/// Where a line meets a triangle.
pub struct Meeting {
    /// Along the line.
    pub distance: f64,
    /// Weights of the second and third corner.
    barycentric: [f64; 2],
}

impl Meeting {
    /// A value that is linear between the corners, of those at the corners.
    pub fn between(&self, corners: [Vec2; 3]) -> Vec2 {
        let [u, v] = self.barycentric;
        let [a, b, c] = corners.map(|corner| corner.as_dvec2());
        (a * (1.0 - u - v) + b * u + c * v).as_vec2()
    }
}

/// Texture coordinates of the corners of triangles, in their order; empty for a scene that nothing is cut out of.
pub type CornerUvs = Vec<[Vec2; 3]>;

/// The triangles of a scene in world space, their texture coordinates, and what was left out of them.
pub fn triangles_of(scene: &Scene) -> (Vec<Triangle>, CornerUvs, Vec<Skipped>) {
    let mut triangles = Vec::with_capacity(scene.triangle_count());
    let mut uvs = CornerUvs::new();
    let has_masks = scene.meshes.iter().any(|mesh| mesh.mask.is_some());
    let mut skipped = Vec::new();
    for (index, mesh) in scene.meshes.iter().enumerate() {
        let (mut broken, mut flat) = (0, 0);
        for &corners in &mesh.triangles {
            match Triangle::new(mesh, index as u32, corners) {
                None => broken += 1,
                Some(triangle) if triangle.is_flat() => flat += 1,
                Some(triangle) => {
                    triangles.push(triangle);
                    uvs.extend(has_masks.then(|| uvs_of(mesh, corners)));
                }
            }
        }
        if broken + flat > 0 {
            skipped.push(Skipped { mesh: mesh.name.clone(), triangles: mesh.triangles.len(), broken, flat });
        }
    }
    (triangles, uvs, skipped)
}

/// Zero where the mesh has none.
fn uvs_of(mesh: &Mesh, corners: [u32; 3]) -> [Vec2; 3] {
    let uv = |corner: u32| mesh.mask.as_ref().and_then(|mask| mask.uvs.get(corner as usize)).copied();
    corners.map(|corner| uv(corner).unwrap_or_default())
}

impl Triangle {
    /// `None` where a corner is missing or no finite point. Normals that are missing are replaced by none, which leaves
    /// the triangle's own.
    fn new(mesh: &Mesh, index: u32, corners: [u32; 3]) -> Option<Self> {
        let position =
            |corner: u32| mesh.positions.get(corner as usize).filter(|p| p.is_finite()).map(|p| p.as_dvec3());
        let [a, b, c] = [position(corners[0])?, position(corners[1])?, position(corners[2])?];
        let normal = |corner: u32| mesh.normals.get(corner as usize).copied().unwrap_or(Vec3::ZERO);
        Some(Self { corner: a, edges: [b - a, c - a], shading_normals: corners.map(normal), mesh: index })
    }

    fn is_flat(&self) -> bool {
        let [e0, e1] = self.edges;
        e0.cross(e1).length() <= AREA_SHARE * e0.length() * e1.length()
    }

    /// Index of its mesh.
    pub fn mesh(&self) -> usize {
        self.mesh as usize
    }

    /// The corners.
    pub fn corners(&self) -> [DVec3; 3] {
        [self.corner, self.corner + self.edges[0], self.corner + self.edges[1]]
    }

    /// The triangle in coordinates about `middle`, in units of `1 / local_per_metre`.
    pub fn make_local(&mut self, middle: DVec3, local_per_metre: f64) {
        self.corner = (self.corner - middle) * local_per_metre;
        self.edges = self.edges.map(|edge| edge * local_per_metre);
    }

    /// A box around the triangle, larger by `padding` on each side.
    pub fn padded_box(&self, padding: f64) -> Aabb {
        let [a, b, c] = self.corners();
        let min = a.min(b).min(c) - padding;
        let max = a.max(b).max(c) + padding;
        Aabb::new(Vec3A::from(min.as_vec3()), Vec3A::from(max.as_vec3()))
    }

    /// `origin + t direction = corner + u e_0 + v e_1`, solved by Cramer's rule.
    pub fn meet(&self, origin: DVec3, direction: DVec3) -> Option<Meeting> {
        let [e0, e1] = self.edges;
        let p = direction.cross(e1);
        let determinant = e0.dot(p);
        if determinant == 0.0 {
            return None;
        }
        let inverse = 1.0 / determinant;
        let s = origin - self.corner;
        let u = s.dot(p) * inverse;
        let q = s.cross(e0);
        let v = direction.dot(q) * inverse;
        let inside = u >= -EDGE_TOLERANCE && v >= -EDGE_TOLERANCE && u + v <= 1.0 + EDGE_TOLERANCE;
        inside.then(|| Meeting { distance: e1.dot(q) * inverse, barycentric: [u, v] })
    }

    /// What a ray from `origin` in world space finds at `distance` metres.
    pub fn hit(&self, meeting: &Meeting, direction: DVec3, distance: f64, origin: DVec3) -> Hit {
        let towards_origin = |normal: DVec3| if normal.dot(direction) > 0.0 { -normal } else { normal };
        let geometric_normal = towards_origin(self.edges[0].cross(self.edges[1]).normalize());

        let [u, v] = meeting.barycentric;
        let [n0, n1, n2] = self.shading_normals.map(|normal| normal.as_dvec3());
        let interpolated = (n0 * (1.0 - u - v) + n1 * u + n2 * v).normalize_or(geometric_normal);
        let shading_normal = if interpolated.dot(geometric_normal) < 0.0 { -interpolated } else { interpolated };
        Hit {
            distance,
            position: origin + direction * distance,
            geometric_normal,
            shading_normal,
            front: (n0 + n1 + n2).dot(direction) <= 0.0,
            mesh: self.mesh as usize,
        }
    }
}
