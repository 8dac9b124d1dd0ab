// Casters into a shadow map: positions only, but for what is cut out. `clip_from_world` is that of the drop-in's view.
// Prepend mask.wgsl.

@group(0) @binding(0) var<uniform> clip_from_world: mat4x4f;

@vertex
fn caster(@location(0) position_world: vec3f) -> @builtin(position) vec4f {
    return clip_from_world * vec4f(position_world, 1.0);
}

struct Masked {
    @builtin(position) clip: vec4f,
    @location(0) uv: vec2f,
}

@vertex
fn caster_masked(@location(0) position_world: vec3f, @location(3) uv: vec2f) -> Masked {
    return Masked(clip_from_world * vec4f(position_world, 1.0), uv);
}

@fragment
fn cut_out(in: Masked) {
    if !is_there(in.uv) {
        discard;
    }
}
