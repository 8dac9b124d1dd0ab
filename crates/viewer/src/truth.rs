//! `truth`: the picture that a map without texels would give, and its visibility as raw numbers.

use anyhow::Result;
use scumble::{Filter, Light, Plan};
use scumble_reference::{KernelTruth, Rays, Receiver};
use serde::Serialize;

use crate::bench::progress;
use crate::cli::{Size, Truth};
use crate::device::Gpu;
use crate::gbuffer::Surface;
use crate::output::{Kind, claim, claim_with_record, write_json, write_png, write_raw};
use crate::setup::Setup;
use crate::stage::Stage;
use crate::timer::Timer;
use crate::variant::Variant;

/// What the record says it is.
const SCHEMA: &str = "scumble/truth/1";

/// Samples per pixel along x and along y.
const SAMPLES_PER_SIDE: u32 = 2;
/// Side of the map whose fit says where the reference plane is; it is never looked at.
const FIT_TEXELS: u32 = 8;

/// The JSON file beside the picture, which says what the raw numbers are.
#[derive(Serialize)]
struct TruthRecord<'a> {
    schema: &'static str,
    scene: &'a str,
    method: &'static str,
    light: &'a Light,
    pcf_radius_plane: f64,
    /// Of the picture.
    width: u32,
    height: u32,
    /// Of the .f32 file: little-endian, rows from top to bottom, visibility 0 dark to 1 lit.
    raw_width: u32,
    raw_height: u32,
}

/// Runs the command.
pub fn run(options: &Truth) -> Result<()> {
    let conditions = &options.view.conditions;
    let (picture_path, record_path) = claim_with_record(&options.out, SCHEMA)?;
    let raw_path = claim(&options.out.with_extension("f32"), Kind::Raw)?;
    let setup = Setup::open(&options.view.scene, conditions)?;
    let stage = Stage::new(Gpu::open()?, setup)?;
    let samples = stage.receivers([conditions.width, conditions.height], SAMPLES_PER_SIDE)?;
    let mut timer = Timer::new(&stage.gpu);
    let mut fitted = Variant::new(&stage, &samples, options.method, Size::Fixed([FIT_TEXELS; 2]))?;
    fitted.frame(&stage, &samples, &mut timer)?;

    let surfaces = samples.read_surfaces(&stage.gpu)?;
    let filter = stage.setup.filter(options.method);
    let message = format!("truth of {}", stage.setup.scene.name);
    let rays = Rays::new(&stage.setup.scene);
    let visibility = true_visibility(&message, &rays, &filter, fitted.plan()?, &surfaces, samples.size_px[0]);

    let texture = stage.upload_visibility(&samples, &visibility);
    write_png(&picture_path, &stage.picture(&samples, &texture, SAMPLES_PER_SIDE)?)?;
    write_raw(&raw_path, &visibility)?;
    let record = TruthRecord {
        schema: SCHEMA,
        scene: &stage.setup.scene.name,
        method: options.method.name(),
        light: &stage.setup.scene.light,
        pcf_radius_plane: stage.setup.pcf_radius_plane,
        width: conditions.width,
        height: conditions.height,
        raw_width: samples.size_px[0],
        raw_height: samples.size_px[1],
    };
    write_json(&record_path, &record)?;
    println!("{}, {}, {}", picture_path.display(), raw_path.display(), record_path.display());
    Ok(())
}

/// Visibility without texels of every pixel of a picture `width_px` wide; 1 where there is no surface or the light has
/// no view. The plan's fit says where the reference plane is, on which radii are measured.
pub fn true_visibility(
    message: &str,
    rays: &Rays,
    filter: &Filter,
    plan: &Plan,
    surfaces: &[Option<Surface>],
    width_px: u32,
) -> Vec<f32> {
    let mut visibility = vec![1.0; surfaces.len()];
    let Some(view) = plan.views().first() else { return visibility };
    let (seen, receivers): (Vec<usize>, Vec<Receiver>) = surfaces
        .iter()
        .enumerate()
        .filter_map(|(index, surface)| Some((index, receiver(surface.as_ref()?, index, width_px))))
        .unzip();
    let bar = progress(message, receivers.len() as u64);
    let of_receivers = KernelTruth::new(rays, &view.fit, *filter).visibility(&receivers, |done| bar.inc(done as u64));
    bar.finish_and_clear();
    for (index, of_receiver) in seen.into_iter().zip(of_receivers) {
        visibility[index] = of_receiver;
    }
    visibility
}

/// What is seen in the pixel `index` of rows `width_px` wide.
fn receiver(surface: &Surface, index: usize, width_px: u32) -> Receiver {
    let (position, normal, index) = (surface.position, surface.normal.normalize_or_zero(), index as u32);
    Receiver { position, normal, pixel: [index % width_px, index / width_px] }
}
