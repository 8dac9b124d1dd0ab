// Which surfaces tell the demand, and what a pixel covers of them.

// From the light to a point of light space; of any length under a directional light.
fn shadow_ray_light(map: u32, position_light: vec3f) -> vec3f {
    return select(vec3f(0.0, 0.0, 1.0), position_light, shadow_lights.maps[map].is_spot == 1u);
}

// Whether the surface looks towards the light, no steeper than the bias follows: beyond, it shadows itself.
fn shadow_faces_light(map: u32, normal_light: vec3f, ray_light: vec3f) -> bool {
    let along = dot(normal_light, ray_light);
    let slope_max = shadow_lights.maps[map].slope_max;
    return along < 0.0 && along * along * (1.0 + slope_max * slope_max) >= dot(ray_light, ray_light);
}

// Width of a pixel, `pixel_world` at the receiver, projected onto the reference plane. CPU twin:
// `scumble_core::pixel_footprint_world`.
fn shadow_footprint(map: u32, pixel_world: f32, light_depth: f32) -> f32 {
    if shadow_lights.maps[map].is_spot == 1u {
        return pixel_world * shadow_lights.maps[map].depth_near / light_depth;
    }
    return pixel_world;
}
