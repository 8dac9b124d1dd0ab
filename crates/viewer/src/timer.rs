//! Times of the parts of a frame, by timestamp queries between passes.
//!
//! A mark ends the part that began at the mark before it. Marks stand between passes and never inside one: a tiled or a
//! software rasteriser does the work of a pass when the pass ends.

use anyhow::Result;

use crate::device::Gpu;
use crate::readback::read_buffer;

/// More marks than any frame here sets.
const MARKS_MAX: u32 = 32;

/// Milliseconds by part of a frame, in the order of the passes.
pub type Times = Vec<(&'static str, f64)>;

/// Collects marks of one frame at a time.
pub struct Timer {
    queries: Option<wgpu::QuerySet>,
    resolved: wgpu::Buffer,
    period_ns: f64,
    parts: Vec<&'static str>,
}

impl Timer {
    /// A timer; on a device without timestamps it measures nothing and says so by an empty list.
    pub fn new(gpu: &Gpu) -> Self {
        let queries = gpu.has_timestamps().then(|| {
            gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("timer"),
                ty: wgpu::QueryType::Timestamp,
                count: MARKS_MAX,
            })
        });
        let resolved = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("timer"),
            size: u64::from(MARKS_MAX) * 8,
            usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        Self { queries, resolved, period_ns: f64::from(gpu.queue.get_timestamp_period()), parts: Vec::new() }
    }

    /// Starts a frame: forgets the marks of the last one.
    pub fn start(&mut self, encoder: &mut wgpu::CommandEncoder) {
        self.parts.clear();
        self.mark(encoder, "start");
    }

    /// Ends the part of the frame that has run since the last mark and names it.
    pub fn mark(&mut self, encoder: &mut wgpu::CommandEncoder, part: &'static str) {
        let Some(queries) = &self.queries else { return };
        assert!(self.parts.len() < MARKS_MAX as usize, "a frame has at most {MARKS_MAX} marks");
        encoder.write_timestamp(queries, self.parts.len() as u32);
        self.parts.push(part);
    }

    /// The last command of a timed frame.
    pub fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        if let Some(queries) = &self.queries {
            encoder.resolve_query_set(queries, 0..self.parts.len() as u32, &self.resolved, 0);
        }
    }

    /// Milliseconds of each part in the order of the marks, after the frame was submitted.
    pub fn read(&self, gpu: &Gpu) -> Result<Times> {
        if self.queries.is_none() || self.parts.is_empty() {
            return Ok(Vec::new());
        }
        let bytes = read_buffer(gpu, &self.resolved)?;
        let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&bytes);
        let spans = ticks.windows(2).map(|pair| pair[1].saturating_sub(pair[0]) as f64 * self.period_ns * 1e-6);
        Ok(self.parts[1..].iter().copied().zip(spans).collect())
    }
}
