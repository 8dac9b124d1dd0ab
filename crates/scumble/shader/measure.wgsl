// The demand pass: the smallest filter radius on screen, by light (Kreuzer 2017, Eq. 5.12 as a minimum of radii).
//
// One invocation a pixel and light over the depth prepass. A fragment counts where its visibility is partial and at least
// two samples found a blocker. Its radius is clamped below by `radius_floor_world` and by what one pixel can show,
// `radius_per_footprint` times the pixel's footprint at the reference plane. Bits of positive floats keep their order,
// so the minimum is an atomic minimum of u32; 0x7F800000, infinity, says that nothing was written.

struct Measure {
    eye: vec3f,
    depth_numerator: f32,
    ray_corner: vec3f,
    depth_offset: f32,
    ray_x: vec3f,
    stride: u32,
    ray_y: vec3f,
    radius_per_footprint: f32,
    forward: vec3f,
    radius_floor_world: f32,
    pixel_at_unit_distance: f32,
}

const MEASURE_NOTHING: u32 = 0x7F800000u;

@group(1) @binding(0) var<uniform> measure: Measure;
@group(1) @binding(1) var prepass: texture_depth_2d;
@group(1) @binding(2) var<storage, read_write> demand: array<atomic<u32>, SHADOW_LIGHTS_MAX>;

var<workgroup> smallest: atomic<u32>;

fn ray_at(pixel: vec2f) -> vec3f {
    return measure.ray_corner + pixel.x * measure.ray_x + pixel.y * measure.ray_y;
}

// The prepass surface at a pixel, clamped to the picture.
fn surface_at(pixel: vec2i, size: vec2i) -> vec3f {
    let place = clamp(pixel, vec2i(0), size - 1);
    let view_depth = measure.depth_numerator / (measure.depth_offset - textureLoad(prepass, place, 0));
    return measure.eye + view_depth * ray_at(vec2f(place) + 0.5);
}

// The shorter of the differences to both neighbours: the one that does not cross a silhouette.
fn difference(before: vec3f, here: vec3f, after: vec3f) -> vec3f {
    let back = here - before;
    let forth = after - here;
    let takes_back = (dot(back, back) < dot(forth, forth) && dot(back, back) > 0.0) || dot(forth, forth) == 0.0;
    return select(forth, back, takes_back);
}

fn normal_at(pixel: vec2i, size: vec2i, here: vec3f) -> vec3f {
    let along_x = difference(surface_at(pixel - vec2i(1, 0), size), here, surface_at(pixel + vec2i(1, 0), size));
    let along_y = difference(surface_at(pixel - vec2i(0, 1), size), here, surface_at(pixel + vec2i(0, 1), size));
    return normalize(cross(along_y, along_x));
}

// Width of a pixel at the receiver, projected onto the reference plane. CPU twin: `scumble_core::pixel_footprint_world`.
fn footprint(light: u32, here: vec3f, light_depth: f32) -> f32 {
    let at_receiver = dot(here - measure.eye, measure.forward) * measure.pixel_at_unit_distance;
    if shadow_lights.lights[light].is_spot == 1u {
        return at_receiver * shadow_lights.lights[light].depth_near / light_depth;
    }
    return at_receiver;
}

// Bits of the radius a fragment needs, or MEASURE_NOTHING.
fn radius_bits(light: u32, pixel: vec2i, size: vec2i) -> u32 {
    let is_surface = all(pixel < size) && textureLoad(prepass, min(pixel, size - 1), 0) < 1.0;
    if !is_surface || shadow_lights.lights[light].has_map == 0u {
        return MEASURE_NOTHING;
    }
    let here = surface_at(pixel, size);
    let normal = normal_at(pixel, size, here);
    let position_light = (shadow_lights.lights[light].light_from_world * vec4f(here, 1.0)).xyz;
    let normal_light = (shadow_lights.lights[light].light_from_world * vec4f(normal, 0.0)).xyz;
    let ray_light = select(vec3f(0.0, 0.0, 1.0), position_light, shadow_lights.lights[light].is_spot == 1u);
    if !(dot(normal_light, ray_light) < 0.0) {
        return MEASURE_NOTHING;
    }
    let found = shadow_sample(light, here, normal, vec2f(pixel) + 0.5);
    let is_partial = found.visibility > 0.0 && found.visibility < 1.0 && found.blockers >= 2u;
    let guard = max(measure.radius_floor_world, measure.radius_per_footprint * footprint(light, here, position_light.z));
    let radius = max(found.radius_plane, guard);
    if !is_partial || !(radius > 0.0) {
        return MEASURE_NOTHING;
    }
    return min(bitcast<u32>(radius), MEASURE_NOTHING);
}

@compute @workgroup_size(8, 8)
fn measure_demand(
    @builtin(global_invocation_id) invocation: vec3u,
    @builtin(local_invocation_index) index: u32,
) {
    let light = invocation.z;
    let pixel = vec2i(invocation.xy * measure.stride);
    if index == 0u {
        atomicStore(&smallest, MEASURE_NOTHING);
    }
    workgroupBarrier();
    let bits = radius_bits(light, pixel, vec2i(textureDimensions(prepass)));
    if bits < MEASURE_NOTHING {
        atomicMin(&smallest, bits);
    }
    workgroupBarrier();
    let group_smallest = atomicLoad(&smallest);
    if index == 0u && group_smallest < MEASURE_NOTHING {
        atomicMin(&demand[light], group_smallest);
    }
}
