//! From the bits that the demand pass leaves to what a picture showed of the receivers of each light.

use glam::{DVec2, DVec3};
use scumble_core::{Camera, Light, Seen, SeenBand};

use crate::measure::Lights;
use crate::uniforms::LightReceivers;

/// What the shader leaves of a minimum where there was no receiver.
pub const NOWHERE: u32 = u32::MAX;

/// What a measured picture was of.
#[derive(Clone, Copy, Debug)]
pub struct Picture {
    /// Its camera.
    pub camera: Camera,
    /// Distance of measured pixels, as a share of their view depth.
    pub gap: f64,
    /// Its lights.
    pub lights: Lights,
    /// Origin of the shaders' world space.
    pub origin_world: DVec3,
}

impl Picture {
    /// What it showed, by light; `None` of a light that has no slices.
    pub fn seen(&self, found: &[LightReceivers]) -> Vec<Option<Seen>> {
        let of_light = |(light, found): (&Option<Light>, &LightReceivers)| {
            let light = light.filter(|light| matches!(light, Light::Directional { .. }))?;
            let origin = light.light_from_world().transform_point3(self.origin_world).truncate();
            let bands = (0..).zip(&found.minima).filter_map(|(band, minima)| band_of(band, minima, origin)).collect();
            Some(Seen { camera: self.camera, light, gap: self.gap, bands })
        };
        self.lights.iter().zip(found).map(of_light).collect()
    }
}

/// The box of a band with its origin at `origin` of light space; `None` where there was no receiver.
fn band_of(band: u32, minima: &[u32; 4], origin: DVec2) -> Option<SeenBand> {
    if minima.contains(&NOWHERE) {
        return None;
    }
    let [x, y, minus_x, minus_y] = minima.map(number_of);
    let (min, max) = (origin + DVec2::new(x, y), origin - DVec2::new(minus_x, minus_y));
    (min.is_finite() && max.is_finite()).then_some(SeenBand { band, min, max })
}

/// The number of bits in order: inverse of `ordered` of `shader/receivers.wgsl`.
fn number_of(ordered: u32) -> f64 {
    let bits = if ordered & 0x8000_0000 != 0 { ordered & 0x7FFF_FFFF } else { !ordered };
    f64::from(f32::from_bits(bits))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As the shader does it.
    fn ordered(number: f32) -> u32 {
        let bits = number.to_bits();
        if bits >= 0x8000_0000 { !bits } else { bits | 0x8000_0000 }
    }

    #[test]
    fn bits_in_order_are_those_of_their_numbers() {
        let numbers = [f32::MIN, -70.25, -1.0, -1e-30, 0.0, 1e-30, 0.5, 1.0, 3000.0, f32::MAX];
        assert!(numbers.windows(2).all(|pair| ordered(pair[0]) < ordered(pair[1])));
        assert!(numbers.iter().all(|&number| number_of(ordered(number)) == f64::from(number)));
        assert!(ordered(f32::INFINITY) < NOWHERE);
    }

    #[test]
    fn a_band_has_its_box_about_the_origin_and_none_where_there_is_no_number() {
        let minima = [-2.0, 3.0, -5.0, -3.5].map(ordered);
        let found = band_of(7, &minima, DVec2::new(100.0, 10.0));
        let expected = SeenBand { band: 7, min: DVec2::new(98.0, 13.0), max: DVec2::new(105.0, 13.5) };
        assert_eq!(found, Some(expected));
        assert_eq!(band_of(7, &[NOWHERE; 4], DVec2::ZERO), None);
        assert_eq!(band_of(7, &[-2.0, f32::NAN, -5.0, -3.5].map(ordered), DVec2::ZERO), None);
    }
}
