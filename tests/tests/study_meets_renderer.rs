//! The study and the renderer meet: people judge the edge that the renderer draws, and the file with their answer sizes
//! its maps.

#[path = "../../crates/scumble/tests/common/mod.rs"]
mod common;

use common::rig::{Point, Rig, fixed, ground_and, slab, sun_above};
use glam::{DVec2, DVec3, Vec3};
use scumble::scumble_core::Relation;
use scumble::{Filter, Options, Settings, SizeChoice, View};
use scumble_stimuli::{Kernel, Silhouette};

/// Maps the texels of a diagonal edge onto the study's stair, where y < floor(x) + 1/2 is dark.
struct Stair {
    sign: DVec2,
    shift: f64,
}

impl Stair {
    /// Finds signs and shift near `around` so that a texel (i, j) is dark exactly when sign.x i - sign.y j exceeds a
    /// whole number.
    fn find(depths: &[f32], width: u32, around: DVec2) -> Self {
        let darkest = depths.iter().copied().fold(f32::INFINITY, f32::min);
        let is_dark = |i: u32, j: u32| depths[(j * width + i) as usize] < darkest + 0.05;
        for sign in [DVec2::new(1.0, 1.0), DVec2::new(-1.0, 1.0), DVec2::new(1.0, -1.0), DVec2::new(-1.0, -1.0)] {
            let at = |i: u32, j: u32| sign.x * (f64::from(i) + 0.5) - sign.y * (f64::from(j) + 0.5);
            let [x, y] = around.as_uvec2().to_array();
            let middle = || (y - 12..y + 12).flat_map(move |j| (x - 12..x + 12).map(move |i| (i, j)));
            let least_dark =
                middle().filter(|&(i, j)| is_dark(i, j)).map(|(i, j)| at(i, j)).fold(f64::INFINITY, f64::min);
            let most_lit =
                middle().filter(|&(i, j)| !is_dark(i, j)).map(|(i, j)| at(i, j)).fold(f64::NEG_INFINITY, f64::max);
            if least_dark == most_lit + 1.0 {
                return Self { sign, shift: most_lit };
            }
        }
        panic!("the map holds no stair");
    }

    /// A place in texels in the study's coordinates: dark from the column's top, (x - y) = shift, downwards.
    fn place(&self, texel: DVec2) -> DVec2 {
        // Texel (0, 0)'s corner stays on a whole number in both; tops of columns move to floor(x) + 1/2.
        self.sign * texel + DVec2::new(0.0, self.shift + 0.5)
    }
}

fn texel_of(view: &View, position: Vec3) -> DVec2 {
    let (uv, _) = view.fit.uv_from_world(position.as_dvec3());
    uv * DVec2::new(f64::from(view.size_texels[0]), f64::from(view.size_texels[1]))
}

#[test]
fn the_stair_that_people_judge_is_the_stair_that_the_renderer_draws() {
    let scene = ground_and(slab(2.0, std::f32::consts::FRAC_PI_4));
    let side = 180;
    let options = |radius_world| Options { fitted: false, ..fixed(Filter::Pcf { radius_world }, side) };
    let mut rig = Rig::new(Settings { cap: 512, ..Settings::default() }, options(1.0), &scene);
    let texel_world = rig.draw(&[sun_above(0.0)]).views()[0].texel_world();
    assert!((texel_world.x - texel_world.y).abs() < 1e-9, "texels are square");
    for ratio in [1.5, 2.5, 3.47] {
        rig.shadows.set_options(options(ratio * texel_world.x)).expect("the radius is allowed");
        let plan = rig.draw(&[sun_above(0.0)]);
        let view = &plan.views()[0];
        let depths = rig.gpu.read_depth(rig.shadows.map_texture(), 0, view.size_texels);
        let stair = Stair::find(&depths, view.size_texels[0], texel_of(view, Vec3::ZERO));

        // Places up to a texel or two beside the edge, each with many rotations of the kernel.
        let places: Vec<Vec3> = (0..120u32)
            .map(|i| {
                let along = (f64::from(i) * 0.569_840_291).fract() * 2.0 - 1.0;
                let across = ((f64::from(i) * 0.754_877_666).fract() * 2.0 - 1.0) * 1.3 * ratio * texel_world.x;
                let turn = glam::DQuat::from_rotation_y(std::f64::consts::FRAC_PI_4);
                (turn * DVec3::new(across, 0.0, along)).as_vec3()
            })
            .collect();
        const TURNS: usize = 128;
        let points: Vec<Point> = places
            .iter()
            .flat_map(|&position| {
                (0..TURNS as u32).map(move |k| Point { position, normal: Vec3::Y, pixel: [k * 31, k * 7 + 3] })
            })
            .collect();
        let errors: Vec<f64> = places
            .iter()
            .zip(rig.visibility(&points).chunks(TURNS))
            .map(|(&place, found)| {
                let drawn = 1.0 - found.iter().map(|&v| f64::from(v)).sum::<f64>() / TURNS as f64;
                let at = stair.place(texel_of(view, place));
                drawn - Silhouette::Stair.coverage(Kernel::Disc, ratio, at.x, at.y)
            })
            .collect();
        let largest = errors.iter().fold(0.0f64, |a, e| a.max(e.abs()));
        println!("ratio {ratio}: largest difference {largest:.4}");
        // What is left: 25 taps for a disc, four bilinear comparisons for a texel.
        assert!(largest < 0.03, "ratio {ratio}: {largest}");
    }
}

#[test]
fn a_relation_file_with_twice_the_ratio_asks_for_twice_the_texels() {
    let sizes = |relation: Relation| {
        let relation = Relation::from_json(&relation.to_json().expect("it can be written")).expect("it can be read");
        let settings = Settings { relation, cap: 4096, ..Settings::default() };
        let options =
            Options { filter: Filter::Pcf { radius_world: 0.1 }, size: SizeChoice::Adaptive, ..Options::default() };
        let rig = Rig::new(settings, options, &ground_and(slab(2.0, 0.3)));
        rig.shadows.plan(&rig.camera, &rig.bounds, &[sun_above(0.1)]).expect("it can be planned").views()[0].size_texels
    };
    let published = sizes(Relation::published());
    let twice = sizes(Relation::exact(2.0 * 3.47).expect("the ratio is allowed"));
    for (a, b) in published.iter().zip(twice) {
        // Each is rounded up to a rung of a quarter octave.
        let factor = f64::from(b) / f64::from(*a);
        assert!((1.9..2.1).contains(&factor), "{published:?} {twice:?}");
    }
}
