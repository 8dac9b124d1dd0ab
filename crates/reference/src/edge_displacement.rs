//! How far a shadow's edge is from where it should be, in pixels.
//!
//! Edges are 0.5 iso-contours, made of chords. Of the chords `s` of both pictures, with the lengths `l_s` and the
//! distances `d_s` from their middles to the nearest point of the other picture's edge:
//! ```text
//! mean = sum(l_s d_s) / sum(l_s)      p95 = smallest d that 95 % of the length do not exceed      max = max(d_s)
//! ```
//! This is symmetric: an edge that is missing counts like one that should not be there. A chord that is nearer to the
//! border of the mask than to the other edge is left out, because the other edge may go on beyond; `compared_share`
//! tells how much was kept.
//!
//! The source of the distance is the Hausdorff metric, whose directed parts are pooled here instead of maximised. An
//! edge is as exact as bilinear interpolation between pixels: of pictures without a penumbra, half a pixel.

use rayon::prelude::*;

use crate::contour::Contour;
use crate::weighted::Weighted;
use crate::{Error, check};

/// Distances between the edges of a picture and those of the truth.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct EdgeDisplacement {
    /// Length of the picture's edges inside the mask, in pixels.
    pub found_length_px: f64,
    /// Length of the truth's edges inside the mask, in pixels.
    pub truth_length_px: f64,
    /// Share of both lengths that was compared, 0 to 1; 1 where there is no edge.
    pub compared_share: f64,
    /// Mean distance in pixels, at least 0. This and the next two are 0 where neither picture has an edge, and
    /// infinite (null in JSON) where there are edges of which nothing can be compared.
    pub mean_px: f64,
    /// 95th percentile of the distance over the length of the edges, in pixels.
    pub p95_px: f64,
    /// Largest distance in pixels.
    pub max_px: f64,
}

/// Compares the edges of two pictures with rows of `width` pixels, where four neighbours are in the mask.
///
/// Leave pixels at depth discontinuities out of the mask: there the picture jumps without a shadow's edge.
///
/// # Errors
/// Different numbers of pixels, rows that do not fill the picture, and values inside the mask that are not finite.
pub fn edge_displacement(found: &[f32], truth: &[f32], mask: &[bool], width: usize) -> Result<EdgeDisplacement, Error> {
    check::rows(found, truth, mask, width)?;
    let [found, truth] = [found, truth].map(|picture| Contour::of(picture, mask, width));
    let mut pairs = distances(&found, &truth);
    pairs.extend(distances(&truth, &found));
    let distances = Weighted::new(pairs);
    let length = found.length() + truth.length();
    let or_defined = |distance: Option<f64>| distance.unwrap_or(if length > 0.0 { f64::INFINITY } else { 0.0 });
    Ok(EdgeDisplacement {
        found_length_px: found.length(),
        truth_length_px: truth.length(),
        compared_share: if length > 0.0 { (distances.weight() / length).min(1.0) } else { 1.0 },
        mean_px: or_defined(distances.mean()),
        p95_px: or_defined(distances.quantile(0.95)),
        max_px: or_defined(distances.max()),
    })
}

/// For the chords of `from` that can be compared: the distance to `to`, and the length it stands for.
fn distances(from: &Contour, to: &Contour) -> Vec<(f64, f64)> {
    let pair = |segment: &crate::contour::Segment| {
        to.nearest(segment.middle()).map(|(_, distance)| (distance, segment.length()))
    };
    from.segments().par_iter().filter_map(pair).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, dvec2};

    const WIDTH: usize = 96;

    /// A penumbra of `width_px` around the zeros of a signed distance in pixels, from the middle of the picture.
    fn soft(width_px: f64, distance: impl Fn(DVec2) -> f64) -> Vec<f32> {
        let at = |i: usize| dvec2((i % WIDTH) as f64, (i / WIDTH) as f64) - DVec2::splat(WIDTH as f64 / 2.0 - 0.3);
        (0..WIDTH * WIDTH).map(|i| (0.5 + distance(at(i)) / width_px).clamp(0.0, 1.0) as f32).collect()
    }

    fn compare(found: &[f32], truth: &[f32]) -> EdgeDisplacement {
        edge_displacement(found, truth, &[true; WIDTH * WIDTH], WIDTH).unwrap()
    }

    fn half_plane(angle: f64, shift_px: f64) -> Vec<f32> {
        soft(12.0, |p| p.dot(DVec2::from_angle(angle)) - shift_px)
    }

    fn circle(radius_px: f64) -> Vec<f32> {
        soft(12.0, |p| p.length() - radius_px)
    }

    #[test]
    fn a_shifted_half_plane_is_off_by_its_shift_at_every_angle() {
        for angle in [0.0, 0.3, std::f64::consts::FRAC_PI_4, 2.0] {
            for shift in [0.3, -2.7] {
                let found = compare(&half_plane(angle, shift), &half_plane(angle, 0.0));
                for distance in [found.mean_px, found.p95_px, found.max_px] {
                    assert!((distance - f64::abs(shift)).abs() < 2e-5, "{shift} at {angle}: {found:?}");
                }
                assert!(found.compared_share > 0.9 && found.truth_length_px >= 95.0 - 1e-9, "{found:?}");
            }
        }
    }

    #[test]
    fn equal_pictures_and_pictures_without_edges_are_not_displaced() {
        let picture = circle(30.0);
        let same = compare(&picture, &picture);
        assert!(same.max_px < 1e-12 && same.compared_share > 1.0 - 1e-12, "{same:?}");
        let blank = compare(&[1.0; WIDTH * WIDTH], &[0.75; WIDTH * WIDTH]);
        assert_eq!((blank.mean_px, blank.max_px, blank.compared_share, blank.found_length_px), (0.0, 0.0, 1.0, 0.0));
    }

    #[test]
    fn a_line_turned_about_its_middle_is_off_by_the_sine_of_the_angle() {
        let angle = 0.05;
        let found = compare(&half_plane(angle, 0.0), &half_plane(0.0, 0.0));
        // Of the half line that is compared, from the middle to near the border.
        let farthest = 0.5 * found.compared_share * found.truth_length_px * angle.sin();
        for (distance, share) in [(found.mean_px, 0.5), (found.p95_px, 0.95), (found.max_px, 1.0)] {
            assert!((distance - share * farthest).abs() < 0.03, "{found:?}, expected {share} of {farthest}");
        }
        assert!(found.compared_share > 0.95, "{found:?}");
    }

    #[test]
    fn a_circle_is_off_by_the_difference_of_the_radii() {
        let found = compare(&circle(31.5), &circle(30.0));
        for distance in [found.mean_px, found.p95_px, found.max_px] {
            assert!((distance - 1.5).abs() < 0.02, "{found:?}");
        }
        let circumference = std::f64::consts::TAU * 30.0;
        assert!((found.truth_length_px - circumference).abs() < 0.005 * circumference, "{found:?}");
    }

    #[test]
    fn it_is_symmetric_so_an_edge_that_is_missing_counts() {
        let truth = soft(6.0, |p| (p.length() - 10.0).min(p.x + 25.0));
        let missing = soft(6.0, |p| p.x + 25.0);
        let [one, other] = [compare(&missing, &truth), compare(&truth, &missing)];
        assert!((one.max_px, one.mean_px) == (other.max_px, other.mean_px) && one.max_px > 10.0, "{one:?} {other:?}");
        let all = compare(&[1.0; WIDTH * WIDTH], &circle(30.0));
        assert!(all.mean_px.is_infinite() && all.compared_share == 0.0, "{all:?}");
        assert!(serde_json::to_string(&all).unwrap().contains(r#""mean_px":null"#));
    }

    #[test]
    fn only_what_is_inside_of_the_mask_counts() {
        let mut found = half_plane(0.0, 0.3);
        let mut mask = vec![true; found.len()];
        for pixel in 0..found.len() / 2 {
            (found[pixel], mask[pixel]) = (f32::NAN, false);
        }
        let truth = half_plane(0.0, 0.0);
        let half = edge_displacement(&found, &truth, &mask, WIDTH).unwrap();
        assert!((half.mean_px - 0.3).abs() < 2e-5 && half.found_length_px == 47.0, "{half:?}");
        let none = edge_displacement(&found, &truth, &vec![false; found.len()], WIDTH).unwrap();
        assert_eq!((none.mean_px, none.compared_share), (0.0, 1.0));
    }

    #[test]
    fn pictures_that_cannot_be_compared_are_refused() {
        let nan = edge_displacement(&[0.0, f32::NAN, 0.0, 1.0], &[0.0; 4], &[true; 4], 2).unwrap_err();
        assert!(nan.to_string().starts_with("pixel 1 is NaN"), "{nan}");
        for width in [0, 3] {
            let rows = edge_displacement(&[0.0; 4], &[0.0; 4], &[true; 4], width).unwrap_err();
            assert!(matches!(rows, Error::Width { pixels: 4, .. }), "{rows}");
        }
        assert!(edge_displacement(&[0.0; 4], &[0.0; 6], &[true; 4], 2).is_err());
    }
}
