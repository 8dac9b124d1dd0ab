// The light and the sky of the pictures; the twin of `LightingUniform` in shading.rs. Colours are linear.

struct Lighting {
    light_color: vec3f,
    obscurance_radius_world: f32,
    light_position: vec3f,       // of a lamp
    focal_length_px: f32,
    light_direction: vec3f,      // the way the light travels, unit length; zero for a point light
    cone_cosine: f32,            // cosine of the spot's half angle; -1 for a point light, -2 for a directional one
    zenith_color: vec3f,
    reference_distance_squared: f32,
    horizon_color: vec3f,
    samples_per_side: u32,
    ground_color: vec3f,
    exposure: f32,
    up: vec3f,
    padding: f32,
    below_color: vec3f,
}

@group(0) @binding(5) var<uniform> lighting: Lighting;
