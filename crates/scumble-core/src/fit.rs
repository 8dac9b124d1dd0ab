//! Fitting: the light's view, limited to what the observer can see.
//!
//! Potential shadow receivers `PSR = L ∩ V ∩ S`: the light's volume, the observer's view volume, the scene's box
//! (Kreuzer 2017, Eq. 3.4). The map is the light-space box of PSR, x and y apart (the matrix F of Eq. 3.5), so a radius
//! takes up
//! `s_x`, `s_y` times as much of it as of the square view plane of the light (5.1.2). Depth reaches from the first
//! potential caster, anything of S between the light and the map's box, to the last receiver.
//!
//! Reference plane: lengths sideways (radius, texel, extent) are measured on it. All planes are alike under directional
//! light; under a spot it is the near plane, which depends on the light and the scene but not on the observer, so that
//! a radius keeps its meaning while the camera moves. The faces of a point light have it in common. Deviation from Eq. 3.6: casters are taken in the whole column of
//! the map, not in the hull of PSR and the light, because taps reach beyond PSR.

mod frame;
mod steps;
#[cfg(test)]
mod tests;
#[cfg(test)]
pub(crate) mod tests_support;

use glam::{DMat4, DVec2, DVec3, DVec4};

use crate::aabb::Aabb;
use crate::camera::Camera;
use crate::error::Error;
use crate::face::Face;
use crate::light::Light;
use crate::polyhedron::Polyhedron;
pub(crate) use frame::Frame;

/// Part of the depth range added at both ends, so that rounding clips no caster.
const DEPTH_MARGIN: f64 = 1e-4;

/// Share of a texel by which a box may stand over a line of the lattice, so that rounding adds no texels.
const LATTICE_SLACK: f64 = 1e-6;

/// Smallest extent, as a share of the scene's size, then of its distance from the world's origin (some 4,000 times the
/// rounding of f64), then in metres. It gives scenes that are flat along the light, and single points, a box.
const SMALLEST_OF_SIZE: f64 = 1e-6;
const SMALLEST_OF_DISTANCE: f64 = 1e-12;
const SMALLEST_WORLD: f64 = 1e-9;

/// Smallest depth range as a share of the scene's size: positions in f32 err by 6e-8 of it, which must stay small
/// against the range.
const DEPTH_RANGE_OF_SIZE: f64 = 1e-2;

/// One light's view.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The light, its direction normalised.
    pub light: Light,
    /// The face of a point light; `None` of other lights.
    pub face: Option<Face>,
    /// World to light space: a rigid motion, the light looks along -z.
    pub light_from_world: DMat4,
    /// Width and height of the map's box at the reference plane, in metres.
    pub extent_world: DVec2,
    /// How much smaller the box is than the light's square view plane, in x and y: `s_x`, `s_y`, 1 or more when fitted.
    pub scale: DVec2,
    /// Light-space depth at the map's near plane, in metres.
    pub depth_near: f64,
    /// Light-space depth at the map's far plane, in metres.
    pub depth_far: f64,
    /// Middle of the box on the reference plane, in light space.
    center: DVec2,
    scene: Aabb,
}

/// Fits `light`'s view to what `camera` sees of `scene`, or with `fitted` off to the scene (directional) or the cone
/// (spot) as a square. `None` where nothing that the camera sees lies in the light's volume: no map is needed.
///
/// # Errors
/// Names a value of camera, scene or light that is out of range; a point light, which has a [`fit_face`] for each face.
pub fn fit(camera: &Camera, scene: &Aabb, light: &Light, fitted: bool) -> Result<Option<Fit>, Error> {
    if let Light::Point { .. } = light {
        return Err(Error::PointLight);
    }
    fit_part(camera, scene, light, None, fitted)
}

/// The same of one face of a point light; other lights have no faces, and are fitted as a whole. With `fitted` off the map
/// is the face.
///
/// # Errors
/// Names a value of camera, scene or light that is out of range.
pub fn fit_face(camera: &Camera, scene: &Aabb, light: &Light, face: Face, fitted: bool) -> Result<Option<Fit>, Error> {
    let face = matches!(light, Light::Point { .. }).then_some(face);
    fit_part(camera, scene, light, face, fitted)
}

fn fit_part(
    camera: &Camera,
    scene: &Aabb,
    light: &Light,
    face: Option<Face>,
    fitted: bool,
) -> Result<Option<Fit>, Error> {
    let (camera, scene, light) = (camera.checked()?, scene.checked()?, light.checked()?);
    if scene.is_empty() {
        return Ok(None);
    }
    // About the scene's middle, so that a scene far from the world's origin keeps its precision.
    let origin = scene.center();
    let local = Polyhedron::from_corners(scene.corners().map(|p| p - origin));
    let frame = Frame::new(light, face, origin);
    let Some((lit, near_lit, far_lit)) = frame.lit_part(&local) else {
        return Ok(None);
    };
    let receivers = lit.clip_all(&camera.half_spaces(origin));
    if receivers.is_empty() {
        return Ok(None);
    }

    let square = frame.square(&local, near_lit);
    let plane = if fitted { frame.bounds(&receivers, near_lit) } else { square };
    let far = if fitted { frame.depth_range(&receivers).1 } else { far_lit };
    Ok(Some(around(&scene, &frame, square, plane, [near_lit, far])))
}

/// The fit of directional light to bodies in place of what a camera sees; `None` where all are empty. `light` and `scene`
/// are checked, the bodies lie in the scene and are about its middle.
pub(crate) fn fit_bodies(scene: &Aabb, light: Light, bodies: &[Polyhedron]) -> Option<Fit> {
    let origin = scene.center();
    let local = Polyhedron::from_corners(scene.corners().map(|p| p - origin));
    let frame = Frame::new(light, None, origin);
    let (_, near_lit, _) = frame.lit_part(&local)?;
    let bodies: Vec<&Polyhedron> = bodies.iter().filter(|body| !body.is_empty()).collect();
    let far = bodies.iter().map(|body| frame.depth_range(body).1).reduce(f64::max)?;
    let boxes = bodies.iter().map(|body| frame.bounds(body, near_lit));
    let plane = boxes.reduce(|(lo, hi), (min, max)| (lo.min(min), hi.max(max)))?;
    Some(around(scene, &frame, frame.square(&local, near_lit), plane, [near_lit, far]))
}

/// The fit to a box on the reference plane, within the light's own square view plane there: depth from the first caster in
/// the column to the last receiver.
fn around(
    scene: &Aabb,
    frame: &Frame,
    square: (DVec2, DVec2),
    (min, max): (DVec2, DVec2),
    [near_lit, far]: [f64; 2],
) -> Fit {
    let smallest = smallest_length(scene);
    let extent_world = (max - min).max(DVec2::splat(smallest));
    let side = (square.1 - square.0).max_element().max(smallest);
    let mut fit = Fit {
        light: frame.light,
        face: frame.face,
        light_from_world: frame.light_from_world,
        extent_world,
        scale: side / extent_world,
        depth_near: near_lit,
        depth_far: far,
        center: min + 0.5 * (max - min),
        scene: *scene,
    };
    if let Light::Directional { .. } = frame.light {
        fit.depth_near = fit.first_caster().min(far);
    }
    fit.widen_depth(smallest.max(DEPTH_RANGE_OF_SIZE * scene.size().length()));
    fit
}

impl Fit {
    /// Depth of the plane on which lengths sideways are measured, in metres.
    #[must_use]
    pub fn reference_depth(&self) -> f64 {
        self.depth_near
    }

    /// Light-space depth of a point, in metres.
    #[must_use]
    pub fn depth(&self, position_world: DVec3) -> f64 {
        -self.light_from_world.transform_point3(position_world).z
    }

    /// Length at the reference plane of one metre sideways at `depth`: 1, or for a lamp `reference depth / depth`.
    #[must_use]
    pub fn reference_from_depth(&self, depth: f64) -> f64 {
        match self.light {
            Light::Directional { .. } => 1.0,
            Light::Spot { .. } | Light::Point { .. } => self.reference_depth() / depth,
        }
    }

    /// Width and height of the map's box at `depth`, in metres.
    #[must_use]
    pub fn extent_at(&self, depth: f64) -> DVec2 {
        self.extent_world / self.reference_from_depth(depth)
    }

    /// Where the light's ray through a point crosses the reference plane, in light space.
    #[must_use]
    pub fn plane_from_world(&self, position_world: DVec3) -> DVec2 {
        let p = self.light_from_world.transform_point3(position_world);
        p.truncate() * self.reference_from_depth(-p.z)
    }

    /// The point at `depth` on the light's ray that crosses the reference plane at `plane`; inverse of
    /// [`Fit::plane_from_world`] with [`Fit::depth`].
    #[must_use]
    pub fn world_from_plane(&self, plane: DVec2, depth: f64) -> DVec3 {
        let sideways = plane / self.reference_from_depth(depth);
        let rotation = glam::DMat3::from_mat4(self.light_from_world);
        rotation.transpose() * (sideways.extend(-depth) - self.light_from_world.w_axis.truncate())
    }

    /// A point's place in the map, in UV with v down, and its depth in metres. Outside of 0..1 it is not in the map.
    #[must_use]
    pub fn uv_from_world(&self, position_world: DVec3) -> (DVec2, f64) {
        let offset = self.plane_from_world(position_world) - self.center;
        (DVec2::splat(0.5) + self.uv_from_offset(offset), self.depth(position_world))
    }

    /// Whether a point has a place in the map: inside its box, not before its near plane. What has none counts as lit.
    #[must_use]
    pub fn covers(&self, position_world: DVec3) -> bool {
        let depth = self.depth(position_world);
        if depth < self.depth_near {
            return false;
        }
        let (uv, _) = self.uv_from_world(position_world);
        uv.cmpge(DVec2::ZERO).all() && uv.cmple(DVec2::ONE).all()
    }

    /// An offset on the reference plane in UV, with v down.
    #[must_use]
    pub fn uv_from_offset(&self, offset_world: DVec2) -> DVec2 {
        offset_world / self.extent_world * DVec2::new(1.0, -1.0)
    }

    /// Depth in clip space, 0 at the near and 1 at the far plane: linear under directional light, else
    /// `far (depth - near) / (depth (far - near))`.
    #[must_use]
    pub fn ndc_from_depth(&self, depth: f64) -> f64 {
        let linear = (depth - self.depth_near) / (self.depth_far - self.depth_near);
        match self.light {
            Light::Directional { .. } => linear,
            Light::Spot { .. } | Light::Point { .. } => linear * self.depth_far / depth,
        }
    }

    /// Light-space depth in metres of a depth in clip space.
    #[must_use]
    pub fn depth_from_ndc(&self, depth_ndc: f64) -> f64 {
        let range = self.depth_far - self.depth_near;
        match self.light {
            Light::Directional { .. } => self.depth_near + depth_ndc * range,
            Light::Spot { .. } | Light::Point { .. } => {
                self.depth_far * self.depth_near / (self.depth_far - depth_ndc * range)
            }
        }
    }

    /// World to the light's clip space: x right and y up in -1..1, depth 0..1.
    #[must_use]
    pub fn clip_from_world(&self) -> DMat4 {
        self.clip_from_light() * self.light_from_world
    }

    /// The same from coordinates relative to `origin_world`. A scene far from the world's origin is uploaded as f32
    /// without loss when the origin is near it.
    #[must_use]
    pub fn clip_from_relative(&self, origin_world: DVec3) -> DMat4 {
        self.clip_from_light() * (self.light_from_world * DMat4::from_translation(origin_world))
    }

    /// The map with `border_world` more on each side at the reference plane, so that taps of that radius around the
    /// outermost receiver fall inside. `N` grows by 2 c texels, whatever the radius.
    #[must_use]
    pub fn with_border(&self, border_world: f64) -> Self {
        self.with_box(self.center, self.extent_world + DVec2::splat(2.0 * border_world))
    }

    /// The map widened to whole texels of the lattice through light space's origin, and how many they are: at most one
    /// more on each side than the box needs, but at least `least`.
    ///
    /// Light space turns with the light alone, so its lattice stands still in the world while the observer moves: a map
    /// that keeps its texel samples the same points, and shadows do not shimmer (course of Eisemann et al., 3.2.1).
    #[must_use]
    pub fn on_lattice(&self, texel_world: DVec2, least: u32) -> (Self, [u32; 2]) {
        let first = ((self.center - 0.5 * self.extent_world) / texel_world + LATTICE_SLACK).floor();
        let last = ((self.center + 0.5 * self.extent_world) / texel_world - LATTICE_SLACK).ceil();
        let count = (last - first).max(DVec2::splat(f64::from(least)));
        let first = first - (0.5 * (count - (last - first))).floor();
        let center = (first + 0.5 * count) * texel_world;
        (self.with_box(center, count * texel_world), [count.x as u32, count.y as u32])
    }

    /// The map with another box on the reference plane, around everything that it held.
    fn with_box(&self, center: DVec2, extent_world: DVec2) -> Self {
        let scale = self.scale * self.extent_world / extent_world;
        let mut other = Self { center, extent_world, scale, ..self.clone() };
        if let Light::Directional { .. } = self.light {
            other.depth_near = other.first_caster().min(self.depth_near);
            other.widen_depth(0.0);
        }
        other
    }

    fn clip_from_light(&self) -> DMat4 {
        let scale = 2.0 / self.extent_world;
        let shift = -self.center * scale;
        let (near, far) = (self.depth_near, self.depth_far);
        match self.light {
            Light::Directional { .. } => DMat4::from_cols(
                DVec4::new(scale.x, 0.0, 0.0, 0.0),
                DVec4::new(0.0, scale.y, 0.0, 0.0),
                DVec4::new(0.0, 0.0, -1.0 / (far - near), 0.0),
                DVec4::new(shift.x, shift.y, -near / (far - near), 1.0),
            ),
            // w = depth = -z; x_clip = (x ref / depth - center) 2 / extent * depth.
            Light::Spot { .. } | Light::Point { .. } => DMat4::from_cols(
                DVec4::new(scale.x * self.reference_depth(), 0.0, 0.0, 0.0),
                DVec4::new(0.0, scale.y * self.reference_depth(), 0.0, 0.0),
                DVec4::new(-shift.x, -shift.y, -far / (far - near), -1.0),
                DVec4::new(0.0, 0.0, -far * near / (far - near), 0.0),
            ),
        }
    }

    /// Smallest depth of the scene's box within the column of the map, under directional light.
    fn first_caster(&self) -> f64 {
        let origin = self.scene.center();
        let frame = Frame::new(self.light, self.face, origin);
        let half = 0.5 * self.extent_world;
        let column = frame.column(self.center - half, self.center + half);
        let casters = Polyhedron::from_corners(self.scene.corners().map(|p| p - origin)).clip_all(&column);
        frame.depth_range(&casters).0
    }

    /// Gives the depth range a margin against rounding, and at least `smallest` of length.
    fn widen_depth(&mut self, smallest: f64) {
        let range = self.depth_far - self.depth_near;
        let margin = (DEPTH_MARGIN * range).max(0.5 * (smallest - range));
        self.depth_far += margin;
        if let Light::Directional { .. } = self.light {
            self.depth_near -= margin;
        }
    }
}

/// The smallest extent that a box of this scene is given.
fn smallest_length(scene: &Aabb) -> f64 {
    let distance = scene.min.abs().max(scene.max.abs()).max_element();
    (SMALLEST_OF_SIZE * scene.size().length()).max(SMALLEST_OF_DISTANCE * distance).max(SMALLEST_WORLD)
}
