// Percentage closer filtering: the share of taps in a disc of the reference plane that the light reaches.
// CPU twin: `scumble_core::filter::pcf`.

// Visibility of one place of the map, bilinear over four comparisons. Never reads outside the viewport; what lies
// outside is lit.
fn shadow_tap(map: u32, texel: vec2f, depth: f32) -> f32 {
    let viewport = shadow_lights.maps[map].viewport_texels;
    let in_layer = shadow_lights.maps[map].origin_texels + clamp(texel, vec2f(0.5), viewport - 0.5);
    let place = in_layer / vec2f(textureDimensions(shadow_maps));
    let layer = shadow_lights.maps[map].layer;
    let visibility = textureSampleCompareLevel(shadow_maps, shadow_sampler, place, layer, depth);
    let is_inside = all(texel >= vec2f(0.0)) && all(texel <= viewport);
    return select(1.0, visibility, is_inside);
}

// Visibility at an offset from the receiver, world length at the reference plane, against its tangent plane.
fn shadow_tap_at(map: u32, receiver: ShadowReceiver, offset: vec2f) -> f32 {
    let texel = receiver.texel + offset * shadow_lights.maps[map].texel_from_plane;
    return shadow_tap(map, texel, shadow_depth_at(receiver, offset));
}

fn shadow_pcf(map: u32, receiver: ShadowReceiver, radius_plane: f32, rotation: mat2x2f) -> f32 {
    var sum = 0.0;
    for (var i = 0u; i < SHADOW_PCF_TAPS; i++) {
        let pair = shadow_taps.pcf[i / 2u];
        let tap = select(pair.xy, pair.zw, (i & 1u) == 1u);
        sum += shadow_tap_at(map, receiver, radius_plane * (rotation * tap));
    }
    return sum / f32(SHADOW_PCF_TAPS);
}
