// Sets the viewport to map depth 1 by one triangle that covers it.
//
// A load operation would clear the whole layer at the cap; this touches only the texels in use.

@vertex
fn clear_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32(index & 1u), f32(index >> 1u));
    return vec4f(corner * 4.0 - 1.0, 1.0, 1.0);
}
