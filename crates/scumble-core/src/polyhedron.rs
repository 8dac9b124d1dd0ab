//! Convex polyhedra and their exact intersection with half spaces.
//!
//! A polyhedron is its faces, each a loop of vertices. Clipping cuts every loop (Sutherland and Hodgman 1974) and
//! closes the cut with a face of its own, the convex hull of the points on the cutting plane. All vertices of the
//! intersection of two convex bodies are found this way: each is a vertex of one or lies on an edge of one.
//!
//! Flat, thin and one-point bodies keep loops of two points or of one, and clip like any other. Points closer to the
//! plane than 1e-12 of the body's size lie on it, so that touching planes make no slivers.

use glam::DVec3;

/// Points within this fraction of the body's size from a plane lie on it: some 4,000 times the rounding of f64.
const ON_PLANE: f64 = 1e-12;

/// All points p with `normal . p + offset >= 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HalfSpace {
    /// Unit normal of the boundary, pointing inside.
    pub(crate) normal: DVec3,
    offset: f64,
}

impl HalfSpace {
    /// The half space whose boundary contains `point` and into which `inward` points; `inward` of any length but zero.
    pub(crate) fn through(point: DVec3, inward: DVec3) -> Self {
        let normal = inward.normalize();
        Self { normal, offset: -normal.dot(point) }
    }

    /// Signed distance of `point` from the boundary, positive inside.
    pub(crate) fn distance(&self, point: DVec3) -> f64 {
        self.normal.dot(point) + self.offset
    }
}

/// A convex body of finite size.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Polyhedron {
    /// Loops of vertices.
    faces: Vec<Vec<DVec3>>,
}

impl Polyhedron {
    /// The body of six faces with these corners; bit 0 of the index chooses x, bit 1 y, bit 2 z, as of
    /// [`Aabb::corners`](crate::Aabb::corners). Corners may coincide.
    pub(crate) fn from_corners(corners: [DVec3; 8]) -> Self {
        const FACES: [[usize; 4]; 6] =
            [[0, 2, 6, 4], [1, 5, 7, 3], [0, 4, 5, 1], [2, 3, 7, 6], [0, 1, 3, 2], [4, 6, 7, 5]];
        Self { faces: FACES.iter().map(|face| face.iter().map(|&i| corners[i]).collect()).collect() }
    }

    /// Whether it holds no point.
    pub(crate) fn is_empty(&self) -> bool {
        self.faces.is_empty()
    }

    /// All vertices, each once for every face that it belongs to.
    pub(crate) fn vertices(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.faces.iter().flatten().copied()
    }

    /// The part of the body inside `side`, its boundary included.
    pub(crate) fn clip(&self, side: &HalfSpace) -> Self {
        let tolerance = ON_PLANE * self.size();
        let distance = |p: DVec3| {
            let d = side.distance(p);
            if d.abs() <= tolerance { 0.0 } else { d }
        };
        let mut faces = Vec::with_capacity(self.faces.len() + 1);
        let mut cut = Vec::new();
        let mut removed = false;
        for face in &self.faces {
            let kept = clip_face(face, distance, &mut cut);
            removed |= face.iter().any(|&p| distance(p) < 0.0);
            if !kept.is_empty() {
                faces.push(kept);
            }
        }
        let cap = convex_loop(cut, side.normal, tolerance);
        if removed && !cap.is_empty() {
            faces.push(cap);
        }
        Self { faces }
    }

    /// The part of the body inside all of `sides`.
    pub(crate) fn clip_all(&self, sides: &[HalfSpace]) -> Self {
        sides.iter().fold(self.clone(), |body, side| body.clip(side))
    }

    /// Largest distance of a vertex from the origin, the scale of rounding.
    fn size(&self) -> f64 {
        self.vertices().map(|p| p.abs().max_element()).fold(0.0, f64::max)
    }
}

/// The part of a loop where `distance` is not negative; points of it on the plane are added to `cut`.
fn clip_face(face: &[DVec3], distance: impl Fn(DVec3) -> f64, cut: &mut Vec<DVec3>) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(face.len() + 1);
    for (i, &from) in face.iter().enumerate() {
        let to = face[(i + 1) % face.len()];
        let (d_from, d_to) = (distance(from), distance(to));
        if d_from >= 0.0 {
            kept.push(from);
        }
        if d_from == 0.0 {
            cut.push(from);
        }
        if d_from * d_to < 0.0 {
            let crossing = from + (to - from) * (d_from / (d_from - d_to));
            kept.push(crossing);
            cut.push(crossing);
        }
    }
    kept
}

/// The convex hull of points of a plane as a loop (Andrew's monotone chain, 1979); of points closer than `tolerance`
/// one stays.
fn convex_loop(points: Vec<DVec3>, normal: DVec3, tolerance: f64) -> Vec<DVec3> {
    let (x_axis, y_axis) = normal.any_orthonormal_pair();
    let mut plane: Vec<(f64, f64, DVec3)> = points.iter().map(|&p| (p.dot(x_axis), p.dot(y_axis), p)).collect();
    plane.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    plane.dedup_by(|a, b| a.2.distance_squared(b.2) <= tolerance * tolerance);
    if plane.len() < 3 {
        return plane.into_iter().map(|p| p.2).collect();
    }
    let turn = |o: &(f64, f64, DVec3), a: &(f64, f64, DVec3), b: &(f64, f64, DVec3)| {
        (a.0 - o.0) * (b.1 - o.1) - (a.1 - o.1) * (b.0 - o.0)
    };
    let chain = |order: &mut dyn Iterator<Item = &(f64, f64, DVec3)>| {
        let mut hull: Vec<(f64, f64, DVec3)> = Vec::new();
        for p in order {
            while hull.len() >= 2 && turn(&hull[hull.len() - 2], &hull[hull.len() - 1], p) <= 0.0 {
                hull.pop();
            }
            hull.push(*p);
        }
        hull.pop();
        hull
    };
    let lower = chain(&mut plane.iter());
    let upper = chain(&mut plane.iter().rev());
    lower.into_iter().chain(upper).map(|p| p.2).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Aabb;

    fn cube() -> Polyhedron {
        Polyhedron::from_corners(Aabb { min: DVec3::NEG_ONE, max: DVec3::ONE }.corners())
    }

    /// By the divergence theorem over fans of triangles; faces may turn either way, so each is signed by its side of
    /// the centre.
    fn volume(body: &Polyhedron) -> f64 {
        let points: Vec<DVec3> = body.vertices().collect();
        let center = points.iter().sum::<DVec3>() / points.len() as f64;
        let fan = |face: &Vec<DVec3>| -> f64 {
            let area: DVec3 =
                (1..face.len().max(1) - 1).map(|i| (face[i] - face[0]).cross(face[i + 1] - face[0])).sum();
            area.dot(face[0] - center).abs() / 6.0
        };
        body.faces.iter().filter(|face| face.len() > 2).map(fan).sum()
    }

    #[test]
    fn half_a_cube_has_half_its_volume_whatever_the_cut() {
        for normal in [DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::ONE, DVec3::new(0.3, -0.8, 0.1)] {
            let half = cube().clip(&HalfSpace::through(DVec3::ZERO, normal));
            assert!((volume(&half) - 4.0).abs() < 1e-12, "{normal}");
        }
    }

    #[test]
    fn the_cut_through_the_middle_of_a_cube_is_a_hexagon() {
        let half = cube().clip(&HalfSpace::through(DVec3::ZERO, DVec3::ONE));
        assert!(half.faces.iter().any(|face| face.len() == 6));
    }

    #[test]
    fn three_cuts_that_meet_inside_leave_their_common_corner() {
        let corner = DVec3::new(0.2, 0.1, -0.3);
        let cuts = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| HalfSpace::through(corner, axis));
        let rest = cube().clip_all(&cuts);
        assert!(rest.vertices().any(|p| (p - corner).length() < 1e-12));
        assert!((volume(&rest) - 0.8 * 0.9 * 1.3).abs() < 1e-12);
    }

    #[test]
    fn planes_that_touch_change_nothing_and_planes_beyond_leave_nothing() {
        let touching = HalfSpace::through(DVec3::new(-1.0 + 1e-14, 0.0, 0.0), DVec3::X);
        assert_eq!(cube().clip(&touching), cube());
        assert!(cube().clip(&HalfSpace::through(DVec3::new(2.0, 0.0, 0.0), DVec3::X)).is_empty());
        assert!(!cube().is_empty());
    }

    #[test]
    fn flat_and_thin_bodies_clip_like_others() {
        let flat = Polyhedron::from_corners(
            Aabb { min: DVec3::new(-1.0, 0.0, -1.0), max: DVec3::new(1.0, 0.0, 1.0) }.corners(),
        );
        let line = Polyhedron::from_corners(
            Aabb { min: DVec3::new(-1.0, 0.0, 0.0), max: DVec3::new(1.0, 0.0, 0.0) }.corners(),
        );
        let cuts = [
            HalfSpace::through(DVec3::new(0.25, 0.0, 0.0), DVec3::new(1.0, 0.0, 0.0)),
            HalfSpace::through(DVec3::new(0.75, 0.0, 0.0), DVec3::NEG_X),
        ];
        for body in [flat, line] {
            let bounds = Aabb::from_points(body.clip_all(&cuts).vertices());
            assert!((bounds.min.x - 0.25).abs() < 1e-12 && (bounds.max.x - 0.75).abs() < 1e-12);
        }
    }
}
