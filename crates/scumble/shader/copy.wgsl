// Puts the kept depth of static casters into a map's viewport, texel by texel and bit by bit.
//
// A copy command would take the whole layer at the cap, as depth formats are copied whole; this touches only the texels in
// use.

@group(0) @binding(0) var kept: texture_2d<f32>;

@vertex
fn copy_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32(index & 1u), f32(index >> 1u));
    return vec4f(corner * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn copy_depth(@builtin(position) at: vec4f) -> @builtin(frag_depth) f32 {
    return textureLoad(kept, vec2i(at.xy), 0).x;
}
