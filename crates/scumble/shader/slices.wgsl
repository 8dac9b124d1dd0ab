// Which map of a light a point is looked up in: that of the slice of the view that its view depth lies in, whatever the
// boxes of the other maps hold. A slice does not change when its map does. CPU twin: `scumble_core::Cascade::depth_end`.

// No map: everything is lit.
const SHADOW_NO_MAP: u32 = 0xffffffffu;

fn shadow_map_of(light: u32, position_world: vec3f) -> u32 {
    if light >= SHADOW_LIGHTS_MAX || shadow_lights.lights[light].map_count == 0u {
        return SHADOW_NO_MAP;
    }
    let view_depth = dot(shadow_lights.view_depth, vec4f(position_world, 1.0));
    let is_behind = vec3f(view_depth) > shadow_lights.lights[light].slice_ends;
    let slice = u32(is_behind.x) + u32(is_behind.y) + u32(is_behind.z);
    let map = shadow_lights.lights[light].first_map + slice;
    return select(SHADOW_NO_MAP, map, shadow_lights.maps[map].has_map == 1u);
}
