//! How far a variant's visibility is from the truth, over the pixels where it matters.
//!
//! *Lit-facing* pixels turn their geometric normal towards the light and lie in its cone: the others are dark whatever
//! the map says. *Penumbra* pixels are those of them whose true visibility is neither 0 nor 1: there the texels show.

use anyhow::Result;
use scumble::Light;
use scumble_reference::{
    Differences, ErrorParts, Estimate, FLIP_PIXELS_PER_DEGREE, differences, error_parts, flip, penumbra,
};
use serde::{Deserialize, Serialize};

use crate::bench::edges::{EdgeTruth, Edges};
use crate::bench::violation::violation_share;
use crate::gbuffer::Surface;
use crate::stage::Stage;
use crate::variant::Variant;

/// Half the window in which errors that differ are grain, without the pixel itself: the larger of the two usual ones of
/// [`error_parts`], 5 x 5 pixels.
pub const GRAIN_RADIUS_PX: usize = 2;

/// What the pixels of a picture show, rows from top to bottom.
pub struct Screen {
    /// Pixels across and down.
    pub size_px: [u32; 2],
    /// What is seen; `None` is the sky.
    pub surfaces: Vec<Option<Surface>>,
    /// Whether it faces the light.
    pub lit_facing: Vec<bool>,
}

impl Screen {
    /// Of the surfaces of a G-buffer.
    pub fn new(light: &Light, surfaces: Vec<Option<Surface>>, size_px: [u32; 2]) -> Self {
        let lit_facing = surfaces.iter().map(|surface| surface.is_some_and(|surface| faces(light, &surface))).collect();
        Self { size_px, surfaces, lit_facing }
    }
}

/// What a filter's pictures are compared with.
pub struct Truths {
    /// The same filter without texels.
    pub kernel: Vec<f32>,
    /// Its edges.
    pub edges: EdgeTruth,
    /// The light itself; `None` for a filter whose softness is not that of a light.
    pub light: Option<Vec<Estimate>>,
}

/// Errors of a variant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// Over all pixels that face the light.
    pub lit_facing: Differences,
    /// Over those with partial visibility.
    pub penumbra: Differences,
    /// The error in the penumbra as grain and as structure.
    pub parts: ErrorParts,
    /// Visible difference of pictures of the visibility, mean FLIP, 0 to 1.
    pub flip_mean: f64,
    /// Edges; null where there are too few that are shadows' alone.
    pub edges: Option<Edges>,
    /// Against the light itself; null for pcf and vsm, whose radius is no light's.
    pub light: Option<LightComparison>,
    /// Share of the penumbra in which texels are seen; null without a soft filter or a map.
    pub violation_share: Option<f64>,
}

/// Errors against the light itself.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LightComparison {
    /// Over all pixels that face the light.
    pub lit_facing: Differences,
    /// Over those of which the light is partly seen.
    pub penumbra: Differences,
    /// Root mean square of the truth's own standard error over the penumbra: no error below it can be told from none.
    pub standard_error: f64,
}

/// Compares the visibility of every pixel with the truths; `radii` are those of the filter before its lower clamp.
pub fn compare(
    stage: &Stage,
    variant: &Variant,
    screen: &Screen,
    visibility: &[f32],
    truths: &Truths,
    radii: &[f32],
) -> Result<Comparison> {
    let (truth, width) = (&truths.kernel, screen.size_px[0] as usize);
    let penumbra = penumbra(truth, &screen.lit_facing)?;
    Ok(Comparison {
        lit_facing: differences(visibility, truth, &screen.lit_facing)?,
        penumbra: differences(visibility, truth, &penumbra)?,
        parts: error_parts(visibility, truth, &penumbra, width, GRAIN_RADIUS_PX)?,
        flip_mean: flip(visibility, truth, &screen.lit_facing, width, FLIP_PIXELS_PER_DEGREE)?.mean,
        edges: truths.edges.compare(visibility)?,
        light: truths.light.as_ref().map(|light| compare_with_light(screen, visibility, light)).transpose()?,
        violation_share: violation_share(stage, variant, screen, &penumbra, radii)?,
    })
}

fn compare_with_light(screen: &Screen, visibility: &[f32], light: &[Estimate]) -> Result<LightComparison> {
    let truth: Vec<f32> = light.iter().map(|estimate| estimate.visibility).collect();
    let penumbra = penumbra(&truth, &screen.lit_facing)?;
    let errors = light.iter().zip(&penumbra).filter(|(_, inside)| **inside);
    let squares: Vec<f64> = errors.map(|(estimate, _)| f64::from(estimate.standard_error).powi(2)).collect();
    Ok(LightComparison {
        lit_facing: differences(visibility, &truth, &screen.lit_facing)?,
        penumbra: differences(visibility, &truth, &penumbra)?,
        standard_error: (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt(),
    })
}

/// Whether the light reaches this side of a surface where nothing stands in the way.
fn faces(light: &Light, surface: &Surface) -> bool {
    let to_light = light.towards_light(surface.position.as_dvec3());
    let is_in_cone = match *light {
        Light::Directional { .. } | Light::Point { .. } => true,
        Light::Spot { direction, cone_half_angle, .. } => -to_light.dot(direction.normalize()) > cone_half_angle.cos(),
    };
    is_in_cone && to_light.dot(surface.normal.as_dvec3()) > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec3, Vec3};

    #[test]
    fn a_surface_faces_a_lamp_only_inside_of_its_cone() {
        let lamp = Light::Spot {
            position: DVec3::new(0.0, 2.0, 0.0),
            direction: DVec3::NEG_Y,
            cone_half_angle: 0.5,
            radius_world: 0.1,
        };
        let floor = |x, normal| Surface { position: Vec3::new(x, 0.0, 0.0), normal };
        assert!(faces(&lamp, &floor(0.5, Vec3::Y)));
        assert!(!faces(&lamp, &floor(1.5, Vec3::Y)));
        assert!(!faces(&lamp, &floor(0.5, Vec3::NEG_Y)));
    }
}
