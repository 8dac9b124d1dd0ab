// Which map of a light a point is looked up in: that of the slice of the view that its view depth lies in, whatever the
// boxes of the other maps hold. A slice does not change when its map does. Under maps that were fitted to what a picture
// showed lies a net, which has what appeared since. CPU twin: `Plan::view_at`.

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
    let has_map = shadow_lights.maps[map].has_map == 1u;
    let net = shadow_lights.lights[light].net_map;
    if net == SHADOW_NO_MAP {
        return select(SHADOW_NO_MAP, map, has_map);
    }
    let clip = (shadow_lights.maps[map].clip_from_world * vec4f(position_world, 1.0)).xy;
    return select(net, map, has_map && all(abs(clip) <= shadow_lights.maps[map].inner));
}
