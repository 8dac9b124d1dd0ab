// Percentage closer soft shadows (Kreuzer 2017, Eq. 5.8 to 5.11): the kernel's radius from the blockers' mean depth.
//   spot         r_search = r_light (z_r - z_n) / z_r,  r_penumbra = r_light (z_r - z_b) / z_b,  r_filter = r_penumbra z_n / z_r
//   directional  r_search = (z_r - z_n) tan(half angle),  r_filter = (z_r - z_b) tan(half angle)
// z_r receiver, z_b mean blocker, z_n near plane, light-space depths; radii at the reference plane.
// CPU twin: `scumble_core::filter`.

// The nearest occluder that a spot searches for, as a share of the receiver's depth; `filter::SEARCH_SHARE` of the CPU.
const SHADOW_SEARCH_SHARE: f32 = 0.2;

struct ShadowBlockers {
    count: u32,
    // Mean light-space depth; the receiver's where there is none.
    mean_depth: f32,
}

fn shadow_filter_radius(map: u32, receiver_depth: f32, blocker_depth: f32) -> f32 {
    let size = shadow_lights.maps[map].light_size;
    let distance = max(receiver_depth - blocker_depth, 0.0);
    if shadow_lights.maps[map].is_spot == 1u {
        return size * distance / blocker_depth * shadow_lights.maps[map].depth_near / receiver_depth;
    }
    return size * distance;
}

// The filter's radius for a blocker at the near plane of the map; under a spot, at SHADOW_SEARCH_SHARE of the
// receiver's depth where the near plane is nearer.
fn shadow_search_radius(map: u32, receiver_depth: f32) -> f32 {
    var nearest = shadow_lights.maps[map].depth_near;
    if shadow_lights.maps[map].is_spot == 1u {
        nearest = max(nearest, SHADOW_SEARCH_SHARE * receiver_depth);
    }
    return shadow_filter_radius(map, receiver_depth, nearest);
}

// Map depths in front of the receiver's tangent plane within `radius_plane`, one texel a tap.
fn shadow_find_blockers(
    map: u32,
    receiver: ShadowReceiver,
    kernel: ShadowKernel,
    radius_plane: f32,
    rotation: mat2x2f,
) -> ShadowBlockers {
    let fraction = shadow_depth_fraction(map);
    let share_from_tap = receiver.depth_share * rotation;
    let origin = vec2i(kernel.origin);
    let last = kernel.viewport - 1.0;
    var count = 0u;
    var sum = 0.0;
    for (var i = 0u; i < SHADOW_BLOCKER_TAPS; i++) {
        let pair = shadow_taps.blocker[i / 2u];
        let tap = radius_plane * select(pair.xy, pair.zw, (i & 1u) == 1u);
        let texel = kernel.texel + kernel.texel_from_tap * tap;
        let place = vec2i(clamp(texel, vec2f(0.0), last)) + origin;
        let depth = textureLoad(shadow_depths, place, kernel.layer, 0).x;
        let is_inside = all(texel >= vec2f(0.0)) && all(texel < kernel.viewport);
        if is_inside && depth < shadow_tap_depth(kernel, tap) {
            count += 1u;
            sum += shadow_light_depth(fraction, depth) * (1.0 + dot(share_from_tap, tap));
        }
    }
    return ShadowBlockers(count, select(receiver.light_depth, sum / f32(max(count, 1u)), count > 0u));
}
