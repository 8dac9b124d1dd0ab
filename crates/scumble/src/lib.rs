//! Adaptive soft shadow maps for wgpu renderers: the smallest map whose texels nobody sees under the filter.
//!
//! The method is in [`scumble_core`]; this crate runs it. A frame:
//!
//! 1. [`Shadows::read_demand`] takes what the GPU measured some frames ago, if anything has arrived.
//! 2. [`Shadows::plan`] turns camera, scene bounds and lights into [`View`]s: matrix, viewport, layer of each map.
//! 3. [`Shadows::upload`] tells the shaders.
//! 4. [`Shadows::begin`] gives a depth-only pass for each view; the caller draws its casters. [`Shadows::prefilter`] then
//!    makes the moments of a variance shadow map; with other filters it does nothing.
//!    Casters that stand still need no pass while their map stays: [`Shadows::begin_static`], [`Keep`].
//! 5. [`Shadows::measure`], optional, looks at a depth prepass and finds the radii on screen, of which the smallest (Kreuzer
//!    2017, Eq. 5.12) or a quantile ([`Statistic`]) sizes the map, and where everything is lit or dark: there the shading
//!    needs one lookup and no filter.
//!    Renderers without a prepass measure while they shade: [`FragmentDemand`].
//! 6. The caller shades: [`shadow_wgsl`] before its shader, [`Shadows::bind_group`] bound, `shadow_visibility` called.
//!
//! ```no_run
//! # use scumble::*;
//! # fn frame(device: &wgpu::Device, queue: &wgpu::Queue, encoder: &mut wgpu::CommandEncoder, prepass: &wgpu::TextureView,
//! #     camera: Camera, bounds: Aabb, lights: Vec<Light>) -> Result<(), Error> {
//! # fn draw_casters(_: &mut wgpu::RenderPass<'_>, _: glam::Mat4) {}
//! let mut shadows = Shadows::new(device, Settings { cap: 2048, ..Settings::default() })?;
//! // Each frame:
//! shadows.read_demand();
//! let plan = shadows.plan(&camera, &bounds, &lights)?;
//! shadows.upload(queue, &plan);
//! for view in plan.views() {
//!     draw_casters(&mut shadows.begin(encoder, view), view.clip_from_world);
//! }
//! shadows.prefilter(encoder);
//! shadows.measure(queue, encoder, prepass, &camera)?;
//! # Ok(()) }
//! ```
//!
//! It takes the types of wgpu 30. The caller keeps device, queue, encoder, scene and camera. This crate never submits, never
//! waits, and allocates at creation, at the first `measure`, and when the prepass changes its size. A directional light has
//! one map or a cascade of them ([`Options::cascades`]), a spot has one, a point light up to six: faces of 90 degrees and what
//! its filter reaches beyond them, each fitted to what is seen in it and with a size of its own, none where nothing is seen.
//!
//! Measuring and variance shadow maps need compute shaders; all else works within
//! `wgpu::Limits::downlevel_webgl2_defaults()`: then bounds and the filter's radius give the sizes, and PCSS, which has no
//! radius, takes the cap's. A prepass has depths from 0 (near) to 1, as [`Camera::clip_from_world`] makes them; a renderer
//! whose depths are reversed uses [`FragmentDemand`], or measures nothing. Files, clocks, threads, network and processes are
//! not used; a build for wasm32 has not been tried.

mod atlas;
mod bindings;
mod blocks;
mod counters;
mod demand;
mod error;
mod fragments;
mod kept;
mod maps;
mod measure;
mod moments;
mod options;
mod plan;
mod readback;
mod seen;
mod shaders;
mod shadows;
mod share;
mod slices;
pub mod uniforms;
mod view;

pub use counters::{BlockCounts, Counters};
pub use error::Error;
pub use fragments::{FragmentDemand, FragmentsStorage};
pub use measure::NOTHING as MEASURE_NOTHING;
pub use options::{Keep, Options, SizeChoice};
pub use plan::filter_constant;
pub use scumble_core::{self, Aabb, AtCap, Camera, Face, Filter, Light, Settings, Splits, Statistic};
pub use shaders::{
    CLEAR_WGSL, COPY_WGSL, FILTER_OVERRIDE, classify_wgsl, fragments_wgsl, measure_wgsl, shadow_wgsl, vsm_box_wgsl,
    vsm_reduce_wgsl,
};
pub use shadows::Shadows;
pub use uniforms::{BLOCKER_TAPS, CASCADES_MAX, LIGHT_MAPS_MAX, LIGHTS_MAX, MAPS_MAX, MOMENT_TAPS, PCF_TAPS};
pub use view::{Plan, View};
