//! What the commands work on: a scene with its light and camera, a filter and a relation, from the options.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use scumble_core::{AtCap, Face, Filter, Fit, Light, Relation, Splits, fit_face, slices_of};
use scumble_scenes::Scene;

use crate::cli::{Conditions, LightKind, Method};

/// A sun wider than this is no disc in the sky any more: tan grows without bound towards 90 degrees.
const HALF_ANGLE_MAX_DEG: f64 = 45.0;

/// A scene under conditions.
pub struct Setup {
    /// Meshes, camera with the aspect of the picture, light with the size asked for.
    pub scene: Scene,
    /// The radius of PCF and VSM at the light's reference plane, metres; see [`pcf_radius_plane`].
    pub pcf_radius_plane: f64,
    /// Most texels per side of an adaptive map.
    pub cap: u32,
    /// What gives way there.
    pub at_cap: AtCap,
    /// Into how many slices the view of a sun is cut.
    pub cascades: Splits,
    /// Texels per radius.
    pub relation: Relation,
    /// Where the relation comes from, for records.
    pub relation_source: String,
}

impl Setup {
    /// Opens the scene, with another `light` if one is given, and applies the conditions.
    pub fn open(scene: &str, light: Option<LightKind>, conditions: &Conditions) -> Result<Self> {
        let mut scene = scumble_scenes::open(scene, &assets(conditions.assets.as_deref()))?;
        if let Some(LightKind::Point) = light {
            scene.light = bulb(&scene)?;
        }
        scene.camera.aspect = f64::from(conditions.width) / f64::from(conditions.height);
        if let Some(size) = conditions.light_size {
            set_light_size(&mut scene.light, size)?;
        }
        let (relation, relation_source) = match &conditions.relation {
            None => (Relation::published(), "published".to_owned()),
            Some(path) => (read_relation(path)?, path.display().to_string()),
        };
        let pcf_radius_plane = pcf_radius_plane(&scene, conditions.radius.unwrap_or(scene.pcf_radius_world))?;
        let cascades = Splits { count: conditions.cascades, ..Splits::default() };
        Ok(Self {
            scene,
            pcf_radius_plane,
            cap: conditions.cap,
            at_cap: conditions.at_cap.at_cap(),
            cascades,
            relation,
            relation_source,
        })
    }

    /// How many maps the light has.
    pub fn map_count(&self) -> u32 {
        slices_of(&self.scene.light, true, &self.cascades)
    }

    /// The filter of a method, `softness` times as soft as this setup; PCSS takes its softness from the light.
    pub fn filter(&self, method: Method, softness: f64) -> Filter {
        match method {
            Method::None => Filter::Hard,
            Method::Pcf => Filter::Pcf { radius_world: self.pcf_radius_plane * softness },
            Method::Pcss => Filter::Pcss,
            Method::Vsm => Filter::Vsm { radius_world: self.pcf_radius_plane * softness },
        }
    }

    /// What a light of this softness sees of what the camera sees; `None` where that is nothing. Not of a point light, which has
    /// six faces.
    pub fn fit(&self, softness: f64) -> Result<Option<Fit>> {
        let scene = &self.scene;
        let fitted = scumble_core::fit(&scene.camera, &scene.bounds(), &self.light(softness)?, true);
        fitted.with_context(|| format!("the scene {}", scene.name))
    }

    /// The light, `softness` times as large as this setup's.
    ///
    /// # Errors
    /// A sun that would be wider than a disc in the sky can be.
    pub fn light(&self, softness: f64) -> Result<Light> {
        let mut light = self.scene.light;
        match &mut light {
            Light::Directional { half_angle, .. } => {
                *half_angle *= softness;
                ensure!(
                    half_angle.to_degrees() <= HALF_ANGLE_MAX_DEG,
                    "--softness {softness}: makes the sun of {} {:.1} degrees wide to each side; {HALF_ANGLE_MAX_DEG} \
                     are allowed",
                    self.scene.name,
                    half_angle.to_degrees()
                );
            }
            Light::Spot { radius_world, .. } | Light::Point { radius_world, .. } => *radius_world *= softness,
        }
        Ok(light)
    }
}

/// The radius at the light's reference plane that is `radius_world` at what the camera looks at. Users think of the
/// shadow they see; a lamp's reference plane is its near plane, where the same kernel is smaller by the ratio of the
/// depths.
fn pcf_radius_plane(scene: &Scene, radius_world: f64) -> Result<f64> {
    let (camera, bounds, light) = (&scene.camera, scene.bounds(), &scene.light);
    let fit = match *light {
        Light::Point { position, .. } => fit_face(camera, &bounds, light, Face::of(camera.target - position), true),
        Light::Directional { .. } | Light::Spot { .. } => scumble_core::fit(camera, &bounds, light, true),
    };
    Ok(fit.with_context(|| format!("the scene {}", scene.name))?.map_or(radius_world, |fit| {
        let (_, depth) = fit.uv_from_world(camera.target);
        radius_world * fit.reference_from_depth(depth.max(fit.reference_depth()))
    }))
}

/// A point light in the place of a scene's lamp, with its radius.
fn bulb(scene: &Scene) -> Result<Light> {
    match scene.light {
        Light::Spot { position, radius_world, .. } | Light::Point { position, radius_world, .. } => {
            Ok(Light::Point { position, radius_world, reach_world: f64::INFINITY })
        }
        Light::Directional { .. } => bail!(
            "--light point: the light of {} is a sun; scenes with a lamp are possible, such as room and stairwell",
            scene.name
        ),
    }
}

fn set_light_size(light: &mut Light, size: f64) -> Result<()> {
    match light {
        Light::Directional { half_angle, .. } => {
            ensure!(
                size <= HALF_ANGLE_MAX_DEG,
                "--light-size {size}: the half angle of a sun is at most {HALF_ANGLE_MAX_DEG} degrees"
            );
            *half_angle = size.to_radians();
        }
        Light::Spot { radius_world, .. } | Light::Point { radius_world, .. } => *radius_world = size,
    }
    Ok(())
}

fn read_relation(path: &Path) -> Result<Relation> {
    let text = fs::read_to_string(path).with_context(|| format!("{}: cannot be read", path.display()))?;
    Relation::from_json(&text).with_context(|| path.display().to_string())
}

/// The folder of models: as asked, else beside the program, else the one of the workspace that built it.
pub fn assets(asked: Option<&Path>) -> PathBuf {
    if let Some(path) = asked {
        return path.to_owned();
    }
    let beside = std::env::current_exe().ok().and_then(|program| Some(program.parent()?.join("assets")));
    match beside.filter(|path| path.is_dir()) {
        Some(path) => path,
        // Without the dots of a path through this crate, where it can be found.
        None => {
            let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets");
            assets.canonicalize().unwrap_or(assets)
        }
    }
}
