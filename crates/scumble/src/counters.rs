//! What the crate did, in counts: for tests and for a statistics line, never a time.

/// Counts since creation, or of the uploaded plan where it says so.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Textures, buffers and bind groups created.
    pub allocations: u64,
    /// Bytes of the map texture, and of the textures of moments where there are any.
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
    /// Depth passes begun.
    pub map_passes: u64,
    /// Demand passes recorded.
    pub measure_passes: u64,
    /// Demand passes whose result was not brought back because the readback ring was full.
    pub readbacks_skipped: u64,
    /// Results that came back and were taken.
    pub readbacks_taken: u64,
}
