//! The observer: a perspective camera, its matrices and its view volume V.
//!
//! Clip space is wgpu's: x right and y up in -1..1, depth 0 at the near plane and 1 at the far plane.

use glam::dcamera::rh::{proj::directx, view};
use glam::{DMat4, DVec3};
use serde::{Deserialize, Serialize};

use crate::error::{Error, check, direction, finite};
use crate::polyhedron::HalfSpace;

/// A perspective camera in world space.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Camera {
    /// Position, in metres.
    pub eye: DVec3,
    /// A point in the middle of the picture, in metres.
    pub target: DVec3,
    /// What is up in the picture; need not be perpendicular to the direction of view.
    pub up: DVec3,
    /// Angle between the upper and the lower side of the picture, in radians.
    pub vertical_fov: f64,
    /// Width of the picture by its height.
    pub aspect: f64,
    /// Distance of the near plane, in metres.
    pub near: f64,
    /// Distance of the far plane, in metres; may be infinite.
    pub far: f64,
}

impl Camera {
    /// Refuses what has no picture: eye on target, up along the view, an angle outside of 0..pi, near <= 0, far <=
    /// near.
    ///
    /// # Errors
    /// Names the value and what is allowed.
    pub fn checked(&self) -> Result<Self, Error> {
        let eye = finite("the camera's eye", self.eye)?;
        let target = finite("the camera's target", self.target)?;
        let forward = direction("the camera's direction, target - eye,", target - eye)?;
        let up = direction("the camera's up", self.up)?;
        if forward.cross(up).length() < 1e-9 {
            return Err(Error::Vector {
                name: "the camera's up",
                value: self.up,
                allowed: "a direction across the view",
            });
        }
        let fov = self.vertical_fov;
        check(
            "the camera's vertical_fov",
            fov,
            fov > 0.0 && fov < std::f64::consts::PI,
            "an angle in radians between 0 and pi",
        )?;
        crate::error::positive("the camera's aspect", self.aspect)?;
        crate::error::positive("the camera's near", self.near)?;
        check("the camera's far", self.far, self.far > self.near, "a distance above near, or infinite")?;
        Ok(*self)
    }

    /// World to view space: x right, y up, looking along -z.
    #[must_use]
    pub fn view_from_world(&self) -> DMat4 {
        view::look_at_mat4(self.eye, self.target, self.up)
    }

    /// View to clip space.
    #[must_use]
    pub fn clip_from_view(&self) -> DMat4 {
        if self.far.is_finite() {
            directx::perspective(self.vertical_fov, self.aspect, self.near, self.far)
        } else {
            directx::perspective_infinite(self.vertical_fov, self.aspect, self.near)
        }
    }

    /// World to clip space.
    #[must_use]
    pub fn clip_from_world(&self) -> DMat4 {
        self.clip_from_view() * self.view_from_world()
    }

    /// Unit direction of view.
    #[must_use]
    pub fn forward(&self) -> DVec3 {
        (self.target - self.eye).normalize()
    }

    /// Height of the picture at distance 1: 2 tan(fov / 2). Times distance / height in pixels, it is a pixel's
    /// footprint.
    #[must_use]
    pub fn height_at_unit_distance(&self) -> f64 {
        2.0 * (0.5 * self.vertical_fov).tan()
    }

    /// Unit directions of view, to the right and up in the picture.
    fn axes(&self) -> [DVec3; 3] {
        let forward = self.forward();
        let right = forward.cross(self.up).normalize();
        [forward, right, right.cross(forward)]
    }

    /// Directions of the corners of the picture, one unit deep.
    pub(crate) fn corner_rays(&self) -> [DVec3; 4] {
        let [forward, right, up] = self.axes();
        let half_height = 0.5 * self.height_at_unit_distance();
        let side = half_height * self.aspect * right;
        let top = half_height * up;
        [forward - side - top, forward + side - top, forward - side + top, forward + side + top]
    }

    /// The view volume V as an intersection of half spaces, about `origin`: near, left, right, bottom, top, and far
    /// unless it is infinite.
    pub(crate) fn half_spaces(&self, origin: DVec3) -> Vec<HalfSpace> {
        let [forward, right, up] = self.axes();
        let eye = self.eye - origin;
        let half_height = 0.5 * self.height_at_unit_distance();
        let half_width = half_height * self.aspect;
        let mut sides = vec![
            HalfSpace::through(eye + self.near * forward, forward),
            HalfSpace::through(eye, right + half_width * forward),
            HalfSpace::through(eye, -right + half_width * forward),
            HalfSpace::through(eye, up + half_height * forward),
            HalfSpace::through(eye, -up + half_height * forward),
        ];
        if self.far.is_finite() {
            sides.push(HalfSpace::through(eye + self.far * forward, -forward));
        }
        sides
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        Camera {
            eye: DVec3::new(1.0, 2.0, 3.0),
            target: DVec3::new(4.0, 1.0, -2.0),
            up: DVec3::Y,
            vertical_fov: 1.0,
            aspect: 1.5,
            near: 0.1,
            far: 50.0,
        }
    }

    #[test]
    fn a_point_lies_in_the_half_spaces_exactly_when_it_lies_in_clip_space() {
        let camera = camera();
        let sides = camera.half_spaces(DVec3::ZERO);
        let mut inside = 0;
        for i in 0..4000_u32 {
            let t = f64::from(i);
            let p = DVec3::new(
                60.0 * (t * 0.618_034).fract() - 10.0,
                40.0 * (t * 0.754_878).fract() - 20.0,
                70.0 * (t * 0.569_840).fract() - 60.0,
            );
            let clip = camera.clip_from_world() * p.extend(1.0);
            let in_clip = clip.x.abs() <= clip.w && clip.y.abs() <= clip.w && clip.z >= 0.0 && clip.z <= clip.w;
            assert_eq!(in_clip, sides.iter().all(|side| side.distance(p) >= 0.0), "{p}");
            inside += usize::from(in_clip);
        }
        assert!(inside > 100, "{inside}");
    }

    #[test]
    fn what_has_no_picture_is_refused_by_name() {
        let wrong = [
            (Camera { target: camera().eye, ..camera() }, "direction"),
            (Camera { up: camera().forward(), ..camera() }, "up"),
            (Camera { vertical_fov: 4.0, ..camera() }, "vertical_fov"),
            (Camera { near: -0.1, ..camera() }, "near"),
            (Camera { far: 0.05, ..camera() }, "far"),
            (Camera { far: f64::NAN, ..camera() }, "far"),
        ];
        for (camera, name) in wrong {
            assert!(camera.checked().unwrap_err().to_string().contains(name), "{name}");
        }
        assert!(Camera { far: f64::INFINITY, ..camera() }.checked().is_ok());
    }
}
