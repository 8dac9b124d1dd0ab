// What the passes of variance shadow maps know of a map. Rust twin: `MomentsUniform`.

struct Moments {
    // Size of the map's viewport, texels.
    viewport: vec2u,
    // Corner of the viewport in its layer, and of the blocks in theirs.
    origin: vec2u,
    // Texels of a block along x and y.
    block: vec2u,
    // Half sides of the kernel, blocks.
    radius: vec2f,
    // Near plane's depth by the far plane's under a spot; 1 where map depth is linear.
    near_over_far: f32,
    padding: u32,
}

@group(0) @binding(0) var<uniform> moments: Moments;
