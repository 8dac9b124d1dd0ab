//! Depth bias: every tap compares with the receiver's tangent plane at the tap, less what a texel's size explains.
//!
//! Light space with depth d; the receiver at (x, y, d) with geometric normal m, and s = (x, y) / d for a spot, 0 for a
//! directional light. Along the tangent plane depth changes by `t = -m_xy / (m . (s, 1))` for each metre sideways at
//! the receiver's depth. Over an offset o at the reference plane (depth `ref`), the plane lies at
//! - directional: `d + t . o`,
//! - spot: `d / (1 - t . o / ref)`; its reciprocal, and so the depth of clip space, is linear in o.
//!
//! A spot's kernel is a disc of that plane. A sphere shows every receiver a disc across the ray s: its points
//! v, seen through a blocker, fall on v_xy - s v_z of the plane, so the disc of radius 1 is an ellipse, 1 wide across s and
//! sqrt(1 + |s|^2) along s: `o + k (k . o)` with `k = s / sqrt(1 + sqrt(1 + |s|^2))`. On the border of two faces both have
//! the same angle to their axes, and so the same kernel. For the same reason a blocker under a sphere counts by its distance
//! along the ray, `d (1 + o . s / (ref (1 + |s|^2)))` as a depth, and not along the axis.
//!
//! A map stores depth at texel centres: a nearest lookup errs by up to half a texel in x and y, a bilinear comparison
//! by up to one. So the bias is `texel (constant + slope (|t_x| + |t_y|))` with `slope` = 1, authored in texels because
//! the size changes while the program runs. The truth has no texel and keeps only the rounding part. Limit: t is
//! clamped to a maximum angle, beyond which a surface shadows itself; at 85 degrees it reflects 9 % of the light.

use glam::{DVec2, DVec3};

use crate::error::{Error, check, not_negative};
use crate::fit::Fit;
use crate::light::Light;

/// Part of the map's depth range that rounding may take: 32-bit depth resolves 6e-8 of clip space, which at the far end
/// of a spot's range (far at most 100 near) is 6e-6 of it.
const ROUNDING: f64 = 1e-5;

/// Depth bias in texels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bias {
    /// Part that does not depend on the slope, in texels.
    pub constant_texels: f64,
    /// Factor of the slope, in texels: 1 makes bilinear comparison exact on a plane, 0.5 a nearest lookup.
    pub slope_texels: f64,
    /// Largest angle between normal and light that the tangent plane follows, in radians.
    pub slope_angle_max: f64,
}

impl Default for Bias {
    fn default() -> Self {
        Self { constant_texels: 0.1, slope_texels: 1.0, slope_angle_max: 85.0_f64.to_radians() }
    }
}

impl Bias {
    /// For a depth source without texels.
    #[must_use]
    pub fn without_texels() -> Self {
        Self { constant_texels: 0.0, slope_texels: 0.0, ..Self::default() }
    }

    /// Refuses negative and unbounded bias.
    ///
    /// # Errors
    /// Names the value and what is allowed.
    pub fn checked(&self) -> Result<Self, Error> {
        not_negative("bias.constant_texels", self.constant_texels)?;
        not_negative("bias.slope_texels", self.slope_texels)?;
        let angle = self.slope_angle_max;
        let holds = (0.0..std::f64::consts::FRAC_PI_2).contains(&angle);
        check("bias.slope_angle_max", angle, holds, "an angle in radians from 0 to below pi / 2")?;
        Ok(*self)
    }
}

/// A receiver's tangent plane in light space, ready to compare taps with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReceiverPlane {
    /// Depth of the receiver, in metres, without bias.
    pub depth: f64,
    /// t: change of depth for each metre sideways at the receiver's depth, clamped.
    pub slope: DVec2,
    /// How far the plane is moved towards the light, in metres.
    pub bias_world: f64,
    /// Depth of the reference plane for a spot; `None` for parallel light.
    pub perspective_reference: Option<f64>,
    /// Depth of the map's far plane; the tangent plane is not followed beyond it.
    pub depth_far: f64,
    /// s of a sphere; zero of other lights, whose kernel is a disc of the reference plane.
    pub sphere_ray: DVec2,
}

impl ReceiverPlane {
    /// The tangent plane of a surface at `position_world` with the geometric normal `normal_world` (unit length, either
    /// side), under a map whose texels measure `texel_world` at the reference plane.
    #[must_use]
    pub fn new(fit: &Fit, position_world: DVec3, normal_world: DVec3, bias: &Bias, texel_world: DVec2) -> Self {
        let p = fit.light_from_world.transform_point3(position_world);
        let n = fit.light_from_world.transform_vector3(normal_world);
        let depth = -p.z;
        let perspective_reference = match fit.light {
            Light::Directional { .. } => None,
            Light::Spot { .. } | Light::Point { .. } => Some(fit.reference_depth()),
        };
        let ray = if perspective_reference.is_some() { p.truncate() / depth } else { DVec2::ZERO };
        let sphere_ray = if fit.face.is_some() { ray } else { DVec2::ZERO };
        let along = ray.dot(n.truncate()) - n.z;
        let slope = slope_of(n.truncate(), along, bias.slope_angle_max.tan());
        let texel = texel_world.max_element() / fit.reference_from_depth(depth);
        let of_texel = texel * (bias.constant_texels + bias.slope_texels * (slope.x.abs() + slope.y.abs()));
        let bias_world = of_texel + ROUNDING * (fit.depth_far - fit.depth_near);
        Self { depth, slope, bias_world, perspective_reference, depth_far: fit.depth_far, sphere_ray }
    }

    /// An offset of the kernel, under a sphere in the disc across the ray, as it lies on the reference plane.
    #[must_use]
    pub fn on_plane(&self, offset_world: DVec2) -> DVec2 {
        let k = self.sphere_ray / (1.0 + (1.0 + self.sphere_ray.length_squared()).sqrt()).sqrt();
        offset_world + k * k.dot(offset_world)
    }

    /// What a blocker counts for that was found at a depth under `offset_world` of the reference plane: under a sphere its
    /// distance along the receiver's ray, as the depth at which that ray has it.
    #[must_use]
    pub fn depth_along_ray(&self, depth: f64, offset_world: DVec2) -> f64 {
        let Some(reference) = self.perspective_reference else { return depth };
        depth * (1.0 + self.sphere_ray.dot(offset_world) / (reference * (1.0 + self.sphere_ray.length_squared())))
    }

    /// The depth to compare with at `offset_world` on the reference plane, in metres.
    #[must_use]
    pub fn depth_at(&self, offset_world: DVec2) -> f64 {
        let rise = self.slope.dot(offset_world);
        let plane = match self.perspective_reference {
            None => self.depth + rise,
            Some(reference) => {
                let share = 1.0 - rise / reference;
                if share * self.depth_far > self.depth { self.depth / share } else { self.depth_far }
            }
        };
        plane.min(self.depth_far) - self.bias_world
    }
}

/// -n_xy / along, no longer than `largest`, also where the surface is seen edge-on (`along` = 0).
fn slope_of(n_xy: DVec2, along: f64, largest: f64) -> DVec2 {
    let length = n_xy.length();
    if length <= largest * along.abs() {
        if along == 0.0 { DVec2::ZERO } else { -n_xy / along }
    } else {
        let sign = if along < 0.0 { 1.0 } else { -1.0 };
        n_xy * (sign * largest / length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::tests_support::{bulb, lamp_over_room, observer, room, sun_over_room};
    use crate::{Face, fit_face};

    /// A tilted plane through `p`; the depth where the light's ray at an offset meets it, computed in world space.
    fn truth(fit: &Fit, p: DVec3, n: DVec3, offset: DVec2) -> f64 {
        let q = fit.plane_from_world(p) + offset;
        let (a, b) = (fit.world_from_plane(q, fit.depth_near), fit.world_from_plane(q, fit.depth_far));
        let share = n.dot(p - a) / n.dot(b - a);
        fit.depth(a + share * (b - a))
    }

    #[test]
    fn the_tangent_plane_is_exact_for_both_kinds_of_light() {
        for fit in [sun_over_room(), lamp_over_room()] {
            let p = DVec3::new(0.4, 0.3, -0.7);
            for n in [DVec3::Y, DVec3::new(0.5, 1.0, -0.3).normalize(), -DVec3::new(-0.8, 1.0, 0.9).normalize()] {
                let plane = ReceiverPlane::new(&fit, p, n, &Bias::without_texels(), DVec2::ZERO);
                for offset in [DVec2::ZERO, DVec2::new(0.02, 0.0), DVec2::new(-0.01, 0.03)] {
                    let expected = truth(&fit, p, n, offset) - plane.bias_world;
                    assert!((plane.depth_at(offset) - expected).abs() < 1e-9, "{n} {offset}");
                }
            }
        }
    }

    #[test]
    fn the_bias_covers_one_texel_of_the_plane_in_x_and_y() {
        let fit = sun_over_room();
        let texel = DVec2::splat(0.05);
        let n = DVec3::new(0.5, 1.0, -0.3).normalize();
        let plane = ReceiverPlane::new(&fit, DVec3::ZERO, n, &Bias::default(), texel);
        for corner in [DVec2::new(1.0, 1.0), DVec2::new(-1.0, 1.0), DVec2::new(1.0, -1.0), DVec2::new(-1.0, -1.0)] {
            let stored = truth(&fit, DVec3::ZERO, n, corner * texel);
            assert!(plane.depth_at(DVec2::ZERO) < stored);
        }
    }

    #[test]
    fn the_kernel_of_a_bulb_is_a_cone_around_the_ray_and_that_of_others_a_disc_of_the_plane() {
        let fit = fit_face(&observer(), &room(), &bulb(), Face::NegativeY, true).unwrap().unwrap();
        let (radius, near) = (1e-4 * fit.depth_near, fit.depth_near);
        for ray in [DVec3::NEG_Y, DVec3::new(0.7, -1.0, 0.2), DVec3::new(-1.0, -1.0, 1.0)] {
            let p = fit.light.position().unwrap() + ray;
            let plane = ReceiverPlane::new(&fit, p, DVec3::Y, &Bias::default(), DVec2::ZERO);
            for turn in 0..16 {
                let offset = plane.on_plane(radius * DVec2::from_angle(f64::from(turn)));
                let tap = fit.world_from_plane(fit.plane_from_world(p) + offset, 1.0) - fit.light.position().unwrap();
                // A length across the ray at the plane's distance along it: the same angle all around.
                let angle = tap.angle_between(ray);
                let expected = radius / (near * ray.length());
                assert!((angle / expected - 1.0).abs() < 1e-3, "{ray} {turn}: {angle} {expected}");
            }
        }
        for fit in [sun_over_room(), lamp_over_room()] {
            let plane = ReceiverPlane::new(&fit, DVec3::splat(0.1), DVec3::Y, &Bias::default(), DVec2::ZERO);
            assert_eq!(plane.on_plane(DVec2::new(0.3, -0.7)), DVec2::new(0.3, -0.7));
        }
    }

    #[test]
    fn an_edge_on_surface_has_a_finite_slope() {
        let fit = sun_over_room();
        let across = fit.light.direction().any_orthonormal_vector();
        let plane = ReceiverPlane::new(&fit, DVec3::ZERO, across, &Bias::default(), DVec2::ONE);
        assert!((plane.slope.length() - 85.0_f64.to_radians().tan()).abs() < 1e-6);
        assert!(plane.depth_at(DVec2::ONE).is_finite());
    }

    #[test]
    fn bias_out_of_range_is_refused_by_name() {
        assert!(
            Bias { slope_angle_max: 1.6, ..Bias::default() }
                .checked()
                .unwrap_err()
                .to_string()
                .contains("slope_angle_max")
        );
        assert!(Bias { constant_texels: -1.0, ..Bias::default() }.checked().is_err());
        assert!(Bias::default().checked().is_ok());
    }
}
