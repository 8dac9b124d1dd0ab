//! A ray-traced picture of a scene, with the light's whole disc sampled: what a composition looks like.
//!
//! `cargo run --release -p scumble-reference --example preview -- SCENE OUT.png [SAMPLES]`

use anyhow::Context;
use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;
use scumble_core::{Camera, Light};
use scumble_reference::Rays;
use scumble_scenes::Scene;
use std::f64::consts::TAU;

const WIDTH: u32 = 960;
const HEIGHT: u32 = 540;
/// Fill light from the sky, of the key light's irradiance.
const AMBIENT: f32 = 0.22;
const SKY: Vec3 = Vec3::new(0.55, 0.62, 0.70);

fn main() -> anyhow::Result<()> {
    let mut arguments = std::env::args().skip(1);
    let usage = "SCENE OUT.png [SAMPLES]";
    let (name, out) = arguments.next().zip(arguments.next()).context(usage)?;
    let samples: u32 = arguments.next().map_or(Ok(16), |n| n.parse()).context(usage)?;

    let started = std::time::Instant::now();
    let scene = scumble_scenes::open(&name, "assets".as_ref())?;
    let rays = Rays::new(&scene);
    println!(
        "{name}: {} triangles in {} meshes, bounds {:?}, ready in {:.2} s",
        scene.triangle_count(),
        scene.meshes.len(),
        scene.bounds(),
        started.elapsed().as_secs_f64()
    );

    let mut picture = image::RgbImage::new(WIDTH, HEIGHT);
    picture.as_mut().par_chunks_mut(3 * WIDTH as usize).enumerate().for_each(|(y, row)| {
        for x in 0..WIDTH {
            let linear = shade(&scene, &rays, DVec2::new(f64::from(x), y as f64), samples);
            let code = linear.clamp(Vec3::ZERO, Vec3::ONE).powf(1.0 / 2.2) * 255.0;
            row[3 * x as usize..][..3].copy_from_slice(&code.to_array().map(|c| c.round() as u8));
        }
    });
    picture.save(&out)?;
    println!("{out} after {:.2} s", started.elapsed().as_secs_f64());
    Ok(())
}

/// The mean over `samples` points of the pixel and of the light.
fn shade(scene: &Scene, rays: &Rays, corner_px: DVec2, samples: u32) -> Vec3 {
    (0..samples)
        .map(|i| {
            // Kronecker sequences of the plastic number (pixel) and the golden ratio (light), shifted per pixel.
            let shift = (corner_px.x * 0.754_877_67 + corner_px.y * 0.569_840_29).fract();
            let step = f64::from(i) + shift * 64.0;
            let in_pixel = DVec2::new((step * 0.754_877_67).fract(), (step * 0.569_840_29).fract());
            let on_disc = disc_point((f64::from(i) + 0.5) / f64::from(samples), step * 0.618_033_99 + shift);
            radiance(scene, rays, corner_px + in_pixel, on_disc)
        })
        .sum::<Vec3>()
        / samples as f32
}

fn disc_point(area_share: f64, turn: f64) -> DVec2 {
    area_share.sqrt() * DVec2::from_angle(turn * TAU)
}

fn radiance(scene: &Scene, rays: &Rays, at_px: DVec2, on_disc: DVec2) -> Vec3 {
    let direction = view_ray(&scene.camera, at_px);
    let Some(hit) = rays.first_hit(scene.camera.eye, direction) else {
        return SKY;
    };
    let from = hit.position + hit.geometric_normal * rays.epsilon();
    let (towards_light, irradiance) = light_sample(scene, rays, from, on_disc);
    let cosine = hit.shading_normal.dot(towards_light.normalize()).max(0.0) as f32;
    let lit = cosine > 0.0 && irradiance > 0.0 && rays.free(from, from + towards_light);
    let key = if lit { cosine * irradiance } else { 0.0 };
    let fill = AMBIENT * (0.65 + 0.35 * hit.shading_normal.y as f32);
    scene.meshes[hit.mesh].linear_color * (1.25 * key + fill)
}

/// The segment to a point of the light, and the irradiance it would give at normal incidence.
fn light_sample(scene: &Scene, rays: &Rays, from: DVec3, on_disc: DVec2) -> (DVec3, f32) {
    match scene.light {
        Light::Directional { direction, half_angle } => {
            let (u, v) = direction.any_orthonormal_pair();
            let offset = (u * on_disc.x + v * on_disc.y) * half_angle.tan();
            ((-direction + offset) * rays.diagonal(), 1.0)
        }
        Light::Spot { position, direction, cone_half_angle, radius_world } => {
            let (u, v) = direction.any_orthonormal_pair();
            let towards = position + (u * on_disc.x + v * on_disc.y) * radius_world - from;
            let cosine = -towards.normalize().dot(direction);
            let edge = cone_half_angle.cos();
            // A soft rim over the outer fifth of the cone's cosine range.
            let rim = ((cosine - edge) / (0.2 * (1.0 - edge))).clamp(0.0, 1.0) as f32;
            (towards, 1.4 * rim * rim * (3.0 - 2.0 * rim))
        }
        Light::Point { position, radius_world, .. } => {
            let (u, v) = (position - from).normalize().any_orthonormal_pair();
            (position + (u * on_disc.x + v * on_disc.y) * radius_world - from, 1.4)
        }
    }
}

fn view_ray(camera: &Camera, at_px: DVec2) -> DVec3 {
    let world_from_clip = camera.clip_from_world().inverse();
    let ndc = DVec2::new(2.0 * at_px.x / f64::from(WIDTH) - 1.0, 1.0 - 2.0 * at_px.y / f64::from(HEIGHT));
    (world_from_clip.project_point3(ndc.extend(0.5)) - camera.eye).normalize()
}
