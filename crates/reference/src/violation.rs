//! The share of a penumbra whose filter is too narrow to hide the texels: `r < c a` (Kreuzer 2017, Eq. 5.1).
//!
//! ```text
//! share = #{r_i < c a_i} / #{r_i > 0}     over the pixels of the penumbra
//! ```
//! r: radius of the filter at a pixel, a: texel there, both lengths in one space; c: ratio of the relation. A pixel
//! with the radius 0 found no occluder and has no edge to hide; it is left out.

use scumble_core::Relation;

use crate::Error;

/// Relative rounding of a radius in `f32` that does not make exactly c texels a violation.
const ROUNDING: f64 = 1e-4;

/// Where the relation says that texels are seen.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Violation {
    /// Pixels of the penumbra with a filter.
    pub pixels: usize,
    /// Share of them with a filter narrower than c texels, 0 to 1; 0 where there are none.
    pub share: f64,
}

/// Counts the pixels of `penumbra` at which a radius does not hide a texel; see [`penumbra`](crate::penumbra()) for the
/// mask.
///
/// # Errors
/// Different numbers of pixels; inside the mask, radii that are not finite and at least 0, and texels that are not
/// finite and above 0.
pub fn violation_share(
    radii: &[f32],
    texels: &[f32],
    penumbra: &[bool],
    relation: &Relation,
) -> Result<Violation, Error> {
    for found in [radii.len(), texels.len()] {
        if found != penumbra.len() {
            return Err(Error::Count { found, allowed: penumbra.len() });
        }
    }
    let (mut pixels, mut violations) = (0, 0usize);
    for pixel in (0..penumbra.len()).filter(|&pixel| penumbra[pixel]) {
        let (radius, texel) = (radii[pixel], texels[pixel]);
        if !(radius.is_finite() && radius >= 0.0 && texel.is_finite() && texel > 0.0) {
            return Err(Error::Filter { pixel, radius, texel });
        }
        if radius > 0.0 {
            let needed = relation.radius_from_texel(f64::from(texel)) * (1.0 - ROUNDING);
            pixels += 1;
            violations += usize::from(f64::from(radius) < needed);
        }
    }
    Ok(Violation { pixels, share: violations as f64 / pixels.max(1) as f64 })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn share(radii: &[f32], texels: &[f32]) -> Violation {
        violation_share(radii, texels, &vec![true; radii.len()], &Relation::exact(2.5).unwrap()).unwrap()
    }

    #[test]
    fn a_filter_of_c_texels_is_wide_enough_and_a_narrower_one_is_not() {
        assert_eq!(share(&[0.25, 0.2499, 0.3, 1.0], &[0.1; 4]), Violation { pixels: 4, share: 0.25 });
        assert_eq!(share(&[0.25; 4], &[0.1, 0.2, 0.05, 0.4]), Violation { pixels: 4, share: 0.5 });
    }

    #[test]
    fn a_map_without_texels_to_hide_is_never_and_a_coarse_one_always_seen() {
        let radii: Vec<f32> = (1..100).map(|i| i as f32 * 0.01).collect();
        assert_eq!(share(&radii, &[1e-3; 99]).share, 0.0);
        assert_eq!(share(&radii, &[1.0; 99]).share, 1.0);
    }

    #[test]
    fn pixels_without_a_filter_or_outside_of_the_penumbra_do_not_count() {
        let relation = Relation::published();
        let found = violation_share(&[0.0, 0.1, f32::NAN], &[1.0; 3], &[true, true, false], &relation).unwrap();
        assert_eq!(found, Violation { pixels: 1, share: 1.0 });
        assert_eq!(share(&[0.0], &[1.0]), Violation { pixels: 0, share: 0.0 });
        assert_eq!(share(&[], &[]), Violation { pixels: 0, share: 0.0 });
    }

    #[test]
    fn lengths_that_are_none_are_refused_with_their_pixel() {
        let relation = Relation::published();
        for (radius, texel) in [(f32::NAN, 1.0), (-1.0, 1.0), (f32::INFINITY, 1.0), (1.0, 0.0), (1.0, f32::NAN)] {
            let error = violation_share(&[1.0, radius], &[1.0, texel], &[true; 2], &relation).unwrap_err();
            assert!(error.to_string().starts_with("pixel 1 has a filter of radius"), "{error}");
        }
        let error = violation_share(&[1.0], &[1.0; 2], &[true; 2], &relation).unwrap_err();
        assert!(matches!(error, Error::Count { found: 1, allowed: 2 }));
    }
}
