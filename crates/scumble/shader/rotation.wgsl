// The turn of the kernel at a pixel. CPU twin, bit for bit in the hash: `scumble_core::pixel_hash`, `rotation_angle`.

fn shadow_pixel_hash(frag_coord: vec2u) -> u32 {
    var h = frag_coord.x + frag_coord.y * 0x9e3779b1u;
    h = (h ^ (h >> 16u)) * 0x7feb352du;
    h = (h ^ (h >> 15u)) * 0x846ca68bu;
    return h ^ (h >> 16u);
}

fn shadow_rotation_angle(frag_coord: vec2u) -> f32 {
    return f32(shadow_pixel_hash(frag_coord) >> 8u) / 16777216.0 * 6.283185307179586;
}

// Columns of the stretch of a disc across the ray (s, 1) where it lies on the plane across the axis: 1 across s and
// sqrt(1 + |s|^2) along it. CPU twin: `scumble_core::ReceiverPlane::on_plane`.
fn shadow_stretch(ray: vec2f) -> mat2x2f {
    let k = ray / sqrt(1.0 + sqrt(1.0 + dot(ray, ray)));
    return mat2x2f(1.0 + k.x * k.x, k.x * k.y, k.x * k.y, 1.0 + k.y * k.y);
}

// Columns of the rotation by the pixel's angle.
fn shadow_rotation(frag_coord: vec2u) -> mat2x2f {
    let angle = shadow_rotation_angle(frag_coord);
    let c = cos(angle);
    let s = sin(angle);
    return mat2x2f(c, s, -s, c);
}
