//! One trial of the two-alternative task: two pictures of the same filtered edge, one of them made
//! from the straight edge, and the question "which one was the line?".

use scumble_stimuli::{Pattern, Shape, Stimulus};
use serde::{Deserialize, Serialize};

/// Which of the two pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// The left picture.
    Left,
    /// The right picture.
    Right,
}

impl Side {
    /// The other picture.
    pub fn other(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }
}

/// What one QUEST measures: a pattern, its contrast and its texel size.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Condition {
    /// How the silhouette lies on the texels.
    pub pattern: Pattern,
    /// Linear light of the lit side, above 0 to 1.
    pub contrast: f64,
    /// Side of a texel on the screen.
    pub texel_px: f64,
}

/// One trial, image for image.
///
/// `left` and `right` differ in their shape and their dithering alone: pattern, texel, radius,
/// contrast, phase, mirroring and polarity are the same, so that nothing but the artifact tells.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Trial {
    /// From 1, through the session; practice trials count by themselves.
    pub number: u32,
    /// From 1; 0 for practice.
    pub round: u32,
    /// What is measured.
    pub condition: Condition,
    /// The radius that QUEST asked for.
    pub placement_radius_px: f64,
    /// The radius that is shown: the placement, clamped to what the picture can hold.
    pub radius_px: f64,
    /// The left picture.
    pub left: Stimulus,
    /// The right picture.
    pub right: Stimulus,
    /// The side that shows the filtered line.
    pub line_side: Side,
}

impl Trial {
    /// Radius in texels, as shown.
    pub fn ratio(&self) -> f64 {
        self.radius_px / self.condition.texel_px
    }

    /// QUEST's intensity as shown: `x = log10(texel / radius)`, the larger the easier.
    pub fn intensity(&self) -> f64 {
        (self.condition.texel_px / self.radius_px).log10()
    }

    /// Whether the picture could not hold the radius that QUEST asked for.
    pub fn is_clamped(&self) -> bool {
        self.radius_px != self.placement_radius_px
    }

    /// Whether `answer` names the filtered line.
    pub fn is_correct(&self, answer: Side) -> bool {
        answer == self.line_side
    }

    /// What contradicts itself in a trial read from a file, in words.
    pub(crate) fn contradiction(&self) -> Option<String> {
        let (line, artifact) = match self.line_side {
            Side::Left => (self.left, self.right),
            Side::Right => (self.right, self.left),
        };
        if line.shape != Shape::Line || artifact.shape != Shape::Artifact {
            return Some("line_side that is not the side of the line".into());
        }
        let twin = Stimulus { shape: Shape::Line, dither_seed: line.dither_seed, ..artifact };
        if twin != line {
            return Some("two pictures that differ in more than shape and dithering".into());
        }
        if line.radius_px != self.radius_px
            || line.texel_px != self.condition.texel_px
            || line.contrast != self.condition.contrast
            || line.pattern != self.condition.pattern
        {
            return Some("pictures that do not show the condition and the radius".into());
        }
        if !(self.radius_px > 0.0 && self.condition.texel_px > 0.0) {
            return Some(format!("radius_px {}", self.radius_px));
        }
        line.check().err().map(|error| error.to_string())
    }
}
