// Shades triangles by one light. `shadow_wgsl(1)` stands before this text and gives `shadow_visibility`.

@group(0) @binding(0) var<uniform> clip_from_world: mat4x4f;

struct Surface {
    @builtin(position) place: vec4f,
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
}

@vertex
fn vertex(@location(0) position: vec3f, @location(1) normal: vec3f) -> Surface {
    return Surface(clip_from_world * vec4f(position, 1.0), position, normal);
}

@fragment
fn shade(surface: Surface) -> @location(0) vec4f {
    let towards_light = normalize(vec3f(-0.5, 1.0, 0.4));
    let normal = normalize(surface.normal);
    let visibility = shadow_visibility(0u, surface.position, normal, surface.place.xy);
    return vec4f(vec3f(0.05 + 0.5 * max(dot(normal, towards_light), 0.0) * visibility), 1.0);
}
