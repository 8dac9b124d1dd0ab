//! From camera, scene and lights to the maps of a frame. Pure: no GPU, and the state of the sizes is copied.
//!
//! By light: slices of the view, or the faces of a point light, and for each: fit; border, so that the taps of the outermost receiver fall into the map;
//! [demand](crate::demand) and the texel that it asks for. Then for all maps together: what each [gets](crate::share), the
//! box on its lattice, matrices and uniforms. The maps of a light have consecutive numbers, of which those that nothing on
//! screen needs stay empty.

use bytemuck::Zeroable;
use glam::{DMat4, DVec2, DVec3, Mat4};
use scumble_core::{
    Aabb, AtCap, Bias, Budget, Camera, Demand, Filter, Fit, Light, ReceiverPlane, Rest, Settings, TexelPolicy,
    size_achieved, slices_of,
};

use crate::demand::{Found, first_bin};
use crate::error::Error;
use crate::moments::blocks_of;
use crate::options::{Keep, Options, SizeChoice};
use crate::share::{Asked, Granted, share};
use crate::slices::{LightState, Slice, slices};
use crate::uniforms::{CASCADES_MAX, LIGHTS_MAX, LightUniform, LightsUniform, MapUniform, NO_MAP};
use crate::view::{Plan, View};

/// Value of the shaders' constant for a filter; see [`FILTER_OVERRIDE`](crate::FILTER_OVERRIDE).
#[must_use]
pub fn filter_constant(filter: &Filter) -> f64 {
    f64::from(filter_kind(filter))
}

/// The constant as the uniforms hold it.
fn filter_kind(filter: &Filter) -> u32 {
    match filter {
        Filter::Hard => 0,
        Filter::Pcf { .. } => 1,
        Filter::Pcss => 2,
        Filter::Vsm { .. } => 3,
    }
}

/// State of a map between frames.
#[derive(Clone, Debug)]
pub struct MapState {
    /// Its texel.
    pub policy: TexelPolicy,
    /// Whether it rests, by all measurements.
    pub rest: Rest,
    /// Newest measurement; `None` before the first and where the map was not drawn.
    pub measured: Option<Found>,
}

/// What a frame is planned from, beside what it shows.
pub struct Planner<'a> {
    /// Of the renderer.
    pub settings: &'a Settings,
    /// Of the renderer.
    pub options: &'a Options,
    /// One a map of the lights, or more.
    pub states: &'a [MapState],
    /// One a light of the most that there are.
    pub lights: &'a [LightState],
    /// Side of the page that all maps share under a budget.
    pub page_side: Option<u32>,
    /// How far maps gave way in the last frame.
    pub budget: Budget,
}

/// A map before it has a size, but for what it [asks](Asked) for.
struct Draft {
    light: u32,
    slice: Slice,
    is_resting: bool,
}

impl Planner<'_> {
    /// Plans a frame.
    pub fn plan(&self, camera: &Camera, scene: &Aabb, lights: &[Light]) -> Result<Plan, Error> {
        let Self { settings, options, states, .. } = *self;
        let counts: Vec<u32> = lights.iter().map(|light| slices_of(light, options.fitted, &options.cascades)).collect();
        let needed = counts.iter().sum();
        if lights.len() > LIGHTS_MAX as usize {
            return Err(Error::TooManyLights { found: lights.len() });
        }
        if needed as usize > states.len() {
            return Err(Error::TooManyMaps { needed, allocated: states.len() as u32 });
        }
        let mut plan = Plan {
            camera: *camera,
            views: Vec::with_capacity(needed as usize),
            maps_needed: needed,
            policies: states.iter().map(|state| state.policy.clone()).collect(),
            depths: [None; LIGHTS_MAX as usize],
            budget: self.budget,
            uniform: LightsUniform { view_depth: view_depth(camera, options.origin_world), ..LightsUniform::zeroed() },
        };

        // What the maps that something is in ask for.
        let (mut drafts, mut asked) = (Vec::new(), Vec::new());
        let mut first = 0;
        for ((index, light), count) in (0_u32..).zip(lights).zip(counts) {
            let state = &self.lights[index as usize];
            let (slices, depths) = slices(settings, options, &states[first as usize..], (camera, scene, light), state)?;
            plan.depths[index as usize] = depths;
            if depths.is_some() && state.depths.is_none() {
                // A net takes the place of the last slice, whose texel is not for it.
                plan.policies[(first + count - 1) as usize] = TexelPolicy::new(settings)?;
            }
            plan.uniform.lights[index as usize] = light_uniform(light, options.origin_world, &slices, first, count);
            for mut slice in slices {
                let Some(fit) = slice.fit.take() else { continue };
                let map = first + slice.slice;
                let is_adaptive = options.size == SizeChoice::Adaptive;
                let is_resting = is_adaptive && !slice.is_net && states[map as usize].rest.is_resting(settings);
                let is_on_steps = is_adaptive && options.keep != Keep::Nothing;
                let mut asks = Asked { map, fit, texel_world: DVec2::ONE, is_known: slice.is_known, is_on_steps };
                asks.texel_world =
                    self.texel_world(&mut plan.policies[map as usize], map, asks.extent_world(), &slice)?;
                asked.push(asks);
                drafts.push(Draft { light: index, slice, is_resting });
            }
            first += count;
        }

        // What they get.
        let (granted, budget) = share(settings, options, self.page_side, &self.budget, &asked)?;
        plan.budget = budget;
        for ((draft, asked), granted) in drafts.into_iter().zip(asked).zip(granted) {
            let view = self.view(draft, asked.map, granted);
            plan.uniform.maps[view.map as usize] = map_uniform(settings, options, &view);
            plan.views.push(view);
        }
        Ok(plan)
    }

    /// The texel that a map of this extent asks for. A net does not rest. What is not known to be asked for leaves the map's
    /// texel alone under a budget: without a cap it is boundless, and would stay where a measurement finds nothing.
    fn texel_world(&self, policy: &mut TexelPolicy, map: u32, extent: DVec2, slice: &Slice) -> Result<DVec2, Error> {
        if let SizeChoice::Fixed(_) = self.options.size {
            return Ok(DVec2::ONE);
        }
        if self.page_side.is_some() && !slice.is_known {
            return Ok(TexelPolicy::new(self.settings)?.next(extent, slice.demand)?);
        }
        let texel_world = policy.next(extent, slice.demand)?;
        if slice.is_net {
            return Ok(texel_world);
        }
        Ok(self.states[map as usize].rest.texel(texel_world, extent, self.settings))
    }

    /// A map with its size.
    fn view(&self, Draft { light, slice, is_resting }: Draft, map: u32, granted: Granted) -> View {
        let Slice { slice, depth_end, border_world, demand, is_net, .. } = slice;
        let Granted { fit, texels, layer, origin_texels } = granted;
        let radius = match demand {
            Demand::Radius(radius) if !is_resting => Some(radius.max(self.settings.radius_min_world)),
            Demand::Radius(_) | Demand::Nothing => None,
        };
        let size = size_achieved(texels, fit.extent_world, radius, &self.settings.relation);
        // Where the cap binds, narrower filters than it hides are widened if so chosen, and under a net and in a map that
        // rests all are. A fixed size is left alone.
        let gives_width = size.capped && self.settings.at_cap == AtCap::Widen;
        let widens = self.options.size == SizeChoice::Adaptive && (gives_width || is_net || is_resting);
        let least = if widens { size.radius_min_world } else { 0.0 };
        View {
            light,
            slice,
            depth_end,
            map,
            layer,
            origin_texels,
            size_texels: texels,
            size,
            clip_from_world: fit.clip_from_relative(self.options.origin_world).as_mat4(),
            radius_min_world: self.settings.radius_min_world.max(least),
            is_net,
            is_resting,
            inner: 1.0 - 2.0 * border_world / fit.extent_world,
            fit,
        }
    }
}

fn light_uniform(light: &Light, origin_world: DVec3, slices: &[Slice], first_map: u32, map_count: u32) -> LightUniform {
    let net_map = slices.iter().find(|slice| slice.is_net).map_or(NO_MAP, |net| first_map + net.slice);
    let mut slice_ends = [f32::MAX; CASCADES_MAX as usize - 1];
    for (end, slice) in slice_ends.iter_mut().zip(slices) {
        *end = (slice.depth_end as f32).min(f32::MAX);
    }
    let across = light.light_from_world().transpose();
    let position = light.position().map_or(DVec3::ZERO, |position| position - origin_world);
    LightUniform {
        slice_ends,
        map_count,
        across_x: across.x_axis.truncate().as_vec3().to_array(),
        first_map,
        across_y: across.y_axis.truncate().as_vec3().to_array(),
        net_map,
        position: position.as_vec3().to_array(),
        is_point: u32::from(matches!(light, Light::Point { .. })),
    }
}

/// View depth of a point relative to the origin, as a dot product.
fn view_depth(camera: &Camera, origin_world: DVec3) -> [f32; 4] {
    let forward = camera.forward();
    forward.extend(forward.dot(origin_world - camera.eye)).as_vec4().to_array()
}

fn map_uniform(settings: &Settings, options: &Options, view: &View) -> MapUniform {
    let fit = &view.fit;
    let texel_world = view.texel_world();
    let (is_spot, light_size, depth_of_zero) = match fit.light {
        // Depth along parallel light has no origin of its own: the shaders' is at their world's, so that f32 carries
        // it.
        Light::Directional { half_angle, .. } => (0, half_angle.tan(), fit.depth(options.origin_world)),
        Light::Spot { radius_world, .. } | Light::Point { radius_world, .. } => (1, radius_world, 0.0),
    };
    let z_as_depth =
        DMat4::from_translation(DVec3::new(0.0, 0.0, -depth_of_zero)) * DMat4::from_scale(DVec3::new(1.0, 1.0, -1.0));
    let light_from_world: Mat4 =
        (z_as_depth * fit.light_from_world * DMat4::from_translation(options.origin_world)).as_mat4();
    let radius_world = options.filter.fixed_radius_world().unwrap_or(0.0);
    let is_widened = view.is_net && matches!(options.filter, Filter::Pcf { .. });
    let least = if is_widened { view.radius_min_world } else { 0.0 };
    MapUniform {
        clip_from_world: view.clip_from_world.to_cols_array_2d(),
        light_from_world: light_from_world.to_cols_array_2d(),
        viewport_texels: view.size_texels.map(|side| side as f32),
        texel_from_plane: [(1.0 / texel_world.x) as f32, (-1.0 / texel_world.y) as f32],
        depth_near: (fit.depth_near - depth_of_zero) as f32,
        depth_far: (fit.depth_far - depth_of_zero) as f32,
        is_spot,
        layer: view.layer,
        light_size: light_size as f32,
        radius_world: radius_world.max(least) as f32,
        radius_min_world: view.radius_min_world as f32,
        texel_world: texel_world.max_element() as f32,
        bias_constant_texels: settings.bias.constant_texels as f32,
        bias_slope_texels: settings.bias.slope_texels as f32,
        bias_rounding_world: rounding_world(fit) as f32,
        slope_max: settings.bias.slope_angle_max.tan() as f32,
        has_map: 1,
        filter_kind: filter_kind(&options.filter),
        deviation_min_texels: settings.variance.deviation_min_texels as f32,
        bleeding_cut: settings.variance.bleeding_cut as f32,
        moment_block: blocks_of(texel_world, radius_world).map(|texels| texels as f32),
        first_bin: first_bin(fit),
        is_sphere: u32::from(fit.face.is_some()),
        inner: view.inner.as_vec2().to_array(),
        origin_texels: view.origin_texels.map(|at| at as f32),
    }
}

/// The part of the bias that does not depend on texels.
fn rounding_world(fit: &Fit) -> f64 {
    let anywhere = fit.world_from_plane(DVec2::ZERO, fit.depth_far);
    let facing = fit.light.towards_light(anywhere);
    ReceiverPlane::new(fit, anywhere, facing, &Bias::without_texels(), DVec2::ZERO).bias_world
}
