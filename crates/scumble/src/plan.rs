//! From camera, scene and lights to the maps of a frame. Pure: no GPU, and the state of the sizes is copied.
//!
//! By light: fit; border, so that the taps of the outermost receiver fall into the map; demand, measured or from
//! bounds; texel, and the box on its lattice; matrices and uniforms. Demand without a measurement: the radius itself (PCF), the settings' smallest
//! radius (PCSS), 0 (one tap), so a PCSS map starts at the cap unless `radius_min_world` or `texel_floor_world` bound
//! it.

use bytemuck::Zeroable;
use glam::{DMat4, DVec3, Mat4};
use scumble_core::{
    Aabb, Bias, Camera, Demand, Filter, Fit, Light, ReceiverPlane, Settings, Size, TexelPolicy, filter, fit,
    size_achieved,
};

use crate::error::Error;
use crate::options::{Options, SizeChoice};
use crate::uniforms::{LightUniform, LightsUniform};
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
    }
}

/// State of a light between frames.
#[derive(Clone, Debug)]
pub struct LightState {
    /// Texel of its map.
    pub policy: TexelPolicy,
    /// Newest measurement: radius over the reference depth of a spot, radius for other lights; `Some(None)` for no
    /// penumbra on screen, `None` before the first and where the light had no map.
    pub measured: Option<Option<f64>>,
}

/// Plans a frame; `states` holds one state a light or more.
pub fn plan(
    settings: &Settings,
    options: &Options,
    states: &[LightState],
    camera: &Camera,
    scene: &Aabb,
    lights: &[Light],
) -> Result<Plan, Error> {
    if lights.len() > states.len() {
        return Err(Error::TooManyLights { found: lights.len(), allocated: states.len() as u32 });
    }
    let mut plan = Plan {
        views: Vec::with_capacity(lights.len()),
        policies: states.iter().map(|state| state.policy.clone()).collect(),
        uniform: LightsUniform::zeroed(),
    };
    for (index, (light, state)) in lights.iter().zip(states).enumerate() {
        let Some(tight) = fit(camera, scene, light, options.fitted)? else { continue };
        let fit = tight.with_border(border_world(&tight, &options.filter));
        let demand = demand(settings, &options.filter, &fit, state.measured);
        let (fit, size) = sized(settings, options, &mut plan.policies[index], fit, demand)?;
        let view = view(settings, options, index as u32, fit, size);
        plan.uniform.lights[index] = light_uniform(settings, options, &view);
        plan.views.push(view);
    }
    Ok(plan)
}

/// How far taps reach beyond the outermost receiver, at the reference plane; no further than the light's whole view.
fn border_world(fit: &Fit, filter: &Filter) -> f64 {
    let reach = match *filter {
        Filter::Hard => 0.0,
        Filter::Pcf { radius_world } => radius_world,
        Filter::Pcss => filter::search_radius_world(fit, fit.depth_far),
    };
    let outside = (fit.extent_world * fit.scale - fit.extent_world).max_element();
    reach.min(outside.max(0.0))
}

/// What is asked of a map of this fit.
fn demand(settings: &Settings, filter: &Filter, fit: &Fit, measured: Option<Option<f64>>) -> Demand {
    match measured {
        Some(Some(radius_per_scale)) => Demand::Radius(radius_per_scale * measure_scale(fit)),
        Some(None) => Demand::Nothing,
        None => {
            let radius = match *filter {
                Filter::Pcf { radius_world } => radius_world,
                Filter::Hard | Filter::Pcss => 0.0,
            };
            Demand::Radius(settings.demand_radius_world(radius, 0.0))
        }
    }
}

/// What a measured radius is divided by to outlive its fit: the reference depth of a spot, 1 otherwise.
pub fn measure_scale(fit: &Fit) -> f64 {
    match fit.light {
        Light::Directional { .. } => 1.0,
        Light::Spot { .. } => fit.reference_depth(),
    }
}

/// The fit with its size: on the lattice of an adaptive texel, or as it is with fixed texels.
fn sized(
    settings: &Settings,
    options: &Options,
    policy: &mut TexelPolicy,
    fit: Fit,
    demand: Demand,
) -> Result<(Fit, Size), Error> {
    let (fit, texels) = match options.size {
        SizeChoice::Adaptive => fit.on_lattice(policy.next(fit.extent_world, demand)?, settings.floor),
        SizeChoice::Fixed(texels) => (fit, texels),
    };
    let radius = match demand {
        Demand::Radius(radius) => Some(radius.max(settings.radius_min_world)),
        Demand::Nothing => None,
    };
    let size = size_achieved(texels, fit.extent_world, radius, &settings.relation);
    Ok((fit, size))
}

fn view(settings: &Settings, options: &Options, light: u32, fit: Fit, size: Size) -> View {
    // Where the cap binds, narrower filters than it hides are widened (Kreuzer 2017, 6.2). A fixed size is left alone.
    let widens = options.size == SizeChoice::Adaptive && size.capped;
    let radius_min_world =
        if widens { settings.radius_min_world.max(size.radius_min_world) } else { settings.radius_min_world };
    View {
        light,
        layer: light,
        size_texels: size.texels,
        size,
        clip_from_world: fit.clip_from_relative(options.origin_world).as_mat4(),
        fit,
        radius_min_world,
    }
}

fn light_uniform(settings: &Settings, options: &Options, view: &View) -> LightUniform {
    let fit = &view.fit;
    let texel_world = view.texel_world();
    let (is_spot, light_size, depth_of_zero) = match fit.light {
        // Depth along parallel light has no origin of its own: the shaders' is at their world's, so that f32 carries
        // it.
        Light::Directional { half_angle, .. } => (0, half_angle.tan(), fit.depth(options.origin_world)),
        Light::Spot { radius_world, .. } => (1, radius_world, 0.0),
    };
    let z_as_depth =
        DMat4::from_translation(DVec3::new(0.0, 0.0, -depth_of_zero)) * DMat4::from_scale(DVec3::new(1.0, 1.0, -1.0));
    let light_from_world: Mat4 =
        (z_as_depth * fit.light_from_world * DMat4::from_translation(options.origin_world)).as_mat4();
    let radius_world = match options.filter {
        Filter::Pcf { radius_world } => radius_world,
        Filter::Hard | Filter::Pcss => 0.0,
    };
    LightUniform {
        clip_from_world: view.clip_from_world.to_cols_array_2d(),
        light_from_world: light_from_world.to_cols_array_2d(),
        viewport_texels: view.size_texels.map(|side| side as f32),
        texel_from_plane: [(1.0 / texel_world.x) as f32, (-1.0 / texel_world.y) as f32],
        depth_near: (fit.depth_near - depth_of_zero) as f32,
        depth_far: (fit.depth_far - depth_of_zero) as f32,
        is_spot,
        layer: view.layer,
        light_size: light_size as f32,
        radius_world: radius_world as f32,
        radius_min_world: view.radius_min_world as f32,
        texel_world: texel_world.max_element() as f32,
        bias_constant_texels: settings.bias.constant_texels as f32,
        bias_slope_texels: settings.bias.slope_texels as f32,
        bias_rounding_world: rounding_world(fit) as f32,
        slope_max: settings.bias.slope_angle_max.tan() as f32,
        has_map: 1,
        filter_kind: filter_kind(&options.filter),
        padding: [0; 2],
    }
}

/// The part of the bias that does not depend on texels.
fn rounding_world(fit: &Fit) -> f64 {
    let anywhere = fit.world_from_plane(glam::DVec2::ZERO, fit.depth_far);
    let facing = fit.light.towards_light(anywhere);
    ReceiverPlane::new(fit, anywhere, facing, &Bias::without_texels(), glam::DVec2::ZERO).bias_world
}
