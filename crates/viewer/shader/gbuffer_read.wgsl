// The G-buffer as the full-screen passes read it (layout in gbuffer.rs), and the triangle that covers the screen.

@group(0) @binding(1) var gbuffer_position: texture_2d<f32>;
@group(0) @binding(2) var gbuffer_normal: texture_2d<f32>;
@group(0) @binding(3) var gbuffer_shading_normal: texture_2d<f32>;
@group(0) @binding(4) var gbuffer_color: texture_2d<f32>;

@vertex
fn full_screen(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
    return vec4f(corner * 2.0 - 1.0, 0.0, 1.0);
}
