//! A picture of what differs: white where the shadow is right, blue where it is too dark, red where it is too bright.
//! The scale is one for all maps, so that pictures can be compared; larger errors have the colour of its end. Pixels that
//! turn away from the light, or see none, are grey: they are dark whatever the map says.

use anyhow::{Context, Result};
use image::RgbImage;

/// Error of the shadow fraction that has the full colour.
const FULL_SCALE: f32 = 0.25;
/// sRGB of an error of minus the full scale, of none, and of the full scale.
const ENDS: [[f32; 3]; 3] = [[20.0, 70.0, 170.0], [250.0, 250.0, 250.0], [190.0, 30.0, 30.0]];

/// sRGB of what no shadow map decides.
const OUTSIDE: [u8; 3] = [225; 3];

/// The map of `visibility - truth` where the mask is set, rows from top to bottom.
pub fn error_map(visibility: &[f32], truth: &[f32], mask: &[bool], width: u32, height: u32) -> Result<RgbImage> {
    let differences = visibility.iter().zip(truth).map(|(visibility, truth)| visibility - truth);
    let pixels =
        differences.zip(mask).flat_map(|(error, &inside)| if inside { color(error) } else { OUTSIDE }).collect();
    RgbImage::from_raw(width, height, pixels).context("the error map has another size than its pixels")
}

fn color(error: f32) -> [u8; 3] {
    let place = (error / FULL_SCALE).clamp(-1.0, 1.0);
    let end = if place < 0.0 { ENDS[0] } else { ENDS[2] };
    std::array::from_fn(|channel| (ENDS[1][channel] + (end[channel] - ENDS[1][channel]) * place.abs()).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn right_is_white_too_dark_is_blue_and_too_bright_is_red() {
        let mask = [true, true, true, true, false, true];
        let map = error_map(&[0.5, 0.0, 1.0, 0.5, 0.0, 0.0], &[0.5, 1.0, 0.0, 0.4, 1.0, 0.0], &mask, 2, 3).unwrap();
        let [red, _, blue] = map.get_pixel(1, 0).0;
        assert!(blue > red);
        let [red, _, blue] = map.get_pixel(0, 1).0;
        assert!(red > blue);
        assert_eq!(map.get_pixel(0, 0).0, [250; 3]);
        assert_eq!(map.get_pixel(0, 2).0, OUTSIDE);
        let [red, green, _] = map.get_pixel(1, 1).0;
        assert!(red > green && green > 100, "a small error has a pale colour");
    }
}
