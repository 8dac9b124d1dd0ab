//! Paths of camera and light: what moves in a measurement of shimmer, of pops, of a loop that follows the picture.
//!
//! A [`Path`] is a list of key poses, run through by a Catmull-Rom spline at equal times between keys. With four
//! neighbouring keys `p0 p1 p2 p3` and `u` in 0..=1 from `p1` to `p2`:
//!
//! ```text
//! p(u) = 1/2 (2 p1 + (p2 - p0) u + (2 p0 - 5 p1 + 4 p2 - p3) u^2 + (3 p1 - p0 - 3 p2 + p3) u^3)
//! ```
//!
//! (E. Catmull, R. Rom, 1974, with tension 1/2.) It passes through every key with a continuous velocity; the first and
//! the last key are doubled. Equal `t` gives equal bits: a frame of a path can be drawn again alone.

use glam::DVec3;

/// Where something is and where it looks or shines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// The eye of a camera, the middle of a lamp; a sun has none and keeps what it is given.
    pub position: DVec3,
    /// The direction of view or of light; any length but none.
    pub direction: DVec3,
}

/// A named motion through key poses.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    /// `approach`, `pan` or `creep` of a camera, `sweep` of a light.
    pub name: &'static str,
    /// One at least, at equal distances of time.
    pub keys: Vec<Pose>,
}

impl Path {
    /// The pose at `t`, 0 at the first key, 1 at the last; outside the nearer end, NaN the first key. The direction has
    /// length 1. `None` for a path without keys.
    pub fn at(&self, t: f64) -> Option<Pose> {
        let last = self.keys.len().checked_sub(1)?;
        let place = if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) } * last as f64;
        let segment = (place.floor() as usize).min(last.saturating_sub(1));
        let u = place - segment as f64;
        let near = [segment.saturating_sub(1), segment, (segment + 1).min(last), (segment + 2).min(last)];
        Some(Pose {
            position: spline(near.map(|i| self.keys[i].position), u),
            direction: spline(near.map(|i| self.keys[i].direction.normalize_or(DVec3::NEG_Y)), u)
                .normalize_or(DVec3::NEG_Y),
        })
    }
}

fn spline([p0, p1, p2, p3]: [DVec3; 4], u: f64) -> DVec3 {
    let linear = p2 - p0;
    let quadratic = 2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3;
    let cubic = 3.0 * p1 - p0 - 3.0 * p2 + p3;
    p1 + 0.5 * u * (linear + u * (quadratic + u * cubic))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn zigzag() -> Path {
        let key = |x: f64, y: f64| Pose { position: DVec3::new(x, y, 0.0), direction: DVec3::new(y, -1.0, x) };
        Path { name: "zigzag", keys: vec![key(0.0, 0.0), key(1.0, 1.0), key(2.0, -1.0), key(3.0, 0.0)] }
    }

    #[test]
    fn a_path_passes_through_its_keys() {
        let path = zigzag();
        for (i, key) in path.keys.iter().enumerate() {
            let pose = path.at(i as f64 / 3.0).unwrap();
            assert!(pose.position.abs_diff_eq(key.position, 1e-12));
            assert!(pose.direction.abs_diff_eq(key.direction.normalize(), 1e-12));
        }
    }

    #[test]
    fn velocity_is_continuous_at_a_key() {
        let path = zigzag();
        let step = 1e-6;
        let position = |t: f64| path.at(t).unwrap().position;
        let key = 1.0 / 3.0;
        let before = (position(key) - position(key - step)) / step;
        let after = (position(key + step) - position(key)) / step;
        assert!(before.abs_diff_eq(after, 1e-3), "{before} {after}");
    }

    #[test]
    fn outside_and_nan_are_the_ends_and_one_key_stands_still() {
        let path = zigzag();
        assert_eq!(path.at(-1.0), path.at(0.0));
        assert_eq!(path.at(f64::NAN), path.at(0.0));
        assert_eq!(path.at(f64::INFINITY), path.at(1.0));
        let still = Path { name: "still", keys: path.keys[..1].to_vec() };
        assert_eq!(still.at(0.7), still.at(0.0));
        assert_eq!(Path { name: "none", keys: Vec::new() }.at(0.5), None);
    }
}
