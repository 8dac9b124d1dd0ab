//! The JSON file beside a truth, which says what its numbers are.

use scumble::Light;
use scumble_reference::Estimate;
use serde::Serialize;

use crate::cli::{Method, Truth};
use crate::stage::Stage;
use crate::truth::source::Samples;

/// What the record says it is.
pub const SCHEMA: &str = "scumble/truth/2";

/// The record.
#[derive(Serialize)]
pub struct TruthRecord<'a> {
    schema: &'static str,
    scene: &'a str,
    triangles: usize,
    /// `kernel`: the filter over the exact hard shadow. `light`: the light itself.
    truth: &'static str,
    /// The filter; null for the light.
    method: Option<&'static str>,
    /// Taps of the filter, or rays to the light, of every pixel.
    samples: u32,
    light: &'a Light,
    /// Radius of a PCF or VSM filter at the light's reference plane, metres; null for the light and other filters.
    pcf_radius_plane: Option<f64>,
    /// Shape of the arrays, rows from top to bottom: visibility 0 dark to 1 lit, 1 where there is no surface.
    width: u32,
    height: u32,
    /// Over the pixels of the penumbra; null for a kernel, whose numbers are no estimates.
    standard_error: Option<StandardErrors>,
    /// Rows that were found in the cache, under this key.
    rows_from_cache: u32,
    cache_key: String,
}

/// Of the pixels that are neither all lit nor all dark, in shares of full light; zeros without one.
#[derive(Serialize)]
struct StandardErrors {
    mean: f64,
    max: f64,
}

impl StandardErrors {
    fn of(estimates: &[Estimate]) -> Self {
        let partial = estimates.iter().filter(|estimate| estimate.visibility > 0.0 && estimate.visibility < 1.0);
        let errors: Vec<f64> = partial.map(|estimate| f64::from(estimate.standard_error)).collect();
        let mean = errors.iter().sum::<f64>() / errors.len().max(1) as f64;
        Self { mean, max: errors.iter().copied().fold(0.0, f64::max) }
    }
}

impl<'a> TruthRecord<'a> {
    /// Of a picture's estimates.
    pub fn new(
        stage: &'a Stage,
        options: &Truth,
        samples: Samples,
        estimates: &[Estimate],
        rows_from_cache: u32,
        cache_key: String,
    ) -> Self {
        let scene = &stage.setup.scene;
        let method = samples.of_light().is_none().then_some(options.method);
        Self {
            schema: SCHEMA,
            scene: &scene.name,
            triangles: scene.triangle_count(),
            truth: options.truth.name(),
            method: method.map(|method| method.name()),
            samples: samples.number(),
            light: &scene.light,
            pcf_radius_plane: method
                .filter(|method| matches!(method, Method::Pcf | Method::Vsm))
                .map(|_| stage.setup.pcf_radius_plane),
            width: options.view.conditions.width,
            height: options.view.conditions.height,
            standard_error: samples.of_light().map(|_| StandardErrors::of(estimates)),
            rows_from_cache,
            cache_key,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_penumbra_counts_and_without_one_the_errors_are_zero() {
        let estimate = |visibility, standard_error| Estimate { visibility, standard_error };
        let found = StandardErrors::of(&[estimate(1.0, 9.0), estimate(0.5, 0.25), estimate(0.25, 0.75)]);
        assert_eq!((found.mean, found.max), (0.5, 0.75));
        let none = StandardErrors::of(&[estimate(0.0, 9.0)]);
        assert_eq!((none.mean, none.max), (0.0, 0.0));
    }
}
