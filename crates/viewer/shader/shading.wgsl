// A picture: Lambert reflection of the light times its visibility, a hemisphere of sky light times the openness, a
// sheen (Schlick's Fresnel term of a dielectric over the sky and a Blinn-Phong highlight), and a sky where there is no
// surface. One output pixel averages samples_per_side^2 samples of the G-buffer, after the tone curve, so that bright
// edges are smooth too. Prepend camera.wgsl, gbuffer_read.wgsl and lighting.wgsl.

@group(1) @binding(0) var visibility: texture_2d<f32>;
@group(1) @binding(1) var openness: texture_2d<f32>;

const WHITE: f32 = 3.2;
const SHEEN: f32 = 0.04;          // reflectance of a dielectric at normal incidence
const SHEEN_SHARE: f32 = 0.35;    // of a mirror's: most surfaces are rough
const HIGHLIGHT_EXPONENT: f32 = 48.0;

// Reinhard's curve with a white point: 0 -> 0, WHITE -> 1.
fn tone(linear: vec3f) -> vec3f {
    let exposed = linear * lighting.exposure;
    return clamp(exposed * (1.0 + exposed / (WHITE * WHITE)) / (1.0 + exposed), vec3f(0.0), vec3f(1.0));
}

fn sky(direction: vec3f) -> vec3f {
    let height = dot(direction, lighting.up);
    let above = mix(lighting.horizon_color, lighting.zenith_color, pow(clamp(height, 0.0, 1.0), 0.55));
    return mix(above, lighting.below_color, smoothstep(0.0, -0.3, height));
}

// Light that falls on a square metre turned towards it, and the way to the light.
fn incident(position: vec3f) -> vec4f {
    if lighting.cone_cosine < -1.0 {
        return vec4f(-lighting.light_direction, 1.0);
    }
    let way = lighting.light_position - position;
    let squared = dot(way, way);
    let to_light = way * inverseSqrt(squared);
    let soft_edge = mix(lighting.cone_cosine, 1.0, 0.12);
    let inside = smoothstep(lighting.cone_cosine, soft_edge, dot(-to_light, lighting.light_direction));
    return vec4f(to_light, inside * lighting.reference_distance_squared / squared);
}

fn radiance(pixel: vec2i, size: vec2f) -> vec3f {
    let position = textureLoad(gbuffer_position, pixel, 0);
    if position.w == 0.0 {
        let ndc = (vec2f(pixel) + 0.5) / size * vec2f(2.0, -2.0) + vec2f(-1.0, 1.0);
        let far = camera.world_from_clip * vec4f(ndc, 1.0, 1.0);
        return sky(normalize(far.xyz / far.w - camera.eye_world.xyz));
    }
    let normal = textureLoad(gbuffer_shading_normal, pixel, 0).xyz;
    let color = textureLoad(gbuffer_color, pixel, 0).rgb;
    let open = textureLoad(openness, pixel, 0).x;
    let light = incident(position.xyz);
    let facing = max(0.0, dot(normal, light.xyz));
    let arriving = lighting.light_color * (facing * light.w * textureLoad(visibility, pixel, 0).x);
    let upward = 0.5 + 0.5 * dot(normal, lighting.up);
    let around = mix(lighting.ground_color, mix(lighting.horizon_color, lighting.zenith_color, 0.6), upward);

    let to_eye = normalize(camera.eye_world.xyz - position.xyz);
    let middle = normalize(to_eye + light.xyz);
    let fresnel = SHEEN + (1.0 - SHEEN) * pow(1.0 - max(0.0, dot(normal, to_eye)), 5.0);
    let mirrored = sky(reflect(-to_eye, normal)) * (SHEEN_SHARE * fresnel * open);
    let highlight = SHEEN * (HIGHLIGHT_EXPONENT + 8.0) / 8.0 * pow(max(0.0, dot(normal, middle)), HIGHLIGHT_EXPONENT);
    return color * (arriving + around * open) + mirrored + arriving * highlight * 0.5;
}

@fragment
fn shade(@builtin(position) frag_coord: vec4f) -> @location(0) vec4f {
    let per_side = i32(lighting.samples_per_side);
    let size = vec2f(textureDimensions(gbuffer_position));
    let corner = vec2i(frag_coord.xy) * per_side;
    var sum = vec3f(0.0);
    for (var y = 0; y < per_side; y++) {
        for (var x = 0; x < per_side; x++) {
            sum += tone(radiance(corner + vec2i(x, y), size));
        }
    }
    return vec4f(sum / f32(per_side * per_side), 1.0);
}
