// From what was found at the corners of blocks of pixels to what the blocks hold: the union over the four corners.

@group(0) @binding(0) var corners: texture_2d_array<u32>;
@group(0) @binding(1) var blocks: texture_storage_2d_array<r32uint, write>;

@compute @workgroup_size(8, 8)
fn classify_blocks(@builtin(global_invocation_id) invocation: vec3u) {
    let block = invocation.xy;
    let light = invocation.z;
    if any(block >= textureDimensions(blocks)) {
        return;
    }
    let last = textureDimensions(corners) - 1u;
    var found = 0u;
    for (var i = 0u; i < 4u; i++) {
        let corner = min(block + vec2u(i & 1u, i >> 1u), last);
        found |= textureLoad(corners, corner, light, 0).x;
    }
    textureStore(blocks, block, light, vec4u(found, 0u, 0u, 0u));
}
