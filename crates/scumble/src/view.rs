//! One map of a frame, and the plan that holds them all: what to draw, where, and how large.

use glam::{DVec2, DVec3, Mat4};
use scumble_core::{Budget, Camera, Face, Fit, Light, Size, TexelPolicy};

use crate::uniforms::{LIGHTS_MAX, LightsUniform};

/// One map to draw this frame.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// Number of the light in the call of `plan`, and of `shadow_visibility`.
    pub light: u32,
    /// Number of the slice of the light's view, 0 the nearest; of a point light that of the face, which `fit.face` names.
    pub slice: u32,
    /// View depth at which the slice ends, in metres; infinite for the last, and for faces.
    pub depth_end: f64,
    /// Number of the map among all that were allocated, the same in every frame with the same lights.
    pub map: u32,
    /// Layer of the map texture: the map's number, or 0 under a budget.
    pub layer: u32,
    /// Corner of the viewport in the layer: texel (0, 0), or the map's place on the page of a budget.
    pub origin_texels: [u32; 2],
    /// Size of the viewport.
    pub size_texels: [u32; 2],
    /// What the size achieves.
    pub size: Size,
    /// The light's clip space from world space relative to `Options::origin_world`: for the casters' vertices.
    pub clip_from_world: Mat4,
    /// The fit, border for the taps included.
    pub fit: Fit,
    /// Smallest filter radius that PCSS uses, and PCF in a net, in metres at the reference plane.
    pub radius_min_world: f64,
    /// Whether it is the net under slices that are fitted to what a picture showed: the map of all that has appeared since.
    pub is_net: bool,
    /// Whether it is small because nothing on screen is in its shadow; see [`Rest`](scumble_core::Rest).
    pub is_resting: bool,
    /// Half of the box, in clip space, in which points are looked up here and not in the net.
    pub inner: DVec2,
}

impl View {
    /// Width and height of a texel at the reference plane, in metres.
    #[must_use]
    pub fn texel_world(&self) -> DVec2 {
        let [width, height] = self.size_texels;
        self.fit.extent_world / DVec2::new(f64::from(width), f64::from(height))
    }

    /// Whether a point lies in the box of the map that leaves its taps room.
    fn is_inner(&self, position_world: DVec3) -> bool {
        let (uv, _) = self.fit.uv_from_world(position_world);
        (2.0 * uv - 1.0).abs().cmple(self.inner).all()
    }

    /// Texels of the viewport.
    #[must_use]
    pub fn texels(&self) -> u64 {
        u64::from(self.size_texels[0]) * u64::from(self.size_texels[1])
    }
}

/// The maps of one frame. It takes effect with [`Shadows::upload`](crate::Shadows::upload).
#[derive(Clone, Debug)]
pub struct Plan {
    pub(crate) camera: Camera,
    pub(crate) views: Vec<View>,
    pub(crate) maps_needed: u32,
    pub(crate) policies: Vec<TexelPolicy>,
    pub(crate) depths: [Option<[f64; 2]>; LIGHTS_MAX as usize],
    pub(crate) budget: Budget,
    pub(crate) uniform: LightsUniform,
}

impl Plan {
    /// The maps to draw, in the order of the lights and their slices or faces. A light that reaches nothing on screen has
    /// none, and so has a slice or a face that holds nothing; they leave everything lit.
    #[must_use]
    pub fn views(&self) -> &[View] {
        &self.views
    }

    /// The maps of a light, from the nearest slice on, or by face.
    pub fn views_of(&self, light: u32) -> impl Iterator<Item = &View> {
        self.views.iter().filter(move |view| view.light == light)
    }

    /// The map of a light that the shaders look a point of the world up in: that of the slice which its depth in the plan's
    /// view lies in, or the net where that slice's map was not fitted to it, or that of the face of a point light. `None` where
    /// everything is lit.
    #[must_use]
    pub fn view_at(&self, light: u32, position_world: DVec3) -> Option<&View> {
        let maps = self.uniform.lights.get(light as usize)?;
        if let Light::Point { position, .. } = self.views_of(light).next()?.fit.light {
            let face = Face::of(position_world - position);
            return self.views_of(light).find(|view| view.fit.face == Some(face));
        }
        let depth = (position_world - self.camera.eye).dot(self.camera.forward());
        let slice = maps.slice_ends.iter().filter(|&&end| depth > f64::from(end)).count();
        let own = self.views_of(light).find(|view| view.slice as usize == slice);
        let Some(net) = self.views_of(light).find(|view| view.is_net) else { return own };
        own.filter(|view| view.is_inner(position_world)).or(Some(net))
    }

    /// Texels of all maps together.
    #[must_use]
    pub fn texels(&self) -> u64 {
        self.views.iter().map(View::texels).sum()
    }

    /// Maps of its lights that nothing on screen needs: they are neither drawn nor read.
    #[must_use]
    pub fn maps_skipped(&self) -> u32 {
        self.maps_needed.saturating_sub(self.views.len() as u32)
    }

    /// Rungs of the ladder, quarters of an octave, by which all maps gave way to their budget; 0 where they fit, and without
    /// one. `c_effective` says what each has left.
    #[must_use]
    pub fn rungs_given_way(&self) -> u32 {
        self.budget.rungs()
    }

    /// What the shaders are told.
    #[must_use]
    pub fn uniform(&self) -> &LightsUniform {
        &self.uniform
    }
}
