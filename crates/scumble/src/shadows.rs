//! The object that a renderer keeps: maps, bindings, sizes and the demand pass of all its shadowed lights.

mod measuring;

use scumble_core::{Aabb, Budget, Camera, Filter, Light, Rest, Settings, TexelPolicy};

use crate::bindings::Bindings;
use crate::counters::Counters;
use crate::demand::Reading;
use crate::error::Error;
use crate::kept::Kept;
use crate::maps::{MAP_FORMAT, Maps, depth_state};
use crate::measure::{Lights, Measure, Readings};
use crate::moments::{Moments, Task};
use crate::options::{Keep, Options};
use crate::plan::{MapState, Planner};
use crate::share::page_side;
use crate::slices::LightState;
use crate::uniforms::{BLOCKER_TAPS, LIGHTS_MAX, MAPS_MAX, MOMENT_TAPS, PCF_TAPS};
use crate::view::{Plan, View};

/// Adaptive shadow maps of one renderer. The steps of a frame are at the head of the crate.
#[derive(Debug)]
pub struct Shadows {
    device: wgpu::Device,
    settings: Settings,
    options: Options,
    maps: Maps,
    kept: Kept,
    moments: Option<Moments>,
    bindings: Bindings,
    measure: Option<Measure>,
    states: Vec<MapState>,
    page_side: Option<u32>,
    budget: Budget,
    lights: Vec<LightState>,
    uploaded: Uploaded,
    counters: Counters,
}

/// What the shaders were told last.
#[derive(Debug)]
struct Uploaded {
    lights: Lights,
    readings: Readings,
    moments: Vec<Task>,
}

impl Shadows {
    /// Allocates one map at the settings' cap, with default [`Options`].
    ///
    /// # Errors
    /// As [`Shadows::with_options`].
    pub fn new(device: &wgpu::Device, settings: Settings) -> Result<Self, Error> {
        Self::with_options(device, settings, Options::default())
    }

    /// Allocates `options.maps` maps at the settings' cap, 4 bytes a texel, with [`Keep::StaticLayers`] as much again, and
    /// with VSM their moments, 8 bytes a texel of one map more: all the memory this will ever take. With
    /// [`Settings::budget_bytes`] all that takes no more than so many bytes: one page, as wide as the device allows at most,
    /// is in the place of the layers, and the maps of a frame share it as they need it.
    ///
    /// # Errors
    /// Settings or options out of range, a cap above the device's limit, VSM on a device without compute shaders, a budget
    /// below what maps of the least size need.
    pub fn with_options(device: &wgpu::Device, settings: Settings, options: Options) -> Result<Self, Error> {
        let settings = settings.checked()?;
        let device_limit = device.limits().max_texture_dimension_2d;
        if settings.cap > device_limit {
            return Err(Error::CapOutsideDevice { cap: settings.cap, device_limit });
        }
        let options = options.checked(settings.cap)?;
        let page_side = page_side(&settings, &options, device_limit)?;
        let maps = match page_side {
            Some(side) => Maps::new(device, side, 1),
            None => Maps::new(device, settings.cap, options.maps),
        };
        let kept = Kept::new(device, &maps, options.maps, options.keep);
        let moments = match options.filter {
            Filter::Vsm { .. } => Some(Moments::new(device, &maps, options.maps)?),
            Filter::Hard | Filter::Pcf { .. } | Filter::Pcss => None,
        };
        let bindings = Bindings::new(device, &maps, moments.as_ref());
        let state = MapState { policy: TexelPolicy::new(&settings)?, rest: Rest::default(), measured: None };
        let counters = Counters {
            allocations: 1
                + Bindings::ALLOCATIONS
                + moments.as_ref().map_or(1, Moments::allocations)
                + kept.allocations(),
            map_bytes: maps.bytes() + moments.as_ref().map_or(0, Moments::bytes) + kept.bytes(),
            ..Counters::default()
        };
        Ok(Self {
            device: device.clone(),
            states: vec![state; options.maps as usize],
            page_side,
            budget: Budget::default(),
            settings,
            options,
            maps,
            kept,
            moments,
            bindings,
            measure: None,
            lights: vec![LightState::default(); LIGHTS_MAX as usize],
            uploaded: Uploaded {
                lights: [None; LIGHTS_MAX as usize],
                readings: [None; MAPS_MAX as usize],
                moments: Vec::new(),
            },
            counters,
        })
    }

    /// The settings given.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The options in force.
    #[must_use]
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// Changes the options from the next plan on. Nothing is allocated. A different filter, or other
    /// cascades, forget what was measured.
    ///
    /// # Errors
    /// Options out of range, another number of maps than were allocated, and VSM where it was not the filter at creation.
    pub fn set_options(&mut self, options: Options) -> Result<(), Error> {
        let options = options.checked(self.settings.cap)?;
        if options.maps != self.options.maps {
            return Err(Error::MapsAllocated { found: options.maps, allocated: self.options.maps });
        }
        if self.moments.is_none() && matches!(options.filter, Filter::Vsm { .. }) {
            return Err(Error::MomentsAllocated);
        }
        if self.kept.is_apart() != (options.keep == Keep::StaticLayers) {
            return Err(Error::LayersAllocated { found: options.keep });
        }
        if (options.filter, options.cascades) != (self.options.filter, self.options.cascades) {
            for state in &mut self.states {
                (state.measured, state.rest) = (None, Rest::default());
            }
        }
        self.options = options;
        Ok(())
    }

    /// The maps that a frame needs. Pure: nothing changes until [`Shadows::upload`].
    ///
    /// `scene` bounds all that casts or receives. Keep what cannot cast behind a lamp, such as the ceiling that it hangs
    /// from, out of it: the reference plane of a spot is where its cone enters these bounds.
    ///
    /// # Errors
    /// A camera, scene or light out of range, lights with more maps than `options.maps`, and fixed sizes beyond the budget.
    pub fn plan(&self, camera: &Camera, scene: &Aabb, lights: &[Light]) -> Result<Plan, Error> {
        let planner = Planner {
            settings: &self.settings,
            options: &self.options,
            states: &self.states,
            lights: &self.lights,
            page_side: self.page_side,
            budget: self.budget,
        };
        planner.plan(camera, scene, lights)
    }

    /// Makes a plan the one that the shaders see from the queue's next submission on. Once a frame.
    pub fn upload(&mut self, queue: &wgpu::Queue, plan: &Plan) {
        self.bindings.write(queue, &plan.uniform);
        for (state, policy) in self.states.iter_mut().zip(&plan.policies) {
            state.policy.clone_from(policy);
        }
        for (state, depths) in self.lights.iter_mut().zip(plan.depths) {
            state.depths = depths;
        }
        self.budget = plan.budget;
        self.uploaded =
            Uploaded { lights: [None; LIGHTS_MAX as usize], readings: [None; MAPS_MAX as usize], moments: Vec::new() };
        for view in &plan.views {
            self.uploaded.lights[view.light as usize] = Some(view.fit.light);
            self.uploaded.readings[view.map as usize] = Some(Reading::of(&view.fit));
        }
        if let (Some(moments), Filter::Vsm { radius_world }) = (&self.moments, self.options.filter) {
            self.uploaded.moments = plan.views.iter().map(|view| Task::new(view, radius_world)).collect();
            self.uploaded.moments.iter().for_each(|task| moments.write(queue, task));
        }
        self.counters.texels = plan.texels();
        self.counters.maps_skipped = plan.maps_skipped();
        self.counters.maps_resting = plan.views.iter().filter(|view| view.is_resting).count() as u32;
        self.counters.moment_taps = self.uploaded.moments.iter().map(Task::taps).sum();
        self.counters.moment_blocks = self.uploaded.moments.iter().map(Task::blocks).sum();
        self.counters.taps_per_pixel = match self.options.filter {
            Filter::Hard => 1,
            Filter::Pcf { .. } => PCF_TAPS,
            Filter::Pcss => BLOCKER_TAPS + PCF_TAPS,
            Filter::Vsm { .. } => MOMENT_TAPS,
        };
    }

    /// Begins the depth-only pass of a view, with viewport and scissor set and that part of the map cleared, or with
    /// [`Keep::StaticLayers`] filled with what [`Shadows::begin_static`] has drawn for this view. Draw the casters with a
    /// pipeline of [`Shadows::depth_stencil_state`] and no colour targets.
    pub fn begin<'encoder>(
        &mut self,
        encoder: &'encoder mut wgpu::CommandEncoder,
        view: &View,
    ) -> wgpu::RenderPass<'encoder> {
        self.drawn_again(view);
        self.kept.begin(&self.maps, encoder, view, self.options.origin_world)
    }

    /// Begins the pass for casters that stand still, or `None` where those drawn for an equal view are still there.
    ///
    /// Where nothing moves, this takes the place of [`Shadows::begin`]. With [`Keep::StaticLayers`] call it first, for what
    /// stands still, and `begin` then, for what moves; without, `begin` clears the map of both. The views of a camera that
    /// moves are equal for a while with [`Options::keep`](crate::Options::keep) alone. What was drawn counts from the
    /// recording on: after an encoder that was never submitted, and after casters changed, call [`Shadows::invalidate`].
    pub fn begin_static<'encoder>(
        &mut self,
        encoder: &'encoder mut wgpu::CommandEncoder,
        view: &View,
    ) -> Option<wgpu::RenderPass<'encoder>> {
        if self.kept.holds(view, self.options.origin_world) {
            self.counters.static_passes_skipped += 1;
            return None;
        }
        self.drawn_again(view);
        Some(self.kept.begin_static(&self.maps, encoder, view, self.options.origin_world))
    }

    fn drawn_again(&mut self, view: &View) {
        self.counters.map_passes += 1;
        if let Some(moments) = &mut self.moments {
            match self.page_side {
                // What lies on the page may have moved.
                Some(_) => moments.forget(),
                None => moments.forget_map(view.map),
            }
        }
    }

    /// Forgets what [`Shadows::begin_static`] has drawn: what stood still has changed.
    pub fn invalidate(&mut self) {
        self.kept.forget();
        if let Some(moments) = &mut self.moments {
            moments.forget();
        }
    }

    /// Records what the filter makes of the maps uploaded last, after their casters are drawn and before anything is shaded
    /// or measured: the moments of VSM. Other filters read the maps as they are, and nothing is recorded for them.
    pub fn prefilter(&mut self, encoder: &mut wgpu::CommandEncoder) {
        if let Some(moments) = &mut self.moments {
            self.counters.moment_passes += moments.record(encoder, &self.uploaded.moments);
        }
    }

    /// Depth state of the casters' pipelines. No depth bias is needed: the receivers carry it.
    #[must_use]
    pub fn depth_stencil_state(&self) -> wgpu::DepthStencilState {
        depth_state(wgpu::CompareFunction::Less)
    }

    /// Format of the maps.
    #[must_use]
    pub fn format(&self) -> wgpu::TextureFormat {
        MAP_FORMAT
    }

    /// What to put into `PrimitiveState::unclipped_depth` of the casters' pipelines: true where the device was created
    /// with `Features::DEPTH_CLIP_CONTROL`, so that casters in front of a spot's near plane keep their shadow.
    #[must_use]
    pub fn unclipped_depth(&self) -> bool {
        self.device.features().contains(wgpu::Features::DEPTH_CLIP_CONTROL)
    }

    /// What `shadow_visibility` reads; for the group number given to [`shadow_wgsl`](crate::shadow_wgsl). Take it anew
    /// each frame: it is another object after `measure` saw the first prepass, or one of another size.
    #[must_use]
    pub fn bind_group(&self) -> &wgpu::BindGroup {
        self.bindings.group()
    }

    /// Layout of [`Shadows::bind_group`], for fragment and compute stages.
    #[must_use]
    pub fn bind_group_layout(&self) -> &wgpu::BindGroupLayout {
        self.bindings.layout()
    }

    /// The map texture, Depth32Float, a layer a map or one page for all: for pictures of it.
    #[must_use]
    pub fn map_texture(&self) -> &wgpu::Texture {
        self.maps.texture()
    }

    /// Forgets sizes and measurements, as after a cut.
    ///
    /// # Errors
    /// None that creation has not found.
    pub fn reset(&mut self) -> Result<(), Error> {
        let policy = TexelPolicy::new(&self.settings)?;
        for state in &mut self.states {
            *state = MapState { policy: policy.clone(), rest: Rest::default(), measured: None };
        }
        self.lights.fill(LightState::default());
        self.budget = Budget::default();
        Ok(())
    }

    /// What was done so far.
    #[must_use]
    pub fn counters(&self) -> Counters {
        self.counters
    }
}
