//! The shaders' parts and how they are put together: plain text, no preprocessor.

const BINDINGS: &str = include_str!("../shader/bindings.wgsl");
const SLICES: &str = include_str!("../shader/slices.wgsl");
const ROTATION: &str = include_str!("../shader/rotation.wgsl");
const RECEIVER: &str = include_str!("../shader/receiver.wgsl");
const PCF: &str = include_str!("../shader/pcf.wgsl");
const PCSS: &str = include_str!("../shader/pcss.wgsl");
const VSM: &str = include_str!("../shader/vsm.wgsl");
const VISIBILITY: &str = include_str!("../shader/visibility.wgsl");
const RECEIVES: &str = include_str!("../shader/receives.wgsl");
const FRAGMENTS: &str = include_str!("../shader/fragments.wgsl");
const CORNER: &str = include_str!("../shader/corner.wgsl");
const CLASSIFY: &str = include_str!("../shader/classify.wgsl");
const MEASURE: &str = include_str!("../shader/measure.wgsl");
const RECEIVERS: &str = include_str!("../shader/receivers.wgsl");
const VSM_MAP: &str = include_str!("../shader/vsm_map.wgsl");
const VSM_REDUCE: &str = include_str!("../shader/vsm_reduce.wgsl");
const VSM_BOX: &str = include_str!("../shader/vsm_box.wgsl");

/// The pass that clears a viewport.
pub const CLEAR_WGSL: &str = include_str!("../shader/clear.wgsl");

/// The pass that puts static casters into a map.
pub const COPY_WGSL: &str = include_str!("../shader/copy.wgsl");

/// Parts of `shadow_visibility`, in the order in which they are joined.
const PARTS: [&str; 8] = [BINDINGS, SLICES, ROTATION, RECEIVER, PCF, PCSS, VSM, VISIBILITY];

/// The pipeline constant that fixes the filter at compile time, so that the branches of the others go away:
/// `"shadow_filter"` with [`filter_constant`](crate::filter_constant)'s value. Left out, the filter is the uploaded one.
pub const FILTER_OVERRIDE: &str = "shadow_filter";

/// WGSL to put before a shader that shades: it declares the bindings of
/// [`Shadows::bind_group`](crate::Shadows::bind_group) in bind group `group` and gives
/// `fn shadow_visibility(light: u32, position_world: vec3f, normal_world: vec3f, frag_coord: vec2f) -> f32`,
/// the share of light number `light` of the plan that arrives: 0 to 1.
///
/// `position_world` is relative to the origin of the options, `normal_world` is the geometric normal, of unit length, and
/// `frag_coord` the pixel. All names start with `shadow_`, `Shadow` or `SHADOW_`.
pub fn shadow_wgsl(group: u32) -> String {
    PARTS.join("\n").replace("@group(0)", &format!("@group({group})"))
}

/// The demand pass, for tests that look at it.
pub fn measure_wgsl() -> String {
    [&shadow_wgsl(0), RECEIVES, CORNER, MEASURE, RECEIVERS].join("\n")
}

/// WGSL to put after [`shadow_wgsl`], for renderers without a depth prepass: it declares the binding of
/// [`FragmentDemand::bind_group`](crate::FragmentDemand::bind_group) in bind group `group` and gives
/// `fn shadow_visibility_measured(light: u32, position_world: vec3f, normal_world: vec3f, frag_coord: vec2f,
/// pixel_world: f32) -> f32`, which is `shadow_visibility` and tells the demand. `pixel_world` is the width of a pixel at
/// the fragment in world length: its view depth by the height of the view one unit away, over the picture's height in
/// pixels.
pub fn fragments_wgsl(group: u32) -> String {
    [RECEIVES, FRAGMENTS].join("\n").replace("@group(0)", &format!("@group({group})"))
}

/// The pass that makes blocks of corners, for tests that look at it.
pub fn classify_wgsl() -> String {
    [CORNER, CLASSIFY].join("\n")
}

/// The first pass of variance shadow maps, for tests that look at it.
pub fn vsm_reduce_wgsl() -> String {
    [VSM_MAP, VSM_REDUCE].join("\n")
}

/// The second and third pass of variance shadow maps, for tests that look at it.
pub fn vsm_box_wgsl() -> String {
    [VSM_MAP, VSM_BOX].join("\n")
}
