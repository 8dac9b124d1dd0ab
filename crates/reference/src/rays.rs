//! Rays against a scene's triangles: the nearest hit, and whether a segment is free.
//!
//! The hierarchy is obvhs's compressed 8-wide tree in `f32`; the triangles are met in `f64`. A ray can slip through a
//! closed surface in two places, and both are shut:
//! * between box and ray: every box is padded by `PADDING` of the scene's extent, more than `f32` loses on the way;
//! * between two triangles: barycentric coordinates may be `EDGE_TOLERANCE` below zero, so that neighbours overlap.
//!
//! Inside, coordinates are relative to the middle of the scene and its diagonal is `LOCAL_EXTENT`, so that a scene of
//! any size at any place has the same accuracy (as far as its own `f32` positions go). Meshes may be open, doubled, or
//! wound either way: both sides of a triangle count. Where a mask has a hole, its triangle is not met.
//!
//! Triangles by Moeller and Trumbore, *Fast, minimum storage ray/triangle intersection* (1997).

use std::sync::Arc;

use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::cwbvh::CwBvh;
use obvhs::ray::{Ray, RayHit};
use scumble_scenes::{AlphaTexture, Scene};

use crate::hierarchy::hierarchy;
use crate::triangle::{CornerUvs, EDGE_TOLERANCE, Meeting, Skipped, Triangle, triangles_of};

/// Growth of the boxes by this share of the scene's extent. A `f32` origin and slab test are off by a few 6e-8.
const PADDING: f64 = 1e-6;
/// The scene's diagonal in local units. The tree ignores boxes that end within 1e-4 units of a ray's origin, whatever
/// the ray's direction is: 1e-7 of the diagonal, a hundredth of [`Rays::epsilon`].
const LOCAL_EXTENT: f64 = 1000.0;
/// See [`Rays::epsilon`].
const EPSILON: f64 = 1e-5;

/// A scene prepared for rays.
pub struct Rays {
    hierarchy: CwBvh,
    /// In local coordinates, in the hierarchy's order.
    triangles: Vec<Triangle>,
    /// In the same order; empty where nothing is cut out.
    uvs: CornerUvs,
    /// By mesh.
    masks: Vec<Option<Arc<AlphaTexture>>>,
    skipped: Vec<Skipped>,
    middle: DVec3,
    /// Metres.
    diagonal: f64,
    local_per_metre: f64,
}

/// The nearest point of the scene on a ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// From the ray's origin, in metres.
    pub distance: f64,
    /// In world space.
    pub position: DVec3,
    /// Unit normal of the triangle, towards the ray's origin.
    pub geometric_normal: DVec3,
    /// Unit normal interpolated between the corners, on the same side as the geometric normal.
    pub shading_normal: DVec3,
    /// Whether the ray meets the side that the corners' mean normal points to. Windings do not tell: in files from many
    /// programs they differ inside of one mesh.
    pub front: bool,
    /// Index into the scene's meshes.
    pub mesh: usize,
}

impl Rays {
    /// Builds the hierarchy: about 0.1 s for 100,000 triangles, 2.3 s and 0.4 GB of memory for a million, 40 s and 4.1 GB
    /// for ten million (`examples/time_hierarchy.rs`). What is no surface is left out and told by [`Rays::skipped`].
    pub fn new(scene: &Scene) -> Self {
        let (mut triangles, uvs, skipped) = triangles_of(scene);
        let extremes = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let corners = triangles.iter().flat_map(Triangle::corners);
        let (min, max) = corners.fold(extremes, |(min, max), corner| (min.min(corner), max.max(corner)));
        let (middle, diagonal) =
            if triangles.is_empty() { (DVec3::ZERO, 0.0) } else { ((min + max) / 2.0, (max - min).length()) };
        let local_per_metre = if diagonal > 0.0 { LOCAL_EXTENT / diagonal } else { 1.0 };
        triangles.iter_mut().for_each(|triangle| triangle.make_local(middle, local_per_metre));
        let boxes: Vec<Aabb> = triangles.iter().map(|triangle| triangle.padded_box(PADDING * LOCAL_EXTENT)).collect();
        let hierarchy = hierarchy(&boxes);
        drop(boxes);

        // Leaves that lie together in memory are met together.
        let order = || hierarchy.primitive_indices.iter().map(|&index| index as usize);
        let triangles = order().map(|index| triangles[index].clone()).collect();
        let uvs = if uvs.is_empty() { uvs } else { order().map(|index| uvs[index]).collect() };
        let masks = scene.meshes.iter().map(|mesh| Some(mesh.mask.as_ref()?.texture.clone())).collect();
        Self { hierarchy, triangles, uvs, masks, skipped, middle, diagonal, local_per_metre }
    }

    /// What rays pass through, by mesh; empty for what the loaders of scenes return.
    pub fn skipped(&self) -> &[Skipped] {
        &self.skipped
    }

    /// The length below which two surfaces are one, in metres: 1e-5 of the scene's diagonal.
    ///
    /// Shadow rays end this far before the receiver. It covers the `f32` rounding of receivers that come from a GPU
    /// (1e-7 of their coordinates, times the slope of a tap on a receiver seen at a grazing angle).
    pub fn epsilon(&self) -> f64 {
        EPSILON * self.diagonal
    }

    /// Length of the diagonal of the scene's box, in metres.
    pub fn diagonal(&self) -> f64 {
        self.diagonal
    }

    /// The nearest hit on the ray, at any distance above 0. `direction` may have any length above 0.
    pub fn first_hit(&self, origin: DVec3, direction: DVec3) -> Option<Hit> {
        let origin_local = self.local(origin);
        let direction = direction.normalize();
        let (mut nearest, mut found) = (f64::INFINITY, None);
        self.hierarchy.ray_traverse(narrow(origin_local, direction, f64::INFINITY), &mut RayHit::none(), |_, index| {
            match self.meet(index, origin_local, direction) {
                Some(meeting) if meeting.distance < nearest => {
                    nearest = meeting.distance;
                    found = Some((index, meeting));
                    // The tree drops the boxes beyond this distance.
                    moved_out(nearest)
                }
                _ => f32::INFINITY,
            }
        });
        let (index, meeting) = found?;
        let distance = meeting.distance / self.local_per_metre;
        Some(self.triangles[index].hit(&meeting, direction, distance, origin))
    }

    /// All hits on the ray, near ones first. Neighbours that share the point where the ray passes count once.
    pub fn all_hits(&self, origin: DVec3, direction: DVec3) -> Vec<Hit> {
        let origin_local = self.local(origin);
        let direction = direction.normalize();
        let mut hits = Vec::new();
        self.hierarchy.ray_traverse(narrow(origin_local, direction, f64::INFINITY), &mut RayHit::none(), |_, index| {
            if let Some(meeting) = self.meet(index, origin_local, direction) {
                hits.push(self.triangles[index].hit(
                    &meeting,
                    direction,
                    meeting.distance / self.local_per_metre,
                    origin,
                ));
            }
            f32::INFINITY
        });
        hits.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        let seam = EDGE_TOLERANCE * self.diagonal;
        hits.dedup_by(|next, kept| {
            next.distance - kept.distance <= seam && (next.mesh, next.front) == (kept.mesh, kept.front)
        });
        hits
    }

    /// Whether nothing lies on the open segment between two points.
    pub fn free(&self, from: DVec3, to: DVec3) -> bool {
        let origin = self.local(from);
        let segment = self.local(to) - origin;
        let length = segment.length();
        if length == 0.0 {
            return true;
        }
        let direction = segment / length;
        self.hierarchy.ray_traverse_miss(narrow(origin, direction, length), |_, index| {
            match self.meet(index, origin, direction) {
                Some(meeting) if meeting.distance < length => 0.0,
                _ => f32::INFINITY,
            }
        })
    }

    /// Where a ray in local coordinates meets a triangle beyond its origin, unless there is a hole.
    fn meet(&self, index: usize, origin: DVec3, direction: DVec3) -> Option<Meeting> {
        let triangle = &self.triangles[index];
        let meeting = triangle.meet(origin, direction).filter(|meeting| meeting.distance > 0.0)?;
        if let Some(&corners) = self.uvs.get(index)
            && let Some(texture) = &self.masks[triangle.mesh()]
            && !texture.is_there(meeting.between(corners))
        {
            return None;
        }
        Some(meeting)
    }

    fn local(&self, world: DVec3) -> DVec3 {
        (world - self.middle) * self.local_per_metre
    }
}

/// The tree's ray.
fn narrow(origin: DVec3, direction: DVec3, length: f64) -> Ray {
    let [origin, direction] = [origin, direction].map(|v| Vec3A::from(v.as_vec3()));
    Ray::new(origin, direction, 0.0, moved_out(length))
}

/// A distance for the tree: larger by one part in a million, so that no box is dropped that the exact distance enters.
fn moved_out(distance: f64) -> f32 {
    ((distance * (1.0 + PADDING)) as f32).min(f32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{UVec2, Vec2, Vec3};
    use scumble_core::{Camera, Light};
    use scumble_scenes::{AlphaMask, Mesh, Wrap, cuboid, ground};

    fn scene(meshes: Vec<Mesh>) -> Scene {
        Scene {
            name: "test".to_owned(),
            meshes,
            camera: Camera {
                eye: DVec3::new(0.0, 2.0, 5.0),
                target: DVec3::ZERO,
                up: DVec3::Y,
                vertical_fov: 0.8,
                aspect: 1.5,
                near: 0.1,
                far: 100.0,
            },
            light: Light::Directional { direction: DVec3::NEG_Y, half_angle: 0.03 },
            pcf_radius_world: 0.1,
        }
    }

    fn unit_box(scale: f64, at: DVec3) -> Scene {
        scene(vec![cuboid("box", at, at + scale, Vec3::ONE)])
    }

    /// Directions that cover the sphere evenly: a Fibonacci lattice.
    fn directions(count: u32) -> impl Iterator<Item = DVec3> {
        (0..count).map(move |i| {
            let y = 1.0 - 2.0 * (f64::from(i) + 0.5) / f64::from(count);
            let (sin, cos) = (f64::from(i) * 2.399_963_229_728_653).sin_cos();
            let radius = (1.0 - y * y).sqrt();
            DVec3::new(radius * cos, y, radius * sin)
        })
    }

    #[test]
    fn a_hit_has_the_distance_the_point_and_the_normal_of_the_surface() {
        let rays = Rays::new(&scene(vec![ground("ground", DVec3::ZERO, 10.0, Vec3::ONE)]));
        let hit = rays.first_hit(DVec3::new(1.0, 3.0, 0.0), DVec3::new(0.0, -2.0, 2.0)).unwrap();
        assert!((hit.distance - 3.0 * 2f64.sqrt()).abs() < 1e-9);
        assert!(hit.position.abs_diff_eq(DVec3::new(1.0, 0.0, 3.0), 1e-9));
        assert_eq!((hit.geometric_normal, hit.shading_normal, hit.mesh), (DVec3::Y, DVec3::Y, 0));
        // From below, the normal is turned.
        let below = rays.first_hit(DVec3::NEG_Y, DVec3::Y).unwrap();
        assert_eq!(below.geometric_normal, DVec3::NEG_Y);
        assert!(rays.first_hit(DVec3::Y, DVec3::Y).is_none());
    }

    #[test]
    fn no_ray_leaves_a_closed_box_at_any_scale_and_place() {
        for (scale, at) in [(1.0, DVec3::ZERO), (1e-3, DVec3::ONE), (1e4, DVec3::ZERO), (1.0, DVec3::splat(4096.0))] {
            let rays = Rays::new(&unit_box(scale, at));
            let middle = at + 0.5 * scale;
            for direction in directions(20_000) {
                assert!(rays.first_hit(middle, direction).is_some(), "{scale} {at} {direction}");
                assert!(!rays.free(middle, middle + 2.0 * scale * direction));
            }
        }
    }

    #[test]
    fn no_ray_slips_through_the_edges_and_corners_of_a_box() {
        let rays = Rays::new(&unit_box(1.0, DVec3::ZERO));
        let middle = DVec3::splat(0.5);
        for i in 0..=1000 {
            let t = f64::from(i) / 1000.0;
            // Along an edge, along the diagonal of a face where its two triangles meet.
            for target in
                [DVec3::new(1.0, 1.0, t), DVec3::new(0.0, t, 0.0), DVec3::new(t, 1.0, t), DVec3::new(t, 1.0, 1.0 - t)]
            {
                assert!(rays.first_hit(middle, target - middle).is_some(), "{target}");
            }
        }
    }

    #[test]
    fn a_segment_is_free_up_to_the_surface_and_not_beyond() {
        let rays = Rays::new(&unit_box(1.0, DVec3::ZERO));
        let from = DVec3::new(0.3, 5.0, 0.4);
        let to = |height: f64| DVec3::new(0.3, height, 0.4);
        assert!(rays.free(from, to(1.0 + rays.epsilon())));
        assert!(!rays.free(from, to(1.0 - rays.epsilon())));
        assert!(rays.free(from, from));
    }

    #[test]
    fn a_blocker_beside_the_start_of_a_long_segment_is_not_missed() {
        // Two far boxes make the scene long; the tree's own near limit must not reach the small step between the
        // points.
        let far = cuboid("far", DVec3::splat(90.0), DVec3::splat(100.0), Vec3::ONE);
        let rays = Rays::new(&scene(vec![far, ground("sheet", DVec3::ZERO, 1.0, Vec3::ONE)]));
        let above = DVec3::new(0.1, rays.epsilon(), 0.1);
        assert!(!rays.free(above, DVec3::new(0.1, -50.0, 0.1)));
    }

    #[test]
    fn all_hits_on_a_ray_are_told_once_with_their_side() {
        let rays = Rays::new(&scene(vec![
            ground("ground", DVec3::ZERO, 4.0, Vec3::ONE),
            cuboid("box", DVec3::new(-0.5, 1.0, -0.5), DVec3::new(0.5, 2.0, 0.5), Vec3::ONE),
        ]));
        // Through a face's middle, where its two triangles meet, and beside it.
        for x in [0.0, 0.2] {
            let hits = rays.all_hits(DVec3::new(x, 3.0, 0.0), DVec3::NEG_Y);
            let told: Vec<_> = hits.iter().map(|hit| (hit.mesh, hit.front)).collect();
            assert_eq!(told, [(1, true), (1, false), (0, true)]);
            assert!(hits.iter().zip([1.0, 2.0, 3.0]).all(|(hit, distance)| (hit.distance - distance).abs() < 1e-9));
        }
        assert!(rays.all_hits(DVec3::new(3.0, 3.0, 0.0), DVec3::NEG_Y).is_empty());
    }

    #[test]
    fn the_nearest_of_many_surfaces_is_found() {
        let sheets = (0..50).map(|i| ground("sheet", DVec3::new(0.0, f64::from(i), 0.0), 2.0, Vec3::ONE)).collect();
        let rays = Rays::new(&scene(sheets));
        for i in 0..50 {
            let hit = rays.first_hit(DVec3::new(0.1, f64::from(i) - 0.5, 0.2), DVec3::Y).unwrap();
            assert!((hit.position.y - f64::from(i)).abs() < 1e-9 && hit.mesh == i as usize);
        }
    }

    #[test]
    fn a_scene_without_triangles_has_nothing_in_the_way() {
        let rays = Rays::new(&scene(Vec::new()));
        assert!(rays.free(DVec3::ZERO, DVec3::ONE));
        assert!(rays.first_hit(DVec3::ZERO, DVec3::ONE).is_none());
    }

    /// A ground of 4 m whose texture is cut out where its texel is 0; u grows with x, v with z.
    fn cut_out(size: UVec2, alphas: &[u8]) -> Mesh {
        let mut mesh = ground("card", DVec3::ZERO, 4.0, Vec3::ONE);
        let uvs = mesh.positions.iter().map(|p| Vec2::new(p.x + 2.0, p.z + 2.0) / 4.0).collect();
        let texture = AlphaTexture { size, alphas: alphas.into(), wrap: [Wrap::Clamp; 2], cutoff: 0.5 };
        mesh.mask = Some(AlphaMask { uvs, texture: Arc::new(texture) });
        mesh
    }

    #[test]
    fn rays_pass_through_the_holes_of_a_mask_and_meet_what_lies_behind() {
        let behind = ground("behind", DVec3::NEG_Y, 4.0, Vec3::ONE);
        let rays = Rays::new(&scene(vec![cut_out(UVec2::new(2, 1), &[0, 255]), behind]));
        for (x, mesh) in [(-1.5, 1), (-0.01, 1), (0.01, 0), (1.5, 0)] {
            for z in [-1.9, 0.0, 0.3, 1.9] {
                let (above, below) = (DVec3::new(x, 2.0, z), DVec3::new(x, -0.5, z));
                assert_eq!(rays.first_hit(above, DVec3::NEG_Y).map(|hit| hit.mesh), Some(mesh), "{x} {z}");
                assert_eq!(rays.free(above, below), mesh == 1, "{x} {z}");
                assert_eq!(rays.all_hits(above, DVec3::NEG_Y).len(), 2 - mesh);
            }
        }
    }

    #[test]
    fn a_mask_blocks_the_share_of_rays_that_its_surface_covers() {
        // A disc in a texture of 64 x 64: pi / 16 of it, but for the staircase of its texels.
        let alphas: Vec<u8> = (0..64 * 64)
            .map(|i| {
                let at = Vec2::new((i % 64) as f32, (i / 64) as f32) + 0.5 - 32.0;
                if at.length() < 16.0 { 255 } else { 0 }
            })
            .collect();
        let rays = Rays::new(&scene(vec![cut_out(UVec2::splat(64), &alphas)]));
        let at = |i: u32, n: f64| {
            DVec3::new((f64::from(i) / n).fract() * 4.0 - 2.0, 1.0, f64::from(i).div_euclid(n) / n * 4.0 - 2.0)
        };
        let count = (0..200 * 200).filter(|&i| !rays.free(at(i, 200.0), at(i, 200.0) - 2.0 * DVec3::Y)).count();
        let share = count as f64 / 40_000.0;
        assert!((share - std::f64::consts::PI / 16.0).abs() < 0.003, "{share}");
    }
}
