//! What the crate did, in counts: for tests and for a statistics line, never a time.

/// Counts since creation, or of the uploaded plan where it says so.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Textures, buffers and bind groups created.
    pub allocations: u64,
    /// Bytes of the map texture.
    pub map_bytes: u64,
    /// Texels of all maps of the uploaded plan.
    pub texels: u64,
    /// Map lookups that one pixel and light needs at most with the filter of the uploaded plan.
    pub taps_per_pixel: u32,
    /// Depth passes begun.
    pub map_passes: u64,
    /// Demand passes recorded.
    pub measure_passes: u64,
    /// Demand passes whose result was not brought back because the readback ring was full.
    pub readbacks_skipped: u64,
    /// Results that came back and were taken.
    pub readbacks_taken: u64,
}
