// From a point with a normal to a place in the map and the plane that every tap compares with.
//
// The receiver is at (x, y, d) of light space with the normal m; s = (x, y) / d for a spot, 0 for a directional light.
// Along its tangent plane depth changes by t = -m_xy / (m . (s, 1)) per world length sideways, and over an offset o at
// the reference plane (depth `near` for a spot) map depth, unlike depth, is linear for both projections:
//   directional  (d + t . o - near) / (far - near)
//   spot         far / (far - near) (1 - near / d + t . o / d)
// so the plane is a map depth and a slope, two operations a tap. The length of t is clamped to `slope_max`.
// The bias is a length, texel (constant + slope (|t_x| + |t_y|)) and a part for rounding, taken as map depth at the
// receiver. CPU twin: `scumble_core::ReceiverPlane`, which takes the bias of a spot at each tap.

struct ShadowReceiver {
    // Place in the viewport, texels.
    texel: vec2f,
    // Map depth there, and its change per world length at the reference plane.
    depth: f32,
    slope: vec2f,
    // To subtract from the map depth of every tap.
    bias: f32,
    // Light-space depth, world length.
    light_depth: f32,
    // Larger side of a texel at the receiver, world length.
    texel_world: f32,
    // s of a point light; zero of others, whose kernel is a disc of the reference plane.
    ray: vec2f,
    // Change of a blocker's depth along the ray by its depth, per world length at the reference plane; zero likewise. CPU
    // twin: `scumble_core::ReceiverPlane::depth_along_ray`.
    depth_share: vec2f,
}

// Light-space depth of a map depth d is (x + y d) / (z + w d) of these.
fn shadow_depth_fraction(map: u32) -> vec4f {
    let near = shadow_lights.maps[map].depth_near;
    let far = shadow_lights.maps[map].depth_far;
    if shadow_lights.maps[map].is_spot == 1u {
        return vec4f(near * far, 0.0, far, near - far);
    }
    return vec4f(near, far - near, 1.0, 0.0);
}

fn shadow_light_depth(fraction: vec4f, map_depth: f32) -> f32 {
    return (fraction.x + fraction.y * map_depth) / (fraction.z + fraction.w * map_depth);
}

// -n_xy / along, no longer than `longest`, also where the surface is seen edge-on.
fn shadow_tangent(n_xy: vec2f, along: f32, longest: f32) -> vec2f {
    let size = length(n_xy);
    if size <= longest * abs(along) {
        return select(-n_xy / along, vec2f(0.0), along == 0.0);
    }
    return n_xy * (select(-1.0, 1.0, along < 0.0) * longest / size);
}

fn shadow_receiver(map: u32, position_world: vec3f, normal_world: vec3f) -> ShadowReceiver {
    let position = vec4f(position_world, 1.0);
    let clip = shadow_lights.maps[map].clip_from_world * position;
    let p = (shadow_lights.maps[map].light_from_world * position).xyz;
    let m = (shadow_lights.maps[map].light_from_world * vec4f(normal_world, 0.0)).xyz;
    let near = shadow_lights.maps[map].depth_near;
    let far = shadow_lights.maps[map].depth_far;
    let slope_max = shadow_lights.maps[map].slope_max;

    var receiver: ShadowReceiver;
    let ndc = clip.xyz / clip.w;
    receiver.texel = (ndc.xy * vec2f(0.5, -0.5) + 0.5) * shadow_lights.maps[map].viewport_texels;
    receiver.depth = ndc.z;
    receiver.light_depth = p.z;

    // Tangent plane, and map depth per length: across a texel at the receiver, and per bias.
    var tangent = shadow_tangent(m.xy, m.z, slope_max);
    var texel = shadow_lights.maps[map].texel_world;
    var depth_per_length = 1.0 / (far - near);
    receiver.slope = tangent * depth_per_length;
    if shadow_lights.maps[map].is_spot == 1u {
        tangent = shadow_tangent(m.xy, dot(m, vec3f(p.xy / p.z, 1.0)), slope_max);
        receiver.ray = select(vec2f(0.0), p.xy / p.z, shadow_lights.maps[map].is_sphere == 1u);
        receiver.depth_share = receiver.ray / (near * (1.0 + dot(receiver.ray, receiver.ray)));
        texel *= p.z / near;
        receiver.slope = tangent * (far / ((far - near) * p.z));
        depth_per_length = near * far / ((far - near) * p.z * p.z);
    }
    receiver.texel_world = texel;
    let bias_texels = shadow_lights.maps[map].bias_constant_texels
        + shadow_lights.maps[map].bias_slope_texels * (abs(tangent.x) + abs(tangent.y));
    receiver.bias = depth_per_length * (texel * bias_texels + shadow_lights.maps[map].bias_rounding_world);
    return receiver;
}
