//! What the crate did, in counts: for tests and for a statistics line, never a time.

/// Counts since creation, or of the uploaded plan where it says so.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Textures, buffers and bind groups created.
    pub allocations: u64,
    /// Bytes of the map texture, and of the textures of moments and of static casters where there are any.
    pub map_bytes: u64,
    /// Texels of all maps of the uploaded plan.
    pub texels: u64,
    /// Map lookups that one pixel and light needs at most with the filter of the uploaded plan.
    pub taps_per_pixel: u32,
    /// Texels and blocks that the moments of all maps of the uploaded plan are made from; 0 without VSM.
    pub moment_taps: u64,
    /// Blocks of the moments of all maps of the uploaded plan, 16 bytes each in two textures; 0 without VSM.
    pub moment_blocks: u64,
    /// Moments made, three dispatches each.
    pub moment_passes: u64,
    /// Depth passes begun, those of static casters included.
    pub map_passes: u64,
    /// Passes of static casters that were not needed, because the map still held them.
    pub static_passes_skipped: u64,
    /// Maps of the lights of the uploaded plan that nothing on screen needs: no pass, no texels, all lit.
    pub maps_skipped: u32,
    /// Maps of the uploaded plan that rest at a small size, because nothing on screen is in their shadow.
    pub maps_resting: u32,
    /// Demand passes recorded.
    pub measure_passes: u64,
    /// Demand passes whose result was not brought back because the readback ring was full.
    pub readbacks_skipped: u64,
    /// Results that came back and were taken.
    pub readbacks_taken: u64,
}

/// What the blocks of pixels of a measured picture hold that read one map, in number; those of sky and of what turns its
/// back on the light are in none. A block has `measure_stride` squared pixels, but for those on the picture's border.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BlockCounts {
    /// Lit at every corner: pixels whose one lookup says so skip the filter.
    pub lit: u32,
    /// Dark at every corner: likewise.
    pub umbra: u32,
    /// All others: every pixel pays the filter.
    pub mixed: u32,
}

impl BlockCounts {
    /// All blocks.
    #[must_use]
    pub fn total(&self) -> u32 {
        self.lit + self.umbra + self.mixed
    }

    /// Share of the blocks that skip the filter of PCF and PCSS, 0 to 1; 0 of no blocks.
    #[must_use]
    pub fn skipped_share(&self) -> f64 {
        f64::from(self.lit + self.umbra) / f64::from(self.total().max(1))
    }
}

impl std::ops::Add for BlockCounts {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { lit: self.lit + other.lit, umbra: self.umbra + other.umbra, mixed: self.mixed + other.mixed }
    }
}
