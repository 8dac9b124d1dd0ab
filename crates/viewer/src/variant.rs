//! One method at one size on a stage: the shadow map, its frames, and when an adaptive size has come to rest.

use std::rc::Rc;

use anyhow::{Context, Result};
use scumble::{Aabb, Counters, Filter, Keep, Options, Plan, Settings, Shadows, SizeChoice};

use crate::casters::CasterPass;
use crate::cli::Method;
use crate::evaluation::{EvaluationPass, Output};
use crate::gbuffer::GBuffer;
use crate::readback::read_texture;
use crate::record::MapRecord;
use crate::setup::Setup;
use crate::size::Size;
use crate::stage::Stage;
use crate::timer::{Timer, Times};

/// More rungs than any ladder of sizes has.
const RUNGS_ALL: u32 = 1000;
/// Frames that a change of size may be late: more than a readback takes to arrive.
const LATE_FRAMES: u32 = 4;
/// Changes of size after which one that still changes is taken as it is.
const SETTLING_CHANGES_MAX: u32 = 8;
/// Every how many pixels, across and down, the demand pass looks at one.
const MEASURE_STRIDE: u32 = 4;

/// What is under test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// How the map is filtered.
    pub method: Method,
    /// How its size is chosen.
    pub size: Size,
    /// Times the setup's own filter radius and light size.
    pub softness: f64,
}

/// Settings for a still picture: nothing flickers, so sizes shrink as soon and as far as the demand allows.
pub fn still_settings(setup: &Setup) -> Settings {
    Settings { shrink_after_frames: 1, shrink_rungs: RUNGS_ALL, ..moving_settings(setup) }
}

/// Settings for a picture that moves: the drop-in's own.
pub fn moving_settings(setup: &Setup) -> Settings {
    Settings { relation: setup.relation, cap: setup.cap, at_cap: setup.at_cap, ..Settings::default() }
}

/// A shadow map under test.
pub struct Variant {
    /// What it is.
    pub case: Case,
    filter: Filter,
    shadows: Shadows,
    casters: Rc<CasterPass>,
    evaluation: Rc<EvaluationPass>,
    visibility: wgpu::Texture,
    bounds: Aabb,
    plan: Option<Plan>,
    allocations_at_rest: u64,
}

impl Variant {
    /// Allocates the map: at the cap of `settings` or the device's for an adaptive size, as large as it is used for a
    /// fixed one.
    pub fn new(stage: &Stage, gbuffer: &GBuffer, case: Case, settings: Settings) -> Result<Self> {
        Self::keeping(Keep::Nothing, stage, gbuffer, case, settings)
    }

    /// The same, whose casters are drawn only when their map changes, unless nothing is kept.
    pub fn keeping(keep: Keep, stage: &Stage, gbuffer: &GBuffer, case: Case, settings: Settings) -> Result<Self> {
        let Case { method, size, softness } = case;
        let filter = stage.setup.filter(method, softness);
        let device_limit = stage.gpu.device.limits().max_texture_dimension_2d;
        let (settings, choice) = match size {
            Size::Adaptive(statistic) => {
                let cap = settings.cap.min(device_limit);
                (Settings { cap, statistic, ..settings }, SizeChoice::Adaptive)
            }
            Size::Fixed(texels) | Size::Blocks(texels) => {
                let cap = texels[0].max(texels[1]);
                (Settings { cap, ..settings }, SizeChoice::Fixed(texels))
            }
        };
        let options = Options {
            filter,
            size: choice,
            maps: stage.setup.map_count(),
            cascades: stage.setup.cascades,
            measure_stride: MEASURE_STRIDE,
            keep,
            ..Options::default()
        };
        let shadows = Shadows::with_options(&stage.gpu.device, settings, options)
            .with_context(|| format!("--size {size} --method {}", method.name()))?;
        let casters = stage.pipelines.casters(&stage.gpu, &shadows);
        let layout = &stage.gbuffer_pass.layout;
        let evaluation = stage.pipelines.evaluation(Output::Visibility, &stage.gpu, layout, &shadows, &filter);
        let visibility = stage.visibility_texture(gbuffer);
        let bounds = stage.setup.scene.bounds();
        Ok(Self { case, filter, shadows, casters, evaluation, visibility, bounds, plan: None, allocations_at_rest: 0 })
    }

    /// Renders frames until the size rests. A fixed size rests at once; what the screen asks of it is measured, so that
    /// its plan says what it achieves.
    pub fn settle(&mut self, stage: &Stage, gbuffer: &GBuffer, timer: &mut Timer) -> Result<()> {
        if !self.measures() {
            self.frame(stage, gbuffer, timer)?;
            self.demand_radius_world(stage, gbuffer)?;
        }
        let mut sizes = Vec::new();
        let mut unchanged = 0;
        let patience = self.settings().shrink_after_frames + LATE_FRAMES;
        for _ in 0..SETTLING_CHANGES_MAX * patience {
            self.frame(stage, gbuffer, timer)?;
            let next: Vec<_> = self.plan()?.views().iter().map(|view| view.size_texels).collect();
            unchanged = if next == sizes { unchanged + 1 } else { 0 };
            sizes = next;
            if unchanged == patience {
                break;
            }
        }
        self.allocations_at_rest = self.counters().allocations;
        Ok(())
    }

    /// Objects of the device that frames have created since the size came to rest.
    pub fn allocations_since_rest(&self) -> u64 {
        self.counters().allocations - self.allocations_at_rest
    }

    /// The plan of the last frame.
    pub fn plan(&self) -> Result<&Plan> {
        self.plan.as_ref().context("no frame has been planned")
    }

    /// Whether a frame has a demand pass.
    pub fn measures(&self) -> bool {
        !matches!(self.case.size, Size::Fixed(_))
    }

    /// One frame as a renderer would do it: plan, depth pass, moments (vsm only), demand (adaptive sizes only), evaluation.
    pub fn frame(&mut self, stage: &Stage, gbuffer: &GBuffer, timer: &mut Timer) -> Result<Times> {
        let scene = &stage.setup.scene;
        self.shadows.read_demand();
        let light = stage.setup.light(self.case.softness)?;
        let plan = self.shadows.plan(&scene.camera, &self.bounds, &[light])?;
        self.shadows.upload(&stage.gpu.queue, &plan);

        let mut encoder = stage.gpu.encoder("frame");
        timer.start(&mut encoder);
        for view in plan.views() {
            let pass = match self.shadows.options().keep {
                Keep::Nothing => Some(self.shadows.begin(&mut encoder, view)),
                Keep::Maps | Keep::StaticLayers => self.shadows.begin_static(&mut encoder, view),
            };
            if let Some(mut pass) = pass {
                let matrix = self.casters.matrix(&stage.gpu, view.clip_from_world);
                self.casters.draw(&mut pass, &matrix, &stage.geometry);
            }
        }
        timer.mark(&mut encoder, "depth");
        if let Filter::Vsm { .. } = self.filter {
            self.shadows.prefilter(&mut encoder);
            timer.mark(&mut encoder, "moments");
        }
        if self.measures() {
            self.measure(stage, gbuffer, &mut encoder)?;
            timer.mark(&mut encoder, "demand");
        }
        self.evaluation.draw(&mut encoder, gbuffer, &self.shadows, &self.visibility);
        timer.mark(&mut encoder, "evaluation");
        timer.resolve(&mut encoder);
        stage.gpu.finish(encoder)?;
        self.plan = Some(plan);
        timer.read(&stage.gpu)
    }

    /// The demand of the screen under the maps of the last frame, in metres at the reference plane: the smallest of all
    /// maps; `None` without a penumbra on screen.
    pub fn demand_radius_world(&mut self, stage: &Stage, gbuffer: &GBuffer) -> Result<Option<f64>> {
        let mut encoder = stage.gpu.encoder("demand");
        self.measure(stage, gbuffer, &mut encoder)?;
        stage.gpu.finish(encoder)?;
        self.shadows.read_demand();
        let radii = self.plan()?.views().iter().filter_map(|view| self.shadows.measured_radius_world(view).flatten());
        Ok(radii.min_by(f64::total_cmp))
    }

    fn measure(&mut self, stage: &Stage, gbuffer: &GBuffer, encoder: &mut wgpu::CommandEncoder) -> Result<()> {
        let camera = &stage.setup.scene.camera;
        Ok(self.shadows.measure(&stage.gpu.queue, encoder, &gbuffer.depth_view, camera)?)
    }

    /// Visibility of every pixel of the last frame, rows from top to bottom.
    pub fn read_visibility(&self, stage: &Stage) -> Result<Vec<f32>> {
        Ok(bytemuck::pod_collect_to_vec(&read_texture(&stage.gpu, &self.visibility)?))
    }

    /// Filter radius of every pixel under the map of the last frame, before the lower clamp, at the reference plane.
    pub fn read_radii(&self, stage: &Stage, gbuffer: &GBuffer) -> Result<Vec<f32>> {
        let layout = &stage.gbuffer_pass.layout;
        let pass = stage.pipelines.evaluation(Output::Radius, &stage.gpu, layout, &self.shadows, &self.filter);
        let radii = stage.visibility_texture(gbuffer);
        let mut encoder = stage.gpu.encoder("radii");
        pass.draw(&mut encoder, gbuffer, &self.shadows, &radii);
        stage.gpu.finish(encoder)?;
        Ok(bytemuck::pod_collect_to_vec(&read_texture(&stage.gpu, &radii)?))
    }

    /// Evaluates the map of the last frame on another G-buffer of the same camera, for a picture with more samples.
    pub fn evaluate(&mut self, stage: &Stage, gbuffer: &GBuffer) -> Result<wgpu::Texture> {
        // The blocks that were found are of the frame's pixels.
        let plan = self.plan()?.clone();
        self.shadows.upload(&stage.gpu.queue, &plan);
        let visibility = stage.visibility_texture(gbuffer);
        let mut encoder = stage.gpu.encoder("evaluation");
        self.evaluation.draw(&mut encoder, gbuffer, &self.shadows, &visibility);
        stage.gpu.finish(encoder)?;
        Ok(visibility)
    }

    /// What sizes are chosen by.
    pub fn settings(&self) -> &Settings {
        self.shadows.settings()
    }

    /// Texels per side of the texture that the map is a part of.
    pub fn cap(&self) -> u32 {
        self.shadows.settings().cap
    }

    /// The maps of the last frame, with the blocks of pixels that skipped the filter where some may.
    pub fn map_records(&self) -> Result<Vec<MapRecord>> {
        let skips = self.measures() && matches!(self.filter, Filter::Pcf { .. } | Filter::Pcss);
        let blocks = |view| if skips { self.shadows.measured_blocks(view) } else { None };
        Ok(self.plan()?.views().iter().map(|view| MapRecord::of(view, self.cap(), blocks(view))).collect())
    }

    /// What the drop-in counted.
    pub fn counters(&self) -> Counters {
        self.shadows.counters()
    }
}
