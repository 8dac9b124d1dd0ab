//! How far a shadow's edge turns away from where the true edge goes: what an observer sees of texels.
//!
//! A filter of radius r leaves of a stair or step of displacement D an edge that leans by about `atan(D / (2 r))`
//! against the true one; observers stop to see it at 8.2 degrees ([`HIDDEN_TILT_DEG`]). Here the angle is measured:
//! each chord `s` of the picture's 0.5 iso-contour is compared with that chord of the truth's which is nearest to its
//! middle, and counts with its length:
//! ```text
//! tilt_s = angle between the two as lines without direction, 0 to 90 degrees
//! p50, p95 = smallest angle that 50, 95 % of the length do not exceed      visible share = length above 8.2 degrees
//! ```
//! A chord is at most a pixel's diagonal long, so noise tilts it as much as texels do, in the picture and in the truth:
//! the grain of rotated taps, or of few rays to a light. Where the penumbra is narrower than a few pixels, an edge
//! consists of the pixels' own sides and diagonals: leave such pixels out of the mask. Chords near the border of the mask
//! are left out as in [`edge_displacement`](crate::edge_displacement()).

use rayon::prelude::*;

use crate::contour::{Contour, Segment};
use crate::weighted::Weighted;
use crate::{Error, check};

/// Tilt up to which observers take a filtered edge for a straight one, in degrees: `atan(1 / (2 c))` of a step at the
/// ratio c = 3.47 and, within 0.2 degrees, of a stair at 2.5 (both Kreuzer 2017, chapter 4). Two data points support
/// it.
pub const HIDDEN_TILT_DEG: f64 = 8.2;

/// Angles between the edges of a picture and those of the truth.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct EdgeTilt {
    /// Share of the length of the picture's edges that was compared, 0 to 1; 1 where there is no edge.
    pub compared_share: f64,
    /// Median angle in degrees, 0 to 90. All angles are 0 where neither picture has an edge, and 90 where there are
    /// edges of which nothing can be compared.
    pub p50_deg: f64,
    /// 95th percentile of the angle over the length of the edges, in degrees.
    pub p95_deg: f64,
    /// Largest angle in degrees.
    pub max_deg: f64,
    /// Share of the compared length that is tilted by more than [`HIDDEN_TILT_DEG`], 0 to 1; 1 where there are edges of
    /// which nothing can be compared.
    pub visible_share: f64,
}

/// Compares the directions of edges in two pictures with rows of `width` pixels, where four neighbours are in the mask.
///
/// Leave pixels at depth discontinuities out of the mask: there the picture jumps without a shadow's edge.
///
/// # Errors
/// Different numbers of pixels, rows that do not fill the picture, and values inside the mask that are not finite.
pub fn edge_tilt(found: &[f32], truth: &[f32], mask: &[bool], width: usize) -> Result<EdgeTilt, Error> {
    check::rows(found, truth, mask, width)?;
    let [found, truth] = [found, truth].map(|picture| Contour::of(picture, mask, width));
    let pair = |segment: &Segment| {
        let (nearest, _) = truth.nearest(segment.middle())?;
        Some((segment.angle(nearest).to_degrees(), segment.length()))
    };
    let angles = Weighted::new(found.segments().par_iter().filter_map(pair).collect::<Vec<_>>());
    let has_edges = found.length() + truth.length() > 0.0;
    let or_defined = |angle: Option<f64>| angle.unwrap_or(if has_edges { 90.0 } else { 0.0 });
    Ok(EdgeTilt {
        compared_share: if found.length() > 0.0 { (angles.weight() / found.length()).min(1.0) } else { 1.0 },
        p50_deg: or_defined(angles.quantile(0.5)),
        p95_deg: or_defined(angles.quantile(0.95)),
        max_deg: or_defined(angles.max()),
        visible_share: angles.share_above(HIDDEN_TILT_DEG).unwrap_or(if has_edges { 1.0 } else { 0.0 }),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use scumble_stimuli::{IsoContour, Kernel, Silhouette};

    const WIDTH: usize = 161;

    /// Visibility under a filter of `ratio` texels; the middle of the picture lies on the true edge.
    fn filtered(silhouette: Silhouette, ratio: f64, texel_px: f64) -> Vec<f32> {
        let place = |pixel: usize| (pixel as f64 - (WIDTH / 2) as f64) / texel_px;
        let at = |i: usize| silhouette.coverage(Kernel::Disc, ratio, place(i % WIDTH), -place(i / WIDTH));
        (0..WIDTH * WIDTH).map(|i| (1.0 - at(i)) as f32).collect()
    }

    fn compare(found: &[f32], truth: &[f32]) -> EdgeTilt {
        edge_tilt(found, truth, &[true; WIDTH * WIDTH], WIDTH).unwrap()
    }

    #[test]
    fn a_filtered_step_leans_by_its_height_over_the_width_of_the_filter() {
        // The rule is the limit of wide filters.
        for (ratio, off) in [(2.0, 0.07), (3.47, 0.025), (6.0, 0.01)] {
            let line = filtered(Silhouette::Line { slope: 0.0 }, ratio, 10.0);
            let found = compare(&filtered(Silhouette::Step, ratio, 10.0), &line);
            let exact = IsoContour::of(Silhouette::Step, Kernel::Disc, ratio, 0.5).unwrap().tilt().to_degrees();
            let rule = (0.5 / ratio).atan().to_degrees();
            assert!((found.max_deg - exact).abs() < 0.003 * exact, "{exact} at {ratio}: {found:?}");
            assert!((found.max_deg - rule).abs() < off * rule, "{rule} at {ratio}: {found:?}");
        }
    }

    #[test]
    fn a_filtered_stair_leans_as_its_closed_form_says() {
        // At 2.5 the steepest part is shorter than a chord of one pixel.
        for (ratio, off) in [(1.0, 0.002), (1.6, 0.002), (2.5, 0.05)] {
            let line = filtered(Silhouette::Line { slope: 1.0 }, ratio, 40.0);
            let found = compare(&filtered(Silhouette::Stair, ratio, 40.0), &line);
            let exact = IsoContour::of(Silhouette::Stair, Kernel::Disc, ratio, 0.5).unwrap().tilt().to_degrees();
            assert!((found.max_deg - exact).abs() < off * exact, "{exact} at {ratio}: {found:?}");
            assert_eq!(found.visible_share > 0.5, ratio == 1.0, "{found:?}");
        }
    }

    #[test]
    fn the_criterion_is_that_of_a_step_at_the_published_ratio() {
        let ratio = scumble_core::Relation::published().ratio();
        assert!(((0.5 / ratio).atan().to_degrees() - HIDDEN_TILT_DEG).abs() < 0.01);
        // A stair's displacement is 1 / sqrt 2 of a texel, and its published ratio 2.5.
        assert!(((0.5 * 0.5f64.sqrt() / 2.5).atan().to_degrees() - HIDDEN_TILT_DEG).abs() < 0.2);
    }

    #[test]
    fn a_line_that_is_only_shifted_or_softer_does_not_lean() {
        for slope in [0.0, 0.37, 1.0] {
            let line = filtered(Silhouette::Line { slope }, 3.0, 10.0);
            let softer = filtered(Silhouette::Line { slope }, 4.0, 10.0);
            let same = compare(&line, &line);
            assert!(same.max_deg < 1e-9 && same.compared_share > 0.99, "{same:?}");
            assert!(compare(&softer, &line).max_deg < 0.05, "{slope}");
            let shifted: Vec<f32> = line.iter().skip(5 * WIDTH).copied().chain(line[..5 * WIDTH].to_vec()).collect();
            let mask: Vec<bool> = (0..line.len()).map(|i| i < line.len() - 6 * WIDTH).collect();
            let shifted = edge_tilt(&shifted, &line, &mask, WIDTH).unwrap();
            assert!(shifted.max_deg < 0.05 && shifted.visible_share == 0.0, "{slope}: {shifted:?}");
        }
    }

    #[test]
    fn a_line_of_another_angle_leans_by_the_difference() {
        let line = |degrees: f64| filtered(Silhouette::Line { slope: degrees.to_radians().tan() }, 3.0, 10.0);
        let found = compare(&line(30.0), &line(18.0));
        assert!((found.p50_deg - 12.0).abs() < 0.02 && (found.max_deg - 12.0).abs() < 0.1, "{found:?}");
        assert_eq!(found.visible_share, 1.0);
    }

    #[test]
    fn a_hard_stair_is_visible_and_a_missing_edge_is_as_far_off_as_can_be() {
        let line = filtered(Silhouette::Line { slope: 1.0 }, 3.47, 10.0);
        let hard = compare(&filtered(Silhouette::Stair, 0.0, 10.0), &line);
        assert!((hard.p50_deg - 45.0).abs() < 1e-3 && hard.visible_share > 0.8, "{hard:?}");
        let missing = compare(&[1.0; WIDTH * WIDTH], &line);
        assert_eq!((missing.p50_deg, missing.max_deg, missing.visible_share), (90.0, 90.0, 1.0));
    }

    #[test]
    fn without_edges_there_is_no_tilt_and_a_nan_is_refused() {
        let none = compare(&[1.0; WIDTH * WIDTH], &[0.6; WIDTH * WIDTH]);
        assert_eq!((none.max_deg, none.visible_share, none.compared_share), (0.0, 0.0, 1.0));
        let nan = edge_tilt(&[0.0, 0.0, f32::NAN, 1.0], &[0.0; 4], &[true; 4], 2).unwrap_err();
        assert!(nan.to_string().starts_with("pixel 2 is NaN"), "{nan}");
    }
}
