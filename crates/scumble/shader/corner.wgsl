// One measured pixel in a word, from the demand pass to the pass that makes blocks of corners: what it is, the map that
// shading reads there, and whether a block of the picture begins with it.
//
// Bits 0 and 1: SHADOW_BLOCK_...; bit 2: begins a block; bits 8 and up: number of the map plus 1, 0 for none.

const SHADOW_CORNER_KIND: u32 = 3u;
const SHADOW_CORNER_BEGINS: u32 = 4u;
const SHADOW_CORNER_MAP_SHIFT: u32 = 8u;

// `map` may be the largest u32, which stands for none.
fn shadow_corner(kind: u32, map: u32, begins_block: bool) -> u32 {
    return kind | select(0u, SHADOW_CORNER_BEGINS, begins_block) | ((map + 1u) << SHADOW_CORNER_MAP_SHIFT);
}
