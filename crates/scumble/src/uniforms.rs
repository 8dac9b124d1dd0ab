//! The Rust twins of the structs in `shader/bindings.wgsl`, `shader/measure.wgsl` and `shader/vsm_map.wgsl`.
//!
//! Field order, offsets and constants are those of the shaders; `tests/shaders.rs` compares them with naga's layouts.

use bytemuck::{Pod, Zeroable};
use scumble_core::{Face, RadiusHistogram, Seen, Splits, Taps};

/// Lights that one set of uniforms holds; `SHADOW_LIGHTS_MAX` of the shaders.
pub const LIGHTS_MAX: u32 = 4;
/// Maps of one directional light; `SHADOW_CASCADES_MAX` of the shaders.
pub const CASCADES_MAX: u32 = Splits::COUNT_MAX;
/// Maps of one light, a point light's faces; `SHADOW_LIGHT_MAPS_MAX` of the shaders.
pub const LIGHT_MAPS_MAX: u32 = Face::ALL.len() as u32;
/// Maps that one set of uniforms holds; `SHADOW_MAPS_MAX` of the shaders.
pub const MAPS_MAX: u32 = LIGHTS_MAX * LIGHT_MAPS_MAX;
/// No map; `SHADOW_NO_MAP` of the shaders.
pub const NO_MAP: u32 = u32::MAX;
/// Taps of the filter kernel; `SHADOW_PCF_TAPS` of the shaders.
pub const PCF_TAPS: u32 = Taps::FILTER as u32;
/// Taps of the blocker search; `SHADOW_BLOCKER_TAPS` of the shaders.
pub const BLOCKER_TAPS: u32 = Taps::BLOCKER as u32;
/// Lookups of moments of one pixel: a bilinear value.
pub const MOMENT_TAPS: u32 = 4;

/// One map as the shaders see it. Spaces and units: head of `shader/bindings.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct MapUniform {
    /// Clip space of the map from world relative to the origin, by columns.
    pub clip_from_world: [[f32; 4]; 4],
    /// Light space from world relative to the origin, by columns; z is the depth along the light.
    pub light_from_world: [[f32; 4]; 4],
    /// Size of the viewport in texels.
    pub viewport_texels: [f32; 2],
    /// Texels per world length at the reference plane; y negative.
    pub texel_from_plane: [f32; 2],
    /// Light-space depth of map depth 0; under a directional light counted from the origin.
    pub depth_near: f32,
    /// Light-space depth of map depth 1, likewise.
    pub depth_far: f32,
    /// 1 for a spot and for a face of a point light, 0 for a directional light.
    pub is_spot: u32,
    /// Layer of the map texture.
    pub layer: u32,
    /// Tangent of the half angle (directional) or radius in world length (lamps).
    pub light_size: f32,
    /// Radius of the fixed kernel at the reference plane, world length.
    pub radius_world: f32,
    /// Smallest PCSS filter radius at the reference plane, world length.
    pub radius_min_world: f32,
    /// Larger side of a texel at the reference plane, world length.
    pub texel_world: f32,
    /// Constant part of the bias in texels.
    pub bias_constant_texels: f32,
    /// Factor of the slope in the bias, texels.
    pub bias_slope_texels: f32,
    /// Part of the bias for rounding, world length.
    pub bias_rounding_world: f32,
    /// Largest receiver slope that is followed, a tangent.
    pub slope_max: f32,
    /// 0 where nothing on screen needs the map and everything is lit.
    pub has_map: u32,
    /// `SHADOW_FILTER_…` of the shaders.
    pub filter_kind: u32,
    /// Smallest standard deviation of depth under VSM, texels at the receiver.
    pub deviation_min_texels: f32,
    /// Share of the light that VSM counts as dark.
    pub bleeding_cut: f32,
    /// Texels of a block of VSM along x and y.
    pub moment_block: [f32; 2],
    /// First bin of the histogram of radii; [`RadiusHistogram::first_bin`] of the map's extent.
    pub first_bin: u32,
    /// 1 for a point light, whose kernel is a disc across the ray.
    pub is_sphere: u32,
    /// Half of the box, in clip space, in which points are looked up here and not in the light's net.
    pub inner: [f32; 2],
    /// Corner of the viewport in the layer, whole texels.
    pub origin_texels: [f32; 2],
}

/// One map as the passes of variance shadow maps see it; `Moments` of `shader/vsm_map.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct MomentsUniform {
    /// Size of the viewport in texels.
    pub viewport: [u32; 2],
    /// Corner of the viewport in its layer, and of the blocks in theirs.
    pub origin: [u32; 2],
    /// Texels of a block along x and y.
    pub block: [u32; 2],
    /// Half sides of the kernel in blocks.
    pub radius: [f32; 2],
    /// Near plane's depth by the far plane's under a spot; 1 where map depth is linear.
    pub near_over_far: f32,
    /// Unused.
    pub padding: u32,
}

/// The maps of one light: consecutive, from the nearest slice on, or those of a point light's faces.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct LightUniform {
    /// View depths at which the first slices end; the largest float from the last slice on.
    pub slice_ends: [f32; CASCADES_MAX as usize - 1],
    /// 0 where the plan has no such light.
    pub map_count: u32,
    /// Direction of a directional light's x.
    pub across_x: [f32; 3],
    /// Index of the nearest slice's map, or the first face's.
    pub first_map: u32,
    /// Direction of a directional light's y.
    pub across_y: [f32; 3],
    /// Index of the net; [`NO_MAP`] where there is none.
    pub net_map: u32,
    /// A point light's position relative to the origin.
    pub position: [f32; 3],
    /// 1 for a point light.
    pub is_point: u32,
}

/// All lights and maps.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct LightsUniform {
    /// By layer.
    pub maps: [MapUniform; MAPS_MAX as usize],
    /// By light, in the order given to `plan`.
    pub lights: [LightUniform; LIGHTS_MAX as usize],
    /// View depth of the plan's camera: dot with (position relative to the origin, 1).
    pub view_depth: [f32; 4],
    /// Side of the blocks in pixels; 0 where they are not of this frame.
    pub block_px: u32,
    /// Unused.
    pub padding: [u32; 3],
}

/// Taps in the unit disc, two a vector; the last vector's second half is unused where the count is odd.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct TapsUniform {
    /// Taps of the filter.
    pub pcf: [[f32; 4]; PCF_TAPS.div_ceil(2) as usize],
    /// Taps of the blocker search.
    pub blocker: [[f32; 4]; BLOCKER_TAPS.div_ceil(2) as usize],
}

impl TapsUniform {
    /// Packs points of the unit disc; missing ones stay at the centre, surplus ones are left out.
    pub fn new(pcf: &[glam::DVec2], blocker: &[glam::DVec2]) -> Self {
        let mut taps = Self::zeroed();
        pack(&mut taps.pcf, pcf);
        pack(&mut taps.blocker, blocker);
        taps
    }
}

fn pack(vectors: &mut [[f32; 4]], points: &[glam::DVec2]) {
    for (place, point) in vectors.iter_mut().flat_map(|v| v.chunks_exact_mut(2)).zip(points) {
        place.copy_from_slice(&point.as_vec2().to_array());
    }
}

/// What the demand pass finds under one map; `MapDemand` of `shader/measure.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct MapDemand {
    /// Bits of the smallest radius; those of infinity where there is none.
    pub minimum_bits: u32,
    /// Measured fragments that do not see all of the light.
    pub shadowed: u32,
    /// Measured fragments with a penumbra, by the bits of their radius.
    pub counts: [u32; RadiusHistogram::BINS as usize],
}

/// Where receivers of one light are, by band of view depth; `LightReceivers` of `shader/receivers.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct LightReceivers {
    /// Smallest x, y, -x and -y across the light, relative to the origin, in bits that keep their order; all ones where
    /// there is none.
    pub minima: [[u32; 4]; Seen::BANDS as usize],
}

/// All that the demand pass finds; `Measured` of `shader/measure.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Measured {
    /// By layer: blocks of pixels that are lit, dark and mixed.
    pub blocks: [[u32; 3]; MAPS_MAX as usize],
    /// By layer.
    pub maps: [MapDemand; MAPS_MAX as usize],
    /// By light.
    pub receivers: [LightReceivers; LIGHTS_MAX as usize],
}

/// The camera of the demand pass. Rays: `eye + view_depth * (ray_corner + x ray_x + y ray_y)` in pixels.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct MeasureUniform {
    /// Relative to the origin.
    pub eye: [f32; 3],
    /// View depth = `depth_numerator / (depth_offset - depth of the prepass)`.
    pub depth_numerator: f32,
    /// Direction of the ray through pixel corner (0, 0), one unit deep.
    pub ray_corner: [f32; 3],
    /// See `depth_numerator`.
    pub depth_offset: f32,
    /// Change of the direction per pixel to the right.
    pub ray_x: [f32; 3],
    /// Every how many pixels, along x and y, one is measured.
    pub stride: u32,
    /// Change of the direction per pixel down.
    pub ray_y: [f32; 3],
    /// Radius that one pixel of footprint asks for, in footprints: ratio times kappa.
    pub radius_per_footprint: f32,
    /// Direction of view.
    pub forward: [f32; 3],
    /// Smallest radius written, world length at the reference plane.
    pub radius_floor_world: f32,
    /// Size of a pixel at distance 1.
    pub pixel_at_unit_distance: f32,
    /// Unused.
    pub padding: [f32; 3],
}
