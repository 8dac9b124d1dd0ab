//! What a caller can get wrong is refused in words, nothing waits, and the counts are right.

mod common;

use common::gpu;
use common::rig::{Point, Rig, fixed, ground_and, slab, sun_above};
use glam::{DVec3, Vec3};
use scumble::{Aabb, AtCap, Camera, Error, Filter, Light, MAPS_MAX, Options, Settings, Shadows, SizeChoice};

fn settings(cap: u32) -> Settings {
    Settings { cap, ..Settings::default() }
}

fn refusal(settings: Settings, options: Options) -> String {
    Shadows::with_options(&gpu().device, settings, options).expect_err("they are out of range").to_string()
}

#[test]
fn settings_out_of_range_are_refused_in_words() {
    let limit = gpu().device.limits().max_texture_dimension_2d;
    let above = refusal(settings(limit + 8), Options::default());
    assert!(above.contains(&(limit + 8).to_string()) && above.contains(&limit.to_string()), "{above}");
    assert!(refusal(settings(3), Options::default()).starts_with("cap is 3"));
    let fixed_size = Options { size: SizeChoice::Fixed([0, 64]), ..Options::default() };
    assert!(refusal(settings(128), fixed_size).contains("[0, 64]"));
    let too_wide = Options { size: SizeChoice::Fixed([129, 64]), ..Options::default() };
    assert!(refusal(settings(128), too_wide).contains("the cap, 128"));
    let maps = Options { maps: MAPS_MAX + 1, ..Options::default() };
    assert!(refusal(settings(128), maps).contains("25 maps"));
    let stride = Options { measure_stride: 0, ..Options::default() };
    assert!(refusal(settings(128), stride).contains("stride"));
    let origin = Options { origin_world: DVec3::NAN, ..Options::default() };
    assert!(refusal(settings(128), origin).contains("origin"));
    let radius = Options { filter: Filter::Pcf { radius_world: -1.0 }, ..Options::default() };
    assert!(refusal(settings(128), radius).contains("radius_world"));
}

#[test]
fn more_lights_than_maps_and_another_number_of_maps_are_refused() {
    let mut rig = Rig::new(settings(64), fixed(Filter::Hard, 64), &ground_and(slab(1.0, 0.0)));
    let lights = [sun_above(0.1); 2];
    let refused = rig.shadows.plan(&rig.camera, &rig.bounds, &lights).unwrap_err();
    assert!(matches!(refused, Error::TooManyMaps { needed: 2, allocated: 1 }));
    let changed = rig.shadows.set_options(Options { maps: 2, ..Options::default() }).unwrap_err();
    assert!(changed.to_string().contains("fixed at creation"));
}

#[test]
fn scenes_lights_and_cameras_out_of_range_are_refused_by_name_and_leave_the_plans_as_they_were() {
    let rig = Rig::new(settings(64), Options { maps: 2, ..Options::default() }, &ground_and(slab(1.0, 0.0)));
    let plan = |camera: &Camera, bounds: &Aabb, lights: &[Light]| {
        rig.shadows.plan(camera, bounds, lights).expect_err("it is out of range").to_string()
    };
    let sun = sun_above(0.1);
    let nowhere = Aabb { max: DVec3::new(1.0, f64::NAN, 1.0), ..rig.bounds };
    assert!(plan(&rig.camera, &nowhere, &[sun]).contains("NaN"), "{}", plan(&rig.camera, &nowhere, &[sun]));
    let blind = Camera { vertical_fov: 0.0, ..rig.camera };
    assert!(plan(&blind, &rig.bounds, &[sun]).contains("fov"));
    let unlit = Light::Directional { direction: DVec3::ZERO, half_angle: 0.1 };
    assert!(plan(&rig.camera, &rig.bounds, &[sun, unlit]).contains("direction"));
    let many = plan(&rig.camera, &rig.bounds, &[sun; 64]);
    assert!(many.contains("64 lights") && many.contains("4 are possible"), "{many}");
    assert_eq!(rig.shadows.plan(&rig.camera, &rig.bounds, &[sun]).expect("nothing is wrong").views().len(), 1);
}

#[test]
fn no_lights_a_scene_of_nothing_and_no_casters_are_frames_without_shadows() {
    let point = Point { position: Vec3::ZERO, normal: Vec3::Y, pixel: [0, 0] };
    let nothing = Aabb::from_points(std::iter::empty());
    for (bounds, lights) in [(None, vec![]), (Some(nothing), vec![sun_above(0.1)])] {
        let mut rig = Rig::new(settings(64), Options::default(), &ground_and(slab(1.0, 0.0)));
        rig.bounds = bounds.unwrap_or(rig.bounds);
        let plan = rig.draw_and_measure(&lights, 16);
        assert!(plan.views().is_empty() && rig.visibility(&[point]) == [1.0]);
    }
    // A pass that nothing is drawn in leaves the map empty.
    let mut rig = Rig::new(settings(64), Options::default(), &ground_and(slab(1.0, 0.0)));
    let plan = rig.shadows.plan(&rig.camera, &rig.bounds, &[sun_above(0.1)]).unwrap();
    rig.shadows.upload(&gpu().queue, &plan);
    let mut encoder = gpu().encoder();
    drop(rig.shadows.begin(&mut encoder, &plan.views()[0]));
    gpu().finish(encoder);
    assert_eq!(rig.visibility(&[point]), [1.0]);
}

#[test]
fn a_view_of_other_shadows_is_drawn_within_the_texture_that_there_is() {
    let big = Rig::new(settings(512), Options { maps: 4, ..fixed(Filter::Hard, 512) }, &ground_and(slab(1.0, 0.0)));
    let lights = [sun_above(0.1), sun_above(0.2), sun_above(0.3)];
    let plan = big.shadows.plan(&big.camera, &big.bounds, &lights).unwrap();
    let mut small = Rig::new(settings(64), fixed(Filter::Hard, 64), &ground_and(slab(1.0, 0.0)));
    let mut encoder = gpu().encoder();
    small.casters.draw_maps(gpu(), &mut encoder, &mut small.shadows, &plan);
    small.casters.draw_static(gpu(), &mut encoder, &mut small.shadows, &plan);
    gpu().finish(encoder);
}

#[test]
fn at_the_cap_narrow_shadows_are_widened_or_show_their_texels() {
    for (at_cap, is_widened) in [(AtCap::Widen, true), (AtCap::ShowTexels, false)] {
        let rig = Rig::new(Settings { at_cap, ..settings(64) }, Options::default(), &ground_and(slab(1.0, 0.0)));
        let plan = rig.shadows.plan(&rig.camera, &rig.bounds, &[sun_above(0.1)]).unwrap();
        let view = &plan.views()[0];
        assert!(view.size.capped);
        assert_eq!(view.radius_min_world > 0.0, is_widened, "{at_cap:?}");
    }
}

#[test]
fn a_prepass_that_cannot_be_read_is_refused() {
    let mut rig = Rig::new(settings(64), fixed(Filter::Pcss, 64), &ground_and(slab(1.0, 0.0)));
    rig.draw(&[sun_above(0.1)]);
    let texture = |format, usage, sample_count| {
        let texture = gpu().device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width: 16, height: 16, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage,
            view_formats: &[],
        });
        texture.create_view(&wgpu::TextureViewDescriptor::default())
    };
    let (drawn, read) = (wgpu::TextureUsages::RENDER_ATTACHMENT, wgpu::TextureUsages::TEXTURE_BINDING);
    let wrong = [
        texture(wgpu::TextureFormat::Rgba8Unorm, drawn | read, 1),
        texture(wgpu::TextureFormat::Depth32Float, drawn, 1),
        texture(wgpu::TextureFormat::Depth32Float, drawn | read, 4),
    ];
    let mut encoder = gpu().encoder();
    for prepass in wrong {
        let refused = rig.shadows.measure(&gpu().queue, &mut encoder, &prepass, &rig.camera).unwrap_err();
        assert!(refused.to_string().contains("Depth32Float"), "{refused}");
    }
    for format in [wgpu::TextureFormat::Depth24Plus, wgpu::TextureFormat::Depth24PlusStencil8] {
        let good = texture(format, drawn | read, 1);
        rig.shadows.measure(&gpu().queue, &mut encoder, &good, &rig.camera).unwrap();
        let blind = Camera { near: -1.0, ..rig.camera };
        let refused = rig.shadows.measure(&gpu().queue, &mut encoder, &good, &blind).unwrap_err();
        assert!(refused.to_string().contains("near"), "{refused}");
    }
    gpu().finish(encoder);
}

#[test]
fn reading_the_demand_never_waits_and_answers_before_the_first_result() {
    let mut rig = Rig::new(settings(64), Options::default(), &ground_and(slab(1.0, 0.0)));
    assert!(!rig.shadows.read_demand());
    let plan = rig.draw(&[sun_above(0.1)]);
    assert_eq!(rig.shadows.measured_radius_world(&plan.views()[0]), None);
    assert!(plan.views()[0].size.capped && plan.views()[0].size_texels.iter().all(|n| (53..=64).contains(n)));

    // Encoders that are never submitted give their slots back.
    for _ in 0..5 {
        let mut encoder = gpu().encoder();
        let prepass = rig.casters.draw_prepass(gpu(), &mut encoder, &rig.camera, DVec3::ZERO, [32; 2]);
        rig.shadows.measure(&gpu().queue, &mut encoder, &prepass, &rig.camera).unwrap();
        drop(encoder);
        assert!(!rig.shadows.read_demand());
    }
    assert_eq!(rig.shadows.counters().readbacks_skipped, 0);

    // A ring that nobody reads fills up; further frames go without a result.
    for _ in 0..5 {
        let mut encoder = gpu().encoder();
        let prepass = rig.casters.draw_prepass(gpu(), &mut encoder, &rig.camera, DVec3::ZERO, [32; 2]);
        rig.shadows.measure(&gpu().queue, &mut encoder, &prepass, &rig.camera).unwrap();
        gpu().finish(encoder);
    }
    assert_eq!(rig.shadows.counters().readbacks_skipped, 2);
    assert!(rig.shadows.read_demand());
    assert!(!rig.shadows.read_demand(), "older results are dropped with the newest");
    assert!(rig.shadows.measured_radius_world(&plan.views()[0]).is_some());
}

#[test]
fn planning_changes_nothing_until_it_is_uploaded() {
    let mut rig = Rig::new(
        settings(512),
        Options { filter: Filter::Pcf { radius_world: 0.3 }, ..Options::default() },
        &ground_and(slab(1.0, 0.0)),
    );
    let lights = [sun_above(0.1)];
    let planned = |rig: &Rig| rig.shadows.plan(&rig.camera, &rig.bounds, &lights).unwrap().views()[0].texel_world();
    let first = planned(&rig);
    assert!((0..40).all(|_| planned(&rig) == first));
    let soft = Options { filter: Filter::Pcf { radius_world: 2.0 }, ..rig.shadows.options().clone() };
    rig.draw(&lights);
    rig.shadows.set_options(soft).unwrap();
    // Coarser texels take 30 uploaded frames; planning alone does not count them.
    for _ in 0..100 {
        planned(&rig);
    }
    assert_eq!(rig.draw(&lights).views()[0].texel_world(), first);
    for _ in 0..30 {
        rig.draw(&lights);
    }
    assert!(rig.draw(&lights).views()[0].texel_world().x > first.x);
}

#[test]
fn the_counters_count_and_nothing_is_allocated_after_the_first_frames() {
    let mut rig = Rig::new(settings(128), fixed(Filter::Pcss, 100), &ground_and(slab(1.0, 0.0)));
    let lights = [sun_above(0.1)];
    let created = rig.shadows.counters();
    assert_eq!((created.allocations, created.map_bytes, created.map_passes), (6, 128 * 128 * 4, 0));
    let mut encoder = gpu().encoder();
    let prepass = rig.casters.draw_prepass(gpu(), &mut encoder, &rig.camera, DVec3::ZERO, [32; 2]);
    gpu().finish(encoder);
    let frame = |rig: &mut Rig| {
        rig.draw(&lights);
        let mut encoder = gpu().encoder();
        rig.shadows.measure(&gpu().queue, &mut encoder, &prepass, &rig.camera).unwrap();
        gpu().finish(encoder);
        rig.shadows.read_demand();
    };
    frame(&mut rig);
    let first = rig.shadows.counters();
    for side in [8, 64, 128, 100] {
        rig.shadows.set_options(fixed(Filter::Pcss, side)).unwrap();
        frame(&mut rig);
    }
    let last = rig.shadows.counters();
    assert_eq!(last.allocations, first.allocations, "sizes change, nothing is allocated");
    assert_eq!((last.map_passes, last.measure_passes, last.readbacks_taken), (5, 5, 5));
    assert_eq!((last.texels, last.taps_per_pixel), (100 * 100, 41));
}
