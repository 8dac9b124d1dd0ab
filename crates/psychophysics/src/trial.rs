//! One trial: what is shown, why, and what an answer to it means.

use scumble_stimuli::{Kernel, Pattern, Shape, Stimulus};
use serde::{Deserialize, Serialize};

use crate::error::{Error, require};

/// An answer to the question of a trial.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    /// "Which one was the line?" The left picture.
    Left,
    /// The right picture.
    Right,
    /// "Was the original image a line?" Yes.
    Yes,
    /// No.
    No,
}

/// What one staircase measures.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Condition {
    /// How the silhouette lies on the texels.
    pub pattern: Pattern,
    /// Lit side relative to the brightest, in the protocol's encoding, above 0 to 1.
    pub contrast: f64,
    /// The filter.
    pub kernel: Kernel,
    /// Side of a texel on the screen.
    pub texel_px: f64,
}

/// Why a trial is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// With feedback, before the measurement.
    Practice,
    /// A staircase learns from the answer.
    Measure,
    /// The filtered line alone, at a radius that a staircase would choose: "no" is a false alarm.
    Line,
    /// An artifact that everyone sees who looks.
    Catch,
}

/// The pictures of a trial.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Pictures {
    /// The same edge twice, one of them filtered from the straight edge. They differ in shape,
    /// dithering and tilt alone, so that nothing but the artifact tells.
    Pair {
        /// The left picture.
        left: Stimulus,
        /// The right picture.
        right: Stimulus,
    },
    /// One picture.
    Single {
        /// The picture.
        picture: Stimulus,
    },
}

/// One trial, image for image.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Trial {
    /// From 1, through the session; practice trials count by themselves.
    pub number: u32,
    /// From 1; 0 for practice.
    pub round: u32,
    /// Why it is shown.
    pub role: Role,
    /// The staircase that chose the radius, its index in the order of the session.
    pub track: Option<u32>,
    /// What is measured.
    pub condition: Condition,
    /// The radius asked for.
    pub placement_radius_px: f64,
    /// The radius that is shown: the placement, clamped to what the picture can hold.
    pub radius_px: f64,
    /// The pictures.
    pub pictures: Pictures,
}

impl Answer {
    /// Its word in files.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
            Self::Yes => "yes",
            Self::No => "no",
        }
    }
}

impl Role {
    /// Its word in files.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Practice => "practice",
            Self::Measure => "measure",
            Self::Line => "line",
            Self::Catch => "catch",
        }
    }
}

impl Pictures {
    /// The pictures from left to right.
    pub fn all(&self) -> Vec<&Stimulus> {
        match self {
            Self::Pair { left, right } => vec![left, right],
            Self::Single { picture } => vec![picture],
        }
    }

    /// The answers that the question over these pictures allows.
    pub fn answers(&self) -> [Answer; 2] {
        match self {
            Self::Pair { .. } => [Answer::Left, Answer::Right],
            Self::Single { .. } => [Answer::Yes, Answer::No],
        }
    }

    /// The right one of them.
    pub fn right_answer(&self) -> Answer {
        match self {
            Self::Pair { left: Stimulus { shape: Shape::Line, .. }, .. } => Answer::Left,
            Self::Pair { .. } => Answer::Right,
            Self::Single { picture: Stimulus { shape: Shape::Line, .. } } => Answer::Yes,
            Self::Single { .. } => Answer::No,
        }
    }
}

impl Trial {
    /// Radius in texels, as shown.
    pub fn ratio(&self) -> f64 {
        self.radius_px / self.condition.texel_px
    }

    /// The staircase's intensity as shown: `x = log10(texel / radius)`, the larger the easier.
    pub fn intensity(&self) -> f64 {
        libm::log10(self.condition.texel_px / self.radius_px)
    }

    /// Whether the picture could not hold the radius asked for.
    pub fn is_clamped(&self) -> bool {
        self.radius_px != self.placement_radius_px
    }

    /// Whether `answer` is the right one. A staircase's response of 1 is a right answer: the line
    /// was found, or the single artifact was not taken for one.
    pub fn is_correct(&self, answer: Answer) -> bool {
        answer == self.pictures.right_answer()
    }

    /// Refuses a trial, read from a file, that contradicts itself; the error names the key.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let is_practice = self.role == Role::Practice;
        require(is_practice == (self.round == 0), "trial.round", self.round, "0 for practice, else 1 or more")?;
        let has_track = matches!(self.role, Role::Measure | Role::Line);
        let track = self.track.map_or("null".into(), |track| track.to_string());
        let allowed = "the index of a staircase for the roles measure and line, else null";
        require(has_track == self.track.is_some(), "trial.track", track, allowed)?;
        for (key, length) in
            [("trial.condition.texel_px", self.condition.texel_px), ("trial.radius_px", self.radius_px)]
        {
            require(length.is_finite() && length > 0.0, key, length, "a finite length above 0")?;
        }
        let allowed = "a line and an artifact, or the one that the role names";
        require(self.has_shapes_of_role(), "trial.pictures", format!("of the role {}", self.role.name()), allowed)?;
        self.pictures.all().into_iter().try_for_each(|picture| self.check_picture(picture))
    }

    fn has_shapes_of_role(&self) -> bool {
        match (self.role, self.pictures) {
            (role, Pictures::Pair { left, right }) => left.shape != right.shape && role != Role::Line,
            (Role::Practice, Pictures::Single { .. }) => true,
            (role, Pictures::Single { picture }) => (picture.shape == Shape::Line) == (role == Role::Line),
        }
    }

    fn check_picture(&self, picture: &Stimulus) -> Result<(), Error> {
        let Condition { pattern, contrast, kernel, texel_px } = self.condition;
        let first = self.pictures.all()[0];
        let expected = Stimulus {
            pattern,
            contrast,
            kernel,
            texel_px,
            radius_px: self.radius_px,
            shape: picture.shape,
            dither_seed: picture.dither_seed,
            tilt_rad: picture.tilt_rad,
            ..*first
        };
        let allowed = "pictures of the trial's condition and radius, which differ in shape, dithering and tilt alone";
        require(*picture == expected, "trial.pictures", "of something else", allowed)?;
        picture.check().map_err(|error| Error::parameter("trial.pictures", error, "numbers that can be drawn"))
    }
}
