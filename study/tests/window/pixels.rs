//! Screenshots, and what is on them.

use image::GrayImage;

/// A screenshot: red, green, blue, row by row.
#[derive(Clone, PartialEq)]
pub struct Pixels {
    pub size_px: [u32; 2],
    pub rgb: Vec<u8>,
}

impl Pixels {
    /// The upper left corner of the first place that shows `picture` texel for pixel and level for
    /// level.
    pub fn find(&self, picture: &GrayImage) -> Option<[u32; 2]> {
        let [width, height] = self.size_px;
        let (picture_width, picture_height) = picture.dimensions();
        let levels = picture.as_raw();
        let agrees = |x: u32, y: u32, index: usize| {
            let (column, row) = (index as u32 % picture_width, index as u32 / picture_width);
            let at = 3 * ((y + row) * width + x + column) as usize;
            self.rgb[at..at + 3].iter().all(|level| *level == levels[index])
        };
        // A sparse comparison rules out almost every place; 7,919 is a prime.
        let sparse = |x, y| (0..levels.len()).step_by(7_919).all(|index| agrees(x, y, index));
        (0..=height - picture_height)
            .flat_map(|y| (0..=width - picture_width).map(move |x| [x, y]))
            .find(|&[x, y]| sparse(x, y) && (0..levels.len()).all(|index| agrees(x, y, index)))
    }

    /// The number of pixels at which two screenshots differ.
    pub fn differing(&self, other: &Self) -> usize {
        let pairs = self.rgb.chunks(3).zip(other.rgb.chunks(3));
        pairs.filter(|(pixel, other)| pixel != other).count()
    }

    /// With the rectangle at `corner` blackened.
    pub fn without(mut self, corner: [u32; 2], size_px: [u32; 2]) -> Self {
        for row in corner[1]..corner[1] + size_px[1] {
            let start = 3 * (row * self.size_px[0] + corner[0]) as usize;
            self.rgb[start..start + 3 * size_px[0] as usize].fill(0);
        }
        self
    }

    /// The rectangle at `corner` alone.
    pub fn part(&self, corner: [u32; 2], size_px: [u32; 2]) -> Self {
        let row = |row: u32| {
            let start = 3 * (row * self.size_px[0] + corner[0]) as usize;
            &self.rgb[start..start + 3 * size_px[0] as usize]
        };
        Self { size_px, rgb: (corner[1]..corner[1] + size_px[1]).flat_map(row).copied().collect() }
    }
}

#[test]
fn a_picture_is_found_where_it_is_and_not_with_one_level_changed() {
    let mut pixels = Pixels { size_px: [40, 30], rgb: vec![128; 40 * 30 * 3] };
    let mut picture = GrayImage::from_fn(20, 10, |x, y| image::Luma([(x + 20 * y) as u8]));
    for (x, y, level) in picture.enumerate_pixels() {
        let at = 3 * ((y + 7) * 40 + x + 5) as usize;
        pixels.rgb[at..at + 3].fill(level.0[0]);
    }
    assert_eq!(pixels.find(&picture), Some([5, 7]));
    assert_eq!(pixels.part([4, 5], [30, 20]).find(&picture), Some([1, 2]));
    picture.get_pixel_mut(19, 9).0[0] += 1;
    assert_eq!(pixels.find(&picture), None);
}

#[test]
fn screenshots_without_a_rectangle_are_equal_when_they_differ_inside_it_alone() {
    let plain = Pixels { size_px: [40, 30], rgb: vec![128; 40 * 30 * 3] };
    for (place, is_inside) in [([5, 7], true), ([24, 16], true), ([25, 16], false), ([4, 7], false)] {
        let mut changed = plain.clone();
        changed.rgb[3 * (place[1] * 40 + place[0])] = 129;
        let [a, b] = [&plain, &changed].map(|pixels| pixels.clone().without([5, 7], [20, 10]));
        assert_eq!(a == b, is_inside, "{place:?}");
        let [a, b] = [&plain, &changed].map(|pixels| pixels.part([5, 7], [20, 10]));
        assert_eq!(a != b, is_inside, "{place:?}");
    }
}
