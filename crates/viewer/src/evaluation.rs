//! The full-screen pass that asks the drop-in for the visibility of every receiver.

use scumble::{FILTER_OVERRIDE, Filter, Shadows, filter_constant, shadow_wgsl};

use crate::device::Gpu;
use crate::fullscreen;
use crate::gbuffer::GBuffer;
use crate::stage::VISIBILITY_FORMAT;

/// Group of the drop-in's resources; group 0 is the G-buffer.
const SHADOW_GROUP: u32 = 1;

/// The pipeline for one filter.
pub struct EvaluationPass {
    pipeline: wgpu::RenderPipeline,
}

/// What is written of every receiver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Output {
    /// Share of the light that arrives.
    Visibility,
    /// Radius of the filter before its lower clamp.
    Radius,
}

impl EvaluationPass {
    /// The filter is a constant for the compiler to fold.
    pub fn new(
        output: Output,
        gpu: &Gpu,
        gbuffer_layout: &wgpu::BindGroupLayout,
        shadows: &Shadows,
        filter: &Filter,
    ) -> Self {
        let entry_point = match output {
            Output::Visibility => "evaluate",
            Output::Radius => "radius",
        };
        let source = [
            include_str!("../shader/gbuffer_read.wgsl"),
            &shadow_wgsl(SHADOW_GROUP),
            include_str!("../shader/evaluation.wgsl"),
        ]
        .concat();
        let constants = [(FILTER_OVERRIDE, filter_constant(filter))];
        let layouts = [gbuffer_layout, shadows.bind_group_layout()];
        let pipeline =
            fullscreen::pipeline(gpu, entry_point, &source, entry_point, &constants, &layouts, VISIBILITY_FORMAT);
        Self { pipeline }
    }

    /// Fills a texture of the G-buffer's size.
    pub fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        gbuffer: &GBuffer,
        shadows: &Shadows,
        visibility: &wgpu::Texture,
    ) {
        let groups = [&gbuffer.bind_group, shadows.bind_group()];
        fullscreen::draw(encoder, "evaluation", &self.pipeline, &groups, visibility);
    }
}
