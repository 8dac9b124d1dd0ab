//! The maps of one light: one, a fit for each slice of the observer's view, or one for each face of a point light.
//!
//! One texel for the whole view of a landscape is either too coarse beside the observer or wasted on the distance
//! (z-partitioning in the course of Eisemann and others). A slice has a light-space box, a lattice and a texel of its own.
//! Which slice a point belongs to is decided by its view depth and not by which box holds it: a box grows and shrinks with
//! its texel and the filter's border, a slice does not, so what a map is asked for does not depend on what it was given.
//!
//! Only directional light is split. A lamp's own perspective already gives more texels to what is near it.

use glam::DVec3;

use crate::aabb::Aabb;
use crate::camera::Camera;
use crate::error::Error;
use crate::face::Face;
use crate::fit::{Fit, fit, fit_face};
use crate::light::Light;
use crate::polyhedron::Polyhedron;
use crate::split::Splits;

/// Share of its depth by which the box of a slice reaches beyond both of its ends: a point that f32 puts on the wrong side
/// of an end still has a place in the map. f32 errs by 6e-8 of a coordinate, so this is good for scenes 1,000 times as far
/// from the shaders' origin as the end is from the eye.
pub(crate) const OVERLAP: f64 = 1e-4;

/// One slice of a light's view, or one face of a point light.
#[derive(Clone, Debug, PartialEq)]
pub struct Cascade {
    /// View depth up to which points belong to it, in metres; infinite for the last, and for faces.
    pub depth_end: f64,
    /// Its map; `None` where nothing on screen is in it.
    pub fit: Option<Fit>,
}

/// The slices of a light from the nearest on, each with its fit. Only a fitted directional light is split: a spot has one
/// slice, and so has a map that covers the scene. Empty where nothing that the camera sees can be in shadow. A point light
/// has its six faces in their place, in the order of [`Face::ALL`].
///
/// # Errors
/// As [`fit`] and [`Splits::checked`].
pub fn cascades(
    camera: &Camera,
    scene: &Aabb,
    light: &Light,
    fitted: bool,
    splits: &Splits,
) -> Result<Vec<Cascade>, Error> {
    let (camera, scene, splits) = (camera.checked()?, scene.checked()?, splits.checked()?);
    if let Light::Point { .. } = light {
        let of_face =
            |face| Ok(Cascade { depth_end: f64::INFINITY, fit: fit_face(&camera, &scene, light, face, fitted)? });
        return Face::ALL.into_iter().map(of_face).collect();
    }
    let count = slices_of(light, fitted, &splits);
    if count == 1 {
        let whole = fit(&camera, &scene, light, fitted)?;
        return Ok(whole.into_iter().map(|fit| Cascade { depth_end: f64::INFINITY, fit: Some(fit) }).collect());
    }
    light.checked()?;
    let Some((near, far)) = depths_on_screen(&camera, &scene) else { return Ok(Vec::new()) };
    let ends = splits.ends(near, far);
    let mut begin = near;
    let mut slices = Vec::with_capacity(ends.len());
    for (index, &end) in ends.iter().enumerate() {
        let slice = Camera { near: begin * (1.0 - OVERLAP), far: end * (1.0 + OVERLAP), ..camera };
        let is_last = index + 1 == ends.len();
        let depth_end = if is_last { f64::INFINITY } else { end };
        slices.push(Cascade { depth_end, fit: fit(&slice, &scene, light, fitted)? });
        begin = end;
    }
    Ok(slices)
}

/// How many slices or faces [`cascades`] makes of this light at most.
#[must_use]
pub fn slices_of(light: &Light, fitted: bool, splits: &Splits) -> u32 {
    match light {
        Light::Directional { .. } if fitted => splits.count,
        Light::Directional { .. } | Light::Spot { .. } => 1,
        Light::Point { .. } => Face::ALL.len() as u32,
    }
}

/// Smallest and largest view depth of the scene's box on screen: the potential receivers of directional light.
fn depths_on_screen(camera: &Camera, scene: &Aabb) -> Option<(f64, f64)> {
    if scene.is_empty() {
        return None;
    }
    // About the scene's middle, as in `fit`.
    let origin = scene.center();
    let receivers = Polyhedron::from_corners(scene.corners().map(|p| p - origin)).clip_all(&camera.half_spaces(origin));
    depths_of(&[receivers], camera, origin)
}

/// Smallest and largest view depth of bodies about `origin` that the camera sees; `None` of empty ones.
pub(crate) fn depths_of(bodies: &[Polyhedron], camera: &Camera, origin: DVec3) -> Option<(f64, f64)> {
    let forward = camera.forward();
    let depths = bodies.iter().flat_map(Polyhedron::vertices).map(|p| forward.dot(p - (camera.eye - origin)));
    let (near, far) = depths.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), d| (lo.min(d), hi.max(d)));
    (near <= far).then(|| (near.max(camera.near), far))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::tests_support::{lamp, observer, room, sun};
    use glam::DVec3;
    use proptest::prelude::*;

    fn street() -> Aabb {
        Aabb { min: DVec3::new(-30.0, 0.0, -200.0), max: DVec3::new(30.0, 20.0, 10.0) }
    }

    fn walker() -> Camera {
        Camera {
            eye: DVec3::new(0.0, 1.7, 0.0),
            target: DVec3::new(0.0, 1.4, -10.0),
            up: DVec3::Y,
            vertical_fov: 0.9,
            aspect: 1.6,
            near: 0.1,
            far: f64::INFINITY,
        }
    }

    fn four() -> Splits {
        Splits { count: 4, ..Splits::default() }
    }

    #[test]
    fn one_slice_is_the_fit_of_the_whole_view() {
        for light in [sun(), lamp()] {
            let slices = cascades(&observer(), &room(), &light, true, &Splits::default()).unwrap();
            assert_eq!(slices.len(), 1);
            assert_eq!(slices[0].fit, fit(&observer(), &room(), &light, true).unwrap());
            assert!(slices[0].depth_end.is_infinite());
        }
    }

    #[test]
    fn lamps_and_maps_of_the_whole_scene_are_not_split() {
        assert_eq!(cascades(&observer(), &room(), &lamp(), true, &four()).unwrap().len(), 1);
        assert_eq!(cascades(&observer(), &room(), &sun(), false, &four()).unwrap().len(), 1);
        assert_eq!(cascades(&observer(), &room(), &sun(), true, &four()).unwrap().len(), 4);
    }

    #[test]
    fn slices_end_with_the_scene_where_the_far_plane_is_infinite() {
        let slices = cascades(&walker(), &street(), &sun(), true, &four()).unwrap();
        // The last slice begins before the street ends, 200 m away, and the boxes grow with the distance.
        assert!(slices[2].depth_end > 20.0 && slices[2].depth_end < 201.0, "{}", slices[2].depth_end);
        let extents: Vec<f64> = slices.iter().map(|it| it.fit.as_ref().unwrap().extent_world.max_element()).collect();
        assert!(extents.windows(2).all(|pair| pair[0] < pair[1]), "{extents:?}");
    }

    #[test]
    fn slices_begin_where_the_scene_does() {
        let distant = Aabb { min: DVec3::new(-5.0, 0.0, -120.0), max: DVec3::new(5.0, 5.0, -80.0) };
        let slices = cascades(&walker(), &distant, &sun(), true, &four()).unwrap();
        assert!(slices.iter().all(|slice| slice.fit.is_some()));
        assert!(slices[0].depth_end > 80.0, "{}", slices[0].depth_end);
    }

    #[test]
    fn where_nothing_is_seen_there_are_no_slices() {
        let away = Camera { target: DVec3::new(2.0, 1.2, 9.0), ..observer() };
        assert_eq!(cascades(&away, &room(), &sun(), true, &four()).unwrap(), []);
        assert_eq!(cascades(&observer(), &Aabb::EMPTY, &sun(), true, &four()).unwrap(), []);
    }

    #[test]
    fn degenerate_scenes_have_usable_slices_whatever_their_number() {
        let flat = |size: DVec3| Aabb { min: -0.5 * size, max: 0.5 * size };
        let scenes =
            [flat(DVec3::ZERO), flat(DVec3::splat(1e-9)), flat(DVec3::new(2.0, 0.0, 2.0)), flat(DVec3::splat(1e6))];
        let along = Light::Directional { direction: observer().forward(), half_angle: 0.0 };
        for scene in scenes {
            for light in [sun(), along] {
                for count in 1..=4 {
                    let splits = Splits { count, ..Splits::default() };
                    let slices = cascades(&observer(), &scene, &light, true, &splits).unwrap();
                    assert!(!slices.is_empty(), "{scene:?}");
                    for fit in slices.iter().filter_map(|slice| slice.fit.as_ref()) {
                        assert!(fit.extent_world.min_element() > 0.0 && fit.clip_from_world().is_finite());
                    }
                }
            }
        }
    }

    #[test]
    fn what_is_out_of_range_is_refused_by_name() {
        let nan = Light::Directional { direction: DVec3::NAN, half_angle: 0.1 };
        assert!(cascades(&observer(), &room(), &nan, true, &four()).unwrap_err().to_string().contains("direction"));
        let many = Splits { count: 9, ..four() };
        assert!(cascades(&observer(), &room(), &sun(), true, &many).unwrap_err().to_string().contains("cascades"));
    }

    proptest! {
        #[test]
        fn every_receiver_on_screen_is_covered_by_the_slice_of_its_depth(
            eye in prop::array::uniform3(-8.0..8.0_f64),
            target in prop::array::uniform3(-3.0..3.0_f64),
            direction in prop::array::uniform3(-1.0..1.0_f64),
            count in 1..=4_u32,
            logarithmic_share in 0.0..=1.0_f64,
            points in prop::collection::vec(prop::array::uniform3(0.0..=1.0_f64), 100),
        ) {
            let camera = Camera { eye: DVec3::from(eye), target: DVec3::from(target), ..observer() };
            let direction = DVec3::from(direction);
            prop_assume!(camera.checked().is_ok() && direction.length() > 0.1);
            let light = Light::Directional { direction, half_angle: 0.02 };
            let splits = Splits { count, logarithmic_share };
            let slices = cascades(&camera, &room(), &light, true, &splits).unwrap();
            for share in points {
                let p = room().min + room().size() * DVec3::from(share);
                let clip = camera.clip_from_world() * p.extend(1.0);
                if clip.truncate().abs().max_element() > clip.w || clip.z < 0.0 {
                    continue;
                }
                let depth = (p - camera.eye).dot(camera.forward());
                // Where rounding may put the point into the slice beside its own, both hold it.
                for depth in [depth * (1.0 - 0.5 * OVERLAP), depth, depth * (1.0 + 0.5 * OVERLAP)] {
                    let slice = slices.iter().find(|slice| depth <= slice.depth_end).unwrap();
                    let fit = slice.fit.as_ref().expect("a slice with a point in it has a map");
                    let (uv, light_depth) = fit.uv_from_world(p);
                    prop_assert!(uv.min_element() > -1e-9 && uv.max_element() < 1.0 + 1e-9, "{uv}");
                    prop_assert!(light_depth >= fit.depth_near && light_depth <= fit.depth_far);
                }
            }
        }
    }
}
