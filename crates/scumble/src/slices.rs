//! The slices or faces of one light before they have a size: fitted, with a border for the taps, and asked for a radius.
//!
//! Without a picture that shows where receivers are, slices are fitted to the scene's box in the view. With one they are
//! fitted to what it showed, and the last map is a *net*: coarse, widened until it hides its texels, and as wide as the view.
//! Receivers that no other map was fitted to are looked up there, so that they never lack their shadow while the next
//! picture is on its way.

use scumble_core::{
    Aabb, Camera, Cascade, Demand, Filter, Fit, Light, SeenCascades, SeenLately, Settings, cascades, filter,
    seen_cascades,
};

use crate::demand::{demand, lent};
use crate::error::Error;
use crate::options::{Options, SizeChoice};
use crate::plan::MapState;

/// What a box of moments reaches beyond its radius, in radii: half a block on either side and one for bilinear values,
/// of which the radius measures 3.47 at least.
const VSM_MARGIN: f64 = 1.5 / 3.47;

/// How far taps of a point light reach beyond the border of its face at most, as a tangent: a face is then 103 degrees wide,
/// and its map 1.6 times as large. A kernel reaches that far for a receiver six radii from a bulb with the occluder halfway;
/// the search, for one four times as far: beyond, it misses blockers, and the two sides of a border may differ by 0.07 (a
/// test) where 0.35 would leave 0.06.
const FACE_BORDER_MAX: f64 = 0.25;

/// Most texels that a net has across, but for the ladder's quarter octave: at most a tenth of a map of 2048 x 2048, for the few
/// frames until a picture has shown what appeared.
const NET_SIDE: u32 = 512;

/// Least texel of a net in texels of the slice that asks for the coarsest: it costs a quarter of one map for the whole view.
const NET_TEXEL: f64 = 2.0;

/// Share of the area of slices fitted to the box below which following what was seen begins; it goes on up to all of it. In
/// the yard it is 0.94, and three wider slices with a net took a fifth longer than four slices, for 0.94 of the texels; in the
/// street it is 0.39, for 0.41 of the texels.
const WORTH: f64 = 0.75;

/// One map of a light before it has a size.
pub struct Slice {
    /// Its number, which its layer follows from.
    pub slice: u32,
    /// View depth at which it ends, in metres; infinite for the last and for a net.
    pub depth_end: f64,
    /// With the border for the taps; `None` where nothing is in it.
    pub fit: Option<Fit>,
    /// Width of the border, at the reference plane.
    pub border_world: f64,
    /// What it is asked for.
    pub demand: Demand,
    /// Whether that is a radius of what is filtered, and not a bound that stands until the first measurement.
    pub is_known: bool,
    /// Whether it is the net under the others.
    pub is_net: bool,
}

/// What is known of one light between frames.
#[derive(Clone, Debug, Default)]
pub struct LightState {
    /// What the measured pictures showed of its receivers.
    pub seen: SeenLately,
    /// View depths between which the last frame's slices were cut, where they followed that.
    pub depths: Option<[f64; 2]>,
}

/// The slices of one light, and the depths for its state of the next frame: fitted to what pictures showed, with the net as
/// the last, where that is worth it, or to the view of the scene's box. Fixed sizes stretch with their box, so they follow the
/// view alone.
pub fn slices(
    settings: &Settings,
    options: &Options,
    states: &[MapState],
    (camera, scene, light): (&Camera, &Aabb, &Light),
    state: &LightState,
) -> Result<(Vec<Slice>, Option<[f64; 2]>), Error> {
    let of_box = cascades(camera, scene, light, options.fitted, &options.cascades)?;
    let of_seen = match state.seen.together() {
        Some(seen) if options.fitted && options.size == SizeChoice::Adaptive => {
            seen_cascades(camera, scene, light, &options.cascades, seen, state.depths)?
        }
        _ => None,
    };
    let (cascades, net, depths) = match of_seen.filter(|of_seen| is_worth(of_seen, &of_box, state.depths.is_some())) {
        Some(SeenCascades { slices, net, depths }) => (slices, Some(net), Some(depths)),
        None => (of_box, None, None),
    };
    let slice = |((slice, Cascade { depth_end, fit }), state): ((u32, Cascade), &MapState)| {
        let border_world = fit.as_ref().map_or(0.0, |fit| border_world(fit, reach_world(fit, &options.filter)));
        let fit = fit.map(|fit| fit.with_border(border_world));
        let demand = fit.as_ref().map_or(Demand::Nothing, |fit| demand(settings, &options.filter, fit, state.measured));
        let is_known = state.measured.is_some() || options.filter.fixed_radius_world().is_some();
        Slice { slice, depth_end, fit, border_world, demand, is_known, is_net: false }
    };
    let mut slices: Vec<Slice> = (0..).zip(cascades).zip(states).map(slice).collect();
    lend(&mut slices);
    slices.extend(net.map(|net| net_slice(settings, &options.filter, &slices, net)));
    Ok((slices, depths))
}

/// Whether slices that follow what was seen, and their net, have so much less area than those of the box that one slice
/// fewer pays; `follows` tells whether they did in the last frame.
fn is_worth(of_seen: &SeenCascades, of_box: &[Cascade], follows: bool) -> bool {
    let area = |fit: &Fit| fit.extent_world.element_product();
    let all = |slices: &[Cascade]| slices.iter().filter_map(|slice| slice.fit.as_ref()).map(area).sum::<f64>();
    let of_net = area(&of_seen.net) / (NET_TEXEL * NET_TEXEL);
    let most = if follows { 1.0 } else { WORTH };
    all(&of_seen.slices) + of_net < most * all(of_box)
}

/// Slices that something is in and no penumbra are lent a demand; and so are faces of a point light that were not measured yet,
/// since they come into view one by one: each would go to its cap until its own measurement is back.
fn lend(slices: &mut [Slice]) {
    let mut present: Vec<(&mut Slice, Fit)> =
        slices.iter_mut().filter_map(|slice| slice.fit.clone().map(|fit| (slice, fit))).collect();
    let is_new_face = |slice: &Slice, fit: &Fit| fit.face.is_some() && !slice.is_known;
    let asked: Vec<(Demand, f64)> = present
        .iter()
        .map(|(slice, fit)| {
            let demand = if is_new_face(slice, fit) { Demand::Nothing } else { slice.demand };
            (demand, fit.extent_world.max_element())
        })
        .collect();
    for ((slice, fit), demand) in present.iter_mut().zip(lent(&asked)) {
        if demand != Demand::Nothing || !is_new_face(slice, fit) {
            slice.is_known |= is_new_face(slice, fit);
            slice.demand = demand;
        }
    }
}

/// The net under slices: its radius is at least that of the texels that it is given, whatever the screen asks for.
fn net_slice(settings: &Settings, filter: &Filter, slices: &[Slice], net: Fit) -> Slice {
    let texel_world = net.extent_world.max_element() / f64::from(NET_SIDE - 1);
    let widest = slices.iter().filter_map(|slice| match slice.demand {
        Demand::Radius(radius_world) => Some(NET_TEXEL * radius_world),
        Demand::Nothing => None,
    });
    let radius_world = widest.fold(settings.relation.radius_from_texel(texel_world), f64::max);
    let border_world = border_world(&net, reach_world(&net, filter).max(radius_world));
    Slice {
        slice: slices.len() as u32,
        depth_end: f64::INFINITY,
        fit: Some(net.with_border(border_world)),
        border_world,
        demand: Demand::Radius(radius_world),
        is_known: true,
        is_net: true,
    }
}

/// How far taps reach at the reference plane.
fn reach_world(fit: &Fit, filter: &Filter) -> f64 {
    match *filter {
        Filter::Hard => 0.0,
        Filter::Pcf { radius_world } => radius_world,
        // On the plane, a search is widest for the nearest receiver that is searched for to its full width.
        Filter::Pcss if fit.face.is_some() => {
            filter::search_radius_world(fit, (fit.depth_near / filter::SEARCH_SHARE).min(fit.depth_far))
        }
        Filter::Pcss => filter::search_radius_world(fit, fit.depth_far),
        Filter::Vsm { radius_world } => radius_world * (1.0 + VSM_MARGIN),
    }
}

/// How wide a border taps of this reach need around the outermost receiver; no wider than the light's whole view, but where
/// that is a face and its neighbours go on.
fn border_world(fit: &Fit, reach_world: f64) -> f64 {
    if fit.face.is_some() {
        // A disc across the ray reaches sqrt 2 as far along the axis towards the border.
        return (std::f64::consts::SQRT_2 * reach_world).min(FACE_BORDER_MAX * fit.reference_depth());
    }
    let outside = (fit.extent_world * fit.scale - fit.extent_world).max_element();
    reach_world.min(outside.max(0.0))
}
