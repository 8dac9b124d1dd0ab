//! The threshold that a simulated person has by assumption, one for each condition.
//!
//! The ratio, radius in texels, at which [`THRESHOLD_PROBABILITY`] of the answers to two alternatives are
//! right, slips included, is
//! `ratio x pattern factor x half_contrast_factor^(log2(1 / contrast))`:
//!
//! * step: 1; double step: 1, a single step in a diagonal is as hard to hide as one in a level edge
//!   (an assumption: the paper has none; by its contour it is hidden at a ratio a tenth smaller);
//!   stair: `stair_factor`;
//! * every texel size has the same ratio, which is the relation `r = c a` itself;
//! * every kernel has the same ratio, an assumption: the steepest part of a filtered step rises by
//!   `0.5 / c` under disc and box and by `0.80 / c` and `1.20 / c` under the Gaussians of
//!   `sigma = r / 2` and `r / 3`. The person who sees pictures,
//!   [`ImageObserver`](crate::ImageObserver), tells the kernels apart.

use scumble_stimuli::Pattern;
use serde::{Deserialize, Serialize};

use crate::error::{Error, require};
use crate::trial::Condition;

/// Share of right answers to two alternatives at a threshold (Kreuzer 2017, 4.2).
pub const THRESHOLD_PROBABILITY: f64 = 0.82;

/// A simulated person's threshold for each condition.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Thresholds {
    /// For the step at 100 % contrast, in texels.
    pub ratio: f64,
    /// The stair's divided by the step's.
    pub stair_factor: f64,
    /// The threshold at half the contrast divided by that at the full one.
    pub half_contrast_factor: f64,
}

impl Default for Thresholds {
    /// Kreuzer 2017: 3.47 texels for the step, 2.5 for the stair. The factor of the contrast is an
    /// assumption: the paper says "slightly".
    fn default() -> Self {
        Self { ratio: 3.47, stair_factor: 2.5 / 3.47, half_contrast_factor: 0.95 }
    }
}

impl Thresholds {
    /// Refuses numbers outside their ranges; the error names the field.
    pub fn check(&self) -> Result<(), Error> {
        let positive = [
            ("thresholds.ratio", self.ratio),
            ("thresholds.stair_factor", self.stair_factor),
            ("thresholds.half_contrast_factor", self.half_contrast_factor),
        ];
        let allowed = "a finite number above 0";
        positive
            .into_iter()
            .try_for_each(|(field, value)| require(value.is_finite() && value > 0.0, field, value, allowed))
    }

    /// The threshold for a condition, in texels.
    pub fn ratio_of(&self, condition: &Condition) -> f64 {
        let pattern_factor = match condition.pattern {
            Pattern::Step | Pattern::DoubleStep => 1.0,
            Pattern::Stair => self.stair_factor,
        };
        let halvings = -libm::log2(condition.contrast);
        self.ratio * pattern_factor * libm::pow(self.half_contrast_factor, halvings)
    }
}
