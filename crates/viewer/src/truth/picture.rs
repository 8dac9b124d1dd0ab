//! Numbers of pixels, shown with several samples per pixel.

use glam::Vec3;

use crate::gbuffer::Surface;

/// The visibility of `fine` samples, `per_side`^2 to a pixel: that of the pixel, among the nine around the sample, whose
/// surface is nearest to the sample's; 1 for samples of no surface, or none among the nine.
pub fn spread(
    visibility: &[f32],
    surfaces: &[Option<Surface>],
    width_px: u32,
    fine: &[Option<Surface>],
    per_side: u32,
) -> Vec<f32> {
    let width = i64::from(width_px);
    let height = surfaces.len() as i64 / width.max(1);
    let of_sample = |(index, sample): (usize, &Option<Surface>)| {
        let Some(sample) = sample else { return 1.0 };
        let per_side = i64::from(per_side);
        let (x, y) = (index as i64 % (width * per_side) / per_side, index as i64 / (width * per_side) / per_side);
        let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (x + dx, y + dy)));
        let nearest = around
            .filter(|&(x, y)| (0..width).contains(&x) && (0..height).contains(&y))
            .map(|(x, y)| (y * width + x) as usize)
            .filter_map(|pixel| Some((pixel, distance(&surfaces[pixel]?, sample))))
            .min_by(|a, b| a.1.total_cmp(&b.1));
        nearest.map_or(1.0, |(pixel, _)| visibility[pixel])
    };
    fine.iter().enumerate().map(of_sample).collect()
}

/// Distance of two surfaces, longer where they face apart: twice at a right angle, three times back to back.
fn distance(a: &Surface, b: &Surface) -> f32 {
    let [n, m] = [a, b].map(|surface| surface.normal.normalize_or(Vec3::ZERO));
    a.position.distance(b.position) * (2.0 - n.dot(m))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f32, depth: f32) -> Option<Surface> {
        Some(Surface { position: Vec3::new(x, 0.0, -depth), normal: Vec3::Z })
    }

    #[test]
    fn samples_of_an_even_surface_have_the_number_of_their_pixel() {
        let pixels = [at(0.5, 1.0), at(1.5, 1.0), at(2.5, 1.0)];
        let fine: Vec<_> = (0..12).map(|i| at(0.25 + 0.5 * (i % 6) as f32, 1.0)).collect();
        let found = spread(&[0.0, 0.5, 1.0], &pixels, 3, &fine, 2);
        assert_eq!(found, [[0.0, 0.0, 0.5, 0.5, 1.0, 1.0]; 2].concat());
    }

    #[test]
    fn at_an_edge_a_sample_has_the_number_of_its_own_surface() {
        // The left pixel shows what is near, the right one what is far; the edge lies inside of the left pixel.
        let pixels = [at(0.5, 1.0), at(1.5, 9.0)];
        let fine = [at(0.25, 1.0), at(0.75, 9.0), at(1.25, 9.0), at(1.75, 9.0)];
        let two_rows = [fine, fine].concat();
        assert_eq!(spread(&[0.25, 0.75], &pixels, 2, &two_rows, 2), [[0.25, 0.75, 0.75, 0.75]; 2].concat());
    }

    #[test]
    fn what_has_no_surface_is_lit() {
        assert_eq!(spread(&[0.0, 0.0], &[None, at(1.5, 1.0)], 2, &[None, at(1.5, 1.0)], 1), [1.0, 0.0]);
        assert_eq!(spread(&[0.0], &[None], 1, &[at(0.5, 1.0)], 1), [1.0]);
    }
}
