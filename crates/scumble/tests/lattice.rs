//! An adaptive map stands on a lattice of texels that does not move: a camera that does changes no shadow.

mod common;

use common::casters::cuboid;
use common::rig::{Point, Rig, fixed, ground_and};
use glam::{DVec3, Vec3};
use scumble::{Filter, Light, Options, Settings};

/// A point of the ground a centimetre from the next, across the edges of a box's shadow.
fn points() -> Vec<Point> {
    (0..300u32)
        .map(|i| Point { position: Vec3::new(0.5 + 0.01 * i as f32, 0.0, 0.1), normal: Vec3::Y, pixel: [7, 9] })
        .collect()
}

/// Largest change of visibility at the points from frame to frame while the camera glides by half a texel a frame, and the
/// change of a texel's size over all frames.
fn shimmer(options: Options) -> (f32, f64) {
    let casters = ground_and(cuboid(Vec3::new(-1.0, 0.0, -1.0), Vec3::new(1.0, 2.0, 1.0)));
    let mut rig = Rig::new(Settings { cap: 512, ..Settings::default() }, options, &casters);
    let sun = Light::Directional { direction: DVec3::new(0.6, -1.0, 0.25), half_angle: 0.05 };
    let mut last: Option<Vec<f32>> = None;
    let (mut largest, mut texels) = (0.0f32, Vec::new());
    for frame in 0..24 {
        let glide = DVec3::new(0.011, 0.004, 0.007) * f64::from(frame);
        rig.camera.eye = DVec3::new(0.5, 5.0, 7.0) + glide;
        rig.camera.target = DVec3::new(1.0, 0.0, 0.0) + glide;
        let plan = rig.draw(&[sun]);
        texels.push(plan.views()[0].texel_world().x);
        let visibility = rig.visibility(&points());
        assert!(visibility.contains(&0.0) && visibility.contains(&1.0), "the points cross the shadow's edge");
        if let Some(last) = &last {
            largest = last.iter().zip(&visibility).map(|(a, b)| (a - b).abs()).fold(largest, f32::max);
        }
        last = Some(visibility);
    }
    let (least, most) = texels.iter().fold((f64::INFINITY, 0.0f64), |(a, b), &t| (a.min(t), b.max(t)));
    (largest, most / least - 1.0)
}

#[test]
fn shadows_of_an_adaptive_map_stand_still_while_the_camera_moves_and_those_of_a_stretched_map_do_not() {
    let pcf = Filter::Pcf { radius_world: 0.08 };
    let (adaptive, change) = shimmer(Options { filter: pcf, ..Options::default() });
    let (stretched, _) = shimmer(fixed(pcf, 160));
    println!("largest change of visibility: {adaptive} on the lattice, {stretched} stretched");
    assert!(change < 1e-12, "the texel stays: {change}");
    // One comparison of 25, bilinear, may fall on the other side of rounding.
    assert!(adaptive < 2e-3, "{adaptive}");
    assert!(stretched > 0.05, "{stretched}");
}
