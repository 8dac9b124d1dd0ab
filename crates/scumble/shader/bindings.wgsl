// What every shadow shader reads: one uniform block for lights and maps, one for the taps, the maps and their sampler.
//
// Spaces: *world* is relative to the origin given to `Shadows`; *light* is that of `scumble_core::Light` with z turned
// round, so that z is the depth along the light; the *reference plane* is any plane across a directional light and the
// near plane of a spot and of the faces of a point light; *map depth* is what the map holds, 0 at `depth_near` and 1 at `depth_far`; *texels* count from
// the corner of a map's viewport.
// Each struct has a `#[repr(C)]` twin in `src/uniforms.rs`; a test compares offsets and constants.

const SHADOW_LIGHTS_MAX: u32 = 4u;
const SHADOW_CASCADES_MAX: u32 = 4u;
// Maps of one light: its cascades, or the faces of a point light.
const SHADOW_LIGHT_MAPS_MAX: u32 = 6u;
const SHADOW_MAPS_MAX: u32 = 24u;
const SHADOW_PCF_TAPS: u32 = 25u;
const SHADOW_BLOCKER_TAPS: u32 = 16u;

const SHADOW_FILTER_HARD: u32 = 0u;
const SHADOW_FILTER_PCF: u32 = 1u;
const SHADOW_FILTER_PCSS: u32 = 2u;
const SHADOW_FILTER_VSM: u32 = 3u;
const SHADOW_FILTER_UPLOADED: u32 = 4u;

// The filter, as a pipeline constant for a compiler to fold, or as it was uploaded.
override shadow_filter: u32 = 4u;

struct ShadowMap {
    clip_from_world: mat4x4f,
    light_from_world: mat4x4f,
    // Size of the viewport, texels.
    viewport_texels: vec2f,
    // Texels per world length at the reference plane; y is negative, rows count downwards.
    texel_from_plane: vec2f,
    // Light-space depths of map depth 0 and 1, world length; under a directional light counted from the world's origin.
    depth_near: f32,
    depth_far: f32,
    // 1 for a spot and for a face of a point light, 0 for a directional light.
    is_spot: u32,
    layer: u32,
    // Tangent of the half angle of a directional light; radius of a lamp, world length.
    light_size: f32,
    // Radius of the fixed kernel at the reference plane, world length.
    radius_world: f32,
    // Smallest filter radius of PCSS at the reference plane, world length.
    radius_min_world: f32,
    // Larger side of a texel at the reference plane, world length.
    texel_world: f32,
    // Bias: constant part and factor of the slope in texels, part for rounding in world length.
    bias_constant_texels: f32,
    bias_slope_texels: f32,
    bias_rounding_world: f32,
    // Largest slope of a receiver against the light that is followed: a tangent.
    slope_max: f32,
    // 0 where nothing on screen needs the map and everything is lit.
    has_map: u32,
    filter_kind: u32,
    // Smallest standard deviation of depth under VSM, texels at the receiver; share of the light that it counts as dark.
    deviation_min_texels: f32,
    bleeding_cut: f32,
    // Texels of a block of `shadow_moments` along x and y.
    moment_block: vec2f,
    // First bin of the histogram of radii that the demand pass makes.
    first_bin: u32,
    // 1 for a point light, whose kernel is a disc across the ray.
    is_sphere: u32,
    // Half of the box, in clip space, in which points are looked up here and not in the light's net.
    inner: vec2f,
    // Corner of the viewport in the layer, whole texels.
    origin_texels: vec2f,
}

// The maps of a light: consecutive, one for each slice of the view from the nearest on, or for each face of a point light.
struct ShadowLight {
    // View depths at which the first slices end; infinite (the largest float) from the last slice on.
    slice_ends: vec3f,
    // 0 where the plan has no such light.
    map_count: u32,
    // Directions of x and y of light space, of a directional light.
    across_x: vec3f,
    first_map: u32,
    across_y: vec3f,
    // The map of what no slice's map was fitted to; SHADOW_NO_MAP where slices are fitted to the whole view.
    net_map: u32,
    // Of a point light.
    position: vec3f,
    // 1 for a point light.
    is_point: u32,
}

struct ShadowLights {
    maps: array<ShadowMap, SHADOW_MAPS_MAX>,
    lights: array<ShadowLight, SHADOW_LIGHTS_MAX>,
    // View depth of the plan's camera: dot with (position, 1).
    view_depth: vec4f,
    // Side in pixels of the blocks of `shadow_blocks`; 0 where they are not of this frame.
    block_px: u32,
}

// What may meet in a block of pixels, bits of `shadow_blocks`; none where nothing was found that counts.
const SHADOW_BLOCK_LIT: u32 = 1u;
const SHADOW_BLOCK_UMBRA: u32 = 2u;
const SHADOW_BLOCK_MIXED: u32 = 3u;

// Points of the unit disc, two a vector: xy is tap 2i, zw is tap 2i + 1.
// A uniform buffer, never a constant array: indexed by a loop variable that runs up to 20 times slower on llvmpipe.
struct ShadowTaps {
    pcf: array<vec4f, 13>,
    blocker: array<vec4f, 8>,
}

@group(0) @binding(0) var<uniform> shadow_lights: ShadowLights;
@group(0) @binding(1) var<uniform> shadow_taps: ShadowTaps;
@group(0) @binding(2) var shadow_maps: texture_depth_2d_array;
@group(0) @binding(3) var shadow_sampler: sampler_comparison;
// By block of pixels, a layer a light: what the demand pass found at its corners.
@group(0) @binding(4) var shadow_blocks: texture_2d_array<u32>;
// By block of texels of each map: mean and variance of linear depth under the kernel of VSM.
@group(0) @binding(5) var shadow_moments: texture_2d_array<f32>;
// The maps again, for what reads a depth itself: GLSL has no way to do so through a texture that is also compared with.
@group(0) @binding(6) var shadow_depths: texture_2d_array<f32>;
