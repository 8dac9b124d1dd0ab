//! What can be wrong with what a caller passes in. Each message says what was found and what is allowed.

use scumble_core::Statistic;

use crate::options::Keep;
use crate::uniforms::{LIGHTS_MAX, MAPS_MAX};

/// Why a call of this crate was refused.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The fit, the settings or the sizes were refused by the method itself.
    #[error(transparent)]
    Method(#[from] scumble_core::Error),
    /// The cap does not fit the device.
    #[error(
        "the cap is {cap} texels a side, the device allows 1 to {device_limit} (`Limits::max_texture_dimension_2d`)"
    )]
    CapOutsideDevice {
        /// What the settings say.
        cap: u32,
        /// What the device allows.
        device_limit: u32,
    },
    /// A budget that holds no maps.
    #[error("the budget is {found} bytes; {maps} maps of the least size need {least} (`Settings::budget_bytes`)")]
    Budget {
        /// What the settings say, bytes.
        found: u64,
        /// Least that would do, bytes.
        least: u64,
        /// Maps that were asked for.
        maps: u32,
    },
    /// Fixed sizes that do not lie beside each other within the budget.
    #[error(
        "{maps} maps of the fixed size do not fit the budget's page of {side} x {side} texels; smaller ones, or a larger \
         `Settings::budget_bytes`, are possible"
    )]
    BeyondBudget {
        /// Maps of the plan.
        maps: usize,
        /// Side of the page, texels.
        side: u32,
    },
    /// The number of maps is not possible.
    #[error("{found} maps were asked for; 1 to {MAPS_MAX} are possible")]
    MapCount {
        /// What was asked for.
        found: u32,
    },
    /// The number of maps cannot change.
    #[error(
        "the options ask for {found} maps, but {allocated} were allocated; the number of maps is fixed at creation"
    )]
    MapsAllocated {
        /// What was asked for.
        found: u32,
        /// Layers of the texture.
        allocated: u32,
    },
    /// The filter needs textures that were not allocated.
    #[error(
        "the options ask for vsm, whose moments are allocated at creation; these shadows were created with another \
         filter, so none, pcf and pcss are possible"
    )]
    MomentsAllocated,
    /// Static casters need layers that were not allocated.
    #[error(
        "the options ask for Keep::{found:?}; layers of static casters are allocated at creation, so shadows created with \
         Keep::StaticLayers stay with it, and all others may have Keep::Nothing or Keep::Maps"
    )]
    LayersAllocated {
        /// What was asked for.
        found: Keep,
    },
    /// The device cannot make moments.
    #[error(
        "vsm needs compute shaders that store to 1 texture a stage; this device allows {found} \
         (`Limits::max_storage_textures_per_shader_stage`)"
    )]
    NoMoments {
        /// Storage textures a stage of the device, 0 without compute shaders.
        found: u32,
    },
    /// More lights than the shaders know.
    #[error("the plan has {found} lights; {LIGHTS_MAX} are possible")]
    TooManyLights {
        /// Lights in the call.
        found: usize,
    },
    /// More maps than were allocated.
    #[error(
        "the plan needs {needed} maps, one for a spot, one for each of a directional light's cascades and six for a point \
         light, but {allocated} were allocated (`Options::maps`)"
    )]
    TooManyMaps {
        /// Maps of the lights in the call.
        needed: u32,
        /// Layers of the texture.
        allocated: u32,
    },
    /// A fixed size that is no size of a map.
    #[error("a fixed map size of {found:?} texels was asked for; each side may be 1 to the cap, {cap}")]
    FixedSize {
        /// What was asked for.
        found: [u32; 2],
        /// Largest side.
        cap: u32,
    },
    /// An origin that is no place.
    #[error("the origin is ({}, {}, {}); three finite numbers are allowed", .0.x, .0.y, .0.z)]
    Origin(glam::DVec3),
    /// A stride of zero measures nothing.
    #[error("the measuring stride is 0; it is 1 (every pixel) or more")]
    Stride,
    /// The device lacks compute shaders or the storage the demand pass needs.
    #[error(
        "measuring needs compute shaders with 1 storage buffer and 1 storage texture a stage; this device has {buffers} and \
         {textures} (`Limits::max_storage_buffers_per_shader_stage`, `max_storage_textures_per_shader_stage`); without \
         measuring, sizes come from bounds"
    )]
    NoCompute {
        /// Storage buffers a stage, 0 without compute shaders.
        buffers: u32,
        /// Storage textures a stage, 0 without compute shaders.
        textures: u32,
    },
    /// A histogram is not made by fragment shaders.
    #[error("{0:?} cannot be measured in fragment shaders, only Statistic::Minimum; `Shadows::measure` has both")]
    FragmentStatistic(Statistic),
    /// The device has no storage for fragment shaders.
    #[error(
        "measuring in fragment shaders needs 1 storage buffer a stage; this device has 0 \
         (`Limits::max_storage_buffers_per_shader_stage`)"
    )]
    NoFragmentStorage,
    /// The prepass cannot be read.
    #[error(
        "the depth prepass is {found}; measuring needs a single-sample 2D depth texture with TEXTURE_BINDING usage, \
         for example Depth32Float"
    )]
    Prepass {
        /// What was passed.
        found: String,
    },
}
