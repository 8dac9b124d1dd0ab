// Whether a surface is there, or cut out by its texture's alpha: bilinear at full size, as `scumble_scenes::AlphaTexture`
// defines it. Texels are loaded and joined here, because a sampler's weights have 8 bits.

struct Mask {
    size: vec2i,
    // By axis: 0 repeats, 1 mirrors, 2 clamps.
    wrap: vec2i,
    cutoff: f32,
}

@group(1) @binding(0) var<uniform> mask: Mask;
@group(1) @binding(1) var mask_alphas: texture_2d<f32>;

fn wrapped(texel: i32, size: i32, wrap: i32) -> i32 {
    if wrap == 2 {
        return clamp(texel, 0, size - 1);
    }
    // The remainder keeps the sign of the texel.
    let period = select(size, 2 * size, wrap == 1);
    let place = ((texel % period) + period) % period;
    return select(place, min(place, 2 * size - 1 - place), wrap == 1);
}

fn texel_alpha(texel: vec2i) -> f32 {
    let x = wrapped(texel.x, mask.size.x, mask.wrap.x);
    let y = wrapped(texel.y, mask.size.y, mask.wrap.y);
    return textureLoad(mask_alphas, vec2i(x, y), 0).x;
}

// CPU twin: `AlphaTexture::alpha`.
fn alpha_at(uv: vec2f) -> f32 {
    let place = uv * vec2f(mask.size) - 0.5;
    let share = fract(place);
    let corner = vec2i(floor(place));
    let above = mix(texel_alpha(corner), texel_alpha(corner + vec2i(1, 0)), share.x);
    let below = mix(texel_alpha(corner + vec2i(0, 1)), texel_alpha(corner + vec2i(1, 1)), share.x);
    return mix(above, below, share.y);
}

fn is_there(uv: vec2f) -> bool {
    return alpha_at(uv) >= mask.cutoff;
}
