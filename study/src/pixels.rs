//! Pictures texel for pixel: one texel of a picture on one physical pixel, whatever the scale factor.
//!
//! egui places things in points, `pixels_per_point` physical pixels each. A picture is placed on
//! whole physical pixels, its size is its number of texels divided by `pixels_per_point`, and its
//! texture is not interpolated. No outline is feathered, because a bare mesh has none.

use eframe::egui;
use egui::{Color32, Mesh, Pos2, Rect, Shape, TextureHandle, TextureOptions, Vec2};
use image::GrayImage;
use rayon::prelude::*;
use scumble_stimuli::{Stimulus, Transfer, picture_sha256};

/// A picture on the GPU.
pub(crate) struct Picture {
    texture: TextureHandle,
    /// SHA-256 of the bytes that were uploaded.
    pub(crate) sha256: String,
}

impl Picture {
    /// Uploads a picture.
    pub(crate) fn new(context: &egui::Context, picture: &GrayImage) -> Self {
        let size = [picture.width() as usize, picture.height() as usize];
        let image = egui::ColorImage::from_gray(size, picture.as_raw());
        let texture = context.load_texture("stimulus", image, TextureOptions::NEAREST);
        Self { texture, sha256: picture_sha256(picture) }
    }
}

/// Draws stimuli side by side, each on a core of its own.
pub(crate) fn draw(
    stimuli: &[&Stimulus],
    size_px: [u32; 2],
    transfer: &Transfer,
) -> Result<Vec<GrayImage>, scumble_stimuli::Error> {
    stimuli.par_iter().map(|stimulus| stimulus.render(size_px[0], size_px[1], transfer)).collect()
}

/// Draws a picture with its centre as near to `centre` as whole physical pixels allow, and gives
/// the place it took.
pub(crate) fn paint(painter: &egui::Painter, picture: &Picture, centre: Pos2) -> Rect {
    let rect = pixel_rect(centre, picture.texture.size(), painter.pixels_per_point());
    let mut mesh = Mesh::with_texture(picture.texture.id());
    let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
    mesh.add_rect_with_uv(rect, whole, Color32::WHITE);
    painter.add(Shape::mesh(mesh));
    rect
}

/// The rectangle, in points, of whole physical pixels that is nearest to `rect`.
pub(crate) fn to_whole_pixels(rect: Rect, pixels_per_point: f32) -> Rect {
    let whole = |place: Pos2| ((place.to_vec2() * pixels_per_point).round() / pixels_per_point).to_pos2();
    let size_px = (rect.size() * pixels_per_point).round();
    Rect::from_min_size(whole(rect.min), size_px / pixels_per_point)
}

/// Fills a rectangle of whole physical pixels, without a soft edge.
pub(crate) fn fill(painter: &egui::Painter, rect: Rect, colour: Color32) {
    let mut mesh = Mesh::default();
    mesh.add_colored_rect(rect, colour);
    painter.add(Shape::mesh(mesh));
}

/// Fills a rectangle of whole physical pixels with rows one physical pixel high, of two colours in turn.
pub(crate) fn fill_rows(painter: &egui::Painter, rect: Rect, colours: [Color32; 2]) {
    let scale = painter.pixels_per_point();
    let mut mesh = Mesh::default();
    for row in 0..(rect.height() * scale).round() as u32 {
        let top = rect.top() + row as f32 / scale;
        let row_rect = Rect::from_x_y_ranges(rect.x_range(), top..=top + 1.0 / scale);
        mesh.add_colored_rect(row_rect, colours[row as usize % 2]);
    }
    painter.add(Shape::mesh(mesh));
}

/// The rectangle, in points, of `size_px` whole physical pixels around `centre`.
fn pixel_rect(centre: Pos2, size_px: [usize; 2], pixels_per_point: f32) -> Rect {
    let size_px = Vec2::new(size_px[0] as f32, size_px[1] as f32);
    let corner_px = (centre.to_vec2() * pixels_per_point - 0.5 * size_px).round();
    let min = Pos2::ZERO + corner_px / pixels_per_point;
    Rect::from_min_size(min, size_px / pixels_per_point)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_covers_whole_physical_pixels_at_any_scale() {
        for scale in [1.0, 1.25, 1.5, 5.0 / 3.0, 2.0, 2.75] {
            for centre in [Pos2::new(333.3, 250.7), Pos2::new(640.0, 401.5)] {
                let rect = pixel_rect(centre, [601, 480], scale);
                for (edge, sides) in [(rect.min, [0.0, 0.0]), (rect.max, [601.0, 480.0])] {
                    let edge_px = edge.to_vec2() * scale;
                    let whole = edge_px.round();
                    assert!((edge_px - whole).abs().max_elem() < 1e-3, "{edge_px} at {scale}");
                    let corner_px = (rect.min.to_vec2() * scale).round();
                    assert_eq!(whole - corner_px, Vec2::from(sides), "at {scale}");
                }
                assert!((rect.center() - centre).abs().max_elem() * scale < 0.51);
            }
        }
    }
}
