//! Shimmer: how much the visibility of fixed points of the world changes while the camera moves by less than a texel.
//!
//! Light and scene rest, so the true visibility of a point does not depend on the camera, and what varies is the map.
//! For a point with the visibilities `V_1 .. V_n` in the frames in which it is seen:
//! ```text
//! variance = sum (V_t - mean V)^2 / (n - 1)       rms = sqrt(mean over points of the variance)
//! ```
//! This is the temporal aliasing of a map that does not move by whole texels (Eisemann et al., *Casting Shadows in Real
//! Time*, section 3.2.1).

use crate::Error;
use crate::percentile::p99;

/// Standard deviations over frames, in shares of full light.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Shimmer {
    /// Points with at least two frames.
    pub points: usize,
    /// Root of the mean variance; 0 where nothing varies and where there are no points. At most 0.71 for visibilities
    /// from 0 to 1, reached by two frames.
    pub rms: f64,
    /// 99th percentile of the standard deviations (nearest rank).
    pub p99: f64,
    /// Largest standard deviation.
    pub max: f64,
}

/// Of the visibilities of each point in the frames in which it is seen; points seen less than twice are left out.
///
/// # Errors
/// Values that are not finite.
pub fn shimmer(points: &[Vec<f32>]) -> Result<Shimmer, Error> {
    let mut variances = Vec::with_capacity(points.len());
    for (point, series) in points.iter().enumerate() {
        if let Some(frame) = series.iter().position(|visibility| !visibility.is_finite()) {
            return Err(Error::Frame { frame, pixel: point, found: series[frame] });
        }
        variances.extend(variance(series));
    }
    variances.sort_by(f64::total_cmp);
    let Some(largest) = variances.last() else { return Ok(Shimmer { points: 0, rms: 0.0, p99: 0.0, max: 0.0 }) };
    Ok(Shimmer {
        points: variances.len(),
        rms: (variances.iter().sum::<f64>() / variances.len() as f64).sqrt(),
        p99: p99(&variances).unwrap_or(0.0).sqrt(),
        max: largest.sqrt(),
    })
}

/// Unbiased, so that points seen in different numbers of frames can be averaged; `None` of fewer than two values.
fn variance(series: &[f32]) -> Option<f64> {
    let count = series.len() as f64;
    let mean = series.iter().map(|&visibility| f64::from(visibility)).sum::<f64>() / count;
    let squares: f64 = series.iter().map(|&visibility| (f64::from(visibility) - mean).powi(2)).sum();
    (series.len() >= 2).then(|| squares / (count - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_that_rest_do_not_shimmer_however_they_differ() {
        let found = shimmer(&[vec![0.25; 5], vec![1.0; 3], vec![0.0; 2]]).unwrap();
        assert_eq!(found, Shimmer { points: 3, rms: 0.0, p99: 0.0, max: 0.0 });
    }

    #[test]
    fn a_point_that_flickers_has_its_standard_deviation() {
        let found = shimmer(&[vec![0.0, 1.0], vec![0.25, 0.5, 0.75]]).unwrap();
        assert!((found.max - 0.5f64.sqrt()).abs() < 1e-12);
        assert!((found.rms - ((0.5 + 0.0625) / 2.0f64).sqrt()).abs() < 1e-12, "{found:?}");
        let mut points = vec![vec![0.5; 4]; 99];
        points.push(vec![0.0, 1.0, 0.0, 1.0]);
        let found = shimmer(&points).unwrap();
        assert_eq!((found.points, found.p99), (100, 0.0));
        assert!((found.rms - (1.0f64 / 300.0).sqrt()).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn a_map_that_slides_shimmers_and_one_that_is_snapped_does_not() {
        // A hard edge at a quarter of a texel, stored in texels whose lattice starts at `shift`.
        let visibility = |point: f64, shift: f64| f32::from(u8::from((point - shift).floor() + 0.5 + shift > 10.25));
        let points = |shift: fn(u32) -> f64| -> Vec<Vec<f32>> {
            let at = |i: u32| 8.0 + 0.05 * f64::from(i);
            (0..80).map(|i| (0..16).map(|frame| visibility(at(i), shift(frame))).collect()).collect()
        };
        assert_eq!(shimmer(&points(|_| 0.0)).unwrap().max, 0.0);
        let slides = shimmer(&points(|frame| f64::from(frame) / 16.0)).unwrap();
        assert!(slides.rms > 0.1 && slides.max > 0.5, "{slides:?}");
    }

    #[test]
    fn points_seen_once_are_left_out_and_nonsense_is_refused() {
        assert_eq!(shimmer(&[vec![], vec![0.5], vec![0.5, 0.5]]).unwrap().points, 1);
        assert_eq!(shimmer(&[]).unwrap().points, 0);
        let nan = shimmer(&[vec![0.0; 2], vec![0.0, 0.0, f32::NAN]]).unwrap_err();
        assert!(nan.to_string().starts_with("pixel 1 of frame 2 is NaN"), "{nan}");
    }
}
