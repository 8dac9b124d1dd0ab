//! A ring of small buffers that brings GPU results to the CPU without ever waiting.
//!
//! A slot goes free -> in flight (a copy was recorded; mapping starts when the caller submits) -> ready (mapped) ->
//! free. When no slot is free, the measurement of that frame is not copied: a frame without a result, never a wait.
//! An encoder that is dropped unsubmitted drops its callback, whose guard frees the slot.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

/// Slots: a result usually comes one to two frames late, and one more slot bridges a late poll.
const SLOTS: usize = 3;

const FREE: u8 = 0;
const IN_FLIGHT: u8 = 1;
const READY: u8 = 2;

/// The buffers and what was known on the CPU when each copy was recorded.
#[derive(Debug)]
pub struct Ring<T> {
    slots: Vec<Slot<T>>,
    recorded: u64,
}

#[derive(Debug)]
struct Slot<T> {
    buffer: wgpu::Buffer,
    state: Arc<AtomicU8>,
    sequence: u64,
    context: Option<T>,
}

/// Sets the state when mapping ends, however it ends.
struct Landing {
    state: Arc<AtomicU8>,
    outcome: u8,
}

impl Landing {
    /// Takes the whole guard, so that a closure captures all of it.
    fn end(mut self, mapped: bool) {
        self.outcome = if mapped { READY } else { FREE };
    }
}

impl Drop for Landing {
    fn drop(&mut self) {
        self.state.store(self.outcome, Ordering::Release);
    }
}

impl<T> Ring<T> {
    /// Allocates every slot with `bytes` bytes.
    pub fn new(device: &wgpu::Device, bytes: u64) -> Self {
        let slots = (0..SLOTS)
            .map(|_| Slot {
                buffer: device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some("scumble readback"),
                    size: bytes,
                    usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                    mapped_at_creation: false,
                }),
                state: Arc::new(AtomicU8::new(FREE)),
                sequence: 0,
                context: None,
            })
            .collect();
        Self { slots, recorded: 0 }
    }

    /// Buffers of the ring.
    pub fn slot_count(&self) -> usize {
        self.slots.len()
    }

    /// Records a copy of the whole `source` and its mapping; false when every slot is taken.
    pub fn record(&mut self, encoder: &mut wgpu::CommandEncoder, source: &wgpu::Buffer, context: T) -> bool {
        let Some(slot) = self.slots.iter_mut().find(|slot| slot.state.load(Ordering::Acquire) == FREE) else {
            return false;
        };
        self.recorded += 1;
        slot.sequence = self.recorded;
        slot.context = Some(context);
        slot.state.store(IN_FLIGHT, Ordering::Release);
        encoder.copy_buffer_to_buffer(source, 0, &slot.buffer, 0, slot.buffer.size());
        let landing = Landing { state: Arc::clone(&slot.state), outcome: FREE };
        encoder.map_buffer_on_submit(&slot.buffer, wgpu::MapMode::Read, .., move |result| {
            landing.end(result.is_ok());
        });
        true
    }

    /// Takes the newest result that has landed, with its context, and frees all older ones.
    pub fn take(&mut self) -> Option<(Vec<u8>, T)> {
        let mut newest: Option<(u64, Vec<u8>, T)> = None;
        for slot in &mut self.slots {
            if slot.state.load(Ordering::Acquire) != READY {
                continue;
            }
            let bytes = slot.buffer.get_mapped_range(..).ok().map(|view| view.to_vec());
            slot.buffer.unmap();
            slot.state.store(FREE, Ordering::Release);
            let (Some(bytes), Some(context)) = (bytes, slot.context.take()) else {
                continue;
            };
            if newest.as_ref().is_none_or(|(sequence, ..)| *sequence < slot.sequence) {
                newest = Some((slot.sequence, bytes, context));
            }
        }
        newest.map(|(_, bytes, context)| (bytes, context))
    }
}
