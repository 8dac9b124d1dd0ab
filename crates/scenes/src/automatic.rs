//! A camera, a sun and, where sensible, a ground for meshes of which nothing is known but their shape.

use crate::shapes::ground;
use crate::{Mesh, Scene, bounds_of};
use glam::{DVec3, Vec3};
use scumble_core::{Aabb, Camera, Light};
use std::path::Path;

/// From the middle of the scene towards the camera: from the front, a little from the right and above.
const CAMERA_SIDE: DVec3 = DVec3::new(0.55, 0.45, 1.0);
/// From the middle of the scene towards the sun: from behind the left shoulder, 38 degrees above the horizon.
const SUN_SIDE: DVec3 = DVec3::new(-0.75, 0.75, 0.6);
/// A hazy sun, angular radius in radians (2 degrees): soft enough that the relation binds at common sizes.
const SUN_HALF_ANGLE: f64 = 0.035;
/// Kernel radius as a share of the scene's diagonal: about 20 px at 1280 x 720.
const PCF_RADIUS_SHARE: f64 = 0.006;
/// Horizontal faces in the lower half that cover this share of the footprint are a floor.
const FLOOR_SHARE: f64 = 0.75;

const VERTICAL_FOV: f64 = 0.7;
const ASPECT: f64 = 16.0 / 9.0;

/// Makes a scene of loaded meshes.
pub fn compose(path: &Path, mut meshes: Vec<Mesh>) -> Scene {
    let bounds = bounds_of(&meshes).unwrap_or(Aabb {
        min: DVec3::ZERO,
        max: DVec3::ZERO,
    });
    let middle = (bounds.min + bounds.max) / 2.0;
    // A scene of one point would have a camera in that point.
    let radius = ((bounds.max - bounds.min).length() / 2.0).max(1e-3);

    if !has_floor(&meshes, &bounds) {
        let center = DVec3::new(middle.x, bounds.min.y, middle.z);
        meshes.push(ground("ground", center, 6.0 * radius, Vec3::splat(0.45)));
    }
    let distance = radius / (VERTICAL_FOV / 2.0).sin();
    Scene {
        name: path
            .file_stem()
            .map_or_else(String::new, |stem| stem.to_string_lossy().into_owned()),
        meshes,
        camera: Camera {
            eye: middle + CAMERA_SIDE.normalize() * distance,
            target: middle,
            up: DVec3::Y,
            vertical_fov: VERTICAL_FOV,
            aspect: ASPECT,
            near: 0.05 * radius,
            far: distance + 5.0 * radius,
        },
        light: Light::Directional {
            direction: -SUN_SIDE.normalize(),
            half_angle: SUN_HALF_ANGLE,
        },
        pcf_radius_world: PCF_RADIUS_SHARE * 2.0 * radius,
    }
}

/// Whether horizontal faces in the lower half of the scene cover most of its footprint.
///
/// Both sides of a doubled floor count, so this answers yes a little too often; a tabletop is in the upper half.
fn has_floor(meshes: &[Mesh], bounds: &Aabb) -> bool {
    let size = bounds.max - bounds.min;
    let middle_height = (bounds.min.y + bounds.max.y) / 2.0;
    let mut floor_area = 0.0;
    for mesh in meshes {
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|i| mesh.positions[i as usize].as_dvec3());
            let area = (b - a).cross(c - a) / 2.0;
            // Within 25 degrees of horizontal.
            if area.y.abs() > 0.9 * area.length() && a.y.max(b.y).max(c.y) <= middle_height {
                floor_area += area.y.abs();
            }
        }
    }
    size.y > 0.0 && floor_area > FLOOR_SHARE * size.x * size.z
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::cuboid;

    fn table() -> Vec<Mesh> {
        vec![
            cuboid(
                "top",
                DVec3::new(0.0, 0.7, 0.0),
                DVec3::new(2.0, 0.75, 1.0),
                Vec3::ONE,
            ),
            cuboid("leg", DVec3::ZERO, DVec3::new(0.1, 0.7, 0.1), Vec3::ONE),
        ]
    }

    #[test]
    fn a_table_gets_a_ground_and_a_room_does_not() {
        assert_eq!(compose(Path::new("table.obj"), table()).meshes.len(), 3);
        let mut room = table();
        room.push(cuboid(
            "floor",
            DVec3::new(-1.0, -0.1, -1.0),
            DVec3::new(3.0, 0.0, 2.0),
            Vec3::ONE,
        ));
        assert_eq!(compose(Path::new("room.glb"), room).meshes.len(), 3);
    }

    #[test]
    fn the_whole_model_is_in_view_at_every_scale() {
        for scale in [1e-3, 1.0, 1e4] {
            let meshes: Vec<Mesh> = table()
                .into_iter()
                .map(|m| m.transformed(&glam::DAffine3::from_scale(DVec3::splat(scale))))
                .collect();
            let bounds = bounds_of(&meshes).unwrap();
            let scene = compose(Path::new("table.obj"), meshes);
            for i in 0..8 {
                let pick = |axis: usize| {
                    if i >> axis & 1 == 1 {
                        bounds.max[axis]
                    } else {
                        bounds.min[axis]
                    }
                };
                let corner = DVec3::new(pick(0), pick(1), pick(2));
                let ndc = scene.camera.clip_from_world().project_point3(corner);
                assert!(ndc.x.abs() <= 1.0 && ndc.y.abs() <= 1.0 && (0.0..=1.0).contains(&ndc.z));
            }
        }
    }

    #[test]
    fn a_scene_is_named_after_its_file() {
        assert_eq!(
            compose(Path::new("a/b/ship.v2.gltf"), table()).name,
            "ship.v2"
        );
    }
}
