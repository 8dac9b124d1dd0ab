//! A camera, a sun and, where sensible, a ground for meshes of which nothing is known but their shape.

use crate::shapes::ground;
use crate::{Mesh, Scene, bounds_of};
use glam::{DVec2, DVec3, Vec3, Vec3Swizzles as _};
use scumble_core::{Aabb, Camera, Light};
use std::path::Path;

/// From the middle of the scene towards the camera: from the front, a little from the right and above.
const CAMERA_SIDE: DVec3 = DVec3::new(0.55, 0.45, 1.0);
/// From the middle of the scene towards the sun: from behind the left shoulder, 38 degrees above the horizon.
const SUN_SIDE: DVec3 = DVec3::new(-0.75, 0.75, 0.6);
/// A hazy sun, half angle in radians (2 degrees): soft enough that the relation binds at common sizes.
const SUN_HALF_ANGLE: f64 = 0.035;
/// Kernel radius as a share of the scene's diagonal: about 20 px at 1280 x 720.
const PCF_RADIUS_SHARE: f64 = 0.006;
/// Cells of the footprint, per side, in which a floor is looked for.
const CELLS: usize = 48;
/// Share of the cells that a floor covers: a room reaches into all corners of its box, a vehicle or a ship does not.
const FLOOR_SHARE: f64 = 0.9;
/// The box of the scene fills this share of the picture's width or height; the rest is for its shadow.
const PICTURE_SHARE: f64 = 0.8;

const VERTICAL_FOV: f64 = 0.7;
const ASPECT: f64 = 16.0 / 9.0;

/// Makes a scene of loaded meshes.
pub fn compose(path: &Path, mut meshes: Vec<Mesh>) -> Scene {
    let bounds = bounds_of(&meshes).unwrap_or(Aabb { min: DVec3::ZERO, max: DVec3::ZERO });
    let middle = bounds.center();
    // A scene of one point would have a camera in that point.
    let radius = (bounds.size().length() / 2.0).max(1e-3);

    if !has_floor(&meshes, &bounds) {
        let center = DVec3::new(middle.x, bounds.min.y, middle.z);
        meshes.push(ground("ground", center, 6.0 * radius, Vec3::splat(0.45)));
    }
    let side = CAMERA_SIDE.normalize();
    let distance = viewing_distance(&bounds, side).max(radius);
    Scene {
        name: path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned()),
        meshes,
        camera: Camera {
            eye: middle + side * distance,
            target: middle,
            up: DVec3::Y,
            vertical_fov: VERTICAL_FOV,
            aspect: ASPECT,
            near: 0.05 * radius,
            far: distance + 5.0 * radius,
        },
        light: Light::Directional { direction: -SUN_SIDE.normalize(), half_angle: SUN_HALF_ANGLE },
        pcf_radius_world: PCF_RADIUS_SHARE * 2.0 * radius,
    }
}

/// The distance from which all corners of the box are inside the middle `PICTURE_SHARE` of the picture.
///
/// With a corner at `c` from the middle, seen along `-side` from the distance d: its depth is `d - c . side`, its place
/// `|c . up|`, which must be at most `PICTURE_SHARE tan(fov / 2)` of the depth, and the same across.
fn viewing_distance(bounds: &Aabb, side: DVec3) -> f64 {
    let right = DVec3::Y.cross(side).normalize();
    let up = side.cross(right);
    let half_height = PICTURE_SHARE * (VERTICAL_FOV / 2.0).tan();
    let needed = |corner: DVec3| {
        let c = corner - bounds.center();
        c.dot(side) + (c.dot(up).abs() / half_height).max(c.dot(right).abs() / (half_height * ASPECT))
    };
    bounds.corners().into_iter().map(needed).fold(0.0, f64::max)
}

/// Whether horizontal faces in the lower half of the scene, seen from above, cover nearly all of its footprint.
fn has_floor(meshes: &[Mesh], bounds: &Aabb) -> bool {
    let mut covered = vec![false; CELLS * CELLS];
    for mesh in meshes {
        for triangle in &mesh.triangles {
            let corners = triangle.map(|i| mesh.positions[i as usize].as_dvec3());
            if is_floor(corners, bounds.center().y) {
                cover(&mut covered, corners, bounds);
            }
        }
    }
    let count = covered.iter().filter(|&&cell| cell).count();
    count as f64 >= FLOOR_SHARE * covered.len() as f64
}

/// Within 25 degrees of horizontal, and not above `height`.
fn is_floor([a, b, c]: [DVec3; 3], height: f64) -> bool {
    let normal = (b - a).cross(c - a);
    normal.y.abs() > 0.9 * normal.length() && a.y.max(b.y).max(c.y) <= height
}

/// Sets the cells whose middle lies in the triangle, seen from above.
fn cover(covered: &mut [bool], corners: [DVec3; 3], bounds: &Aabb) {
    let cell_size = bounds.size().xz() / CELLS as f64;
    let [a, b, c] = corners.map(|p| (p.xz() - bounds.min.xz()) / cell_size - 0.5);
    // Rounded inwards, then kept inside of the grid.
    let range =
        |low: f64, high: f64| low.ceil().max(0.0) as usize..=high.floor().clamp(-1.0, CELLS as f64 - 1.0) as usize;
    let (min, max) = (a.min(b).min(c), a.max(b).max(c));
    if max.x < 0.0 || max.y < 0.0 {
        return;
    }
    for z in range(min.y, max.y) {
        for x in range(min.x, max.x) {
            let p = DVec2::new(x as f64, z as f64);
            let sides = [(b - a).perp_dot(p - a), (c - b).perp_dot(p - b), (a - c).perp_dot(p - c)];
            if sides.iter().all(|&s| s >= 0.0) || sides.iter().all(|&s| s <= 0.0) {
                covered[z * CELLS + x] = true;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::cuboid;

    fn table() -> Vec<Mesh> {
        vec![
            cuboid("top", DVec3::new(0.0, 0.7, 0.0), DVec3::new(2.0, 0.75, 1.0), Vec3::ONE),
            cuboid("leg", DVec3::ZERO, DVec3::new(0.1, 0.7, 0.1), Vec3::ONE),
        ]
    }

    #[test]
    fn a_table_gets_a_ground_and_a_room_does_not() {
        assert_eq!(compose(Path::new("table.obj"), table()).meshes.len(), 3);
        let mut room = table();
        room.push(cuboid("floor", DVec3::new(-1.0, -0.1, -1.0), DVec3::new(3.0, 0.0, 2.0), Vec3::ONE));
        assert_eq!(compose(Path::new("room.glb"), room).meshes.len(), 3);
    }

    #[test]
    fn the_whole_model_is_in_view_at_every_scale() {
        for scale in [1e-3, 1.0, 1e4] {
            let meshes: Vec<Mesh> =
                table().into_iter().map(|m| m.transformed(&glam::DAffine3::from_scale(DVec3::splat(scale)))).collect();
            let bounds = bounds_of(&meshes).unwrap();
            let scene = compose(Path::new("table.obj"), meshes);
            for corner in bounds.corners() {
                let ndc = scene.camera.clip_from_world().project_point3(corner);
                assert!(ndc.x.abs() <= 1.0 && ndc.y.abs() <= 1.0 && (0.0..=1.0).contains(&ndc.z));
            }
        }
    }

    #[test]
    fn a_scene_is_named_after_its_file() {
        assert_eq!(compose(Path::new("a/b/ship.v2.gltf"), table()).name, "ship.v2");
    }
}
