// The demand from a renderer's own fragment shaders, for one without a depth prepass (Kreuzer 2017, 5.1.3 and Eq. 5.12).
//
// Every fragment that is shaded counts, under the rules of the demand pass: partial visibility, two blockers at least, a
// surface that the bias follows, no radius below what a pixel can show. Fragments that a later one hides count as well, so
// the map may be larger than the screen needs, never smaller. Most fragments do not lower the minimum; they only read it.

struct ShadowFragments {
    // Radius that one pixel of footprint asks for, in footprints: ratio times kappa.
    radius_per_footprint: f32,
    // Smallest radius that is counted, world length at the reference plane.
    radius_floor_world: f32,
    // By map: bits of the smallest radius, those of infinity where there was none.
    minima: array<atomic<u32>, SHADOW_MAPS_MAX>,
}

@group(0) @binding(0) var<storage, read_write> shadow_fragments: ShadowFragments;

// As `shadow_visibility`, and tells the demand. `pixel_world` is the width of a pixel at the fragment, world length.
fn shadow_visibility_measured(
    light: u32,
    position_world: vec3f,
    normal_world: vec3f,
    frag_coord: vec2f,
    pixel_world: f32,
) -> f32 {
    let map = shadow_map_of(light, position_world);
    if map == SHADOW_NO_MAP {
        return 1.0;
    }
    let sample = shadow_sample(light, position_world, normal_world, frag_coord);
    let is_partial = sample.visibility > 0.0 && sample.visibility < 1.0 && sample.blockers >= 2u;
    if !is_partial {
        return sample.visibility;
    }
    let position_light = (shadow_lights.maps[map].light_from_world * vec4f(position_world, 1.0)).xyz;
    let normal_light = (shadow_lights.maps[map].light_from_world * vec4f(normal_world, 0.0)).xyz;
    if shadow_faces_light(map, normal_light, shadow_ray_light(map, position_light)) {
        let footprint = shadow_footprint(map, pixel_world, position_light.z);
        let guard = max(shadow_fragments.radius_floor_world, shadow_fragments.radius_per_footprint * footprint);
        // The bits of what is no radius, NaN or below 0, are above those of infinity.
        let radius_bits = bitcast<u32>(max(sample.radius_plane, guard));
        if radius_bits > 0u && radius_bits < atomicLoad(&shadow_fragments.minima[map]) {
            atomicMin(&shadow_fragments.minima[map], radius_bits);
        }
    }
    return sample.visibility;
}
