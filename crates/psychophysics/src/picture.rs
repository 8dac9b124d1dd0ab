//! Draws the pictures of a trial: side, phase, mirroring, polarity, tilt and dithering from the seed.

use scumble_stimuli::{Pattern, Shape, Stimulus};

use crate::draw::{Draw, Purpose};
use crate::protocol::{Protocol, Task};
use crate::trial::{Condition, Pictures, Role, Trial};

/// What is to be drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Request {
    /// Seed of the session.
    pub(crate) seed: u64,
    /// The trial's number.
    pub(crate) number: u32,
    /// Its round, 0 for practice.
    pub(crate) round: u32,
    /// Why it is shown.
    pub(crate) role: Role,
    /// The staircase that asks.
    pub(crate) track: Option<u32>,
    /// What is measured.
    pub(crate) condition: Condition,
    /// The radius asked for.
    pub(crate) placement_radius_px: f64,
}

/// The trial with its pictures; the radius is clamped to what a picture can hold.
pub(crate) fn draw_trial(protocol: &Protocol, request: Request) -> Trial {
    let Request { seed, number, round, role, track, condition, placement_radius_px } = request;
    let (smallest_px, largest_px) = protocol.radius_range_px(condition.texel_px);
    let radius_px = placement_radius_px.clamp(smallest_px, largest_px);
    let purpose = if role == Role::Practice { Purpose::Practice } else { Purpose::Pictures };
    let mut draw = Draw::new(seed, purpose, number);
    let coin = draw.coin();
    let first = Stimulus {
        pattern: condition.pattern,
        shape: Shape::Line,
        kernel: condition.kernel,
        texel_px: condition.texel_px,
        radius_px,
        contrast: condition.contrast,
        encoding: protocol.pictures.encoding,
        phase: draw.unit(),
        mirrored: draw.coin(),
        inverted: draw.coin(),
        tilt_rad: 0.0,
        dither_seed: None,
    };
    let mut of_shape = |shape| {
        let turn = 2.0 * draw.unit() - 1.0;
        let noise = draw.bits32();
        // A stair's line runs with its steps: no tilt tells them apart.
        let tilt_rad = if condition.pattern == Pattern::Stair { 0.0 } else { protocol.pictures.tilt_range_rad * turn };
        Stimulus { shape, tilt_rad, dither_seed: protocol.pictures.dithered.then_some(noise.into()), ..first }
    };
    let pictures = match protocol.task {
        Task::TwoAlternative => {
            let (line, artifact) = (of_shape(Shape::Line), of_shape(Shape::Artifact));
            match coin {
                true => Pictures::Pair { left: line, right: artifact },
                false => Pictures::Pair { left: artifact, right: line },
            }
        }
        Task::YesNo => {
            let is_line = role == Role::Line || (role == Role::Practice && coin);
            Pictures::Single { picture: of_shape(if is_line { Shape::Line } else { Shape::Artifact }) }
        }
    };
    Trial { number, round, role, track, condition, placement_radius_px, radius_px, pictures }
}
