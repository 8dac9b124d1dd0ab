//! Real scenes: the shadows on the GPU against the same kernel over rays, which have no texels.
//!
//! Receivers are what the camera sees. The truth runs `scumble_core::filter` with rays in place of the map: a map
//! without texels, compared with the receiver's tangent plane as the shader does. Errors are taken on the ground, where
//! the tangent plane is the surface, so that the texel alone differs (and the bias that hides it).

#[path = "../../crates/scumble/tests/common/mod.rs"]
mod common;

use std::path::Path;

use common::gpu;
use common::rig::{Point, Rig};
use glam::{DVec2, DVec3, Vec3};
use scumble::scumble_core::{Bias, ReceiverPlane, Taps, filter, rotation_angle};
use scumble::{Filter, Options, Settings, SizeChoice, View};
use scumble_reference::Rays;
use scumble_scenes::Scene;

const WIDTH: u32 = 96;
const HEIGHT: u32 = 54;

fn open(name: &str) -> Scene {
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets");
    scumble_scenes::open(name, &assets).expect("the scene is in the catalogue and its models are here")
}

/// All triangles, three vertices each.
fn vertices(scene: &Scene) -> Vec<Vec3> {
    let of_mesh = |mesh: &scumble_scenes::Mesh| -> Vec<Vec3> {
        mesh.triangles.iter().flatten().map(|&i| mesh.positions[i as usize]).collect()
    };
    scene.meshes.iter().flat_map(of_mesh).collect()
}

/// What the camera sees and the light could reach: surfaces that face it by at least 10 degrees.
fn receivers(scene: &Scene, rays: &Rays) -> Vec<Point> {
    let camera = &scene.camera;
    let forward = camera.forward();
    let right = forward.cross(camera.up).normalize();
    let up = right.cross(forward);
    let half = 0.5 * camera.height_at_unit_distance();
    let hit = |x: u32, y: u32| {
        let across = (f64::from(x) + 0.5) / f64::from(WIDTH) * 2.0 - 1.0;
        let above = 1.0 - (f64::from(y) + 0.5) / f64::from(HEIGHT) * 2.0;
        let ray = forward + half * (above * up + camera.aspect * across * right);
        let hit = rays.first_hit(camera.eye, ray)?;
        let normal = hit.geometric_normal;
        let towards_eye = if normal.dot(ray) < 0.0 { normal } else { -normal };
        let faces = towards_eye.dot(scene.light.towards_light(hit.position)) > 10f64.to_radians().sin();
        faces.then_some(Point { position: hit.position.as_vec3(), normal: towards_eye.as_vec3(), pixel: [x, y] })
    };
    (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y))).filter_map(|(x, y)| hit(x, y)).collect()
}

/// Receivers on level ground.
fn ground(scene: &Scene, rays: &Rays) -> Vec<Point> {
    let mut points = receivers(scene, rays);
    points.retain(|point| point.normal.y > 0.999 && point.position.y.abs() < 1e-3);
    points
}

/// Visibility of each receiver by rays, with the radius of its filter, which is 0 where nothing is in the way.
fn truth(rays: &Rays, view: &View, kind: &Filter, points: &[Point]) -> Vec<(f64, f64)> {
    let fit = &view.fit;
    let taps = Taps::default();
    let at_point = |point: &Point| {
        let position = point.position.as_dvec3();
        let plane = ReceiverPlane::new(fit, position, point.normal.as_dvec3(), &Bias::without_texels(), DVec2::ZERO);
        let from = |offset: DVec2, depth: f64| fit.world_from_plane(fit.plane_from_world(position) + offset, depth);
        let lookup = |offset, depth| {
            f64::from(u8::from(rays.free(from(offset, fit.depth_near), from(offset, depth - rays.epsilon()))))
        };
        let depth_at = |offset| {
            let (start, end) = (from(offset, fit.depth_near), from(offset, fit.depth_far));
            rays.first_hit(start, end - start).map(|hit| fit.depth(hit.position))
        };
        let turn = rotation_angle(point.pixel);
        match *kind {
            Filter::Hard => (filter::hard(lookup, &plane), 0.0),
            Filter::Vsm { .. } => unreachable!("compared with rays by the viewer's bench"),
            Filter::Pcf { radius_world } => {
                (filter::pcf(lookup, &taps.filter, radius_world, turn, &plane), radius_world)
            }
            Filter::Pcss => {
                let soft = filter::pcss(depth_at, lookup, &taps, turn, fit, &plane, view.radius_min_world);
                (soft.visibility, soft.radius_world)
            }
        }
    };
    points.iter().map(at_point).collect()
}

fn rms(found: &[f32], truth: &[(f64, f64)]) -> f64 {
    let squares: f64 = found.iter().zip(truth).map(|(&f, (t, _))| (f64::from(f) - t).powi(2)).sum();
    (squares / truth.len() as f64).sqrt()
}

fn rig(scene: &Scene, settings: Settings, options: Options) -> Rig {
    let mut rig = Rig::new(settings, options, &vertices(scene));
    rig.camera = scene.camera;
    rig.bounds = scene.bounds();
    rig
}

fn settings() -> Settings {
    Settings { cap: 2048, ..Settings::default() }
}

#[test]
fn a_fixed_kernel_over_the_map_that_the_relation_asks_for_is_close_to_the_kernel_without_texels() {
    for name in ["contact", "stairwell", "recital", "yard"] {
        let scene = open(name);
        let rays = Rays::new(&scene);
        let points = ground(&scene, &rays);
        let kind = Filter::Pcf { radius_world: scene.pcf_radius_world };
        let mut rig = rig(&scene, settings(), Options { filter: kind, ..Options::default() });

        let plan = rig.draw(&[scene.light]);
        let view = &plan.views()[0];
        let truth = truth(&rays, view, &kind, &points);
        let adaptive = rms(&rig.visibility(&points), &truth);

        // A fifth of the texels a side is clearly worse, so the comparison can fail.
        let coarse_size = view.size_texels.map(|side| (side / 5).max(1));
        rig.shadows
            .set_options(Options { size: SizeChoice::Fixed(coarse_size), ..rig.shadows.options().clone() })
            .expect("the size is below the cap");
        rig.draw(&[scene.light]);
        let coarse = rms(&rig.visibility(&points), &truth);

        let shaded = truth.iter().filter(|(visibility, _)| *visibility < 1.0).count();
        println!(
            "{name}: {:?} rms {adaptive:.4}, {coarse_size:?} rms {coarse:.4}, {shaded} of {} shaded",
            view.size_texels,
            points.len()
        );
        assert!(shaded * 50 > points.len(), "{name} has shadows on screen");
        assert!(adaptive < 0.05 && coarse > 1.5 * adaptive, "{name}: {adaptive} {coarse}");
    }
}

#[test]
fn soft_shadows_at_the_measured_size_are_close_to_soft_shadows_without_texels() {
    for name in ["contact", "stairwell"] {
        let scene = open(name);
        let rays = Rays::new(&scene);
        let points = ground(&scene, &rays);
        let mut rig = rig(&scene, settings(), Options::default());
        rig.draw(&[scene.light]);
        measure(&mut rig);
        // Sizes shrink late; begin again with what was measured.
        let radius = {
            let plan = rig.draw(&[scene.light]);
            rig.shadows.measured_radius_world(&plan.views()[0]).flatten().expect("there is a penumbra")
        };
        let view_extent = rig.draw(&[scene.light]).views()[0].fit.extent_world;
        let sides = (view_extent * 3.47 / radius).ceil().min(DVec2::splat(2048.0)).as_uvec2().to_array();
        rig.shadows
            .set_options(Options { size: SizeChoice::Fixed(sides), ..Options::default() })
            .expect("the size is below the cap");
        let plan = rig.draw(&[scene.light]);
        let truth = truth(&rays, &plan.views()[0], &Filter::Pcss, &points);
        let found = rms(&rig.visibility(&points), &truth);
        println!("{name}: radius {radius:.4} m, {sides:?}, rms {found:.4}");
        assert!(found < 0.05, "{name}: {found}");
    }
}

/// One demand pass over a prepass of the screen's size, read back.
fn measure(rig: &mut Rig) {
    let mut encoder = gpu().encoder();
    let prepass = rig.casters.draw_prepass(gpu(), &mut encoder, &rig.camera, DVec3::ZERO, [WIDTH, HEIGHT]);
    rig.shadows.measure(&gpu().queue, &mut encoder, &prepass, &rig.camera).expect("it can be measured");
    gpu().finish(encoder);
    rig.shadows.read_demand();
}

#[test]
fn the_measured_minimum_is_what_rays_find_in_the_penumbra() {
    for name in ["contact", "stairwell", "recital", "yard"] {
        let scene = open(name);
        let rays = Rays::new(&scene);
        let points = receivers(&scene, &rays);
        let options = Options { size: SizeChoice::Fixed([2048; 2]), measure_stride: 1, ..Options::default() };
        let mut rig = rig(&scene, settings(), options);
        let plan = rig.draw(&[scene.light]);
        let view = &plan.views()[0];
        measure(&mut rig);
        let measured = rig.shadows.measured_radius_world(view).flatten().expect("there is a penumbra");

        // By rays: fragments of partial visibility, clamped by the pixel as the demand is.
        let smallest = truth(&rays, view, &Filter::Pcss, &points)
            .into_iter()
            .zip(&points)
            .filter(|((visibility, _), _)| (0.02..0.98).contains(visibility))
            .map(|((_, radius), point)| {
                let position = point.position.as_dvec3();
                let footprint =
                    scumble::scumble_core::pixel_footprint_world(&scene.camera, &view.fit, position, HEIGHT);
                rig.shadows.settings().demand_radius_world(radius, footprint)
            })
            .fold(f64::INFINITY, f64::min);
        println!("{name}: measured {measured:.5}, by rays {smallest:.5}");
        assert!((measured / smallest - 1.0).abs() < 0.15, "{name}: {measured} {smallest}");
    }
}

#[test]
fn the_loop_of_measuring_and_sizing_rests_in_every_scene() {
    for name in ["contact", "stairwell", "recital", "yard"] {
        let scene = open(name);
        let mut rig = rig(&scene, Settings { cap: 1024, ..Settings::default() }, Options::default());
        let sizes: Vec<[u32; 2]> = (0..150)
            .map(|_| {
                let plan = rig.draw(&[scene.light]);
                measure(&mut rig);
                plan.views()[0].size_texels
            })
            .collect();
        println!("{name}: {:?} -> {:?}", sizes[0], sizes[149]);
        assert!(sizes[100..].iter().all(|size| *size == sizes[149]), "{name}: {sizes:?}");
    }
}
