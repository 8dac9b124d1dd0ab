//! Point lights: every point finds the map of its face, no seam shows between faces, faces that nothing seen lies in have no
//! map.

mod common;

use common::casters::{cuboid, quad};
use common::gpu;
use common::rig::{Point, Rig, camera_above, fixed, ground_and, slab};
use glam::{DVec3, Vec3};
use scumble::scumble_core::half_plane_under_disc;
use scumble::{Camera, Error, Face, Filter, Light, Options, Settings};

/// Half the side of the room that the bulb hangs in.
const HALF: f32 = 3.0;

fn settings(cap: u32) -> Settings {
    Settings { cap, ..Settings::default() }
}

fn with_faces(options: Options) -> Options {
    Options { maps: 6, ..options }
}

fn bulb(position: DVec3, radius_world: f64) -> Light {
    Light::Point { position, radius_world, reach_world: f64::INFINITY }
}

/// The six walls of a room about the origin, and boxes in it.
fn room(boxes: &[[Vec3; 2]]) -> Vec<Vec3> {
    let mut all = cuboid(Vec3::splat(-HALF), Vec3::splat(HALF));
    all.extend(boxes.iter().flat_map(|[min, max]| cuboid(*min, *max)));
    all
}

/// From far away, so that all of the room is on screen.
fn outside() -> Camera {
    Camera { eye: DVec3::new(9.0, 12.0, 20.0), far: 60.0, ..camera_above(DVec3::ZERO) }
}

/// Points of all walls, looking inwards.
fn on_walls(count: u32) -> Vec<Point> {
    (1..=count)
        .map(|i| {
            let t = f64::from(i);
            let along = |step: f64| (1.998 * f64::from(HALF) * ((t * step).fract() - 0.5)) as f32;
            let axis = i as usize % 3;
            let side = if i % 2 == 0 { HALF } else { -HALF };
            let mut position = Vec3::new(along(0.618_033_9), along(0.754_877_7), along(0.569_840_3));
            position[axis] = side;
            let mut normal = Vec3::ZERO;
            normal[axis] = -side.signum();
            Point { position, normal, pixel: [i % 331, i / 7] }
        })
        .collect()
}

/// Whether a segment meets a box grown by `margin` on all sides.
fn meets(from: DVec3, to: DVec3, [min, max]: [Vec3; 2], margin: f64) -> bool {
    let direction = to - from;
    let [a, b] = [min.as_dvec3() - margin, max.as_dvec3() + margin].map(|side| (side - from) / direction);
    a.min(b).max_element().max(0.0) <= a.max(b).min_element().min(1.0)
}

#[test]
fn every_point_is_looked_up_in_the_map_of_its_face_with_room_for_its_taps() {
    let radius_world = 0.002;
    for filter in [Filter::Hard, Filter::Pcf { radius_world }] {
        let mut rig = Rig::new(settings(512), with_faces(fixed(filter, 512)), &room(&[]));
        rig.camera = outside();
        let plan = rig.draw(&[bulb(DVec3::new(0.5, -0.3, 1.0), 0.1)]);
        let faces: Vec<Option<Face>> = plan.views().iter().map(|view| view.fit.face).collect();
        assert_eq!(faces, Face::ALL.map(Some));
        let points = on_walls(3000);
        let body = "let map = shadow_map_of(0u, row.a.xyz);
             let face = shadow_face_of(row.a.xyz - shadow_lights.lights[0].position);
             result = vec4f(f32(map), shadow_receiver(map, row.a.xyz, row.b.xyz).texel, f32(face));";
        for (point, [map, x, y, face]) in points.iter().zip(rig.evaluate(body, &points)) {
            let view = plan.view_at(0, point.position.as_dvec3()).expect("every point has a map");
            assert_eq!([map, face], [view.layer as f32; 2], "{point:?}");
            let reach = filter.fixed_radius_world().unwrap_or(0.0) / view.texel_world().max_element();
            for (at, side) in [x, y].into_iter().zip(view.size_texels) {
                let at = f64::from(at);
                assert!(at >= reach - 0.01 && at <= f64::from(side) - reach + 0.01, "{point:?} {at} of {side}");
            }
        }
    }
}

#[test]
fn one_tap_tells_dark_from_lit_on_all_six_walls() {
    let boxes = [
        [Vec3::new(-1.5, -0.4, -0.2), Vec3::new(-0.9, 0.5, 0.7)],
        [Vec3::new(0.3, 0.8, -1.0), Vec3::new(1.1, 1.2, 0.4)],
        [Vec3::new(0.6, -1.6, -2.0), Vec3::new(1.7, -0.8, -1.2)],
        [Vec3::new(-0.6, -0.6, 1.4), Vec3::new(0.4, 0.2, 1.8)],
        [Vec3::new(1.2, 0.1, 0.5), Vec3::new(1.4, 0.9, 1.1)],
    ];
    let position = DVec3::new(0.1, 0.0, 0.2);
    let mut rig = Rig::new(settings(1024), with_faces(fixed(Filter::Hard, 1024)), &room(&boxes));
    rig.camera = outside();
    let plan = rig.draw(&[bulb(position, 0.1)]);
    assert_eq!(plan.views().len(), 6);
    let points = on_walls(6000);
    let mut dark = [0; 6];
    for (point, found) in points.iter().zip(rig.visibility(&points)) {
        let end = point.position.as_dvec3();
        let is_dark = |margin| boxes.iter().any(|sides| meets(position, end, *sides, margin));
        // Two texels of the wall are 12 mm, and a box is at least a third as far away.
        if is_dark(-0.015) == is_dark(0.015) {
            assert_eq!(found, f32::from(u8::from(!is_dark(0.0))), "{point:?}");
            dark[Face::of(end - position).index() as usize] += u32::from(is_dark(0.0));
        }
    }
    assert!(dark.iter().all(|&count| count > 10), "{dark:?}");
}

/// Where the truth of a straight edge is known: ground under a half plane at `height`, whose edge is turned by `angle` about
/// the middle; `t` is the distance of the light's middle from the plane through receiver and edge, in light radii.
struct Edge {
    position: DVec3,
    height: f64,
    angle: f64,
}

impl Edge {
    /// A point of the edge, and the horizontal direction out of the half plane.
    fn line(&self) -> (DVec3, DVec3) {
        let across = DVec3::new(self.angle.cos(), 0.0, -self.angle.sin());
        (DVec3::Y * self.height, across)
    }

    /// Share of a sphere at the light that a point of the ground sees.
    fn soft(&self, radius_world: f64, p: DVec3) -> f64 {
        let (point, across) = self.line();
        let along = across.cross(DVec3::Y);
        let normal = (point - p).cross(along).normalize();
        let normal = if normal.dot(across) < 0.0 { -normal } else { normal };
        let to_light = self.position - p;
        let sine = normal.dot(to_light.normalize());
        half_plane_under_disc(to_light.length() * sine / (1.0 - sine * sine).sqrt() / radius_world)
    }

    /// Share of a cone of directions about a point, as wide as `radius_world` at the reference plane is there, in which the
    /// light's middle sees the ground.
    fn filtered(&self, radius_world: f64, near: f64, p: DVec3) -> f64 {
        let (point, across) = self.line();
        let along = across.cross(DVec3::Y);
        let normal = (point - self.position).cross(along).normalize();
        let normal = if normal.dot(across) < 0.0 { -normal } else { normal };
        let ray = p - self.position;
        let cone = radius_world / near * ray.abs().max_element() / ray.length();
        let sine = normal.dot(ray.normalize());
        half_plane_under_disc(sine / (1.0 - sine * sine).sqrt() / cone)
    }
}

/// Visibility at points of the ground, each a mean over the turns of the kernel.
fn means(rig: &Rig, places: &[DVec3]) -> Vec<f64> {
    let turns = 64;
    let turned = |p: &DVec3| {
        let position = p.as_vec3();
        (0..turns).map(move |k| Point { position, normal: Vec3::Y, pixel: [k * 13, k * 7] })
    };
    let points: Vec<Point> = places.iter().flat_map(turned).collect();
    let found = rig.visibility(&points);
    found.chunks(turns as usize).map(|all| all.iter().map(|&v| f64::from(v)).sum::<f64>() / f64::from(turns)).collect()
}

#[test]
fn no_seam_shows_where_faces_meet() {
    let radius_world = 0.15;
    let (mut jump, mut error) = ([0.0f64; 3], [0.0f64; 3]);
    // Above its scene, where the near plane is 1 m away, and between ground and ceiling, where it is at 1 % of the reach.
    for (turn, angle) in [0.3, 1.1, 2.4, 3.6, 5.2].into_iter().enumerate() {
        let ceiling =
            if turn % 2 == 0 { Vec::new() } else { cuboid(Vec3::new(-5.0, 2.4, -5.0), Vec3::new(5.0, 2.5, 5.0)) };
        // The edge crosses the borders of the face that looks down, 2 m from the middle.
        let edge = Edge { position: DVec3::new(0.2, 2.0, -0.1), height: 1.0, angle };
        let casters = slab(edge.height as f32, angle as f32).into_iter().chain(ceiling).collect();
        let mut rig = Rig::new(settings(1024), with_faces(fixed(Filter::Hard, 8)), &ground_and(casters));
        rig.camera = Camera { vertical_fov: 1.0, ..camera_above(DVec3::ZERO) };
        let light = [bulb(edge.position, radius_world)];
        let near = rig.draw(&light).views()[0].fit.depth_near;
        let pcf = Filter::Pcf { radius_world: 0.08 * near };
        let adaptive = Options { filter: pcf, ..Options::default() };
        for (case, options) in [adaptive, fixed(pcf, 900), fixed(Filter::Pcss, 1024)].into_iter().enumerate() {
            rig.shadows.set_options(with_faces(options.clone())).unwrap();
            rig.draw(&light);
            let truth = |p| match options.filter.fixed_radius_world() {
                Some(radius) => edge.filtered(radius, near, p),
                None => edge.soft(radius_world, p),
            };
            // Along the borders of the face, on both sides of each, where the shadow is partial.
            let border = |i: u32| {
                let along = 1.999 * (f64::from(i % 400) / 199.5 - 1.0);
                let at = |out: f64| {
                    let [x, z] = [[out, along], [-out, along], [along, out], [along, -out]][i as usize / 400];
                    DVec3::new(edge.position.x + x, 0.0, edge.position.z + z)
                };
                [2.0 * (1.0 - 1e-4), 2.0 * (1.0 + 1e-4)].map(at)
            };
            let places: Vec<[DVec3; 2]> =
                (0..1600).map(border).filter(|places| (0.02..0.98).contains(&truth(places[0]))).collect();
            assert!(places.len() > 12, "{angle}: {}", places.len());
            let found = means(&rig, places.as_flattened());
            for (places, found) in places.iter().zip(found.chunks(2)) {
                let faces = places.map(|p| Face::of(p - edge.position));
                assert!(faces[0] == Face::NegativeY && faces[1] != Face::NegativeY);
                jump[case] = jump[case].max((found[0] - found[1]).abs());
                for (p, found) in places.iter().zip(found) {
                    error[case] = error[case].max((found - truth(*p)).abs());
                }
            }
        }
    }
    println!("jump {jump:?}, error {error:?}");
    // Two maps differ by the residual of their texels, to each side of the truth; soft shadows besides by what they find.
    assert!(jump[0] < 0.09 && jump[1] < 0.04 && jump[2] < 0.08, "{jump:?}");
    assert!(error[0] < 0.07 && error[1] < 0.05 && error[2] < 0.09, "{error:?}");
}

#[test]
fn a_face_that_nothing_seen_lies_in_has_no_map_and_no_pass() {
    let mut rig = Rig::new(settings(256), with_faces(fixed(Filter::Hard, 64)), &ground_and(slab(1.0, 0.0)));
    // The camera sees 1 m of ground under the bulb; the slab above lies in the same face.
    rig.camera = Camera { vertical_fov: 0.08, ..camera_above(DVec3::new(1.0, 0.0, 0.0)) };
    rig.camera.eye.y = 1.5;
    let plan = rig.draw(&[bulb(DVec3::new(1.0, 2.0, 0.0), 0.1)]);
    let faces: Vec<Option<Face>> = plan.views().iter().map(|view| view.fit.face).collect();
    assert_eq!(faces, [Some(Face::NegativeY)]);
    let counters = rig.shadows.counters();
    assert_eq!((counters.map_passes, counters.texels), (1, 64 * 64));
    // What lies in another face is lit.
    let beside = Point { position: Vec3::new(-4.0, 0.0, 0.0), normal: Vec3::Y, pixel: [0, 0] };
    assert_eq!(rig.visibility(&[beside]), [1.0]);
}

#[test]
fn each_face_is_measured_by_itself_and_has_a_size_of_its_own() {
    // A plate below the bulb, and one before a wall that touches nothing: radii by similar triangles.
    let mut casters = cuboid(Vec3::new(-0.3, 0.9, -0.3), Vec3::new(0.3, 1.0, 0.3));
    casters.extend(quad([[4.0, 1.0, -1.0], [4.0, 1.7, -1.0], [4.0, 1.7, 0.5], [4.0, 1.0, 0.5]].map(Vec3::from)));
    casters.extend(quad([[4.6, 0.5, -5.0], [4.6, 4.0, -5.0], [4.6, 4.0, 5.0], [4.6, 0.5, 5.0]].map(Vec3::from)));
    let geometry_alone = Settings { footprint_kappa: 0.0, ..settings(1024) };
    let mut rig = Rig::new(geometry_alone, with_faces(fixed(Filter::Pcss, 1024)), &ground_and(casters));
    // The eye sees the ground around the bulb and the wall at x = 4.6.
    rig.camera =
        Camera { eye: DVec3::new(-6.0, 7.0, 0.0), vertical_fov: 0.9, ..camera_above(DVec3::new(2.0, 0.5, 0.0)) };
    let light = bulb(DVec3::new(0.0, 2.0, 0.0), 0.1);
    let plan = rig.draw_and_measure(&[light], 512);
    let radius_of = |face, receiver: f64, blocker: f64| {
        let view = plan.views().iter().find(|view| view.fit.face == Some(face)).expect("it has a map");
        let expected = 0.1 * (receiver - blocker) / blocker * view.fit.depth_near / receiver;
        (rig.shadows.measured_radius_world(view).flatten().expect("it has a penumbra"), expected)
    };
    for (face, receiver, blocker) in [(Face::NegativeY, 2.0, 1.0), (Face::PositiveX, 4.6, 4.0)] {
        let (found, expected) = radius_of(face, receiver, blocker);
        assert!((found / expected - 1.0).abs() < 0.05, "{face:?}: {found} for {expected}");
    }
    rig.shadows.set_options(with_faces(Options::default())).unwrap();
    let sized = rig.draw(&[light]);
    let texels: Vec<f64> = sized.views().iter().map(|view| view.texel_world().x).collect();
    assert!(texels.iter().any(|&texel| texel > 2.0 * texels[0]) || texels.iter().any(|&texel| texel < 0.5 * texels[0]));
}

#[test]
fn sizes_of_faces_come_to_rest() {
    let still = Settings { shrink_after_frames: 1, shrink_rungs: 1000, ..settings(1024) };
    let light = [bulb(DVec3::new(0.3, 2.0, 0.4), 0.2)];
    let scene = ground_and(cuboid(Vec3::new(-1.0, 0.0, -1.0), Vec3::new(-0.4, 0.8, 0.6)));
    let run = |first: Options| {
        let mut rig = Rig::new(still.clone(), with_faces(first), &scene);
        rig.draw_and_measure(&light, 128);
        rig.shadows.set_options(with_faces(Options::default())).unwrap();
        let sizes: Vec<Vec<[u32; 2]>> = (0..14)
            .map(|_| rig.draw_and_measure(&light, 128).views().iter().map(|view| view.size_texels).collect())
            .collect();
        assert!(sizes[10..].iter().all(|now| *now == sizes[13]), "{sizes:?}");
        sizes[13].clone()
    };
    assert_eq!(run(fixed(Filter::Pcss, 1024)), run(fixed(Filter::Pcss, 64)));
}

#[test]
fn lights_without_a_map_to_spare_are_refused_in_words() {
    let rig = Rig::new(settings(64), Options { maps: 5, ..fixed(Filter::Hard, 64) }, &room(&[]));
    let light = bulb(DVec3::ZERO, 0.1);
    let refused = |lights: &[Light]| rig.shadows.plan(&rig.camera, &rig.bounds, lights).unwrap_err();
    let few = refused(&[light]);
    assert!(matches!(few, Error::TooManyMaps { needed: 6, allocated: 5 }), "{few}");
    assert!(few.to_string().contains("six for a point light"));
    let many = refused(&[light; 64]);
    assert!(matches!(many, Error::TooManyLights { found: 64 }), "{many}");
    assert!(many.to_string().contains("64 lights; 4 are possible"), "{many}");
    assert!(gpu().device.limits().max_texture_array_layers >= scumble::MAPS_MAX);
}
