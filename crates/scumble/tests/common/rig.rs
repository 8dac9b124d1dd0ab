//! A scene with its shadows on the GPU, and visibility asked point by point.

use glam::{DVec3, Vec3};
use scumble::{Aabb, Camera, Filter, Light, Options, Plan, Settings, Shadows, SizeChoice, shadow_wgsl};

use super::casters::Casters;
use super::{Gpu, gpu};

/// One point to ask for.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    pub position: Vec3,
    pub normal: Vec3,
    pub pixel: [u32; 2],
}

pub struct Rig {
    pub gpu: &'static Gpu,
    pub shadows: Shadows,
    pub casters: Casters,
    pub bounds: Aabb,
    pub camera: Camera,
}

/// A camera that looks down on a square of 8 m around `target`.
pub fn camera_above(target: DVec3) -> Camera {
    Camera {
        eye: target + DVec3::new(0.0, 12.0, 0.001),
        target,
        up: DVec3::NEG_Z,
        vertical_fov: 2.0 * (4.0f64 / 12.0).atan(),
        aspect: 1.0,
        near: 1.0,
        far: 30.0,
    }
}

/// Parallel light straight down.
pub fn sun_above(half_angle: f64) -> Light {
    Light::Directional { direction: DVec3::NEG_Y, half_angle }
}

/// The ground's points under every pixel of a picture of `side` squared that shows the 8 m below `camera_above`, by rows.
pub fn ground_points(side: u32) -> Vec<Point> {
    let world = |i: u32| ((i as f32 + 0.5) / side as f32 - 0.5) * 8.0;
    (0..side * side)
        .map(|i| {
            let pixel = [i % side, i / side];
            Point { position: Vec3::new(world(pixel[0]), 0.0, world(pixel[1])), normal: Vec3::Y, pixel }
        })
        .collect()
}

/// Ground of 10 m at y = 0 and above it what is given.
pub fn ground_and(casters: Vec<Vec3>) -> Vec<Vec3> {
    let mut all = super::casters::quad([
        Vec3::new(-5.0, 0.0, -5.0),
        Vec3::new(5.0, 0.0, -5.0),
        Vec3::new(5.0, 0.0, 5.0),
        Vec3::new(-5.0, 0.0, 5.0),
    ]);
    all.extend(casters);
    all
}

/// A level half plane at `height`, x <= 0 before it is turned about y by `angle`.
pub fn slab(height: f32, angle: f32) -> Vec<Vec3> {
    let turn = glam::Quat::from_rotation_y(angle);
    let corners = [[-9.0, -9.0], [0.0, -9.0], [0.0, 9.0], [-9.0, 9.0]];
    super::casters::quad(corners.map(|[x, z]| turn * Vec3::new(x, 0.0, z) + Vec3::Y * height))
}

/// A filter with a fixed size, and every pixel measured.
pub fn fixed(filter: Filter, side: u32) -> Options {
    Options { filter, size: SizeChoice::Fixed([side; 2]), measure_stride: 1, ..Options::default() }
}

impl Rig {
    /// Draws nothing yet. `vertices` are relative to the origin of the options.
    pub fn new(settings: Settings, options: Options, vertices: &[Vec3]) -> Self {
        let gpu = gpu();
        let origin = options.origin_world;
        let shadows = Shadows::with_options(&gpu.device, settings, options).expect("the settings are allowed");
        let casters = Casters::new(gpu, &shadows, vertices);
        let bounds = Aabb::from_points(vertices.iter().map(|v| v.as_dvec3() + origin));
        Self { gpu, shadows, casters, bounds, camera: camera_above(origin) }
    }

    /// One frame's maps: plan, upload, draw, submit, wait.
    pub fn draw(&mut self, lights: &[Light]) -> Plan {
        let plan = self.shadows.plan(&self.camera, &self.bounds, lights).expect("the scene can be planned");
        self.shadows.upload(&self.gpu.queue, &plan);
        let mut encoder = self.gpu.encoder();
        self.casters.draw_maps(self.gpu, &mut encoder, &mut self.shadows, &plan);
        self.gpu.finish(encoder);
        plan
    }

    /// A frame with its demand measured and read, over a prepass of `side` squared pixels.
    pub fn draw_and_measure(&mut self, lights: &[Light], side: u32) -> Plan {
        let plan = self.draw(lights);
        let mut encoder = self.gpu.encoder();
        let origin = self.shadows.options().origin_world;
        let prepass = self.casters.draw_prepass(self.gpu, &mut encoder, &self.camera, origin, [side; 2]);
        self.shadows
            .measure(&self.gpu.queue, &mut encoder, &prepass, &self.camera)
            .expect("the prepass can be measured");
        self.gpu.finish(encoder);
        self.shadows.read_demand();
        plan
    }

    /// Runs WGSL once a point: `row.a` position, `row.b` normal, `row.c` pixel.
    pub fn evaluate(&self, body: &str, points: &[Point]) -> Vec<[f32; 4]> {
        let rows: Vec<[[f32; 4]; 4]> = points
            .iter()
            .map(|point| {
                let pixel = [point.pixel[0] as f32 + 0.5, point.pixel[1] as f32 + 0.5, 0.0, 0.0];
                [point.position.extend(1.0).to_array(), point.normal.extend(0.0).to_array(), pixel, [0.0; 4]]
            })
            .collect();
        self.gpu.evaluate(
            &shadow_wgsl(0),
            body,
            Some((self.shadows.bind_group_layout(), self.shadows.bind_group())),
            &rows,
        )
    }

    /// `shadow_visibility` of the first light at each point.
    pub fn visibility(&self, points: &[Point]) -> Vec<f32> {
        let results = self.evaluate("result.x = shadow_visibility(0u, row.a.xyz, row.b.xyz, row.c.xy);", points);
        results.into_iter().map(|result| result[0]).collect()
    }
}
