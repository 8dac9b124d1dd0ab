//! The paths of every scene: derived from its camera and its light, so that a file of the user moves as the catalogue
//! does. By their construction none leads through what stands in the view's middle: a camera turns in place, creeps by
//! less than a thousandth of the scene, or goes a part of the way to what it looks at.

use crate::{Path, Pose, Scene};
use glam::{DQuat, DVec3};
use scumble_core::{Camera, Light};

/// Share of the way to the target that `approach` goes: the object that a picture shows is nearer than its middle.
const APPROACH_SHARE: f64 = 0.35;
/// Angle by which `pan` turns to each side, as a share of the vertical field of view.
const PAN_SHARE: f64 = 0.25;
/// Length of `creep` as a share of the scene's diagonal: two texels of a map of 2048 over all of the scene.
const CREEP_SHARE: f64 = 2.0 / 2048.0;
/// A sun's azimuth to each side, radians (20 degrees): 80 minutes to each side of noon, at 15 degrees an hour.
const SUN_AZIMUTH: f64 = 0.349;
/// A lamp's swing to each side, radians (7 degrees): the light stays on what it is aimed at.
const LAMP_SWING: f64 = 0.122;
/// Length of a lamp's cord, as a share of the scene's diagonal: 1 m in a room of 10 m.
const LAMP_CORD_SHARE: f64 = 0.1;
/// From side to side by the middle, and back to the middle: one period of a swing.
const SWING: [f64; 5] = [0.0, 1.0, 0.0, -1.0, 0.0];

impl Scene {
    /// `approach`: towards the target by about a third of the way. `pan`: turns to both sides in place.
    /// `creep`: sideways by two texels of a map of 2048 x 2048 over the scene's diagonal; between 64 samples the
    /// camera moves by 1/32 of such a texel.
    pub fn camera_paths(&self) -> Vec<Path> {
        let Camera { eye, target, up, vertical_fov, .. } = self.camera;
        let view = target - eye;
        let side = view.cross(up).normalize_or(DVec3::X);
        let keyed = |position: DVec3, direction: DVec3| Pose { position, direction };
        let creep = CREEP_SHARE * self.bounds().size().length();
        vec![
            Path {
                name: "approach",
                keys: [0.0, 0.5, 1.0].map(|s| keyed(eye + s * APPROACH_SHARE * view, view)).to_vec(),
            },
            Path {
                name: "pan",
                keys: SWING
                    .map(|s| {
                        keyed(
                            eye,
                            DQuat::from_axis_angle(up.normalize_or(DVec3::Y), s * PAN_SHARE * vertical_fov) * view,
                        )
                    })
                    .to_vec(),
            },
            Path { name: "creep", keys: [0.0, 1.0].map(|s| keyed(eye + s * creep * side, view)).to_vec() },
        ]
    }

    /// `sweep`: a sun goes about the vertical at its height, a lamp swings as a pendulum on a cord behind it.
    pub fn light_paths(&self) -> Vec<Path> {
        let keys = match self.light {
            Light::Directional { direction, .. } => SWING
                .map(|s| Pose { position: DVec3::ZERO, direction: DQuat::from_rotation_y(s * SUN_AZIMUTH) * direction })
                .to_vec(),
            Light::Spot { position, direction, .. } => {
                let axis = direction.normalize_or(DVec3::NEG_Y);
                let cord = LAMP_CORD_SHARE * self.bounds().size().length();
                let pivot = position - cord * axis;
                let about = axis.any_orthonormal_vector();
                SWING
                    .map(|s| {
                        let turned = DQuat::from_axis_angle(about, s * LAMP_SWING) * axis;
                        Pose { position: pivot + cord * turned, direction: turned }
                    })
                    .to_vec()
            }
            // A bulb swings too, though only its place changes.
            Light::Point { position, .. } => {
                let cord = LAMP_CORD_SHARE * self.bounds().size().length();
                let pivot = position + cord * DVec3::Y;
                SWING
                    .map(|s| {
                        let direction = DQuat::from_rotation_x(s * LAMP_SWING) * DVec3::NEG_Y;
                        Pose { position: pivot + cord * direction, direction }
                    })
                    .to_vec()
            }
        };
        vec![Path { name: "sweep", keys }]
    }

    /// The path of camera or light that is called `name`; `None` where there is none.
    pub fn path(&self, name: &str) -> Option<Path> {
        self.camera_paths().into_iter().chain(self.light_paths()).find(|path| path.name == name)
    }

    /// Camera and light where `path` is at `t` in 0..=1: `sweep` moves the light, the others the camera. Only pose
    /// changes: field of view, planes and the light's size stay.
    #[must_use]
    pub fn moved(&self, path: &Path, t: f64) -> (Camera, Light) {
        let (mut camera, mut light) = (self.camera, self.light);
        let Some(pose) = path.at(t) else { return (camera, light) };
        if path.name != "sweep" {
            // The distance of the target has no meaning to a picture; kept, so that the first key is the scene's camera.
            let distance = (camera.target - camera.eye).length();
            camera.eye = pose.position;
            camera.target = pose.position + distance * pose.direction;
            return (camera, light);
        }
        match &mut light {
            Light::Directional { direction, .. } => *direction = pose.direction,
            Light::Spot { position, direction, .. } => {
                (*position, *direction) = (pose.position, pose.direction);
            }
            Light::Point { position, .. } => *position = pose.position,
        }
        (camera, light)
    }
}
