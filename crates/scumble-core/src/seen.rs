//! Where a picture showed receivers, and what of it can still be on screen some frames later.
//!
//! A fit to the scene's box in the view is as wide as the box where only a little of it shows, as through an arch (sample
//! distribution shadow maps: Lauritzen, Salvi and Lefohn 2011). [`Seen`] is what a pass over a depth prepass found: for each
//! [band](Seen::band_depths) of view depth the box of its receivers across the light. It comes back frames late, so it is
//! kept as *cells*, bodies in the world that do not depend on any fit or slice:
//! ```text
//! cell = box of the band, grown, along the light  ∩  band in the view of then  ∩  view of today  ∩  scene
//! ```
//! A receiver that was seen and has not moved is in the cell of its band whatever the camera and the light have done since.
//! The box is grown by how far the corners of the picture have moved since, at the depth of the band, so that surfaces which
//! go on beyond the edge of the picture of then are held too, and by two of the gaps between the pixels that were looked at.
//! What appears from behind an occluder no camera can tell; the [net](crate::seen_cascades) is for that.

mod lately;
#[cfg(test)]
mod tests;

pub use lately::SeenLately;

use glam::{DVec2, DVec3};

use crate::aabb::Aabb;
use crate::camera::Camera;
use crate::cascade::{Cascade, OVERLAP, depths_of};
use crate::error::Error;
use crate::fit::{Fit, Frame, fit, fit_bodies};
use crate::light::Light;
use crate::polyhedron::{HalfSpace, Polyhedron};
use crate::split::Splits;

/// Gaps between pixels that a box is grown by: a surface tilted by 60 degrees has a length of two between them.
const GAPS: f64 = 2.0;

/// Share of the picture's height that its corners may have moved, at the depth of a band. Beyond, more is new than was seen:
/// a cut, a flick of the head, or nobody measures any more.
const MOVED_MAX: f64 = 0.5;

/// Share by which the depths between which a view is cut may change from one frame to the next: receivers that change their
/// map with an end of a slice then do so few at a time. What is far comes and goes behind what is near at once; a walker at
/// 1.5 m/s changes depths of 2.5 m and more by less.
const DRIFT: f64 = 0.01;

/// The least exponent of two of a band's depth: 1/16 m, nearer than eyes and hands are.
const FIRST_EXPONENT: i32 = -4;

/// What was seen in a band of view depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenBand {
    /// Number of the band, below [`Seen::BANDS`].
    pub band: u32,
    /// Smallest light-space x and y of a receiver, in metres.
    pub min: DVec2,
    /// Largest.
    pub max: DVec2,
}

/// What one picture showed of the receivers of a directional light.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// The camera of the picture.
    pub camera: Camera,
    /// The light, whose light space the boxes are in.
    pub light: Light,
    /// Distance of neighbouring pixels that were looked at, as a share of their view depth.
    pub gap: f64,
    /// Bands with a receiver, in any order.
    pub bands: Vec<SeenBand>,
}

impl Seen {
    /// Number of bands: two an octave, from 1/16 m to 4 km.
    pub const BANDS: u32 = 32;

    /// View depths between which a band lies, in metres; the first begins at 0, the last has no end. The bands stay where
    /// they are whatever camera and scene: their number is that of the upper ten bits of a depth as f32.
    #[must_use]
    pub fn band_depths(band: u32) -> (f64, f64) {
        let begin =
            |band: u32| (1.0 + 0.5 * f64::from(band % 2)) * f64::from(FIRST_EXPONENT + (band / 2) as i32).exp2();
        let near = if band == 0 { 0.0 } else { begin(band) };
        let far = if band + 1 >= Self::BANDS { f64::INFINITY } else { begin(band + 1) };
        (near, far)
    }

    /// The cells that `camera` sees, in a scene given by its box about `origin`; `None` where the view has moved too far
    /// since the picture.
    ///
    /// # Errors
    /// Names a value of camera or light of then that is out of range.
    pub(crate) fn cells(
        &self,
        camera: &Camera,
        scene: &Polyhedron,
        origin: DVec3,
    ) -> Result<Option<Vec<Polyhedron>>, Error> {
        let (then, frame) = (self.camera.checked()?, Frame::new(self.light.checked()?, None, origin));
        let (eye, forward) = (then.eye - origin, then.forward());
        let farthest = scene.vertices().map(|p| forward.dot(p - eye)).fold(0.0, f64::max);
        let view = scene.clip_all(&camera.half_spaces(origin));
        let mut cells = Vec::with_capacity(self.bands.len());
        for seen in &self.bands {
            let (near, far) = Self::band_depths(seen.band);
            let (near, far) = (near * (1.0 - OVERLAP), (far * (1.0 + OVERLAP)).min(farthest));
            let moved = corners_moved(&then, camera, near).into_iter().chain(corners_moved(&then, camera, far));
            let (mut farthest_moved, mut across) = (0.0_f64, DVec2::ZERO);
            for step in moved {
                farthest_moved = farthest_moved.max(step.length());
                across = across.max(frame.light_from_world.transform_vector3(step).truncate().abs());
            }
            if farthest_moved > MOVED_MAX * far * then.height_at_unit_distance() {
                return Ok(None);
            }
            let grown = across + DVec2::splat(GAPS * self.gap * far);
            let mut sides = frame.column(seen.min - grown, seen.max + grown).to_vec();
            sides.push(HalfSpace::through(eye + near * forward, forward));
            sides.push(HalfSpace::through(eye + far * forward, -forward));
            let cell = view.clip_all(&sides);
            if !cell.is_empty() {
                cells.push(cell);
            }
        }
        Ok(Some(cells))
    }
}

/// How far the four corners of the picture at a view depth have moved from one camera to another. The view's distance at
/// any depth between two, and of any point of the picture, is at most that of the corner that moved the most.
fn corners_moved(then: &Camera, now: &Camera, depth: f64) -> [DVec3; 4] {
    let corners = |camera: &Camera| camera.corner_rays().map(|ray| camera.eye + depth * ray);
    let (from, to) = (corners(then), corners(now));
    std::array::from_fn(|corner| to[corner] - from[corner])
}

/// The slices of a light around what was seen, and what catches all else.
#[derive(Clone, Debug, PartialEq)]
pub struct SeenCascades {
    /// One fewer than [`cascades`](crate::cascades) makes, from the nearest on, the last without an end. Without a fit where
    /// nothing was seen.
    pub slices: Vec<Cascade>,
    /// The fit of the whole view: for receivers that no camera can tell before they appear, and for those that move.
    pub net: Fit,
    /// View depths between which the view was cut, for the next frame.
    pub depths: [f64; 2],
}

/// The slices of a light, each fitted to what a picture showed of its receivers: the view is cut between the nearest and the
/// farthest of them, or on the way there from `last`, the depths of the last frame. A receiver that was seen, has not moved and
/// is on screen is in the map of its slice; every other one on screen is in the net.
///
/// `None` where [`cascades`](crate::cascades) serves better: a light that is not split, a view of nothing, a picture that
/// showed no receiver, and a view that has moved by half of the picture's height since.
///
/// # Errors
/// As [`cascades`](crate::cascades), also for the camera and the light of the picture.
pub fn seen_cascades(
    camera: &Camera,
    scene: &Aabb,
    light: &Light,
    splits: &Splits,
    seen: &Seen,
    last: Option<[f64; 2]>,
) -> Result<Option<SeenCascades>, Error> {
    let (camera, scene, light, splits) = (camera.checked()?, scene.checked()?, light.checked()?, splits.checked()?);
    let is_sun = |light: &Light| matches!(light, Light::Directional { .. });
    if !is_sun(&light) || !is_sun(&seen.light) || splits.count < 2 {
        return Ok(None);
    }
    let Some(net) = fit(&camera, &scene, &light, true)? else { return Ok(None) };
    let origin = scene.center();
    let local = Polyhedron::from_corners(scene.corners().map(|p| p - origin));
    let Some(cells) = seen.cells(&camera, &local, origin)? else { return Ok(None) };
    let Some((near, far)) = depths_of(&cells, &camera, origin) else { return Ok(None) };
    let near = drifted(last.map(|depths| depths[0]), near);
    let far = drifted(last.map(|depths| depths[1]), far).max(near);

    let count = splits.count - 1;
    let ends = Splits { count, ..splits }.ends(near, far);
    let mut begin = 0.0;
    let mut slices = Vec::with_capacity(ends.len());
    for (index, &end) in ends.iter().enumerate() {
        let is_last = index + 1 == ends.len();
        let depth_end = if is_last { f64::INFINITY } else { end };
        let sides = depths_between(&camera, origin, begin * (1.0 - OVERLAP), depth_end * (1.0 + OVERLAP));
        let bodies: Vec<Polyhedron> = cells.iter().map(|cell| cell.clip_all(&sides)).collect();
        slices.push(Cascade { depth_end, fit: fit_bodies(&scene, light, &bodies) });
        begin = end;
    }
    Ok(Some(SeenCascades { slices, net, depths: [near, far] }))
}

/// A depth on its way from that of the last frame.
fn drifted(last: Option<f64>, depth: f64) -> f64 {
    last.map_or(depth, |last| depth.clamp(last * (1.0 - DRIFT), last * (1.0 + DRIFT)))
}

/// All points between two view depths, of which the farther may be infinite.
fn depths_between(camera: &Camera, origin: DVec3, near: f64, far: f64) -> Vec<HalfSpace> {
    let (eye, forward) = (camera.eye - origin, camera.forward());
    let behind = HalfSpace::through(eye + near * forward, forward);
    let before = far.is_finite().then(|| HalfSpace::through(eye + far * forward, -forward));
    std::iter::once(behind).chain(before).collect()
}
