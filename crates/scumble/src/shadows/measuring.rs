//! What the screen asks for: the demand pass of a renderer's maps, and what has come back of it.

use scumble_core::{Camera, SeenLately};

use super::Shadows;
use crate::counters::BlockCounts;
use crate::demand::{Found, measure_scale};
use crate::error::Error;
use crate::measure::{Measure, Readings, Request};
use crate::view::View;

impl Shadows {
    /// Records the demand pass: the filter radii that the pixels of a depth prepass need, by map, with the maps and
    /// matrices uploaded last; which of them counts is the settings' [`Statistic`](scumble_core::Statistic). The result comes
    /// back frames later; see [`Shadows::read_demand`]. One call a submission.
    ///
    /// It also boxes the receivers, for [cascades](crate::Options::cascades) to follow: so call it each frame or never, and
    /// [`Shadows::reset`] where you stop.
    ///
    /// Call it after the maps are drawn and before shading: until the next `upload`, `shadow_visibility` then takes its
    /// `frag_coord` for a pixel of this prepass, and filters only where the pass did not find the pixels around it lit or
    /// dark. Shading other pixels needs an `upload` between. Called before `plan` it measures the maps of the last frame,
    /// and shading filters everywhere.
    ///
    /// `prepass` is a view of a single-sample depth texture, with or without stencil, drawn with
    /// `camera.clip_from_world()`, cleared to 1. A plan without maps records nothing.
    ///
    /// # Errors
    /// A prepass that cannot be read, a camera out of range, a device without compute shaders.
    pub fn measure(
        &mut self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        prepass: &wgpu::TextureView,
        camera: &Camera,
    ) -> Result<(), Error> {
        let measure = match &mut self.measure {
            Some(measure) => measure,
            None => {
                let created = Measure::new(&self.device, self.bindings.layout())?;
                self.counters.allocations += created.buffer_count() as u64;
                self.measure.insert(created)
            }
        };
        if self.uploaded.lights.iter().all(Option::is_none) {
            return Ok(());
        }
        let request = Request {
            camera,
            origin_world: self.options.origin_world,
            settings: &self.settings,
            stride: self.options.measure_stride,
            lights: self.uploaded.lights,
            readings: self.uploaded.readings,
        };
        let recorded = measure.record(&self.device, queue, encoder, self.bindings.group(), prepass, &request)?;
        self.counters.measure_passes += 1;
        self.counters.allocations += recorded.allocations;
        if recorded.new_blocks
            && let Some(blocks) = measure.blocks()
        {
            self.bindings.set_blocks(&self.device, &self.maps, blocks.blocks());
            self.counters.allocations += 1;
        }
        self.bindings.write_block_px(queue, self.options.measure_stride);
        self.counters.readbacks_skipped += u64::from(!recorded.copied);
        Ok(())
    }

    /// Takes the newest measurement that has come back, for the plans from here on; never waits. Results arrive while
    /// the caller submits or polls the device. Returns whether there was one. Until the first, sizes come from bounds.
    pub fn read_demand(&mut self) -> bool {
        let Some(taken) = self.measure.as_mut().and_then(|it| it.take(self.settings.statistic)) else { return false };
        self.set_measured(taken.maps.into_iter());
        for (state, seen) in self.lights.iter_mut().zip(taken.seen) {
            match seen {
                Some(seen) => state.seen.add(seen, self.settings.shrink_after_frames),
                None => state.seen = SeenLately::default(),
            }
        }
        true
    }

    /// Takes what was found under the maps, by map; `None` where none was drawn.
    pub(crate) fn set_measured(&mut self, maps: impl Iterator<Item = Option<Found>>) {
        for (state, found) in self.states.iter_mut().zip(maps) {
            state.measured = found;
            if let Some(found) = found {
                state.rest.saw(found.is_lit, &self.settings);
            }
        }
        self.counters.readbacks_taken += 1;
    }

    /// How to read what is found under the maps uploaded last.
    pub(crate) fn readings(&self) -> Readings {
        self.uploaded.readings
    }

    /// The newest measurement for a map in use, in metres at the reference plane of `view`: `None` before the first,
    /// `Some(None)` where no fragment had a penumbra.
    #[must_use]
    pub fn measured_radius_world(&self, view: &View) -> Option<Option<f64>> {
        let measured = self.states.get(view.map as usize)?.measured?;
        Some(measured.radius_per_scale.map(|radius| radius * measure_scale(&view.fit)))
    }

    /// The newest measurement's blocks of pixels that read a map in use, by what they pay; `None` before the first, and
    /// where fragments tell the demand.
    #[must_use]
    pub fn measured_blocks(&self, view: &View) -> Option<BlockCounts> {
        self.states.get(view.map as usize)?.measured?.blocks
    }
}
