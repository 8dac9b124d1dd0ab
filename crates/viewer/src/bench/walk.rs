//! `--paths`: an adaptive map while camera or light moves, and the fixed one that it is set beside ([`Size::beside`]).
//!
//! Both maps see every frame, one after the other, so that a machine that gets busy does so for both. The sizes follow the
//! drop-in's own policy, with its patience before a map shrinks. After them comes the adaptive map once more, kept while it
//! is right (`Keep::Maps`): how many depth passes that saves, and what it costs in texels.
//!
//! *Pop* and *shimmer* look at fixed points of the world, one of every [`POINT_STRIDE`] x [`POINT_STRIDE`] pixels that
//! see a surface: at the beginning of the path, for `approach` at its end, where all that is seen was seen before. A `pan`
//! has few points that are seen throughout and is left out. The kernel of a point is turned by its own pixel all the
//! time, so what changes is the map: its size (pop), its place (shimmer), or with `sweep` the light.

use anyhow::{Context, Result};
use scumble::{Counters, Keep, Plan};
use scumble_reference::{Pop, Shimmer, pop, shimmer};
use serde::{Deserialize, Serialize};

use crate::bench::row::Key;
use crate::cli::Motion;
use crate::gbuffer::GBuffer;
use crate::progress::progress;
use crate::readback::read_texture;
use crate::size::Size;
use crate::stage::Stage;
use crate::timer::Timer;
use crate::variant::{Case, Variant, moving_settings};

/// Frames of a path: a second and a half at 30 a second, more than the 30 that the policy waits before a map shrinks.
const FRAMES: u32 = 48;
/// Of a picture of 1280 x 720 this leaves 57,600 points.
const POINT_STRIDE: u32 = 4;

/// A path seen by an adaptive map and by a fixed one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Walk {
    /// The adaptive case.
    #[serde(flatten)]
    pub key: Key,
    /// `approach`, `pan`, `creep` or `sweep`.
    pub path: String,
    /// The fixed size beside it; null without one.
    pub fixed: Option<String>,
    /// In the order of the path.
    pub frames: Vec<WalkFrame>,
    /// What the adaptive map shows at fixed points; null for `pan`.
    pub adaptive_points: Option<Points>,
    /// What the fixed map shows there.
    pub fixed_points: Option<Points>,
}

/// One frame of a path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WalkFrame {
    /// Texels of the adaptive maps together.
    pub texels: u64,
    /// Sides of their texels, metres at the reference plane: the size of a map in the world changes with what is seen,
    /// that of its texels only by the policy.
    pub texels_world: Vec<f64>,
    /// Whether the screen asks for more than the cap.
    pub capped: bool,
    /// Milliseconds of the whole adaptive shadow; null without timestamps.
    pub adaptive_ms: Option<f64>,
    /// Milliseconds of the fixed one.
    pub fixed_ms: Option<f64>,
    /// The adaptive maps again, which are kept while they are right.
    #[serde(default)]
    pub kept: KeptFrame,
}

/// A frame of adaptive maps whose boxes are on steps, so that casters that stand still need not be drawn again.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct KeptFrame {
    /// Maps that were drawn.
    pub drawn: u64,
    /// Maps that were as they had to be.
    pub skipped: u64,
    /// Texels of all maps.
    pub texels: u64,
    /// Milliseconds of the whole shadow; null without timestamps.
    pub ms: Option<f64>,
}

/// What changes at fixed points.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Points {
    /// Changes between frames, at a change of size and without one.
    pub pop: Pop,
    /// Spread over the frames.
    pub shimmer: Shimmer,
}

/// A map on its way.
struct Walker {
    variant: Variant,
    last_ms: Option<f64>,
    texels_world: Vec<Vec<f64>>,
    frames: Vec<Vec<f32>>,
}

impl Walker {
    fn new(keep: Keep, stage: &Stage, receivers: &GBuffer, case: Case) -> Result<Self> {
        let mut variant = Variant::keeping(keep, stage, receivers, case, moving_settings(&stage.setup))?;
        variant.settle(stage, receivers, &mut Timer::new(&stage.gpu))?;
        Ok(Self { variant, last_ms: None, texels_world: Vec::new(), frames: Vec::new() })
    }

    fn step(&mut self, stage: &Stage, receivers: &GBuffer, points: Option<&GBuffer>, timer: &mut Timer) -> Result<()> {
        let times = self.variant.frame(stage, receivers, timer)?;
        self.last_ms = (!times.is_empty()).then(|| times.iter().map(|(_, milliseconds)| milliseconds).sum());
        self.texels_world.push(texels_world(self.variant.plan()?));
        if let Some(points) = points {
            let visibility = self.variant.evaluate(stage, points)?;
            let pixels: Vec<f32> = bytemuck::pod_collect_to_vec(&read_texture(&stage.gpu, &visibility)?);
            self.frames.push(thinned(&pixels, points.size_px));
        }
        Ok(())
    }

    /// What the last step did, of the counters before it.
    fn frame_since(&self, before: &Counters) -> Result<KeptFrame> {
        let counters = self.variant.counters();
        Ok(KeptFrame {
            drawn: counters.map_passes - before.map_passes,
            skipped: counters.static_passes_skipped - before.static_passes_skipped,
            texels: self.variant.plan()?.texels(),
            ms: self.last_ms,
        })
    }

    fn points(&self, seen: &[bool]) -> Result<Option<Points>> {
        if self.frames.is_empty() {
            return Ok(None);
        }
        let switches: Vec<usize> =
            (1..self.texels_world.len()).filter(|&at| self.texels_world[at] != self.texels_world[at - 1]).collect();
        let series = (0..seen.len()).filter(|&point| seen[point]);
        let series: Vec<Vec<f32>> =
            series.map(|point| self.frames.iter().map(|frame| frame[point]).collect()).collect();
        Ok(Some(Points { pop: pop(&self.frames, &switches, seen)?, shimmer: shimmer(&series)? }))
    }
}

/// Walks one path; camera and light of the stage are where they were when it is done.
pub fn walk(stage: &mut Stage, size_px: [u32; 2], case: Case, fixed: Option<Size>, motion: Motion) -> Result<Walk> {
    let (camera, light) = (stage.setup.scene.camera, stage.setup.scene.light);
    let walked = walk_path(stage, size_px, case, fixed, motion);
    (stage.setup.scene.camera, stage.setup.scene.light) = (camera, light);
    walked
}

fn walk_path(stage: &mut Stage, size_px: [u32; 2], case: Case, fixed: Option<Size>, motion: Motion) -> Result<Walk> {
    let scene = &stage.setup.scene;
    let (name, path) = (scene.name.clone(), scene.path(motion.name()).context("a scene has every path")?);
    let poses: Vec<_> = (0..FRAMES).map(|frame| scene.moved(&path, time(frame))).collect();

    // The points, then the maps as they are before the first step.
    let seen_at = match motion {
        Motion::Approach => poses.last(),
        Motion::Creep | Motion::Sweep => poses.first(),
        Motion::Pan => None,
    };
    let points = match seen_at {
        Some(&pose) => Some(receivers_at(stage, size_px, pose)?),
        None => None,
    };
    let seen = match &points {
        Some(points) => {
            let surfaces: Vec<bool> = points.read_surfaces(&stage.gpu)?.iter().map(Option::is_some).collect();
            thinned(&surfaces, size_px)
        }
        None => Vec::new(),
    };
    let start = receivers_at(stage, size_px, poses[0])?;
    let mut adaptive = Walker::new(Keep::Nothing, stage, &start, case)?;
    let mut kept = Walker::new(Keep::Maps, stage, &start, case)?;
    let mut beside = fixed.map(|size| Walker::new(Keep::Nothing, stage, &start, Case { size, ..case })).transpose()?;

    // The path.
    let bar = progress(&format!("{name}: {} under {}", path.name, case.method.name()), u64::from(FRAMES));
    let mut timer = Timer::new(&stage.gpu);
    let mut frames = Vec::new();
    for pose in poses {
        let receivers = receivers_at(stage, size_px, pose)?;
        // The one that comes first finds the caches as the receivers left them, so they take turns.
        let mut turns: Vec<&mut Walker> = [&mut adaptive].into_iter().chain(&mut beside).collect();
        if frames.len() % 2 == 1 {
            turns.reverse();
        }
        for walker in turns {
            walker.step(stage, &receivers, points.as_ref(), &mut timer)?;
        }
        let before = kept.variant.counters();
        kept.step(stage, &receivers, None, &mut timer)?;
        let plan = adaptive.variant.plan()?;
        let capped = plan.views().iter().any(|view| view.size.capped);
        frames.push(WalkFrame {
            texels: plan.texels(),
            texels_world: texels_world(plan),
            capped,
            adaptive_ms: adaptive.last_ms,
            fixed_ms: beside.as_ref().and_then(|beside| beside.last_ms),
            kept: kept.frame_since(&before)?,
        });
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(Walk {
        key: Key::of(&name, &case),
        path: path.name.into(),
        fixed: fixed.map(|size| size.to_string()),
        frames,
        adaptive_points: adaptive.points(&seen)?,
        fixed_points: beside.map(|beside| beside.points(&seen)).transpose()?.flatten(),
    })
}

/// The longer side of the texels of each map, rounded to seven digits, below which they are one.
fn texels_world(plan: &Plan) -> Vec<f64> {
    let round = |side: f64| format!("{side:.6e}").parse().unwrap_or(side);
    plan.views().iter().map(|view| round(view.texel_world().max_element())).collect()
}

/// Place on the path of a frame, 0 to 1.
fn time(frame: u32) -> f64 {
    f64::from(frame) / f64::from(FRAMES - 1)
}

fn receivers_at(stage: &mut Stage, size_px: [u32; 2], pose: (scumble::Camera, scumble::Light)) -> Result<GBuffer> {
    (stage.setup.scene.camera, stage.setup.scene.light) = pose;
    stage.receivers(size_px, 1)
}

/// One of every few pixels, across and down.
fn thinned<T: Copy>(pixels: &[T], [width, height]: [u32; 2]) -> Vec<T> {
    let rows = (0..height).step_by(POINT_STRIDE as usize);
    let places = rows.flat_map(|y| (0..width).step_by(POINT_STRIDE as usize).map(move |x| y * width + x));
    places.map(|place| pixels[place as usize]).collect()
}

impl Walk {
    /// Adaptive time over fixed time of every frame that has both.
    pub fn time_ratios(&self) -> Vec<f64> {
        let ratio = |frame: &WalkFrame| Some(frame.adaptive_ms? / frame.fixed_ms.filter(|&fixed| fixed > 0.0)?);
        self.frames.iter().filter_map(ratio).collect()
    }

    /// Time of the kept maps over that of those drawn in every frame, of every frame that has both.
    pub fn kept_time_ratios(&self) -> Vec<f64> {
        let ratio = |frame: &WalkFrame| Some(frame.kept.ms? / frame.adaptive_ms.filter(|&drawn| drawn > 0.0)?);
        self.frames.iter().filter_map(ratio).collect()
    }

    /// Maps that were drawn and maps that could stay, over all frames.
    pub fn kept_passes(&self) -> [u64; 2] {
        [
            self.frames.iter().map(|frame| frame.kept.drawn).sum(),
            self.frames.iter().map(|frame| frame.kept.skipped).sum(),
        ]
    }

    /// Frames whose texels have another size than those of the frame before.
    pub fn switches(&self) -> usize {
        self.frames.windows(2).filter(|pair| pair[0].texels_world != pair[1].texels_world).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_thinned_by_rows_and_columns() {
        let pixels: Vec<u32> = (0..6 * 5).collect();
        assert_eq!(thinned(&pixels, [6, 5]), [0, 4, 24, 28]);
    }

    #[test]
    fn a_path_is_run_from_its_first_key_to_its_last() {
        assert_eq!((time(0), time(FRAMES - 1)), (0.0, 1.0));
    }
}
