//! Triangles from a polygon of a file: any number of corners, concave or not.
//!
//! The polygon's normal is Newell's: `n = sum_i p_i x p_(i+1)`, the area-weighted mean that exists for concave and
//! slightly bent polygons alike. The corners are projected along the normal's largest axis and cut by ears in that
//! plane. A fan from the first corner, which many loaders use, covers the outside of a concave polygon and casts
//! shadows that are not there.
//!
//! Not done: holes (OBJ has none) and polygons that cross themselves (cut in some way, without a promise).

use glam::{DVec2, DVec3, Vec3};

/// Cuts a polygon into triangles, as indices into `corners`, in the polygon's own winding.
///
/// Triangles of zero area are left out, so a polygon with all corners on one line gives none.
pub fn triangulate(corners: &[Vec3]) -> Vec<[usize; 3]> {
    let triangles = match corners.len() {
        0..=2 => Vec::new(),
        3 => vec![[0, 1, 2]],
        _ => clip_ears(corners),
    };
    triangles.into_iter().filter(|t| has_area(t.map(|i| corners[i]))).collect()
}

/// Whether a triangle has a normal in `f64`. It is the condition for every later use: shading, rays, bias.
pub fn has_area(triangle: [Vec3; 3]) -> bool {
    let [a, b, c] = triangle.map(|p| p.as_dvec3());
    let twice_area = (b - a).cross(c - a).length();
    let longest_squared = (b - a).length_squared().max((c - a).length_squared()).max((c - b).length_squared());
    // 1e-7 is one f32 rounding step: a height below it is not resolved by the positions.
    twice_area > 1e-7 * longest_squared
}

fn clip_ears(corners: &[Vec3]) -> Vec<[usize; 3]> {
    let origin = corners[0].as_dvec3();
    let relative: Vec<DVec3> = corners.iter().map(|p| p.as_dvec3() - origin).collect();
    let normal = newell_normal(&relative);
    let flat: Vec<f64> = relative.iter().flat_map(|&p| project(p, normal).to_array()).collect();

    match earcutr::earcut(&flat, &[], 2) {
        Ok(indices) => {
            indices.chunks_exact(3).map(|t| with_winding_of([t[0], t[1], t[2]], &relative, normal)).collect()
        }
        // Only malformed input arrays are refused, and these are not.
        Err(_) => Vec::new(),
    }
}

fn newell_normal(corners: &[DVec3]) -> DVec3 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| a.cross(*b)).sum()
}

/// Drops the normal's largest axis: a projection that keeps the polygon simple.
fn project(p: DVec3, normal: DVec3) -> DVec2 {
    let size = normal.abs();
    if size.x >= size.y && size.x >= size.z {
        DVec2::new(p.y, p.z)
    } else if size.y >= size.z {
        DVec2::new(p.z, p.x)
    } else {
        DVec2::new(p.x, p.y)
    }
}

/// The ear clipper orders its triangles by its own rule; the polygon's winding says where its front is.
fn with_winding_of([a, b, c]: [usize; 3], corners: &[DVec3], normal: DVec3) -> [usize; 3] {
    let face = (corners[b] - corners[a]).cross(corners[c] - corners[a]);
    if face.dot(normal) < 0.0 { [a, c, b] } else { [a, b, c] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::TAU;

    fn area(corners: &[Vec3], triangles: &[[usize; 3]]) -> f32 {
        triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|i| corners[i]);
                (b - a).cross(c - a).length() / 2.0
            })
            .sum()
    }

    /// A star of 37 and a half rays, 75 corners, tilted out of every axis plane.
    fn star() -> Vec<Vec3> {
        let tilt = glam::Quat::from_euler(glam::EulerRot::XYZ, 0.4, 0.9, -0.3);
        (0..75)
            .map(|i| {
                let angle = i as f32 / 75.0 * TAU;
                let radius = if i % 2 == 0 { 1.0 } else { 0.3 };
                tilt * Vec3::new(radius * angle.cos(), radius * angle.sin(), 0.0)
            })
            .collect()
    }

    #[test]
    fn a_concave_polygon_of_75_corners_keeps_its_area_where_a_fan_does_not() {
        let corners = star();
        let exact = newell_normal(&corners.iter().map(|p| p.as_dvec3()).collect::<Vec<_>>()).length() as f32 / 2.0;
        let triangles = triangulate(&corners);
        assert_eq!(triangles.len(), 73);
        assert!((area(&corners, &triangles) - exact).abs() < 1e-5 * exact);

        let fan: Vec<_> = (1..74).map(|i| [0, i, i + 1]).collect();
        assert!(area(&corners, &fan) > 1.05 * exact);
    }

    #[test]
    fn triangles_keep_the_winding_of_their_polygon() {
        for reversed in [false, true] {
            let mut corners = star();
            if reversed {
                corners.reverse();
            }
            let normal = newell_normal(&corners.iter().map(|p| p.as_dvec3()).collect::<Vec<_>>());
            for t in triangulate(&corners) {
                let [a, b, c] = t.map(|i| corners[i]);
                assert!((b - a).cross(c - a).as_dvec3().dot(normal) > 0.0);
            }
        }
    }

    #[test]
    fn corners_on_one_line_give_no_triangles() {
        let line: Vec<Vec3> = (0..6).map(|i| Vec3::splat(i as f32)).collect();
        assert!(triangulate(&line).is_empty());
        assert!(triangulate(&line[..3]).is_empty());
        assert!(triangulate(&line[..2]).is_empty());
        assert!(triangulate(&[]).is_empty());
    }

    #[test]
    fn a_small_polygon_far_from_the_origin_is_cut_too() {
        let corners: Vec<Vec3> = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 0.5)]
            .iter()
            .map(|&(x, z)| Vec3::new(1e6 + x, 5.0, -1e6 + z))
            .collect();
        assert_eq!(triangulate(&corners).len(), 2);
    }
}
