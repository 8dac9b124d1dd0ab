//! Which ratio c? The error and the violations of adaptive maps whose texels are chosen by other ratios than the
//! relation's.
//!
//! Every point is an adaptive map at its own c, compared with the same truth as the rows. A violation is still judged by
//! the relation of the run: it says how much of the penumbra shows texels to a person of that ratio. Near c the violations
//! end; the error goes on falling, without a person who sees it.

use anyhow::Result;
use scumble::scumble_core::Relation;
use scumble::{Settings, Statistic};
use serde::{Deserialize, Serialize};

use crate::bench::comparison::{Screen, Truths, compare};
use crate::cli::Method;
use crate::gbuffer::GBuffer;
use crate::size::Size;
use crate::stage::Stage;
use crate::timer::Timer;
use crate::variant::{Case, Variant, still_settings};

/// Texels per filter radius, from a kernel as wide as a texel to three times the published ratio, which is among them; in
/// steps of a half to a third of an octave, smaller ones where people's thresholds lie.
const RATIOS: [f64; 12] = [0.5, 0.75, 1.0, 1.4, 2.0, 2.5, 3.0, 3.47, 4.2, 5.5, 7.5, 10.0];

/// An adaptive map chosen by one ratio.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SweepPoint {
    /// Name of the scene.
    pub scene: String,
    /// `pcf`, `pcss` or `vsm`.
    pub method: String,
    /// Texels per filter radius that the size was chosen by.
    pub ratio: f64,
    /// Texels of all maps together.
    pub texels: u64,
    /// Whether the cap allowed fewer texels than the ratio asks for.
    pub capped: bool,
    /// RMS error in the penumbra.
    pub rms: f64,
    /// 99th percentile of the error in the penumbra.
    pub p99: f64,
    /// Share of the length of edges that is tilted by more than observers miss; null where there are too few.
    pub tilt_visible_share: Option<f64>,
    /// RMS error in the penumbra against the light; null for pcf and vsm.
    pub light_rms: Option<f64>,
    /// Share of the penumbra that violates the run's relation; null where nothing is filtered.
    pub violation_share: Option<f64>,
}

/// The points of one scene and method, from the smallest ratio to the largest; none for a filter without softness.
pub fn sweep(
    stage: &Stage,
    receivers: &GBuffer,
    (method, softness): (Method, f64),
    screen: &Screen,
    truths: &Truths,
) -> Result<Vec<SweepPoint>> {
    if method == Method::None {
        return Ok(Vec::new());
    }
    let mut timer = Timer::new(&stage.gpu);
    let point = |ratio: f64| {
        let relation = Relation::exact(ratio)?;
        let settings = Settings { relation, ..still_settings(&stage.setup) };
        let case = Case { method, size: Size::Adaptive(Statistic::default()), softness };
        let mut variant = Variant::new(stage, receivers, case, settings)?;
        variant.settle(stage, receivers, &mut timer)?;
        let visibility = variant.read_visibility(stage)?;
        let radii = variant.read_radii(stage, receivers)?;
        let comparison = compare(stage, &variant, screen, &visibility, truths, &radii)?;
        let plan = variant.plan()?;
        Ok(SweepPoint {
            scene: stage.setup.scene.name.clone(),
            method: method.name().into(),
            ratio,
            texels: plan.texels(),
            capped: plan.views().iter().any(|view| view.size.capped),
            rms: comparison.penumbra.rms,
            p99: comparison.penumbra.p99,
            tilt_visible_share: comparison.edges.map(|edges| edges.tilt_visible_share),
            light_rms: comparison.light.map(|light| light.penumbra.rms),
            violation_share: comparison.violation_share,
        })
    };
    RATIOS.into_iter().map(point).collect()
}
