// The shader's one call: how much of a light reaches a point.

struct ShadowSample {
    // Share of the light that arrives, 0 to 1.
    visibility: f32,
    // Radius of the filter at the reference plane before it is clamped, world length; 0 where there was none.
    radius_plane: f32,
    // Samples that found a blocker: of the search (PCSS), or of the kernel.
    blockers: u32,
}

fn shadow_filter_of(map: u32) -> u32 {
    if shadow_filter == SHADOW_FILTER_UPLOADED {
        return shadow_lights.maps[map].filter_kind;
    }
    return shadow_filter;
}

// Filters a point that has a place in a map.
fn shadow_filtered(map: u32, receiver: ShadowReceiver, frag_coord: vec2f) -> ShadowSample {
    let kind = shadow_filter_of(map);
    if kind == SHADOW_FILTER_HARD {
        let visibility = shadow_hard(map, receiver);
        return ShadowSample(visibility, 0.0, u32(visibility < 1.0));
    }

    if kind == SHADOW_FILTER_VSM {
        // Moments do not say how many texels block the light: some do, or none.
        let visibility = shadow_vsm(map, receiver);
        let radius = shadow_lights.maps[map].radius_world;
        return ShadowSample(visibility, radius, select(0u, 2u, visibility < 1.0));
    }

    var rotation = shadow_rotation(vec2u(frag_coord));
    if shadow_lights.maps[map].is_sphere == 1u {
        rotation = shadow_stretch(receiver.ray) * rotation;
    }
    let kernel = shadow_kernel(map, receiver, rotation);
    if kind == SHADOW_FILTER_PCF {
        let radius = shadow_lights.maps[map].radius_world;
        let visibility = shadow_pcf(kernel, radius);
        return ShadowSample(visibility, radius, u32(round((1.0 - visibility) * f32(SHADOW_PCF_TAPS))));
    }

    let radius_min = shadow_lights.maps[map].radius_min_world;
    let search = max(shadow_search_radius(map, receiver.light_depth), radius_min);
    let blockers = shadow_find_blockers(map, receiver, kernel, search, rotation);
    if blockers.count == 0u {
        return ShadowSample(1.0, 0.0, 0u);
    }
    let radius = shadow_filter_radius(map, receiver.light_depth, blockers.mean_depth);
    let visibility = shadow_pcf(kernel, max(radius, radius_min));
    return ShadowSample(visibility, radius, blockers.count);
}

// Whether a point has no place in a map: everything is lit there.
fn shadow_is_open(map: u32, receiver: ShadowReceiver) -> bool {
    return shadow_lights.maps[map].is_spot == 1u && !(receiver.light_depth > 0.0);
}

fn shadow_sample(light: u32, position_world: vec3f, normal_world: vec3f, frag_coord: vec2f) -> ShadowSample {
    let map = shadow_map_of(light, position_world);
    if map == SHADOW_NO_MAP {
        return ShadowSample(1.0, 0.0, 0u);
    }
    let receiver = shadow_receiver(map, position_world, normal_world);
    if shadow_is_open(map, receiver) {
        return ShadowSample(1.0, 0.0, 0u);
    }
    return shadow_filtered(map, receiver, frag_coord);
}

// What all corners of the pixel's block agree on; SHADOW_BLOCK_MIXED where they do not, or none is known.
fn shadow_block(light: u32, pixel: vec2u) -> u32 {
    let side = shadow_lights.block_px;
    if side == 0u {
        return SHADOW_BLOCK_MIXED;
    }
    return textureLoad(shadow_blocks, pixel / side, light, 0).x;
}

// Share of a light that reaches `position_world` (relative to the origin given to `Shadows`) on a surface with the
// geometric normal `normal_world`; `frag_coord` turns the kernel per pixel. Where the demand pass found the block of
// pixels around it lit or dark, one lookup that says the same stands for the filter.
fn shadow_visibility(light: u32, position_world: vec3f, normal_world: vec3f, frag_coord: vec2f) -> f32 {
    let map = shadow_map_of(light, position_world);
    if map == SHADOW_NO_MAP {
        return 1.0;
    }
    let receiver = shadow_receiver(map, position_world, normal_world);
    if shadow_is_open(map, receiver) {
        return 1.0;
    }
    let kind = shadow_filter_of(map);
    if kind == SHADOW_FILTER_PCF || kind == SHADOW_FILTER_PCSS {
        let block = shadow_block(light, vec2u(frag_coord));
        if block == SHADOW_BLOCK_LIT || block == SHADOW_BLOCK_UMBRA {
            let visibility = shadow_hard(map, receiver);
            if visibility == select(0.0, 1.0, block == SHADOW_BLOCK_LIT) {
                return visibility;
            }
        }
    }
    return shadow_filtered(map, receiver, frag_coord).visibility;
}
