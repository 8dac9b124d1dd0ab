//! Draws the pictures of a trial: side, phase, mirroring, polarity and dithering from the seed.

use scumble_stimuli::{Shape, Stimulus};

use crate::draw::{Draw, Purpose};
use crate::trial::{Condition, Side, Trial};

/// A trial's place in the session.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Seed of the session.
    pub(crate) seed: u64,
    /// [`Purpose::Pictures`] or [`Purpose::Practice`].
    pub(crate) purpose: Purpose,
    /// The trial's number.
    pub(crate) number: u32,
    /// Its round, 0 for practice.
    pub(crate) round: u32,
}

/// The trial at `place` with the radius asked for and the radius shown.
pub(crate) fn draw_trial(place: Place, condition: Condition, placement_radius_px: f64, radius_px: f64) -> Trial {
    let mut draw = Draw::new(place.seed, place.purpose, place.number);
    let line_side = if draw.coin() { Side::Left } else { Side::Right };
    let line = Stimulus {
        pattern: condition.pattern,
        shape: Shape::Line,
        texel_px: condition.texel_px,
        radius_px,
        contrast: condition.contrast,
        phase: draw.unit(),
        mirrored: draw.coin(),
        inverted: draw.coin(),
        dither_seed: Some(draw.bits32().into()),
    };
    let artifact = Stimulus { shape: Shape::Artifact, dither_seed: Some(draw.bits32().into()), ..line };
    let (left, right) = match line_side {
        Side::Left => (line, artifact),
        Side::Right => (artifact, line),
    };
    Trial {
        number: place.number,
        round: place.round,
        condition,
        placement_radius_px,
        radius_px,
        left,
        right,
        line_side,
    }
}
