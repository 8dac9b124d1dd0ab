// Casters into a shadow map: positions only. `clip_from_world` is that of the drop-in's view.

@group(0) @binding(0) var<uniform> clip_from_world: mat4x4f;

@vertex
fn caster(@location(0) position_world: vec3f) -> @builtin(position) vec4f {
    return clip_from_world * vec4f(position_world, 1.0);
}
