// What the pixels of a block are, the low bits of `shadow_blocks`: nothing known, all lit, all dark, anything, or a wide
// penumbra on one surface.
const SHADOW_BLOCK_NONE: u32 = 0u;
const SHADOW_BLOCK_LIT: u32 = 1u;
const SHADOW_BLOCK_UMBRA: u32 = 2u;
const SHADOW_BLOCK_MIXED: u32 = 3u;
const SHADOW_BLOCK_SMOOTH: u32 = 4u;
const SHADOW_BLOCK_BITS: u32 = 7u;
