// Variance shadow maps: an upper bound of the light from mean and variance of depth under the kernel (Chebyshev).
//   d <= mu  1;    d > mu  s / (s + (d - mu)^2), less the cut
// Depths are linear, 0 at the map's near plane and 1 at its far plane. The receiver is moved towards the light by the part
// of the bias that is for rounding, and by no texels: a mean over a symmetric kernel has no texel's error on a plane.
// CPU twin: `scumble_core::moments`.

// Linear depth of a map depth.
fn shadow_linear_depth(map: u32, map_depth: f32) -> f32 {
    if shadow_lights.maps[map].is_spot == 0u {
        return map_depth;
    }
    let near_over_far = shadow_lights.maps[map].depth_near / shadow_lights.maps[map].depth_far;
    return near_over_far * map_depth / (1.0 - map_depth * (1.0 - near_over_far));
}

// Mean and variance at a place of the viewport in texels, bilinear between the middles of blocks. A map's blocks begin where
// its texels do: they are no more.
fn shadow_moments_at(map: u32, texel: vec2f) -> vec2f {
    let block = shadow_lights.maps[map].moment_block;
    let layer = shadow_lights.maps[map].layer;
    let last = vec2i(ceil(shadow_lights.maps[map].viewport_texels / block)) - 1;
    let place = texel / block - 0.5;
    let corner = vec2i(floor(place));
    let share = place - floor(place);
    let origin = vec2i(shadow_lights.maps[map].origin_texels);
    let low = origin + clamp(corner, vec2i(0), last);
    let high = origin + clamp(corner + 1, vec2i(0), last);
    let a = textureLoad(shadow_moments, low, layer, 0).xy;
    let b = textureLoad(shadow_moments, vec2i(high.x, low.y), layer, 0).xy;
    let c = textureLoad(shadow_moments, vec2i(low.x, high.y), layer, 0).xy;
    let d = textureLoad(shadow_moments, high, layer, 0).xy;
    let weights = vec4f((1.0 - share.x) * (1.0 - share.y), share.x * (1.0 - share.y), (1.0 - share.x) * share.y, share.x * share.y);
    let differences = vec4f(0.0, b.x - a.x, c.x - a.x, d.x - a.x);
    let shift = dot(weights, differences);
    let squares = dot(weights, vec4f(a.y, b.y, c.y, d.y) + differences * differences);
    return vec2f(a.x + shift, max(squares - shift * shift, 0.0));
}

// Upper bound of the light at a depth, less the cut.
fn shadow_bound(moments: vec2f, depth: f32, deviation_min: f32, bleeding_cut: f32) -> f32 {
    let gap = depth - moments.x;
    if gap <= 0.0 {
        return 1.0;
    }
    let variance = max(moments.y, deviation_min * deviation_min);
    return max((variance / (variance + gap * gap) - bleeding_cut) / (1.0 - bleeding_cut), 0.0);
}

// What lies outside of the map is lit.
fn shadow_vsm(map: u32, receiver: ShadowReceiver) -> f32 {
    let viewport = shadow_lights.maps[map].viewport_texels;
    if any(receiver.texel < vec2f(0.0)) || any(receiver.texel > viewport) {
        return 1.0;
    }
    let range = shadow_lights.maps[map].depth_far - shadow_lights.maps[map].depth_near;
    let rounding = shadow_lights.maps[map].bias_rounding_world / range;
    let depth = shadow_linear_depth(map, min(receiver.depth, 1.0)) - rounding;
    let deviation_min = shadow_lights.maps[map].deviation_min_texels * receiver.texel_world / range;
    let moments = shadow_moments_at(map, receiver.texel);
    return shadow_bound(moments, depth, deviation_min, shadow_lights.maps[map].bleeding_cut);
}
