//! How long the truths of a picture take: every pixel of a scene's own view, for each filter and for the light itself.
//!
//! `cargo run --release -p scumble-reference --example time_truth -- SCENE [WIDTH HEIGHT]`

use anyhow::Context;
use glam::DVec2;
use rayon::prelude::*;
use scumble_core::{Filter, fit};
use scumble_reference::{KernelTruth, LightTruth, Rays, Receiver};
use std::time::Instant;

/// Rays to the light from each receiver, as many as `scumble-viewer truth` sends by default.
const LIGHT_SAMPLES: u32 = 256;

fn main() -> anyhow::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let name = arguments.first().context("SCENE [WIDTH HEIGHT]")?;
    let side = |index: usize, default: u32| arguments.get(index).map_or(Ok(default), |text| text.parse());
    let (width, height) = (side(1, 1280)?, side(2, 720)?);

    let scene = scumble_scenes::open(name, "assets".as_ref())?;
    let started = Instant::now();
    let rays = Rays::new(&scene);
    println!(
        "{name}: {} triangles, hierarchy in {:.2} s, {} threads",
        scene.triangle_count(),
        started.elapsed().as_secs_f64(),
        rayon::current_num_threads()
    );
    let fit = fit(&scene.camera, &scene.bounds(), &scene.light, true)?.context("the light has no view")?;

    // What the camera sees.
    let world_from_clip = scene.camera.clip_from_world().inverse();
    let receivers: Vec<Receiver> = (0..width * height)
        .into_par_iter()
        .filter_map(|index| {
            let pixel = [index % width, index / width];
            let across = 2.0 * (f64::from(pixel[0]) + 0.5) / f64::from(width) - 1.0;
            let up = 1.0 - 2.0 * (f64::from(pixel[1]) + 0.5) / f64::from(height);
            let through = world_from_clip.project_point3(DVec2::new(across, up).extend(0.5));
            let hit = rays.first_hit(scene.camera.eye, through - scene.camera.eye)?;
            Some(Receiver { position: hit.position.as_vec3(), normal: hit.geometric_normal.as_vec3(), pixel })
        })
        .collect();

    for filter in [Filter::Hard, Filter::Pcf { radius_world: scene.pcf_radius_world }, Filter::Pcss] {
        let started = Instant::now();
        let visibility = KernelTruth::new(&rays, &fit, filter).visibility(&receivers, |_| ());
        let elapsed_secs = started.elapsed().as_secs_f64();
        let mean = visibility.iter().sum::<f32>() / visibility.len() as f32;
        let partial = visibility.iter().filter(|v| **v > 0.0 && **v < 1.0).count();
        println!(
            "{:>4}: {} receivers of {width} x {height} in {elapsed_secs:.1} s, mean visibility {mean:.3}, {partial} partial",
            filter.name(),
            receivers.len()
        );
    }

    let samples = LIGHT_SAMPLES;
    let started = Instant::now();
    let estimates = LightTruth::new(&rays, &scene.light, samples)?.visibility(&receivers, |_| ());
    let elapsed_secs = started.elapsed().as_secs_f64();
    let largest = estimates.iter().map(|estimate| estimate.standard_error).fold(0.0, f32::max);
    println!("light: {samples} samples each in {elapsed_secs:.1} s, standard error at most {largest:.3}");
    Ok(())
}
