//! `shot`: one picture, and its numbers beside it.

use std::collections::BTreeMap;

use anyhow::Result;
use scumble::Light;
use serde::Serialize;

use crate::cli::Shot;
use crate::device::Gpu;
use crate::output::{claim_with_record, write_json, write_png};
use crate::record::{MachineRecord, MapRecord, RatioRecord};
use crate::setup::Setup;
use crate::size::Size;
use crate::stage::Stage;
use crate::statistics::Spread;
use crate::timer::Timer;
use crate::variant::{Case, Variant, still_settings};

/// What the record says it is.
const SCHEMA: &str = "scumble/shot/1";

/// Frames whose median is reported.
const TIMED_FRAMES: usize = 5;

/// The JSON file beside a picture.
#[derive(Serialize)]
struct ShotRecord<'a> {
    schema: &'static str,
    scene: &'a str,
    method: &'static str,
    size: String,
    width: u32,
    height: u32,
    light: &'a Light,
    pcf_radius_plane: f64,
    ratio: RatioRecord,
    /// Of all maps together.
    texels: u64,
    maps: Vec<MapRecord>,
    demand: DemandRecord,
    /// Medians in milliseconds at one sample per pixel; empty where the device has no timestamps.
    times_ms: BTreeMap<&'static str, f64>,
    machine: MachineRecord,
}

/// What the screen asked for.
#[derive(Serialize)]
struct DemandRecord {
    /// Smallest filter radius on screen, metres at the reference plane; null without a penumbra on screen.
    radius_world: Option<f64>,
}

/// Runs the command.
pub fn run(options: &Shot) -> Result<()> {
    let conditions = &options.view.conditions;
    let (picture_path, record_path) = claim_with_record(&options.out, SCHEMA)?;
    let setup = Setup::open(&options.view.scene, options.view.light, conditions)?;
    let stage = Stage::new(Gpu::open()?, setup)?;

    let size_px = [conditions.width, conditions.height];
    let receivers = stage.receivers(size_px, 1)?;
    let mut timer = Timer::new(&stage.gpu);
    let case = Case { method: options.method, size: options.size, softness: 1.0 };
    let mut variant = Variant::new(&stage, &receivers, case, still_settings(&stage.setup))?;
    variant.settle(&stage, &receivers, &mut timer)?;

    let mut times: BTreeMap<&'static str, Vec<f64>> = BTreeMap::new();
    for _ in 0..TIMED_FRAMES {
        for (part, milliseconds) in variant.frame(&stage, &receivers, &mut timer)? {
            times.entry(part).or_default().push(milliseconds);
        }
    }

    let samples = stage.receivers(size_px, options.samples)?;
    let visibility = variant.evaluate(&stage, &samples)?;
    write_png(&picture_path, &stage.picture(&samples, &visibility, options.samples)?)?;

    let medians = times.iter().filter_map(|(&part, list)| Some((part, Spread::of(list)?.median)));
    let demand = DemandRecord { radius_world: variant.demand_radius_world(&stage, &receivers)? };
    let plan = variant.plan()?;
    let record = ShotRecord {
        schema: SCHEMA,
        scene: &stage.setup.scene.name,
        method: options.method.name(),
        size: options.size.to_string(),
        width: size_px[0],
        height: size_px[1],
        light: &stage.setup.scene.light,
        pcf_radius_plane: stage.setup.pcf_radius_plane,
        ratio: RatioRecord::of(&stage.setup),
        texels: plan.texels(),
        maps: variant.map_records()?,
        demand,
        times_ms: medians.collect(),
        machine: MachineRecord::of(&stage.gpu),
    };
    write_json(&record_path, &record)?;
    let is_adaptive = matches!(options.size, Size::Adaptive(_));
    let words = |map: &MapRecord| {
        let [_, _, across, down] = map.viewport;
        format!("{across} x {down}{}", if is_adaptive && map.capped { " (cap)" } else { "" })
    };
    let maps: Vec<String> = record.maps.iter().map(words).collect();
    println!("{}: {} texels, {}; {}", picture_path.display(), record.texels, maps.join(" + "), record_path.display());
    Ok(())
}
