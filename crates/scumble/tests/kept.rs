//! Casters that stand still are drawn again only when their map changes, and no picture tells the difference.

mod common;

use common::casters::{Casters, cuboid};
use common::gpu;
use common::rig::{Point, Rig, camera_above, ground_and, sun_above};
use glam::{DVec3, Vec3};
use scumble::{Camera, Error, Filter, Keep, Light, Options, Plan, Settings};

const SUN: Light = Light::Directional { direction: DVec3::new(0.3, -1.0, 0.2), half_angle: 0.05 };

fn settings() -> Settings {
    Settings { cap: 512, ..Settings::default() }
}

fn keeping(keep: Keep) -> Options {
    Options { keep, ..Options::default() }
}

fn still() -> Vec<Vec3> {
    cuboid(Vec3::new(-1.0, 0.5, -1.0), Vec3::new(0.5, 1.5, 1.0))
}

fn moving(frame: usize) -> Vec<Vec3> {
    let x = -3.0 + 0.2 * frame as f32;
    cuboid(Vec3::new(x, 0.7, 1.2), Vec3::new(x + 0.7, 1.9, 1.9))
}

fn rig(keep: Keep) -> Rig {
    Rig::new(settings(), keeping(keep), &ground_and(still()))
}

fn camera_at(frame: usize) -> Camera {
    camera_above(DVec3::new(0.004 * frame as f64, 0.0, 0.002 * frame as f64))
}

/// Points of the ground, row by row.
fn ground_points() -> Vec<Point> {
    let world = |i: u32| (f64::from(i) / 48.0 - 0.5) as f32 * 7.0;
    (0..48 * 48)
        .map(|i| {
            let pixel = [i % 48, i / 48];
            Point { position: Vec3::new(world(pixel[0]), 0.0, world(pixel[1])), normal: Vec3::Y, pixel }
        })
        .collect()
}

/// A frame whose maps `draw` records; the visibility of the ground, and the plan.
fn frame(rig: &mut Rig, draw: impl FnOnce(&mut Rig, &mut wgpu::CommandEncoder, &Plan)) -> (Vec<f32>, Plan) {
    let plan = rig.shadows.plan(&rig.camera, &rig.bounds, &[SUN]).expect("the scene can be planned");
    rig.shadows.upload(&gpu().queue, &plan);
    let mut encoder = gpu().encoder();
    draw(rig, &mut encoder, &plan);
    rig.shadows.prefilter(&mut encoder);
    gpu().finish(encoder);
    (rig.visibility(&ground_points()), plan)
}

/// Measures what the maps of the last frame show, for the plans from here on.
fn measure(rig: &mut Rig) {
    let mut encoder = gpu().encoder();
    let prepass = rig.casters.draw_prepass(gpu(), &mut encoder, &rig.camera, DVec3::ZERO, [64; 2]);
    rig.shadows.measure(&gpu().queue, &mut encoder, &prepass, &rig.camera).expect("the prepass can be measured");
    gpu().finish(encoder);
    rig.shadows.read_demand();
}

fn drawn_always(rig: &mut Rig) -> (Vec<f32>, Plan) {
    frame(rig, |rig, encoder, plan| rig.casters.draw_maps(gpu(), encoder, &mut rig.shadows, plan))
}

fn drawn_if_changed(rig: &mut Rig) -> (Vec<f32>, Plan) {
    frame(rig, |rig, encoder, plan| rig.casters.draw_static(gpu(), encoder, &mut rig.shadows, plan))
}

#[test]
fn a_walk_with_kept_maps_looks_bit_for_bit_as_one_that_draws_them_in_every_frame() {
    for (filter, frames) in [(Filter::Pcss, 24), (Filter::Vsm { radius_world: 0.2 }, 8)] {
        let options = Options { filter, ..keeping(Keep::Maps) };
        let new = || Rig::new(settings(), options.clone(), &ground_and(still()));
        let (mut always, mut kept) = (new(), new());
        for step in 0..frames {
            (always.camera, kept.camera) = (camera_at(step), camera_at(step));
            let ((expected, plan), (found, its)) = (drawn_always(&mut always), drawn_if_changed(&mut kept));
            assert_eq!(plan.views(), its.views());
            assert!(expected == found, "frame {step}");
            assert!(expected.iter().any(|&v| v < 0.5) && expected.iter().any(|&v| v > 0.5));
            measure(&mut always);
            measure(&mut kept);
        }
        let counters = kept.shadows.counters();
        println!("{filter:?}: {} of {frames} passes skipped", counters.static_passes_skipped);
        assert_eq!(counters.map_passes + counters.static_passes_skipped, frames as u64);
        assert!(counters.static_passes_skipped >= frames as u64 / 2, "{counters:?}");
        assert_eq!(always.shadows.counters().map_passes, frames as u64);
        let moments = if filter == Filter::Pcss { 0 } else { counters.map_passes };
        assert_eq!(counters.moment_passes, moments, "moments stay with their map");
    }
}

#[test]
fn a_camera_that_stands_still_keeps_maps_of_every_kind() {
    for keep in [Keep::Nothing, Keep::Maps] {
        let mut rig = rig(keep);
        (0..5).for_each(|_| drop(drawn_if_changed(&mut rig)));
        assert_eq!(
            (rig.shadows.counters().map_passes, rig.shadows.counters().static_passes_skipped),
            (1, 4),
            "{keep:?}"
        );
    }
}

#[test]
fn casters_that_changed_show_after_invalidate_and_not_before() {
    let mut rig = rig(Keep::Maps);
    let (before, _) = drawn_if_changed(&mut rig);
    rig.casters = Casters::new(gpu(), &rig.shadows, &ground_and(moving(5)));
    assert!(drawn_if_changed(&mut rig).0 == before, "the old casters stay by contract");
    rig.shadows.invalidate();
    let (after, _) = drawn_if_changed(&mut rig);
    assert!(after != before && after == drawn_always(&mut rig).0);
}

#[test]
fn what_moves_is_drawn_over_what_stands_still_and_leaves_no_trace() {
    let mut kept = Rig::new(settings(), keeping(Keep::StaticLayers), &ground_and(still()));
    let mut always = rig(Keep::Maps);
    for step in 0..12 {
        (always.camera, kept.camera) = (camera_at(step), camera_at(step));
        let mut all = ground_and(still());
        all.extend(moving(step));
        always.casters = Casters::new(gpu(), &always.shadows, &all);
        let over = Casters::new(gpu(), &kept.shadows, &moving(step));
        let (expected, _) = drawn_always(&mut always);
        let (found, plan) = frame(&mut kept, |rig, encoder, plan| {
            rig.casters.draw_static(gpu(), encoder, &mut rig.shadows, plan);
            over.draw_maps(gpu(), encoder, &mut rig.shadows, plan);
        });
        assert!(expected == found, "frame {step}");
        let view = &plan.views()[0];
        let depth = |rig: &Rig| gpu().read_depth(rig.shadows.map_texture(), view.layer, view.size_texels);
        assert!(depth(&always) == depth(&kept), "frame {step}");
    }
    let counters = kept.shadows.counters();
    assert!(counters.static_passes_skipped >= 6, "{counters:?}");
    assert_eq!(counters.map_passes + counters.static_passes_skipped, 24);
    assert_eq!(counters.map_bytes, 2 * always.shadows.counters().map_bytes);
    assert_eq!(counters.allocations, always.shadows.counters().allocations + 2);
}

#[test]
fn a_map_that_all_casters_were_drawn_into_holds_no_static_ones() {
    let mut rig = rig(Keep::Maps);
    drawn_if_changed(&mut rig);
    drawn_always(&mut rig);
    drawn_if_changed(&mut rig);
    assert_eq!((rig.shadows.counters().map_passes, rig.shadows.counters().static_passes_skipped), (3, 0));
}

#[test]
fn without_static_casters_for_its_view_a_layer_is_empty_under_those_that_move() {
    let mut rig = Rig::new(settings(), keeping(Keep::StaticLayers), &ground_and(still()));
    let (_, plan) = drawn_always(&mut rig);
    let view = &plan.views()[0];
    rig.casters = Casters::new(gpu(), &rig.shadows, &[Vec3::ZERO; 3]);
    drawn_always(&mut rig);
    let depth = gpu().read_depth(rig.shadows.map_texture(), view.layer, view.size_texels);
    assert!(depth.iter().all(|&depth| depth == 1.0));
}

#[test]
fn another_light_size_origin_or_layer_draws_the_map_again() {
    let mut rig = Rig::new(settings(), Options { maps: 2, ..keeping(Keep::Maps) }, &ground_and(still()));
    let passes = |rig: &mut Rig, lights: &[Light]| {
        let before = rig.shadows.counters().map_passes;
        let plan = rig.shadows.plan(&rig.camera, &rig.bounds, lights).expect("the scene can be planned");
        let mut encoder = gpu().encoder();
        rig.casters.draw_static(gpu(), &mut encoder, &mut rig.shadows, &plan);
        gpu().finish(encoder);
        rig.shadows.counters().map_passes - before
    };
    assert_eq!(passes(&mut rig, &[SUN]), 1);
    assert_eq!(passes(&mut rig, &[SUN, sun_above(0.1)]), 1, "the first light's map is there");
    assert_eq!(passes(&mut rig, &[sun_above(0.1), SUN]), 2, "both are in the other's layer");
    assert_eq!(passes(&mut rig, &[sun_above(0.1), SUN]), 0);
    let elsewhere = Options { origin_world: DVec3::X, ..rig.shadows.options().clone() };
    rig.shadows.set_options(elsewhere).expect("an origin may change");
    assert_eq!(passes(&mut rig, &[sun_above(0.1), SUN]), 2);
}

#[test]
fn on_a_page_a_map_that_another_one_was_drawn_over_is_drawn_again() {
    let settings = Settings { budget_bytes: Some(4 * 128 * 128), ..settings() };
    let options = Options { maps: 2, filter: Filter::Vsm { radius_world: 0.3 }, ..keeping(Keep::Maps) };
    let new = || Rig::new(settings.clone(), options.clone(), &ground_and(still()));
    let (mut kept, mut always) = (new(), new());
    let (low, away) = (sun_above(0.1), Light::Directional { direction: DVec3::new(0.9, -1.0, 0.0), half_angle: 0.1 });
    for lights in [&[SUN, away] as &[Light], &[SUN, away], &[low], &[low], &[SUN, away], &[away, SUN], &[SUN, away]] {
        let of = |rig: &mut Rig, keeps: bool| {
            let plan = rig.shadows.plan(&rig.camera, &rig.bounds, lights).expect("the scene can be planned");
            rig.shadows.upload(&gpu().queue, &plan);
            let mut encoder = gpu().encoder();
            match keeps {
                true => rig.casters.draw_static(gpu(), &mut encoder, &mut rig.shadows, &plan),
                false => rig.casters.draw_maps(gpu(), &mut encoder, &mut rig.shadows, &plan),
            }
            rig.shadows.prefilter(&mut encoder);
            gpu().finish(encoder);
            let both = "result.x = shadow_visibility(0u, row.a.xyz, row.b.xyz, row.c.xy);
                        result.y = shadow_visibility(1u, row.a.xyz, row.b.xyz, row.c.xy);";
            rig.evaluate(both, &ground_points())
        };
        assert!(of(&mut kept, true) == of(&mut always, false), "{lights:?}");
    }
    assert!(kept.shadows.counters().static_passes_skipped >= 3, "{:?}", kept.shadows.counters());
}

#[test]
fn layers_of_static_casters_are_there_from_the_beginning_or_not_at_all() {
    for (created, other) in [(Keep::Maps, Keep::StaticLayers), (Keep::StaticLayers, Keep::Nothing)] {
        let mut rig = rig(created);
        let refused = rig.shadows.set_options(keeping(other)).unwrap_err();
        assert!(matches!(refused, Error::LayersAllocated { .. }));
        assert!(
            refused.to_string().contains(&format!("Keep::{other:?}")) && refused.to_string().contains("at creation")
        );
    }
    rig(Keep::Nothing).shadows.set_options(keeping(Keep::Maps)).expect("boxes alone need no memory");
}
