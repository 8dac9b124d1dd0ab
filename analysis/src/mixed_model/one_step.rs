//! The shared parameters of cohorts that a fitted model made, without a search for each.
//!
//! One step of Fisher's scoring from the model's own parameters, `at + I^-1 gradient`: as good as the maximum to first
//! order, because the start is off by no more than the cohort's error (Le Cam; van der Vaart 1998, section 5.7). `I` is the
//! covariance of the gradients over the cohorts plus the priors' precisions.

use nalgebra::{Matrix4, Vector4};
use rayon::prelude::*;

use super::{Coordinates, MixedFit, MixedModel, MixedParameters, PersonAnswers, parameters_of};

/// Precision added for `ln s`, which has no prior: where `s` is near 0 the answers say nothing of its logarithm.
const LN_SD_PRECISION: f64 = 1.0;

/// Longest step in a coordinate: the logarithms and logits among them move by a factor of e.
const STEP_MOST: f64 = 1.0;

impl MixedFit {
    /// The parameters of each cohort; those of the fit where the cohorts are too few to tell the information.
    pub(crate) fn one_step(&self, cohorts: &[Vec<PersonAnswers>]) -> Vec<MixedParameters> {
        let gradient = |people: &Vec<PersonAnswers>| {
            let model = MixedModel { people: people.clone(), known: self.model.known };
            Vector4::from(model.objective(&self.top.at).1)
        };
        let gradients: Vec<Vector4<f64>> = cohorts.par_iter().map(gradient).collect();
        let count = gradients.len() as f64;
        let mean = gradients.iter().sum::<Vector4<f64>>() / count;
        let squares = gradients.iter().map(|gradient| (gradient - mean) * (gradient - mean).transpose());
        let mut information = squares.sum::<Matrix4<f64>>() / (count - 1.0);
        information[(1, 1)] += LN_SD_PRECISION;
        for (index, _, sd) in self.model.priors() {
            information[(index, index)] += 1.0 / (sd * sd);
        }
        let covariance = information.try_inverse().filter(|matrix| matrix.iter().all(|entry| entry.is_finite()));
        let moved = |gradient: &Vector4<f64>| {
            let step = covariance.map_or(Vector4::zeros(), |covariance| covariance * gradient);
            let at: Coordinates = std::array::from_fn(|i| self.top.at[i] + step[i].clamp(-STEP_MOST, STEP_MOST));
            parameters_of(&at)
        };
        gradients.iter().map(moved).collect()
    }
}
