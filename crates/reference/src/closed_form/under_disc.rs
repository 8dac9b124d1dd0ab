//! Shares of the unit disc about the origin. Lengths are in its radii, shares are 0 to 1.

use std::f64::consts::PI;

use glam::DVec2;
use scumble_core::half_plane_under_disc;

/// Share of the disc in a slit: the strip of `width` whose middle line passes the disc's centre at distance `offset`.
/// The difference of two half planes, `F(offset + width / 2) - F(offset - width / 2)`.
///
/// A negative width is an empty slit.
#[must_use]
pub fn slit_under_disc(offset: f64, width: f64) -> f64 {
    let half = 0.5 * width.max(0.0);
    half_plane_under_disc(offset + half) - half_plane_under_disc(offset - half)
}

/// Share of the disc in another disc of `radius` (0 or more) whose centre is `distance` away.
///
/// The common chord lies at `x = (d^2 + 1 - R^2) / (2 d)` from the origin, has the half length `c`, and cuts a segment
/// of area `q^2 atan2(c, x) - c x` from a disc of radius `q` with the chord at distance `x`. The share is the two
/// segments' area over pi (E. W. Weisstein, *Circle-Circle Intersection*, MathWorld). Rounding: some 1e-16 times
/// `max(1, radius)`.
#[must_use]
pub fn disc_under_disc(distance: f64, radius: f64) -> f64 {
    let (distance, radius) = (distance.abs(), radius.max(0.0));
    if distance >= 1.0 + radius {
        return 0.0;
    }
    if distance <= (1.0 - radius).abs() {
        // One lies in the other.
        return radius.min(1.0).powi(2);
    }

    let chord_from_disc = ((distance - radius) * (distance + radius) + 1.0) / (2.0 * distance);
    let chord_from_other = distance - chord_from_disc;
    let half_chord = ((1.0 - chord_from_disc) * (1.0 + chord_from_disc)).max(0.0).sqrt();
    let segment = |radius: f64, chord_at: f64| radius * radius * half_chord.atan2(chord_at) - half_chord * chord_at;
    ((segment(1.0, chord_from_disc) + segment(radius, chord_from_other)) / PI).clamp(0.0, 1.0)
}

/// Share of the disc in a polygon that does not cross itself; corners in either order, all finite. Fewer than three
/// corners enclose nothing.
///
/// By Green's theorem the area is the sum, over the edges, of the signed area of the disc's part of the triangle
/// (origin, start, end): where the edge runs inside of the disc a triangle's `cross / 2`, where it runs outside a
/// sector's `angle / 2`. The edge enters and leaves the disc where its line does, `sqrt(1 - d^2)` to both sides of the
/// foot of the perpendicular `d` from the origin. Rounding: some 1e-16 times the largest coordinate.
#[must_use]
pub fn polygon_under_disc(corners: &[DVec2]) -> f64 {
    let following = corners.iter().cycle().skip(1);
    let area: f64 = corners.iter().zip(following).map(|(&start, &end)| edge_area(start, end)).sum();
    (area.abs() / PI).min(1.0)
}

/// Signed area of the disc's part of the triangle (origin, start, end).
fn edge_area(start: DVec2, end: DVec2) -> f64 {
    let length = start.distance(end);
    if length == 0.0 {
        return 0.0;
    }
    let along = (end - start) / length;
    let from_origin = along.perp_dot(-start);
    let half_chord_squared = 1.0 - from_origin * from_origin;
    if half_chord_squared <= 0.0 {
        return 0.5 * start.angle_to(end);
    }

    // Where the line enters and leaves the disc, from the start, kept on the edge.
    let (foot, half_chord) = (-start.dot(along), half_chord_squared.sqrt());
    let enters = (foot - half_chord).clamp(0.0, length);
    let leaves = (foot + half_chord).clamp(0.0, length);
    let (entry, exit) = (start + enters * along, start + leaves * along);
    let sector = |from: DVec2, to: DVec2, arc: f64| if arc > 0.0 { from.perp_dot(to).atan2(from.dot(to)) } else { 0.0 };
    0.5 * (sector(start, entry, enters) + entry.perp_dot(exit) + sector(exit, end, length - leaves))
}

#[cfg(test)]
mod tests {
    use super::super::counting::{Uniform, assert_standard, z_score};
    use super::*;

    /// Far beyond the disc.
    const FAR: f64 = 1e3;

    fn rectangle(min: DVec2, max: DVec2) -> [DVec2; 4] {
        [min, DVec2::new(max.x, min.y), max, DVec2::new(min.x, max.y)]
    }

    /// A point of the unit disc.
    fn in_disc(random: &mut Uniform) -> DVec2 {
        loop {
            let p = DVec2::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
            if p.length_squared() <= 1.0 {
                return p;
            }
        }
    }

    fn range(from: f64, to: f64, count: u32) -> impl Iterator<Item = f64> {
        (0..=count).map(move |i| from + (to - from) * f64::from(i) / f64::from(count))
    }

    #[test]
    fn a_wide_slit_is_the_disc_a_closed_one_nothing_and_slits_side_by_side_add_up() {
        assert_eq!((slit_under_disc(0.0, 2.0), slit_under_disc(0.3, 0.0), slit_under_disc(0.3, -1.0)), (1.0, 0.0, 0.0));
        assert_eq!(slit_under_disc(3.0, 2.0), 0.0);
        for offset in range(-1.5, 1.5, 30) {
            let halves = slit_under_disc(offset - 0.1, 0.2) + slit_under_disc(offset + 0.1, 0.2);
            assert!((halves - slit_under_disc(offset, 0.4)).abs() < 1e-15);
            assert!((slit_under_disc(offset, 0.4) - slit_under_disc(-offset, 0.4)).abs() < 1e-15);
        }
    }

    #[test]
    fn a_disc_inside_of_the_disc_is_its_own_area_and_a_touching_one_nothing() {
        for (distance, radius, share) in
            [(0.0, 1.0, 1.0), (0.0, 0.5, 0.25), (0.5, 0.5, 0.25), (2.0, 1.0, 0.0), (0.5, 3.0, 1.0), (5.0, 0.0, 0.0)]
        {
            assert_eq!(disc_under_disc(distance, radius), share, "{distance} {radius}");
        }
        // Two unit discs through each other's centre: (2 pi / 3 - sqrt(3) / 2) / pi.
        let expected = (2.0 * PI / 3.0 - 3f64.sqrt() / 2.0) / PI;
        assert!((disc_under_disc(1.0, 1.0) - expected).abs() < 1e-15);
    }

    #[test]
    fn discs_share_one_area_whichever_is_the_unit() {
        for distance in range(0.05, 3.0, 59) {
            for radius in range(0.1, 4.0, 39) {
                let exchanged = disc_under_disc(distance / radius, 1.0 / radius) * radius * radius;
                let share = disc_under_disc(distance, radius);
                assert!((share - exchanged).abs() < 1e-13, "{distance} {radius}: {share} {exchanged}");
            }
        }
    }

    #[test]
    fn a_large_disc_is_a_half_plane_as_its_curvature_vanishes() {
        let worst = |radius: f64| {
            let error = |t: f64| (disc_under_disc(radius - t, radius) - half_plane_under_disc(t)).abs();
            range(-1.2, 1.2, 24).map(error).fold(0.0, f64::max)
        };
        // The rim leaves its tangent by 1 / (2 R) at most, on a chord of 2, in a disc of pi.
        for radius in [1e1, 1e3, 1e6] {
            assert!(worst(radius) < 1.0 / (PI * radius), "{radius}: {}", worst(radius));
        }
    }

    #[test]
    fn a_long_rectangle_is_a_half_plane_and_a_slit() {
        for t in range(-1.5, 1.5, 60) {
            let half_plane = rectangle(DVec2::new(-t, -FAR), DVec2::new(FAR, FAR));
            assert!((polygon_under_disc(&half_plane) - half_plane_under_disc(t)).abs() < 1e-12, "{t}");
            let slit = rectangle(DVec2::new(-FAR, t - 0.2), DVec2::new(FAR, t + 0.2));
            assert!((polygon_under_disc(&slit) - slit_under_disc(t, 0.4)).abs() < 1e-12, "{t}");
        }
    }

    #[test]
    fn a_polygon_of_many_corners_is_a_disc() {
        let count = 20_000;
        for (distance, radius) in [(0.0, 0.5), (0.7, 0.6), (1.2, 0.9), (0.4, 1.3), (3.0, 3.5)] {
            let corner =
                |i: u32| DVec2::X * distance + radius * DVec2::from_angle(2.0 * PI * f64::from(i) / f64::from(count));
            let share = polygon_under_disc(&(0..count).map(corner).collect::<Vec<_>>());
            // An inscribed polygon loses 2/3 (pi / n)^2 of its area.
            let lost = 2.0 / 3.0 * (PI / f64::from(count)).powi(2) * radius * radius;
            assert!((share - disc_under_disc(distance, radius)).abs() < 1.1 * lost.max(1e-12), "{distance} {radius}");
        }
    }

    #[test]
    fn a_share_does_not_change_when_the_polygon_is_turned_mirrored_or_cut() {
        let whole = rectangle(DVec2::new(-0.7, -1.4), DVec2::new(0.45, 0.2));
        let share = polygon_under_disc(&whole);
        for turn in range(0.0, 6.0, 12) {
            let turned = whole.map(|p| DVec2::from_angle(turn).rotate(p));
            let mirrored = turned.map(|p| DVec2::new(-p.x, p.y));
            assert!((polygon_under_disc(&turned) - share).abs() < 1e-15);
            assert!((polygon_under_disc(&mirrored) - share).abs() < 1e-15);
        }
        for x in range(-0.7, 0.45, 20) {
            let left = rectangle(DVec2::new(-0.7, -1.4), DVec2::new(x, 0.2));
            let right = rectangle(DVec2::new(x, -1.4), DVec2::new(0.45, 0.2));
            assert!((polygon_under_disc(&left) + polygon_under_disc(&right) - share).abs() < 1e-15, "{x}");
        }
    }

    #[test]
    fn corners_edges_and_tangents_on_the_disc_have_their_limits() {
        let quarter = rectangle(DVec2::ZERO, DVec2::splat(2.0));
        assert!((polygon_under_disc(&quarter) - 0.25).abs() < 1e-15, "two edges through the origin");
        let inscribed = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y];
        assert!((polygon_under_disc(&inscribed) - 2.0 / PI).abs() < 1e-15, "corners on the rim");
        assert_eq!(polygon_under_disc(&rectangle(DVec2::NEG_ONE, DVec2::ONE)), 1.0, "edges touch the rim");
        assert!(
            polygon_under_disc(&rectangle(DVec2::new(1.0, -3.0), DVec2::splat(3.0))) < 1e-15,
            "touched from outside"
        );
        assert!((polygon_under_disc(&rectangle(DVec2::splat(-0.1), DVec2::splat(0.1))) - 0.04 / PI).abs() < 1e-16);
        assert_eq!(polygon_under_disc(&[]), 0.0);
        assert_eq!(polygon_under_disc(&[DVec2::ZERO, DVec2::X]), 0.0);
    }

    #[test]
    fn every_share_is_the_one_that_counting_finds() {
        let mut random = Uniform::new(1);
        let mut scores = Vec::new();
        for _ in 0..20 {
            let (offset, width) = (random.between(-0.7, 0.7), random.between(0.1, 1.2));
            scores.push(z_score(slit_under_disc(offset, width), || {
                (in_disc(&mut random).x + offset).abs() <= 0.5 * width
            }));
            let (distance, radius) = (random.between(0.0, 1.0), random.between(0.2, 2.0));
            scores.push(z_score(disc_under_disc(distance, radius), || {
                in_disc(&mut random).distance(DVec2::new(distance, 0.0)) <= radius
            }));
            let min = DVec2::new(random.between(-1.3, 0.5), random.between(-1.3, 0.5));
            let max = min + DVec2::new(random.between(0.2, 2.0), random.between(0.2, 2.0));
            scores.push(z_score(polygon_under_disc(&rectangle(min, max)), || {
                let p = in_disc(&mut random);
                p.cmpge(min).all() && p.cmple(max).all()
            }));
        }
        assert_standard(&scores);
    }

    #[test]
    fn counting_tells_a_wrong_share() {
        let mut random = Uniform::new(2);
        let wrong = disc_under_disc(0.5, 0.8) + 0.02;
        assert!(z_score(wrong, || in_disc(&mut random).distance(DVec2::new(0.5, 0.0)) <= 0.8).abs() > 5.0);
    }
}
