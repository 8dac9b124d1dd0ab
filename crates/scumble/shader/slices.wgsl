// Which map of a light a point is looked up in, whatever the boxes of the other maps hold. No map: everything is lit.

const SHADOW_NO_MAP: u32 = 0xffffffffu;

// The slice of the view that the point's view depth lies in. CPU twin: `scumble_core::Cascade::depth_end`.
fn shadow_slice_of(light: u32, position_world: vec3f) -> u32 {
    let view_depth = dot(shadow_lights.view_depth, vec4f(position_world, 1.0));
    let is_behind = vec3f(view_depth) > shadow_lights.lights[light].slice_ends;
    return u32(is_behind.x) + u32(is_behind.y) + u32(is_behind.z);
}

// The face of a point light that a ray from it meets: that of its longest component, x before y before z. CPU twin:
// `scumble_core::Face::of`.
fn shadow_face_of(ray: vec3f) -> u32 {
    let size = abs(ray);
    if size.x >= size.y && size.x >= size.z {
        return select(0u, 1u, ray.x < 0.0);
    }
    if size.y >= size.z {
        return select(2u, 3u, ray.y < 0.0);
    }
    return select(4u, 5u, ray.z < 0.0);
}

// A slice does not change when its map does. Under maps that were fitted to what a picture showed lies a net, which has what
// appeared since. CPU twin: `Plan::view_at`.
fn shadow_map_of(light: u32, position_world: vec3f) -> u32 {
    if light >= SHADOW_LIGHTS_MAX || shadow_lights.lights[light].map_count == 0u {
        return SHADOW_NO_MAP;
    }
    if shadow_lights.lights[light].is_point == 1u {
        let face = shadow_face_of(position_world - shadow_lights.lights[light].position);
        let map = shadow_lights.lights[light].first_map + face;
        return select(SHADOW_NO_MAP, map, shadow_lights.maps[map].has_map == 1u);
    }
    let map = shadow_lights.lights[light].first_map + shadow_slice_of(light, position_world);
    let has_map = shadow_lights.maps[map].has_map == 1u;
    let net = shadow_lights.lights[light].net_map;
    if net == SHADOW_NO_MAP {
        return select(SHADOW_NO_MAP, map, has_map);
    }
    let clip = (shadow_lights.maps[map].clip_from_world * vec4f(position_world, 1.0)).xy;
    return select(net, map, has_map && all(abs(clip) <= shadow_lights.maps[map].inner));
}
