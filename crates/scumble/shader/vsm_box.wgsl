// Variance shadow maps, second and third pass: a moving mean of moments along one axis.
//
// Weights are the parts of blocks inside the kernel; beyond the viewport it is cut off. Parts are joined by their
// differences from the middle one: variance = E (variance_i + difference_i^2) - (E difference_i)^2.
// CPU twin: `scumble_core::moments::MomentMap::new`. Prepend vsm_map.wgsl.

// 0 along x, 1 along y.
override box_axis: u32 = 0u;

@group(0) @binding(1) var source: texture_2d<f32>;
@group(0) @binding(2) var filtered: texture_storage_2d<rg32float, write>;

@compute @workgroup_size(8, 8)
fn box_blocks(@builtin(global_invocation_id) invocation: vec3u) {
    let size = (moments.viewport + moments.block - 1u) / moments.block;
    if any(invocation.xy >= size) {
        return;
    }
    let at = vec2i(moments.origin + invocation.xy);
    let along = select(vec2i(1, 0), vec2i(0, 1), box_axis == 1u);
    let middle = i32(invocation[box_axis]);
    let last = i32(size[box_axis]) - 1;
    let edge = max(moments.radius[box_axis], 0.5) + 0.5;
    let reach = i32(ceil(edge)) - 1;

    let mean = textureLoad(source, at, 0).x;
    var weights = 0.0;
    var sum = 0.0;
    var squares = 0.0;
    for (var i = max(-reach, -middle); i <= min(reach, last - middle); i++) {
        let part = textureLoad(source, at + i * along, 0).xy;
        let weight = clamp(edge - abs(f32(i)), 0.0, 1.0);
        let difference = part.x - mean;
        weights += weight;
        sum += weight * difference;
        squares += weight * (part.y + difference * difference);
    }
    let shift = sum / weights;
    textureStore(filtered, at, vec4f(mean + shift, max(squares / weights - shift * shift, 0.0), 0.0, 0.0));
}
