// The demand pass: the filter radii on screen, by map: their minimum (Kreuzer 2017, Eq. 5.12) and their histogram; and where
// receivers are, by light.
//
// One invocation a pixel and light over the depth prepass, which asks the map that shading reads there. A fragment counts
// where its visibility is partial and at least two samples found a blocker. Its radius is clamped below by
// `radius_floor_world` and by what one pixel can show, `radius_per_footprint` times the pixel's footprint at the reference
// plane. Bits of positive floats keep their order, so the minimum is an atomic minimum of u32, where 0x7F800000, infinity,
// says that nothing was written; without the lowest 20 they are the bins of the histogram, 8 an octave. Receivers are boxed
// as `receivers.wgsl` says.

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

struct MapDemand {
    minimum_bits: atomic<u32>,
    // Fragments that do not see all of the light.
    shadowed: atomic<u32>,
    counts: array<atomic<u32>, MEASURE_BINS>,
}

struct Measured {
    // Counted by the pass that makes blocks of corners.
    blocks: array<array<atomic<u32>, 3>, SHADOW_MAPS_MAX>,
    maps: array<MapDemand, SHADOW_MAPS_MAX>,
    receivers: array<LightReceivers, SHADOW_LIGHTS_MAX>,
}

const MEASURE_NOTHING: u32 = 0x7F800000u;
const MEASURE_BINS: u32 = 128u;
// Bits of a radius that no bin tells apart.
const MEASURE_BIN_SHIFT: u32 = 20u;
const MEASURE_GROUP: u32 = 64u;

// Change of slope from pixel to pixel that still counts as one surface, as a share of the slope, and as depth: a few
// units in the last place of 24 or 32 bits.
const BEND_SHARE: f32 = 0.25;
const BEND_ROUNDING: f32 = 4e-7;
// Above every bend.
const NO_PLANE: f32 = 1e30;

@group(1) @binding(0) var<uniform> measure: Measure;
@group(1) @binding(1) var prepass: texture_depth_2d;
@group(1) @binding(2) var<storage, read_write> measured: Measured;
// What each measured pixel is, `shadow_corner`, a layer a light.
@group(1) @binding(3) var corners: texture_storage_2d_array<r32uint, write>;

// By map of the light; the bins of all maps one after the other.
var<workgroup> group_minimum: array<atomic<u32>, SHADOW_LIGHT_MAPS_MAX>;
var<workgroup> group_shadowed: array<atomic<u32>, SHADOW_LIGHT_MAPS_MAX>;
var<workgroup> group_counts: array<atomic<u32>, SHADOW_LIGHT_MAPS_MAX * MEASURE_BINS>;

fn ray_at(pixel: vec2f) -> vec3f {
    return measure.ray_corner + pixel.x * measure.ray_x + pixel.y * measure.ray_y;
}

fn depth_at(pixel: vec2i) -> f32 {
    return textureLoad(prepass, pixel, 0);
}

// The prepass surface at a pixel.
fn surface_at(pixel: vec2i) -> vec3f {
    let view_depth = measure.depth_numerator / (measure.depth_offset - depth_at(pixel));
    return measure.eye + view_depth * ray_at(vec2f(pixel) + 0.5);
}

// How far the three pixels from `pixel` along `step` are from lying on one plane, whose depth is linear in the picture;
// NO_PLANE where they do not.
fn bend(pixel: vec2i, step: vec2i, size: vec2i) -> f32 {
    let last = pixel + 2 * step;
    if any(last < vec2i(0)) || any(last >= size) {
        return NO_PLANE;
    }
    let change = depth_at(pixel + step) - depth_at(pixel);
    let residual = abs(depth_at(last) - depth_at(pixel + step) - change);
    let is_plane = residual <= BEND_SHARE * abs(change) + BEND_ROUNDING;
    return select(NO_PLANE, residual, is_plane);
}

// World difference of neighbours along `step`, from the side that is a plane; zero where neither is.
fn tangent_at(pixel: vec2i, step: vec2i, size: vec2i, here: vec3f) -> vec3f {
    let forth = bend(pixel, step, size);
    let back = bend(pixel, -step, size);
    if min(forth, back) >= NO_PLANE {
        return vec3f(0.0);
    }
    if forth <= back {
        return surface_at(pixel + step) - here;
    }
    return here - surface_at(pixel - step);
}

// Geometric normal towards the eye; zero at creases and on faces of less than three pixels, which have none.
fn normal_at(pixel: vec2i, size: vec2i, here: vec3f) -> vec3f {
    let along_x = tangent_at(pixel, vec2i(1, 0), size, here);
    let along_y = tangent_at(pixel, vec2i(0, 1), size, here);
    let normal = cross(along_y, along_x);
    return normal / max(length(normal), 1e-30);
}

// What a fragment tells: bits of the radius that it needs of a map, or MEASURE_NOTHING; and what it is for the pixels
// around it.
struct Found {
    radius_bits: u32,
    block: u32,
    map: u32,
    turns_back: bool,
    is_shadowed: bool,
}

// The sky, and what turns its back on the light, say nothing of the pixels around; a crease has no normal to tell.
fn found_at(light: u32, pixel: vec2i, size: vec2i) -> Found {
    if depth_at(pixel) >= 1.0 {
        return Found(MEASURE_NOTHING, 0u, SHADOW_NO_MAP, false, false);
    }
    let here = surface_at(pixel);
    let map = shadow_map_of(light, here);
    if map == SHADOW_NO_MAP {
        return Found(MEASURE_NOTHING, 0u, map, false, false);
    }
    let normal = normal_at(pixel, size, here);
    let position_light = (shadow_lights.maps[map].light_from_world * vec4f(here, 1.0)).xyz;
    let normal_light = (shadow_lights.maps[map].light_from_world * vec4f(normal, 0.0)).xyz;
    let ray_light = shadow_ray_light(map, position_light);
    if !shadow_faces_light(map, normal_light, ray_light) {
        let turns_back = dot(normal_light, ray_light) > 0.0;
        return Found(MEASURE_NOTHING, select(SHADOW_BLOCK_MIXED, 0u, turns_back), map, turns_back, false);
    }

    let sample = shadow_sample(light, here, normal, vec2f(pixel) + 0.5);
    if sample.visibility == 1.0 {
        return Found(MEASURE_NOTHING, SHADOW_BLOCK_LIT, map, false, false);
    }
    if sample.visibility == 0.0 {
        return Found(MEASURE_NOTHING, SHADOW_BLOCK_UMBRA, map, false, true);
    }
    let pixel_world = dot(here - measure.eye, measure.forward) * measure.pixel_at_unit_distance;
    let footprint = shadow_footprint(map, pixel_world, position_light.z);
    let guard = max(measure.radius_floor_world, measure.radius_per_footprint * footprint);
    let radius = max(sample.radius_plane, guard);
    if sample.blockers < 2u || !(radius > 0.0) {
        return Found(MEASURE_NOTHING, SHADOW_BLOCK_MIXED, map, false, true);
    }
    return Found(min(bitcast<u32>(radius), MEASURE_NOTHING), SHADOW_BLOCK_MIXED, map, false, true);
}

// CPU twin: `scumble_core::RadiusHistogram::bin_of`.
fn bin_of(map: u32, radius_bits: u32) -> u32 {
    let bin = radius_bits >> MEASURE_BIN_SHIFT;
    let first = shadow_lights.maps[map].first_bin;
    return min(max(bin, first) - first, MEASURE_BINS - 1u);
}

@compute @workgroup_size(8, 8)
fn measure_demand(
    @builtin(global_invocation_id) invocation: vec3u,
    @builtin(local_invocation_index) index: u32,
) {
    let light = invocation.z;
    let first_map = shadow_lights.lights[light].first_map;
    let map_count = shadow_lights.lights[light].map_count;
    let size = vec2i(textureDimensions(prepass));
    if index < map_count {
        atomicStore(&group_minimum[index], MEASURE_NOTHING);
        atomicStore(&group_shadowed[index], 0u);
    }
    for (var bin = index; bin < map_count * MEASURE_BINS; bin += MEASURE_GROUP) {
        atomicStore(&group_counts[bin], 0u);
    }
    start_receivers(index);
    workgroupBarrier();
    if all(invocation.xy < textureDimensions(corners)) {
        let pixel = min(vec2i(invocation.xy * measure.stride), size - 1);
        let found = found_at(light, pixel, size);
        let starts_block = all(vec2i(invocation.xy * measure.stride) < size);
        let corner = shadow_corner(found.block, found.map, starts_block);
        textureStore(corners, invocation.xy, light, vec4u(corner, 0u, 0u, 0u));
        if found.is_shadowed {
            atomicAdd(&group_shadowed[found.map - first_map], 1u);
        }
        if found.radius_bits < MEASURE_NOTHING {
            let slice = found.map - first_map;
            atomicMin(&group_minimum[slice], found.radius_bits);
            atomicAdd(&group_counts[slice * MEASURE_BINS + bin_of(found.map, found.radius_bits)], 1u);
        }
        if map_count > 1u && shadow_lights.lights[light].is_point == 0u && !found.turns_back {
            find_receivers(light, pixel, size);
        }
    }
    workgroupBarrier();
    if index < map_count {
        let minimum = atomicLoad(&group_minimum[index]);
        if minimum < MEASURE_NOTHING {
            atomicMin(&measured.maps[first_map + index].minimum_bits, minimum);
        }
        let shadowed = atomicLoad(&group_shadowed[index]);
        if shadowed > 0u {
            atomicAdd(&measured.maps[first_map + index].shadowed, shadowed);
        }
    }
    for (var bin = index; bin < map_count * MEASURE_BINS; bin += MEASURE_GROUP) {
        let count = atomicLoad(&group_counts[bin]);
        if count > 0u {
            atomicAdd(&measured.maps[first_map + bin / MEASURE_BINS].counts[bin % MEASURE_BINS], count);
        }
    }
    write_receivers(light, index);
}
