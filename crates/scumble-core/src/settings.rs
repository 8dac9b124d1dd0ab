//! What a user chooses: quality, softness, guards. Checked once, where it is used.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::bias::Bias;
use crate::error::{Error, check, not_negative, positive};
use crate::moments::VarianceBound;
use crate::relation::Relation;
use crate::statistic::Statistic;

/// How visibility is filtered.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Filter {
    /// One lookup, a hard edge; no size hides its texels.
    Hard,
    /// Percentage closer filtering with one radius everywhere.
    Pcf {
        /// Radius of the kernel, in metres at the fit's reference plane.
        radius_world: f64,
    },
    /// Percentage closer soft shadows; the light's size gives the radius.
    Pcss,
    /// A variance shadow map with one radius everywhere; see [`moments`](crate::moments).
    Vsm {
        /// Half the side of the square kernel, in metres at the fit's reference plane.
        radius_world: f64,
    },
}

impl Filter {
    /// Name on command lines and in tables: `none`, `pcf`, `pcss`, `vsm`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Hard => "none",
            Self::Pcf { .. } => "pcf",
            Self::Pcss => "pcss",
            Self::Vsm { .. } => "vsm",
        }
    }

    /// The radius of a filter that has one radius everywhere, in metres at the fit's reference plane.
    #[must_use]
    pub fn fixed_radius_world(&self) -> Option<f64> {
        match *self {
            Self::Hard | Self::Pcss => None,
            Self::Pcf { radius_world } | Self::Vsm { radius_world } => Some(radius_world),
        }
    }

    /// Refuses a radius that is not finite and above 0.
    ///
    /// # Errors
    /// Names the radius.
    pub fn checked(&self) -> Result<Self, Error> {
        if let Some(radius_world) = self.fixed_radius_world() {
            positive("the filter's radius_world", radius_world)?;
        }
        Ok(*self)
    }
}

/// What gives way where the screen asks for more texels than a map may have, under PCSS.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AtCap {
    /// Width: shadows that are too narrow are widened until their texels hide (Kreuzer 2017, 6.2).
    #[default]
    Widen,
    /// Smoothness: they keep their width and show texels. Nearer to the light.
    ShowTexels,
}

/// Choices of one renderer, all lights together.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The relation between radius and texel.
    pub relation: Relation,
    /// Which of the radii on screen the relation is asked with.
    pub statistic: Statistic,
    /// Most texels per side; maps are allocated once at this size.
    pub cap: u32,
    /// What gives way where the cap binds.
    pub at_cap: AtCap,
    /// Least texels per side.
    pub floor: u32,
    /// Most bytes that all maps together take, allocated and used; `None` for one of `cap` squared texels for each. Maps that
    /// ask for more give way together: see [`Budget`](crate::Budget).
    pub budget_bytes: Option<u64>,
    /// No texel is asked to be smaller than this, in metres at the reference plane; 0 for no such limit.
    pub texel_floor_world: f64,
    /// No texel is asked to be smaller than this many pixels: the texel below a pixel cannot be seen.
    pub footprint_kappa: f64,
    /// No filter is narrower than this radius, in metres at the reference plane: contact shadows would ask for an
    /// infinite map (Kreuzer 2017, 5.1.3 and 6.2).
    pub radius_min_world: f64,
    /// A size may shrink when the demand stayed this share below it, 0..1.
    pub shrink_below: f64,
    /// Number of frames that the demand must stay below, and for which a box holds a receiver that is not seen any more.
    pub shrink_after_frames: u32,
    /// Most rungs of the ladder, quarters of an octave, that one shrinking takes; limits the rate of visible change.
    pub shrink_rungs: u32,
    /// Most texels per side of a map under which all that is measured on screen has been lit for `shrink_after_frames`
    /// pictures; the cap or more for maps that never rest. Casters narrower than its texels may stay unseen when they enter.
    pub side_at_rest: u32,
    /// Depth bias.
    pub bias: Bias,
    /// Guards of variance shadow maps.
    pub variance: VarianceBound,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            relation: Relation::published(),
            statistic: Statistic::default(),
            cap: 4096,
            at_cap: AtCap::default(),
            floor: 8,
            budget_bytes: None,
            texel_floor_world: 0.0,
            footprint_kappa: 1.0,
            radius_min_world: 0.0,
            shrink_below: 0.2,
            shrink_after_frames: 30,
            shrink_rungs: 4,
            // A tenth to a hundredth of the texels of usual maps, and a texel of 0.2 m of 50.
            side_at_rest: 256,
            bias: Bias::default(),
            variance: VarianceBound::default(),
        }
    }
}

impl Settings {
    /// Largest cap: no device that wgpu reaches has wider textures.
    pub const CAP_MAX: u32 = 32_768;

    /// Refuses what has no meaning.
    ///
    /// # Errors
    /// Names the value and what is allowed.
    pub fn checked(&self) -> Result<Self, Error> {
        let (cap, floor) = (f64::from(self.cap), f64::from(self.floor));
        check("cap", cap, (8..=Self::CAP_MAX).contains(&self.cap), "8 to 32768 texels")?;
        check("floor", floor, self.floor >= 8 && self.floor <= self.cap, "8 texels to the cap")?;
        not_negative("texel_floor_world", self.texel_floor_world)?;
        not_negative("footprint_kappa", self.footprint_kappa)?;
        not_negative("radius_min_world", self.radius_min_world)?;
        check("shrink_below", self.shrink_below, (0.0..1.0).contains(&self.shrink_below), "a share from 0 to below 1")?;
        check("shrink_rungs", f64::from(self.shrink_rungs), self.shrink_rungs > 0, "1 or more")?;
        check("side_at_rest", f64::from(self.side_at_rest), self.side_at_rest >= 8, "8 texels or more")?;
        self.statistic.checked()?;
        self.bias.checked()?;
        self.variance.checked()?;
        Ok(self.clone())
    }

    /// The radius that counts for a fragment's demand, in metres at the reference plane: the filter's, but no smaller
    /// than what hides a texel of `footprint_kappa` pixels or of `texel_floor_world`, nor than `radius_min_world`:
    /// `r = max(r_filter, c kappa footprint, c texel_floor, r_min)`. Then `a_required = r / c`.
    #[must_use]
    pub fn demand_radius_world(&self, filter_radius_world: f64, pixel_footprint_world: f64) -> f64 {
        let texel = (self.footprint_kappa * pixel_footprint_world).max(self.texel_floor_world);
        filter_radius_world.max(self.relation.radius_from_texel(texel)).max(self.radius_min_world)
    }
}

/// Width of a pixel's projection onto the light's reference plane, in metres: distance from the eye times
/// [`Camera::height_at_unit_distance`](crate::Camera::height_at_unit_distance) by the picture's height, scaled from the
/// receiver's depth to the reference plane.
#[must_use]
pub fn pixel_footprint_world(
    camera: &crate::Camera,
    fit: &crate::Fit,
    position_world: DVec3,
    picture_height_px: u32,
) -> f64 {
    let view_depth = (position_world - camera.eye).dot(camera.forward());
    let at_receiver = view_depth * camera.height_at_unit_distance() / f64::from(picture_height_px.max(1));
    at_receiver * fit.reference_from_depth(fit.depth(position_world))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::tests_support::{observer, room};
    use crate::{Light, fit};

    #[test]
    fn the_default_settings_are_allowed() {
        assert!(Settings::default().checked().is_ok());
    }

    #[test]
    fn settings_out_of_range_are_refused_by_name() {
        let good = Settings::default;
        let wrong = [
            (Settings { cap: 7, ..good() }, "cap"),
            (Settings { cap: 1 << 20, ..good() }, "cap"),
            (Settings { floor: 4, ..good() }, "floor"),
            (Settings { cap: 16, floor: 32, ..good() }, "floor"),
            (Settings { texel_floor_world: -1.0, ..good() }, "texel_floor_world"),
            (Settings { footprint_kappa: f64::NAN, ..good() }, "footprint_kappa"),
            (Settings { radius_min_world: f64::INFINITY, ..good() }, "radius_min_world"),
            (Settings { shrink_below: 1.0, ..good() }, "shrink_below"),
            (Settings { shrink_rungs: 0, ..good() }, "shrink_rungs"),
            (Settings { side_at_rest: 7, ..good() }, "side_at_rest"),
            (Settings { statistic: Statistic::Quantile(1.0), ..good() }, "the share of Statistic::Quantile"),
        ];
        for (settings, name) in wrong {
            assert!(settings.checked().unwrap_err().to_string().starts_with(name), "{name}");
        }
        assert!(Filter::Pcf { radius_world: 0.0 }.checked().is_err());
        assert!(Filter::Vsm { radius_world: f64::NAN }.checked().is_err());
    }

    #[test]
    fn a_contact_shadow_asks_for_no_texel_below_a_pixel() {
        let settings = Settings::default();
        let radius = settings.demand_radius_world(0.0, 0.01);
        assert!((settings.relation.texel_from_radius(radius) - 0.01).abs() < 1e-15);
        assert_eq!(settings.demand_radius_world(2.0, 0.01), 2.0);
        let floored = Settings { texel_floor_world: 0.1, radius_min_world: 0.4, ..settings };
        assert_eq!(floored.demand_radius_world(0.0, 0.01), 0.4);
    }

    #[test]
    fn a_footprint_is_what_one_pixel_covers_of_the_reference_plane() {
        let camera = observer();
        let p = DVec3::new(0.3, 0.1, -0.5);
        let along = Light::Directional { direction: camera.forward(), half_angle: 0.01 };
        let lamp_at_eye = Light::Spot {
            position: camera.eye - camera.forward(),
            direction: camera.forward(),
            cone_half_angle: 0.7,
            radius_world: 0.1,
        };
        for light in [along, lamp_at_eye] {
            let fit = fit(&camera, &room(), &light, true).unwrap().unwrap();
            // The point one pixel of 720 higher in the picture, at the same distance.
            let clip = camera.clip_from_world() * p.extend(1.0);
            let higher = camera.clip_from_world().inverse() * (clip + glam::DVec4::Y * (clip.w * 2.0 / 720.0));
            let apart = fit.plane_from_world(higher.truncate() / higher.w).distance(fit.plane_from_world(p));
            let footprint = pixel_footprint_world(&camera, &fit, p, 720);
            assert!((footprint / apart - 1.0).abs() < 1e-9, "{footprint} {apart}");
        }
    }
}
