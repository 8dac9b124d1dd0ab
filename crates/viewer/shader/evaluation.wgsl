// The visibility of the light at every receiver, by the drop-in's own function. Prepend gbuffer_read.wgsl and the text of
// `shadow_wgsl(1)`. Pixels without a surface get 1.

@fragment
fn evaluate(@builtin(position) frag_coord: vec4f) -> @location(0) f32 {
    let pixel = vec2i(frag_coord.xy);
    let position = textureLoad(gbuffer_position, pixel, 0);
    if position.w == 0.0 {
        return 1.0;
    }
    let normal = textureLoad(gbuffer_normal, pixel, 0).xyz;
    return shadow_visibility(0u, position.xyz, normal, frag_coord.xy);
}

// The radius of the filter at the reference plane before its lower clamp, metres; 0 where nothing is filtered.
@fragment
fn radius(@builtin(position) frag_coord: vec4f) -> @location(0) f32 {
    let pixel = vec2i(frag_coord.xy);
    let position = textureLoad(gbuffer_position, pixel, 0);
    if position.w == 0.0 {
        return 0.0;
    }
    let normal = textureLoad(gbuffer_normal, pixel, 0).xyz;
    return shadow_sample(0u, position.xyz, normal, frag_coord.xy).radius_plane;
}
