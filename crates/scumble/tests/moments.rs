//! Variance shadow maps: the moments are those of the CPU, edges fade as the closed forms of a square say, light bleeds
//! by what the bound says, and the cost does not depend on the radius.

mod common;

use common::casters::{cuboid, quad};
use common::rig::{Point, Rig, fixed, ground_and, slab, sun_above};
use glam::{DVec2, DVec3, Vec2, Vec3};
use scumble::scumble_core::moments::{MomentMap, VarianceBound};
use scumble::{Error, Filter, Light, Options, Settings, View};

/// Of the two-plane tests: the bound by itself.
const UNCUT: VarianceBound = VarianceBound { deviation_min_texels: 0.01, bleeding_cut: 0.0 };

fn vsm(radius_world: f64) -> Filter {
    Filter::Vsm { radius_world }
}

fn settings(cap: u32) -> Settings {
    Settings { cap, ..Settings::default() }
}

fn on_ground(x: f32, z: f32) -> Point {
    Point { position: Vec3::new(x, 0.0, z), normal: Vec3::Y, pixel: [0, 0] }
}

fn lamp() -> Light {
    Light::Spot {
        position: DVec3::new(1.0, 8.0, -0.5),
        direction: DVec3::new(-0.1, -1.0, 0.05),
        cone_half_angle: 0.6,
        radius_world: 0.4,
    }
}

/// Linear depths of a drawn map, 0 at its near plane and 1 at its far plane.
fn linear_depths(rig: &Rig, view: &View) -> Vec<f64> {
    let depths = rig.gpu.read_depth(rig.shadows.map_texture(), view.layer, view.size_texels);
    depths.into_iter().map(|depth| share_of_range(view, view.fit.depth_from_ndc(f64::from(depth)))).collect()
}

fn share_of_range(view: &View, depth: f64) -> f64 {
    (depth - view.fit.depth_near) / (view.fit.depth_far - view.fit.depth_near)
}

#[test]
fn moments_and_visibility_are_those_of_the_cpu_over_the_same_map() {
    let mut above = cuboid(Vec3::new(0.5, 0.0, -2.0), Vec3::new(1.7, 1.1, -0.6));
    above.extend(cuboid(Vec3::new(-2.0, 1.5, 0.3), Vec3::new(0.2, 1.7, 2.4)));
    let scene = ground_and(above);
    let points: Vec<Point> =
        (0..1600).map(|i| on_ground((i % 40) as f32 * 0.153 - 3.0, (i / 40) as f32 * 0.149 - 2.9)).collect();
    let sun = Light::Directional { direction: DVec3::new(0.35, -1.0, 0.2), half_angle: 0.1 };
    // Less than half a texel, a few texels, blocks of many.
    for (light, radii) in [(sun, [0.01, 0.3, 0.9]), (lamp(), [0.002, 0.02, 0.12])] {
        for radius_world in radii {
            let mut rig = Rig::new(settings(512), fixed(vsm(radius_world), 160), &scene);
            let plan = rig.draw(&[light]);
            let view = &plan.views()[0];
            let texels = radius_world / view.texel_world();
            let map = MomentMap::new(&linear_depths(&rig, view), view.size_texels, texels);
            let bound = rig.shadows.settings().variance;
            let range = view.fit.depth_far - view.fit.depth_near;

            let found = rig.evaluate(
                "let receiver = shadow_receiver(0u, row.a.xyz, row.b.xyz);
                 result = vec4f(shadow_moments_at(0u, receiver.texel), shadow_vsm(0u, receiver), 0.0);",
                &points,
            );
            let (mut of_mean, mut of_deviation, mut off, mut partial) = (0.0f64, 0.0f64, 0, 0);
            for (point, [mean, variance, visibility, _]) in points.iter().zip(found) {
                let (uv, depth) = view.fit.uv_from_world(point.position.as_dvec3());
                let size = DVec2::new(f64::from(view.size_texels[0]), f64::from(view.size_texels[1]));
                let expected = map.at(uv * size);
                of_mean = of_mean.max((f64::from(mean) - expected.mean).abs());
                of_deviation = of_deviation.max((f64::from(variance).sqrt() - expected.variance.sqrt()).abs());
                // The part of the bias that is for rounding: 1e-5 of the range.
                let deviation_min = bound.deviation_min_texels * view.texel_world().max_element()
                    / view.fit.reference_from_depth(depth)
                    / range;
                let depth = share_of_range(view, depth).min(1.0) - 1e-5;
                let expected = expected.visibility(depth, deviation_min, bound.bleeding_cut);
                off += usize::from((f64::from(visibility) - expected).abs() > 0.01);
                partial += usize::from(expected > 0.0 && expected < 1.0);
            }
            println!("{texels:.1} texels: mean off by {of_mean:.1e}, deviation by {of_deviation:.1e} of the range");
            assert!(partial >= 10, "only {partial} of the points are in a penumbra");
            // Depth and place of f32: 6e-8 of the range by up to some tens of texels of slope. Of the deviation, where it is 0.
            assert!(of_mean < 1e-4 && of_deviation < 1e-3, "{of_mean} {of_deviation}");
            assert!(off <= 4, "{light:?}: {off} of {} points differ", points.len());
        }
    }
}
