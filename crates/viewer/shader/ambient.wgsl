// How open a receiver is to the sky, from the G-buffer alone (ambient obscurance; idea: McGuire et al. 2011, "The
// Alchemy screen-space ambient obscurance algorithm"). For the pictures only: it plays no part in any measurement.
//
// openness = max(0, 1 - strength * mean over taps of max(0, cos - bias) * (1 - d^2 / radius^2)), where d is the
// distance of the receiver under the tap and cos the cosine between the normal and the way there. Prepend camera.wgsl,
// gbuffer_read.wgsl and lighting.wgsl.

const TAPS: u32 = 24u;
const GOLDEN_ANGLE: f32 = 2.3999632;
const STRENGTH: f32 = 2.2;
const COSINE_BIAS: f32 = 0.12;
const RADIUS_PX_MIN: f32 = 3.0;
const RADIUS_PX_MAX: f32 = 200.0;

// Interleaved gradient noise (Jimenez 2014): neighbours get well spread values in [0, 1).
fn noise(pixel: vec2f) -> f32 {
    return fract(52.9829189 * fract(dot(pixel, vec2f(0.06711056, 0.00583715))));
}

@fragment
fn ambient(@builtin(position) frag_coord: vec4f) -> @location(0) f32 {
    let pixel = vec2i(frag_coord.xy);
    let center = textureLoad(gbuffer_position, pixel, 0);
    if center.w == 0.0 {
        return 1.0;
    }
    let normal = textureLoad(gbuffer_shading_normal, pixel, 0).xyz;
    let size = vec2i(textureDimensions(gbuffer_position));
    let radius_world = lighting.obscurance_radius_world;
    let distance_world = distance(center.xyz, camera.eye_world.xyz);
    let radius_px = clamp(radius_world * lighting.focal_length_px / distance_world, RADIUS_PX_MIN, RADIUS_PX_MAX);
    let turn = noise(frag_coord.xy) * 6.2831853;

    var blocked = 0.0;
    for (var tap = 0u; tap < TAPS; tap++) {
        let angle = turn + GOLDEN_ANGLE * f32(tap);
        let reach = radius_px * sqrt((f32(tap) + 0.5) / f32(TAPS));
        let at = vec2i(frag_coord.xy + reach * vec2f(cos(angle), sin(angle)));
        if any(at < vec2i(0)) || any(at >= size) {
            continue;
        }
        let other = textureLoad(gbuffer_position, at, 0);
        let way = other.xyz - center.xyz;
        let squared = dot(way, way);
        if other.w == 0.0 || squared < 1e-12 * radius_world * radius_world {
            continue;
        }
        let cosine = dot(way, normal) * inverseSqrt(squared);
        blocked += max(0.0, cosine - COSINE_BIAS) * max(0.0, 1.0 - squared / (radius_world * radius_world));
    }
    return max(0.0, 1.0 - STRENGTH * blocked / f32(TAPS));
}
