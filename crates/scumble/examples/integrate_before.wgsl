// Shades triangles by one light through a shadow map: four comparisons, blended by the hardware.

@group(0) @binding(0) var<uniform> clip_from_world: mat4x4f;
@group(1) @binding(0) var<uniform> light_from_world: mat4x4f;
@group(1) @binding(1) var map: texture_depth_2d;
@group(1) @binding(2) var comparison: sampler_comparison;

struct Surface {
    @builtin(position) place: vec4f,
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
}

@vertex
fn vertex(@location(0) position: vec3f, @location(1) normal: vec3f) -> Surface {
    return Surface(clip_from_world * vec4f(position, 1.0), position, normal);
}

fn visibility_at(position: vec3f, normal: vec3f) -> f32 {
    let clip = light_from_world * vec4f(position + 0.02 * normal, 1.0);
    let place = clip.xy * vec2f(0.5, -0.5) + 0.5;
    return textureSampleCompareLevel(map, comparison, place, clip.z - 0.0005);
}

@fragment
fn shade(surface: Surface) -> @location(0) vec4f {
    let towards_light = normalize(vec3f(-0.5, 1.0, 0.4));
    let normal = normalize(surface.normal);
    let visibility = visibility_at(surface.position, normal);
    return vec4f(vec3f(0.05 + 0.5 * max(dot(normal, towards_light), 0.0) * visibility), 1.0);
}
