//! The pipelines that all maps of a scene share, each built when it is first asked for. A renderer builds them once, too;
//! and a software renderer that compiles a filter anew for every map spends most of its time on that.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use scumble::{Filter, Shadows, filter_constant};

use crate::casters::CasterPass;
use crate::device::Gpu;
use crate::evaluation::{EvaluationPass, Output};

/// Pipelines by what they do. The drop-in's layouts are the same for every [`Shadows`] of a device.
#[derive(Default)]
pub struct Pipelines {
    casters: RefCell<Option<Rc<CasterPass>>>,
    evaluations: RefCell<BTreeMap<(Output, u32), Rc<EvaluationPass>>>,
}

impl Pipelines {
    /// Draws casters into the maps.
    pub fn casters(&self, gpu: &Gpu, shadows: &Shadows) -> Rc<CasterPass> {
        self.casters.borrow_mut().get_or_insert_with(|| Rc::new(CasterPass::new(gpu, shadows))).clone()
    }

    /// Runs a filter at every pixel.
    pub fn evaluation(
        &self,
        output: Output,
        gpu: &Gpu,
        gbuffer_layout: &wgpu::BindGroupLayout,
        shadows: &Shadows,
        filter: &Filter,
    ) -> Rc<EvaluationPass> {
        let build = || Rc::new(EvaluationPass::new(output, gpu, gbuffer_layout, shadows, filter));
        let key = (output, filter_constant(filter) as u32);
        self.evaluations.borrow_mut().entry(key).or_insert_with(build).clone()
    }
}
