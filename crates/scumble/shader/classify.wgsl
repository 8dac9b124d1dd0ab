// From what was found at the corners of blocks of pixels to what the blocks hold: the union over the four corners. And how
// many blocks of each kind a map has; a block of several maps counts for the last of them.

@group(0) @binding(0) var corners: texture_2d_array<u32>;
@group(0) @binding(1) var blocks: texture_storage_2d_array<r32uint, write>;
// Begins with `Measured.blocks` of the demand pass: three counts a map, by kind.
@group(0) @binding(2) var<storage, read_write> counts: array<atomic<u32>>;

const CLASSIFY_GROUP: u32 = 64u;
const CLASSIFY_KINDS: u32 = 3u;
const CLASSIFY_COUNTS: u32 = 72u;

var<workgroup> group_counts: array<atomic<u32>, CLASSIFY_COUNTS>;

@compute @workgroup_size(8, 8)
fn classify_blocks(
    @builtin(global_invocation_id) invocation: vec3u,
    @builtin(local_invocation_index) index: u32,
) {
    let block = invocation.xy;
    let light = invocation.z;
    for (var i = index; i < CLASSIFY_COUNTS; i += CLASSIFY_GROUP) {
        atomicStore(&group_counts[i], 0u);
    }
    workgroupBarrier();
    if all(block < textureDimensions(blocks)) {
        let last = textureDimensions(corners) - 1u;
        let first = textureLoad(corners, block, light, 0).x;
        var kind = 0u;
        var map = 0u;
        for (var i = 0u; i < 4u; i++) {
            let corner = textureLoad(corners, min(block + vec2u(i & 1u, i >> 1u), last), light, 0).x;
            kind |= corner & SHADOW_CORNER_KIND;
            map = max(map, corner >> SHADOW_CORNER_MAP_SHIFT);
        }
        textureStore(blocks, block, light, vec4u(kind, 0u, 0u, 0u));
        if (first & SHADOW_CORNER_BEGINS) != 0u && kind > 0u && map > 0u {
            atomicAdd(&group_counts[(map - 1u) * CLASSIFY_KINDS + kind - 1u], 1u);
        }
    }
    workgroupBarrier();
    for (var i = index; i < CLASSIFY_COUNTS; i += CLASSIFY_GROUP) {
        let count = atomicLoad(&group_counts[i]);
        if count > 0u {
            atomicAdd(&counts[i], count);
        }
    }
}
