//! The protocol: every parameter of a session, with its unit, as it stands in a protocol file and in
//! `session.json`.
//!
//! A round is a pattern at a contrast under a kernel; its staircases, one a texel size and prior, are
//! interleaved. Ranges are checked in `protocol_check`, files are read in `protocol_file`.

use scumble_stimuli::{Encoding, Kernel, Pattern};
use serde::{Deserialize, Serialize};

use crate::convergence::Convergence;
use crate::error::Error;
use crate::exclusions::Exclusions;
use crate::staircase::Staircase;
use crate::staircase_config::StaircaseConfig;
use crate::trial::Condition;

/// Every parameter of a session.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Protocol {
    /// Name of the protocol.
    pub name: String,
    /// The question.
    pub task: Task,
    /// What is measured.
    pub conditions: Conditions,
    /// How it is drawn.
    pub pictures: PictureRules,
    /// How the radii are chosen.
    pub staircase: StaircaseConfig,
    /// When a staircase between its fewest and its most trials is done.
    pub convergence: Convergence,
    /// In what order, and how much.
    pub schedule: Schedule,
    /// Trials with feedback before the measurement.
    pub practice: Practice,
    /// Artifacts that everyone sees who looks; none without this table.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub catch_trials: Option<CatchTrials>,
    /// Lines alone among the artifacts of a yes-no task; none without this table.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line_trials: Option<LineTrials>,
    /// What does not enter a fit; everything does without this table.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub exclusions: Option<Exclusions>,
}

/// What the participant is asked and what a response of 1 means.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Task {
    /// Two pictures, a filtered line and a filtered artifact: "which one was the line?".
    /// A response of 1 means "correct"; guessing is right half of the time.
    TwoAlternative,
    /// One picture: "was the original image a line?". A response of 1 to an artifact means "no", it
    /// was told from a line; how often a line is called an artifact is the person's own.
    YesNo,
}

/// What is measured: each list crossed with the others.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Conditions {
    /// Patterns.
    pub patterns: Vec<Pattern>,
    /// Lit side relative to the brightest, in the encoding of the pictures, above 0 to 1.
    pub contrasts: Vec<f64>,
    /// Filters.
    pub kernels: Vec<Kernel>,
    /// Texel sizes.
    pub texels_px: Vec<f64>,
}

/// How the pictures are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PictureRules {
    /// Width of each picture in physical pixels.
    pub width_px: u32,
    /// Height of each picture in physical pixels.
    pub height_px: u32,
    /// What the filter averages and the contrast scales.
    pub encoding: Encoding,
    /// Whether noise of less than a level hides the contours of equal levels.
    pub dithered: bool,
    /// Each picture but a stair's is turned by an angle of its own, drawn from `-tilt_range_rad ..=
    /// tilt_range_rad`, as no blur hides the tilt of the line of a step, `s = texel_px / width_px`. Who calls
    /// the more tilted picture the line is right in `1/2 + (s / tilt_range_rad)^2 / 4` of the trials.
    pub tilt_range_rad: f64,
    /// Smallest radius shown, in texels.
    pub ratio_min: f64,
}

/// In what order the rounds come, how long they are, and when to rest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Schedule {
    /// Order of the rounds.
    pub order: Order,
    /// Fewest trials of each staircase.
    pub trials_min: u32,
    /// Most trials of each staircase.
    pub trials_max: u32,
    /// A rest within a round after this many trials; without it there are rests before rounds only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rest_every_trials: Option<u32>,
}

/// Order of the rounds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Order {
    /// Drawn from the seed.
    Random,
    /// The row of a balanced Latin square that the participant's number names: over as many
    /// participants as rows each round stands in each place, and follows each other one, equally often.
    LatinSquare,
}

/// Trials with feedback before the measurement, none of which reaches a staircase.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Practice {
    /// Radius in texels of each practice trial, in order; empty for no practice.
    pub ratios: Vec<f64>,
    /// Texel size of the practice trials.
    pub texel_px: f64,
    /// Their contrast.
    pub contrast: f64,
}

/// Artifacts that everyone sees who looks: who misses them does not attend.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CatchTrials {
    /// Share of all trials, above 0 to 0.5.
    pub share: f64,
    /// Radius in texels.
    pub ratio: f64,
    /// Texel size.
    pub texel_px: f64,
}

/// Lines alone, matched to the artifacts: same condition, the radius that the staircase would show.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LineTrials {
    /// Share of the trials that are not catch trials, above 0 to 0.9.
    pub share: f64,
}

/// A pattern at a contrast under a kernel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Round {
    /// How the silhouette lies on the texels.
    pub pattern: Pattern,
    /// Lit side relative to the brightest.
    pub contrast: f64,
    /// The filter.
    pub kernel: Kernel,
}

impl Protocol {
    /// The staircase whose prior is centred at `prior_ratio` texels: its intensity is
    /// `log10(texel / radius)`. Errors name the key that is out of its range.
    pub fn staircase_at(&self, prior_ratio: f64) -> Result<Staircase, Error> {
        self.staircase.staircase(-libm::log10(prior_ratio))
    }

    /// Every round, before their order is drawn.
    pub fn rounds(&self) -> Vec<Round> {
        let Conditions { patterns, contrasts, kernels, .. } = &self.conditions;
        let mut rounds = Vec::new();
        for &pattern in patterns {
            for &contrast in contrasts {
                rounds.extend(kernels.iter().map(|&kernel| Round { pattern, contrast, kernel }));
            }
        }
        rounds
    }

    /// Everything that is measured, round after round, before their order is drawn.
    pub fn all_conditions(&self) -> Vec<Condition> {
        self.rounds().into_iter().flat_map(|round| self.conditions_of(round)).collect()
    }

    /// Share of the trials that a staircase learns from, catch trials and lines being drawn independently.
    pub fn measured_share(&self) -> f64 {
        (1.0 - self.catch_share()) * (1.0 - self.line_share())
    }

    /// Share of catch trials among all trials.
    pub(crate) fn catch_share(&self) -> f64 {
        self.catch_trials.map_or(0.0, |catch| catch.share)
    }

    /// Share of lines among the trials that are not catch trials.
    pub(crate) fn line_share(&self) -> f64 {
        self.line_trials.map_or(0.0, |lines| lines.share)
    }

    /// What is measured in a round.
    pub(crate) fn conditions_of(&self, round: Round) -> Vec<Condition> {
        let Round { pattern, contrast, kernel } = round;
        let of_texel = |&texel_px: &f64| Condition { pattern, contrast, kernel, texel_px };
        self.conditions.texels_px.iter().map(of_texel).collect()
    }

    /// Smallest and largest radius shown for this texel.
    ///
    /// The smallest is `ratio_min` texels, where the steps are plain to everyone: who does not see
    /// them there guesses, and the convergence rule finds the estimate at this end.
    /// The largest keeps the penumbra of the edge, which lies within one texel of the middle,
    /// inside the picture: half of its shorter side less a texel.
    pub fn radius_range_px(&self, texel_px: f64) -> (f64, f64) {
        let shorter_px = self.pictures.width_px.min(self.pictures.height_px);
        let largest_px = f64::from(shorter_px) / 2.0 - texel_px;
        (self.pictures.ratio_min * texel_px, largest_px)
    }
}
