//! The 0.5 iso-contour of a picture, where an observer sees the edge of a shadow.
//!
//! Between four pixel centres the picture is bilinear. On a side of such a cell it is linear, so the contour crosses
//! it where `v_a + t (v_b - v_a) = 1/2`, exactly. Inside it is a hyperbola, replaced by its chord; which crossings a
//! chord joins in a saddle is decided by the value at the saddle's centre, `(v0 v2 - v1 v3) / (v0 + v2 - v1 - v3)`
//! (Nielson and Hamann, *The asymptotic decider*, 1991).
//!
//! Coordinates are pixels, x to the right, y down, with pixel centres at whole numbers. Only cells whose four pixels
//! are in the mask belong to the contour: a cell across a depth discontinuity shows no shadow's edge.

use glam::{DVec2, IVec2, dvec2, ivec2};

/// Visibility at which an edge is drawn: the middle of every symmetric penumbra.
const LEVEL: f64 = 0.5;

/// Cells a side of the blocks in which a search passes over what is empty.
const BLOCK: i32 = 8;

/// A chord of the contour, within one cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Segment(DVec2, DVec2);

impl Segment {
    /// In pixels.
    pub(crate) fn length(&self) -> f64 {
        self.0.distance(self.1)
    }

    /// The point half way between its ends.
    pub(crate) fn middle(&self) -> DVec2 {
        self.0.midpoint(self.1)
    }

    /// Angle between this line and another, 0 to pi / 2: neither has a direction.
    pub(crate) fn angle(&self, other: &Segment) -> f64 {
        let (this, other) = (self.1 - self.0, other.1 - other.0);
        this.perp_dot(other).abs().atan2(this.dot(other).abs())
    }

    /// From a point to the nearest point of the chord.
    fn distance(&self, point: DVec2) -> f64 {
        let along = self.1 - self.0;
        let share = (point - self.0).dot(along) / along.length_squared();
        point.distance(self.0 + share.clamp(0.0, 1.0) * along)
    }
}

/// The contour of a picture under a mask.
pub(crate) struct Contour {
    /// Cells across and down: one fewer than pixels.
    cells: IVec2,
    /// Per cell, rows from top to bottom: whether its four pixels are in the mask.
    inside: Vec<bool>,
    /// Cell `i` has the segments from `first[i]` to `first[i + 1]`.
    first: Vec<usize>,
    segments: Vec<Segment>,
    /// Blocks across and down.
    blocks: IVec2,
    /// Per block: whether it has a chord, or a cell outside of the mask or the picture.
    is_busy: Vec<bool>,
}

impl Contour {
    /// Of a picture with rows of `width` pixels, which are finite where the mask is set.
    pub(crate) fn of(picture: &[f32], mask: &[bool], width: usize) -> Self {
        let height = picture.len() / width;
        let cells = ivec2(width as i32 - 1, height.saturating_sub(1) as i32);
        let blocks = (cells + BLOCK - 1) / BLOCK;
        let (inside, first, segments, is_busy) = (Vec::new(), vec![0], Vec::new(), Vec::new());
        let mut contour = Self { cells, inside, first, segments, blocks, is_busy };
        for y in 0..height.saturating_sub(1) {
            for x in 0..width - 1 {
                let top = y * width + x;
                let corners = [top, top + 1, top + width + 1, top + width];
                let is_inside = corners.iter().all(|&pixel| mask[pixel]);
                if is_inside {
                    let values = corners.map(|pixel| f64::from(picture[pixel]));
                    contour.segments.extend(chords(dvec2(x as f64, y as f64), values));
                }
                contour.inside.push(is_inside);
                contour.first.push(contour.segments.len());
            }
        }
        let has_something = |cell| contour.segments_in(cell).is_none_or(|segments| !segments.is_empty());
        let blocks = (0..blocks.y).flat_map(|y| (0..blocks.x).map(move |x| ivec2(x, y)));
        contour.is_busy = blocks.map(|block| square(block * BLOCK, BLOCK).any(has_something)).collect();
        contour
    }

    /// Every chord, none of them a point.
    pub(crate) fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Sum of the chords, in pixels.
    pub(crate) fn length(&self) -> f64 {
        self.segments.iter().fold(0.0, |sum, segment| sum + segment.length())
    }

    /// The chord nearest to a point, and its distance; `None` where the border of the mask is nearer than any chord,
    /// because the contour may go on beyond.
    pub(crate) fn nearest(&self, point: DVec2) -> Option<(&Segment, f64)> {
        let home = (point / f64::from(BLOCK)).floor().as_ivec2();
        let mut nearest: Option<(&Segment, f64)> = None;
        let mut border = f64::INFINITY;
        for ring in 0.. {
            // A block of this ring is at least `ring - 1` blocks away. What is outside of the picture is border: this ends.
            if nearest.map_or(border, |(_, distance)| distance.min(border)) <= f64::from((ring - 1) * BLOCK) {
                break;
            }
            for block in ring_around(home, ring).filter(|&block| self.is_busy(block)) {
                let least = nearest.map_or(border, |(_, distance)| distance.min(border));
                if distance_to_square(point, block * BLOCK, BLOCK) > least {
                    continue;
                }
                for cell in square(block * BLOCK, BLOCK) {
                    let Some(segments) = self.segments_in(cell) else {
                        border = border.min(distance_to_square(point, cell, 1));
                        continue;
                    };
                    for segment in segments {
                        let distance = segment.distance(point);
                        if nearest.is_none_or(|(_, least)| distance < least) {
                            nearest = Some((segment, distance));
                        }
                    }
                }
            }
        }
        nearest.filter(|&(_, distance)| distance <= border)
    }

    /// The chords of a cell; `None` outside of the mask.
    fn segments_in(&self, cell: IVec2) -> Option<&[Segment]> {
        let index = index_in(self.cells, cell)?;
        self.inside[index].then(|| &self.segments[self.first[index]..self.first[index + 1]])
    }

    /// Whether a block has a chord, or a cell that does not count.
    fn is_busy(&self, block: IVec2) -> bool {
        index_in(self.blocks, block).is_none_or(|index| self.is_busy[index])
    }
}

/// Place of a cell in rows of `size.x`, `size.y` of them; `None` outside.
fn index_in(size: IVec2, cell: IVec2) -> Option<usize> {
    let is_inside = cell.cmpge(IVec2::ZERO).all() && cell.cmplt(size).all();
    is_inside.then(|| cell.y as usize * size.x as usize + cell.x as usize)
}

/// The cells of a square with `side` cells a side, from its corner on.
fn square(corner: IVec2, side: i32) -> impl Iterator<Item = IVec2> {
    (0..side).flat_map(move |y| (0..side).map(move |x| corner + ivec2(x, y)))
}

/// From a point to the nearest point of a square.
fn distance_to_square(point: DVec2, corner: IVec2, side: i32) -> f64 {
    point.distance(point.clamp(corner.as_dvec2(), (corner + side).as_dvec2()))
}

/// The cells at the chessboard distance `ring` from a cell.
fn ring_around(middle: IVec2, ring: i32) -> impl Iterator<Item = IVec2> {
    (-ring..=ring).flat_map(move |y| {
        let step = if y.abs() == ring || ring == 0 { 1 } else { 2 * ring };
        (-ring..=ring).step_by(step as usize).map(move |x| middle + ivec2(x, y))
    })
}

/// Chords of a cell whose corners have `values`, clockwise from the top left, which is `origin`.
fn chords(origin: DVec2, values: [f64; 4]) -> impl Iterator<Item = Segment> {
    const CORNERS: [DVec2; 4] = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
    let is_lit = values.map(|value| value >= LEVEL);
    let crossing = |side: usize| {
        let (a, b) = (side, (side + 1) % 4);
        let share = (LEVEL - values[a]) / (values[b] - values[a]);
        (is_lit[a] != is_lit[b]).then(|| origin + CORNERS[a].lerp(CORNERS[b], share))
    };
    let pairs = match [0, 1, 2, 3].map(crossing) {
        [Some(top), Some(right), Some(bottom), Some(left)] => {
            let [v0, v1, v2, v3] = values;
            let saddle = (v0 * v2 - v1 * v3) / (v0 + v2 - v1 - v3);
            // A saddle as lit as the first corner joins it with the third: the chords cut the other two off.
            if (saddle >= LEVEL) == is_lit[0] {
                [Some((top, right)), Some((bottom, left))]
            } else {
                [Some((left, top)), Some((right, bottom))]
            }
        }
        crossings => {
            let mut crossings = crossings.into_iter().flatten();
            [crossings.next().zip(crossings.next()), None]
        }
    };
    pairs.into_iter().flatten().filter(|(a, b)| a != b).map(|(a, b)| Segment(a, b))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contour(picture: &[f32], width: usize) -> Contour {
        Contour::of(picture, &vec![true; picture.len()], width)
    }

    #[test]
    fn the_contour_crosses_between_pixels_where_the_picture_is_one_half() {
        let found = contour(&[0.0, 0.25, 0.75, 0.0, 0.25, 1.25], 3);
        assert_eq!(found.segments(), [Segment(dvec2(1.5, 0.0), dvec2(1.25, 1.0))]);
    }

    #[test]
    fn a_saddle_joins_the_corners_that_its_centre_is_like() {
        let lit = contour(&[1.0, 0.4, 0.4, 1.0], 2);
        let dark = contour(&[0.6, 0.0, 0.0, 0.6], 2);
        assert_eq!((lit.segments().len(), dark.segments().len()), (2, 2));
        let cuts_off = |found: &Contour, corner: DVec2| found.segments().iter().all(|s| s.distance(corner) > 0.5);
        assert!(cuts_off(&lit, DVec2::ZERO) && cuts_off(&lit, DVec2::ONE), "lit corners are joined");
        assert!(cuts_off(&dark, DVec2::X) && cuts_off(&dark, DVec2::Y), "dark corners are joined");
    }

    #[test]
    fn a_pixel_of_exactly_one_half_makes_no_chord_without_length() {
        let found = contour(&[0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0], 3);
        assert!(found.segments().is_empty(), "{:?}", found.segments());
    }

    #[test]
    fn the_nearest_chord_is_that_of_a_search_through_all() {
        let noise = |i: usize| (i as f32 * 12.9898).sin().abs();
        // Chords everywhere, and a few with empty blocks between them.
        for (width, every) in [(40, 11), (100, 997)] {
            let spots = (0..width * width).map(|i| if i % every == 0 { noise(i) } else { 1.0 });
            let found = contour(&spots.collect::<Vec<f32>>(), width);
            let end = DVec2::splat(width as f64 - 1.0);
            for step in 0..400 {
                let point = dvec2(f64::from(step) / 400.0, f64::from(step * 7 % 400) / 400.0) * end;
                let least = found.segments().iter().map(|s| s.distance(point)).fold(f64::INFINITY, f64::min);
                let border = point.min(end - point).min_element();
                match found.nearest(point) {
                    Some((_, distance)) => assert_eq!(distance, least),
                    None => assert!(border < least, "{point} has a chord at {least} and a border at {border}"),
                }
            }
        }
    }

    #[test]
    fn a_chord_beyond_the_border_of_the_mask_is_not_the_nearest() {
        let picture: Vec<f32> = (0..80).map(|i| f32::from(u8::from(i % 20 >= 10))).collect();
        let mut mask = vec![true; 80];
        assert!(contour(&picture, 20).nearest(dvec2(8.6, 1.5)).is_some());
        for row in mask.chunks_mut(20) {
            row[9] = false;
        }
        assert!(Contour::of(&picture, &mask, 20).nearest(dvec2(7.5, 1.5)).is_none());
    }

    #[test]
    fn angles_between_lines_have_no_direction() {
        let along = Segment(DVec2::ZERO, DVec2::X);
        for (end, degrees) in
            [(dvec2(1.0, 1.0), 45.0), (dvec2(-1.0, 1.0), 45.0), (dvec2(0.0, -2.0), 90.0), (dvec2(-3.0, 0.0), 0.0)]
        {
            assert!((along.angle(&Segment(DVec2::ZERO, end)).to_degrees() - degrees).abs() < 1e-12);
        }
    }

    #[test]
    fn a_picture_of_one_row_or_column_or_none_has_no_contour() {
        for (pixels, width) in [(4, 4), (4, 1), (0, 3)] {
            assert!(contour(&[0.0, 1.0, 0.0, 1.0][..pixels], width).segments().is_empty());
        }
    }
}
