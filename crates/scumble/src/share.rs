//! What each map of a frame gets of the texture: its texels and their place.
//!
//! Without a budget every map has a layer, of which it takes what it asks for, up to the cap. Under one
//! ([`Settings::budget_bytes`]) all maps share one page of that many bytes, on which they are [packed](crate::atlas). What does not fit
//! gives way by [`Budget`]'s rule; what is not known to be asked for, before the first measurement, has an equal share of the page
//! as its cap, so that it takes nothing from what is. Rooms are for the most texels that a box may take, so that neither sizes nor places follow
//! a box that only moves.

use glam::DVec2;
use scumble_core::{Budget, Filter, Fit, Settings, given_way, texels_at_most};

use crate::atlas::pack;
use crate::error::Error;
use crate::moments;
use crate::options::{Keep, Options, SizeChoice};

/// Bytes of a texel of depth.
const DEPTH_BYTES: u64 = 4;

/// A map before it has a size.
#[derive(Clone, Debug)]
pub struct Asked {
    /// Its number.
    pub map: u32,
    /// Its fit, border included.
    pub fit: Fit,
    /// The texel that it asks for, of the ladder; nothing under a fixed size.
    pub texel_world: DVec2,
    /// Whether the screen is known to ask for it.
    pub is_known: bool,
    /// Whether its box is on steps, so that it stays while the view creeps.
    pub is_on_steps: bool,
}

impl Asked {
    /// Extent of the box at the reference plane, in metres, with what steps may add to it.
    pub fn extent_world(&self) -> DVec2 {
        let room = if self.is_on_steps { Fit::STEPS_ROOM } else { 1.0 };
        room * self.fit.extent_world
    }
}

/// What a map gets.
#[derive(Clone, Debug, PartialEq)]
pub struct Granted {
    /// The fit on its lattice.
    pub fit: Fit,
    /// Width and height of the viewport.
    pub texels: [u32; 2],
    /// Layer of the texture.
    pub layer: u32,
    /// Corner of the viewport there.
    pub origin_texels: [u32; 2],
}

/// Side of the one page that a budget allows, in texels; `None` without a budget.
///
/// # Errors
/// A budget below what the options' maps of the least size need.
pub fn page_side(settings: &Settings, options: &Options, device_limit: u32) -> Result<Option<u32>, Error> {
    let Some(budget_bytes) = settings.budget_bytes else { return Ok(None) };
    let maps = options.maps;
    // Moments lie on a page of their own, and so do what is between their passes and static casters that are kept apart.
    let of_moments = match options.filter {
        Filter::Vsm { .. } => 2 * moments::TEXEL_BYTES,
        Filter::Hard | Filter::Pcf { .. } | Filter::Pcss => 0,
    };
    let of_static = if options.keep == Keep::StaticLayers { DEPTH_BYTES } else { 0 };
    let texel_bytes = DEPTH_BYTES + of_moments + of_static;
    let side = (budget_bytes / texel_bytes).isqrt().min(u64::from(device_limit)) as u32;
    let least = settings.floor * equal_across(maps);
    if side < least {
        return Err(Error::Budget { found: budget_bytes, least: texel_bytes * u64::from(least).pow(2), maps });
    }
    Ok(Some(side))
}

/// How many maps of one size lie beside each other on a page with room for all.
fn equal_across(maps: u32) -> u32 {
    let across = maps.isqrt();
    if across * across < maps { across + 1 } else { across }
}

/// Sizes and places of all maps, in their order, on a page of `page_side` or in layers, and how far they gave way.
///
/// # Errors
/// Fixed sizes that the page has no room for.
pub fn share(
    settings: &Settings,
    options: &Options,
    page_side: Option<u32>,
    budget: &Budget,
    asked: &[Asked],
) -> Result<(Vec<Granted>, Budget), Error> {
    let size = options.size;
    let Some(side) = page_side else {
        let own_layer = |asked: &Asked| granted(settings, size, asked, asked.texel_world, asked.map, [0; 2]);
        return Ok((asked.iter().map(own_layer).collect(), *budget));
    };
    let cap_known = settings.cap.min(side);
    let cap_unknown = cap_known.min(side / equal_across(options.maps));
    let texels = |rungs: u32, growth: f64| -> Vec<DVec2> {
        let given = |asked: &Asked| {
            let cap = if asked.is_known { cap_known } else { cap_unknown };
            given_way(asked.texel_world, growth * asked.extent_world(), rungs, cap, settings.floor)
        };
        asked.iter().map(given).collect()
    };
    let rooms = |rungs: u32, growth: f64| -> Vec<[u32; 2]> {
        match size {
            SizeChoice::Fixed(texels) => vec![texels; asked.len()],
            SizeChoice::Adaptive => {
                let room = |(texel, asked): (DVec2, &Asked)| {
                    texels_at_most(growth * asked.extent_world(), texel, settings.floor)
                };
                texels(rungs, growth).into_iter().zip(asked).map(room).collect()
            }
        }
    };
    let beyond = || Error::BeyondBudget { maps: asked.len(), side };
    let next = budget.next(|rungs, growth| pack(side, &rooms(rungs, growth)).is_some()).ok_or_else(beyond)?;
    let places = pack(side, &rooms(next.rungs(), 1.0)).ok_or_else(beyond)?;
    let maps = asked.iter().zip(texels(next.rungs(), 1.0)).zip(places);
    Ok((maps.map(|((asked, texel), origin)| granted(settings, size, asked, texel, 0, origin)).collect(), next))
}

fn granted(
    settings: &Settings,
    size: SizeChoice,
    asked: &Asked,
    texel_world: DVec2,
    layer: u32,
    origin_texels: [u32; 2],
) -> Granted {
    let (fit, texels) = match size {
        SizeChoice::Adaptive if asked.is_on_steps => asked.fit.on_steps(texel_world, settings.floor),
        SizeChoice::Adaptive => asked.fit.on_lattice(texel_world, settings.floor),
        SizeChoice::Fixed(texels) => (asked.fit.clone(), texels),
    };
    Granted { fit, texels, layer, origin_texels }
}
