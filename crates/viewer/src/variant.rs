//! One method at one size on a stage: the shadow map, its frames, and when an adaptive size has come to rest.

use anyhow::{Context, Result};
use scumble::{Aabb, Counters, Filter, Options, Plan, Settings, Shadows, SizeChoice};

use crate::casters::CasterPass;
use crate::cli::{Method, Size};
use crate::evaluation::EvaluationPass;
use crate::gbuffer::GBuffer;
use crate::readback::read_texture;
use crate::setup::Setup;
use crate::stage::Stage;
use crate::timer::{Timer, Times};

/// More rungs than any ladder of sizes has.
const RUNGS_ALL: u32 = 1000;
/// Frames without a change of size after which it counts as settled: more than a readback takes to arrive.
const SETTLED_FRAMES: u32 = 4;
/// Frames after which a size that still changes is taken as it is.
const SETTLING_FRAMES_MAX: u32 = 64;
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
    Settings { relation: setup.relation, cap: setup.cap, ..Settings::default() }
}

/// A shadow map under test.
pub struct Variant {
    /// What it is.
    pub case: Case,
    filter: Filter,
    shadows: Shadows,
    casters: CasterPass,
    evaluation: EvaluationPass,
    visibility: wgpu::Texture,
    bounds: Aabb,
    plan: Option<Plan>,
}

impl Variant {
    /// Allocates the map: at the cap of `settings` or the device's for an adaptive size, as large as it is used for a
    /// fixed one.
    pub fn new(stage: &Stage, gbuffer: &GBuffer, case: Case, settings: Settings) -> Result<Self> {
        let Case { method, size, softness } = case;
        let filter = stage.setup.filter(method, softness);
        let device_limit = stage.gpu.device.limits().max_texture_dimension_2d;
        let (cap, choice) = match size {
            Size::Adaptive => (settings.cap.min(device_limit), SizeChoice::Adaptive),
            Size::Fixed(texels) => (texels[0].max(texels[1]), SizeChoice::Fixed(texels)),
        };
        let settings = Settings { cap, ..settings };
        let options = Options { filter, size: choice, measure_stride: MEASURE_STRIDE, ..Options::default() };
        let shadows = Shadows::with_options(&stage.gpu.device, settings, options)
            .with_context(|| format!("--size {size} --method {}", method.name()))?;
        let casters = CasterPass::new(&stage.gpu, &shadows);
        let evaluation = EvaluationPass::new(&stage.gpu, &stage.gbuffer_pass.layout, &shadows, &filter);
        let visibility = stage.visibility_texture(gbuffer);
        let bounds = stage.setup.scene.bounds();
        Ok(Self { case, filter, shadows, casters, evaluation, visibility, bounds, plan: None })
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
        for _ in 0..SETTLING_FRAMES_MAX {
            self.frame(stage, gbuffer, timer)?;
            let next: Vec<_> = self.plan()?.views().iter().map(|view| view.size_texels).collect();
            unchanged = if next == sizes { unchanged + 1 } else { 0 };
            sizes = next;
            if unchanged == SETTLED_FRAMES {
                break;
            }
        }
        Ok(())
    }

    /// The plan of the last frame.
    pub fn plan(&self) -> Result<&Plan> {
        self.plan.as_ref().context("no frame has been planned")
    }

    /// Whether a frame has a demand pass.
    pub fn measures(&self) -> bool {
        self.case.size == Size::Adaptive
    }

    /// One frame as a renderer would do it: plan, depth pass, demand (adaptive sizes only), evaluation.
    pub fn frame(&mut self, stage: &Stage, gbuffer: &GBuffer, timer: &mut Timer) -> Result<Times> {
        let scene = &stage.setup.scene;
        self.shadows.read_demand();
        let light = stage.setup.light(self.case.softness)?;
        let plan = self.shadows.plan(&scene.camera, &self.bounds, &[light])?;
        self.shadows.upload(&stage.gpu.queue, &plan);

        let mut encoder = stage.gpu.encoder("frame");
        timer.start(&mut encoder);
        for view in plan.views() {
            let matrix = self.casters.matrix(&stage.gpu, view.clip_from_world);
            self.casters.draw(&mut self.shadows.begin(&mut encoder, view), &matrix, &stage.geometry);
        }
        timer.mark(&mut encoder, "depth");
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

    /// The demand of the screen under the map of the last frame, in metres at the reference plane; `None` without a
    /// penumbra on screen.
    pub fn demand_radius_world(&mut self, stage: &Stage, gbuffer: &GBuffer) -> Result<Option<f64>> {
        let Some(view) = self.plan()?.views().first().cloned() else { return Ok(None) };
        let mut encoder = stage.gpu.encoder("demand");
        self.measure(stage, gbuffer, &mut encoder)?;
        stage.gpu.finish(encoder)?;
        self.shadows.read_demand();
        Ok(self.shadows.measured_radius_world(&view).flatten())
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
        let pass = EvaluationPass::of_radii(&stage.gpu, &stage.gbuffer_pass.layout, &self.shadows, &self.filter);
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

    /// What the drop-in counted.
    pub fn counters(&self) -> Counters {
        self.shadows.counters()
    }
}
