// Percentage closer filtering: the share of taps in a disc of the reference plane that the light reaches.
// CPU twin: `scumble_core::filter::pcf`.

// What the taps of a pixel share, read once: a field of `shadow_lights` is one read a lane wherever the map differs from
// pixel to pixel. A tap t of the unit disc, times the radius, is at
//   texel + texel_from_tap t    and is compared with    min(depth + depth_from_tap . t, depth_limit)
struct ShadowKernel {
    // The receiver's place in the viewport, and the viewport's size and corner in the layer, texels.
    texel: vec2f,
    viewport: vec2f,
    origin: vec2f,
    // Size of a layer, texels.
    layer_texels: vec2f,
    layer: u32,
    // Texels and map depth per world length at the reference plane, along the axes of the turned disc.
    texel_from_tap: mat2x2f,
    depth_from_tap: vec2f,
    // Map depth of the receiver and the largest that there is, both less the bias.
    depth: f32,
    depth_limit: f32,
}

// `rotation` turns, and under a point light stretches, the disc.
fn shadow_kernel(map: u32, receiver: ShadowReceiver, rotation: mat2x2f) -> ShadowKernel {
    let scale = shadow_lights.maps[map].texel_from_plane;
    return ShadowKernel(
        receiver.texel,
        shadow_lights.maps[map].viewport_texels,
        shadow_lights.maps[map].origin_texels,
        vec2f(textureDimensions(shadow_maps)),
        shadow_lights.maps[map].layer,
        mat2x2f(scale * rotation[0], scale * rotation[1]),
        receiver.slope * rotation,
        receiver.depth - receiver.bias,
        1.0 - receiver.bias,
    );
}

// Map depth that a tap is compared with: the receiver's tangent plane there.
fn shadow_tap_depth(kernel: ShadowKernel, tap: vec2f) -> f32 {
    return min(kernel.depth + dot(kernel.depth_from_tap, tap), kernel.depth_limit);
}

// Visibility of one place of the map, bilinear over four comparisons. Never reads outside the viewport; what lies
// outside is lit.
fn shadow_tap(kernel: ShadowKernel, tap: vec2f) -> f32 {
    let texel = kernel.texel + kernel.texel_from_tap * tap;
    let in_layer = kernel.origin + clamp(texel, vec2f(0.5), kernel.viewport - 0.5);
    let place = in_layer / kernel.layer_texels;
    let depth = shadow_tap_depth(kernel, tap);
    let visibility = textureSampleCompareLevel(shadow_maps, shadow_sampler, place, kernel.layer, depth);
    let is_inside = all(texel >= vec2f(0.0)) && all(texel <= kernel.viewport);
    return select(1.0, visibility, is_inside);
}

// One lookup at the receiver.
fn shadow_hard(map: u32, receiver: ShadowReceiver) -> f32 {
    return shadow_tap(shadow_kernel(map, receiver, mat2x2f(1.0, 0.0, 0.0, 1.0)), vec2f(0.0));
}

fn shadow_pcf(kernel: ShadowKernel, radius_plane: f32) -> f32 {
    var sum = 0.0;
    for (var i = 0u; i < SHADOW_PCF_TAPS; i++) {
        let pair = shadow_taps.pcf[i / 2u];
        sum += shadow_tap(kernel, radius_plane * select(pair.xy, pair.zw, (i & 1u) == 1u));
    }
    return sum / f32(SHADOW_PCF_TAPS);
}
