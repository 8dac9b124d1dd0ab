//! What a renderer chooses beside the method's settings: filter, sizes, number of maps, origin.

use glam::DVec3;
use scumble_core::{Filter, Splits};

use crate::error::Error;
use crate::uniforms::MAPS_MAX;

/// How the size of a map is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum SizeChoice {
    /// From the filter's radius by the relation, between the settings' floor and cap.
    #[default]
    Adaptive,
    /// These texels, whatever the filter: width and height of the viewport. They stretch with the box, so they move in the
    /// world when the camera does.
    Fixed([u32; 2]),
}

/// What of the casters is kept from frame to frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Keep {
    /// Adaptive boxes follow the view by the texel, and so change in every frame in which the camera moves.
    #[default]
    Nothing,
    /// Adaptive boxes are on steps of a 16th ([`Fit::on_steps`](scumble_core::Fit::on_steps)), so that maps stay while the
    /// camera moves by less: a tenth more texels, or where the cap binds a texel of a rung more.
    Maps,
    /// The same, and static casters have layers of their own, allocated at creation, under those that move: twice the
    /// memory.
    StaticLayers,
}

/// Choices of one [`Shadows`](crate::Shadows). All but `maps` may change between frames, and between
/// `keep` and [`Keep::StaticLayers`] only at creation.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// How visibility is filtered, for every light.
    pub filter: Filter,
    /// How sizes are found.
    pub size: SizeChoice,
    /// Whether maps are fitted to what the camera can see (Kreuzer 2017, 3.4.2); else they cover the scene.
    pub fitted: bool,
    /// The most maps that the lights of a plan have together, 1 to
    /// [`MAPS_MAX`]: a spot has one, a directional light one for each of its `cascades`, a point light six. Each is a layer of
    /// the texture, all that is ever allocated; but under a [budget](scumble_core::Settings::budget_bytes) they share one.
    pub maps: u32,
    /// Into how many slices the view of a directional light is cut, each with a map of its own box and size. Worth it
    /// outdoors, where the nearest contact asks for texels that the distance has no use for. Adaptive maps of two slices and
    /// more follow the receivers that `measure` saw where that makes them small; the last of them is then a coarse net over
    /// the whole view, for what appears before the next result.
    pub cascades: Splits,
    /// What of the casters is kept; see [`Shadows::begin_static`](crate::Shadows::begin_static).
    pub keep: Keep,
    /// Origin of the world space that shaders and vertex buffers use, in world coordinates. Put it near the camera or
    /// the scene where coordinates are large: what reaches the GPU is relative to it, in f32. With another origin
    /// nothing that was kept is right any more.
    pub origin_world: DVec3,
    /// Every how many pixels, along x and along y, `measure` looks at one; and so the side of the blocks of pixels that
    /// one lookup may be enough for. On llvmpipe 4 costs a twelfth of 1.
    pub measure_stride: u32,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            filter: Filter::Pcss,
            size: SizeChoice::Adaptive,
            fitted: true,
            maps: 1,
            cascades: Splits::default(),
            keep: Keep::default(),
            origin_world: DVec3::ZERO,
            measure_stride: 4,
        }
    }
}

impl Options {
    /// Refuses what cannot be done below `cap` texels.
    pub(crate) fn checked(&self, cap: u32) -> Result<Self, Error> {
        self.filter.checked()?;
        if let SizeChoice::Fixed(found) = self.size
            && found.iter().any(|side| !(1..=cap).contains(side))
        {
            return Err(Error::FixedSize { found, cap });
        }
        self.cascades.checked()?;
        if !(1..=MAPS_MAX).contains(&self.maps) {
            return Err(Error::MapCount { found: self.maps });
        }
        if self.measure_stride == 0 {
            return Err(Error::Stride);
        }
        if !self.origin_world.is_finite() {
            return Err(Error::Origin(self.origin_world));
        }
        Ok(self.clone())
    }
}
