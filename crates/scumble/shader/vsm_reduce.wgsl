// Variance shadow maps, first pass: mean and variance of depth in each block of texels of a map.
//
// Depth is linear, 0 at the map's near plane and 1 at its far plane. The sums are of differences from the block's first
// texel, so that nothing cancels. CPU twin: `scumble_core::moments::MomentMap::new`.
// Prepend vsm_map.wgsl.

@group(0) @binding(1) var map: texture_depth_2d;
@group(0) @binding(2) var reduced: texture_storage_2d<rg32float, write>;

fn linear_depth(texel: vec2u) -> f32 {
    let depth = textureLoad(map, moments.origin + texel, 0);
    return moments.near_over_far * depth / (1.0 - depth * (1.0 - moments.near_over_far));
}

@compute @workgroup_size(8, 8)
fn reduce_blocks(@builtin(global_invocation_id) invocation: vec3u) {
    let first = invocation.xy * moments.block;
    if any(first >= moments.viewport) {
        return;
    }
    let end = min(first + moments.block, moments.viewport);
    let middle = linear_depth(first);
    var sum = 0.0;
    var squares = 0.0;
    for (var y = first.y; y < end.y; y++) {
        for (var x = first.x; x < end.x; x++) {
            let difference = linear_depth(vec2u(x, y)) - middle;
            sum += difference;
            squares += difference * difference;
        }
    }
    let size = end - first;
    let count = f32(size.x * size.y);
    let shift = sum / count;
    textureStore(reduced, moments.origin + invocation.xy, vec4f(middle + shift, max(squares / count - shift * shift, 0.0), 0.0, 0.0));
}
