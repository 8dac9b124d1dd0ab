//! How long the preparation of a large scene for rays takes, and how much memory: a wavy field of squares, two triangles
//! each.
//!
//! `cargo run --release -p scumble-reference --example time_hierarchy -- [MILLION_TRIANGLES]`

use std::time::Instant;

use glam::{DVec3, Vec3};
use scumble_core::{Camera, Light};
use scumble_reference::Rays;
use scumble_scenes::{Mesh, Scene};

/// Rays that are timed, downwards over the field.
const RAYS: u32 = 1_000_000;

fn main() -> anyhow::Result<()> {
    let millions: f64 = std::env::args().nth(1).map_or(Ok(10.0), |text| text.parse())?;
    let per_side = (millions * 1e6 / 2.0).sqrt().round().max(1.0) as u32;
    let scene = field(per_side);
    let before = peak_mib();

    let started = Instant::now();
    let rays = Rays::new(&scene);
    println!(
        "{} triangles: prepared in {:.1} s; peak {} MiB, of which the scene {} MiB",
        scene.triangle_count(),
        started.elapsed().as_secs_f64(),
        peak_mib(),
        before
    );

    let started = Instant::now();
    let side = f64::from(per_side);
    let hits = (0..RAYS)
        .filter(|&i| {
            // Spread evenly by two irrational steps (R2 sequence), slanted by a few degrees.
            let [x, z] = [0.754_877_666, 0.569_840_291].map(|step| (f64::from(i) * step).fract() * side);
            rays.first_hit(DVec3::new(x, 20.0, z), DVec3::new(0.05, -1.0, 0.02)).is_some()
        })
        .count();
    let per_second = f64::from(RAYS) / started.elapsed().as_secs_f64();
    println!("{per_second:.0} rays a second on one core, {hits} of {RAYS} meet the field");
    Ok(())
}

/// Squares of a metre.
fn field(per_side: u32) -> Scene {
    let height = |x: u32, z: u32| 2.0 * (f64::from(x) * 0.05).sin() * (f64::from(z) * 0.07).cos();
    let across = per_side + 1;
    let corners = (0..across * across).map(|i| (i % across, i / across));
    let positions = corners.map(|(x, z)| DVec3::new(f64::from(x), height(x, z), f64::from(z)).as_vec3()).collect();
    let square = |i: u32| {
        let corner = i / per_side * across + i % per_side;
        [[corner, corner + across, corner + 1], [corner + 1, corner + across, corner + across + 1]]
    };
    let mesh = Mesh {
        name: "field".to_owned(),
        positions,
        normals: vec![Vec3::Y; (across * across) as usize],
        triangles: (0..per_side * per_side).flat_map(square).collect(),
        linear_color: Vec3::ONE,
        mask: None,
    };
    let camera = Camera {
        eye: DVec3::new(0.0, 20.0, 0.0),
        target: DVec3::new(100.0, 0.0, 100.0),
        up: DVec3::Y,
        vertical_fov: 0.8,
        aspect: 1.5,
        near: 0.1,
        far: 1e4,
    };
    let light = Light::Directional { direction: DVec3::NEG_Y, half_angle: 0.01 };
    Scene { name: "field".to_owned(), meshes: vec![mesh], camera, light, pcf_radius_world: 0.1 }
}

/// Most memory that the process has held; 0 where the system does not tell as Linux does.
fn peak_mib() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let kib =
        status.lines().find_map(|line| line.strip_prefix("VmHWM:")?.split_whitespace().next()?.parse::<u64>().ok());
    kib.unwrap_or(0) / 1024
}
