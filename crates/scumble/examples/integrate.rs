//! A little forward renderer with the drop-in. `integrate_before.rs` is the same renderer with a shadow map of a fixed size:
//! their difference is the tutorial, `diff -u crates/scumble/examples/integrate_before.rs crates/scumble/examples/integrate.rs`.
//!
//! `cargo run -p scumble --example integrate -- after.png`

mod shared;

use scumble::{Aabb, Camera, Light, Settings, Shadows, shadow_wgsl};
use shared::Mesh;

const FRAMES: u32 = 4;
const SUN: Light = Light::Directional { direction: shared::SUN, half_angle: 0.03 };

struct Renderer {
    mesh: Mesh,
    depth_only: wgpu::RenderPipeline,
    caster: wgpu::RenderPipeline,
    shading: wgpu::RenderPipeline,
    bounds: Aabb,
    shadows: Shadows,
}

impl Renderer {
    fn new(device: &wgpu::Device) -> Result<Self, Box<dyn std::error::Error>> {
        let mesh = Mesh::new(device, &shared::vertices());
        let bounds = Aabb::from_points(shared::vertices().iter().map(|[position, _]| position.as_dvec3()));
        let shadows = Shadows::new(device, Settings { cap: 1024, ..Settings::default() })?;
        let source = [&shadow_wgsl(1), include_str!("minimal.wgsl")].concat();
        let depth_only = mesh.pipeline(device, &source, None, false);
        let caster = mesh.pipeline(device, &source, None, shadows.unclipped_depth());
        let shading = mesh.pipeline(device, &source, Some(shadows.bind_group_layout()), false);
        Ok(Self { mesh, depth_only, caster, shading, bounds, shadows })
    }

    fn frame(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        camera: &Camera,
        [color, depth]: &[wgpu::Texture; 2],
    ) -> Result<(), Box<dyn std::error::Error>> {
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let clip_from_world = camera.clip_from_world().as_mat4();

        self.shadows.read_demand();
        let plan = self.shadows.plan(camera, &self.bounds, &[SUN])?;
        self.shadows.upload(queue, &plan);
        for view in plan.views() {
            let mut pass = self.shadows.begin(&mut encoder, view);
            self.mesh.draw(device, &mut pass, &self.caster, view.clip_from_world);
        }

        let mut pass = shared::begin(&mut encoder, None, depth);
        self.mesh.draw(device, &mut pass, &self.depth_only, clip_from_world);
        drop(pass);
        self.shadows.measure(queue, &mut encoder, &depth.create_view(&Default::default()), camera)?;

        let mut pass = shared::begin(&mut encoder, Some(color), depth);
        pass.set_bind_group(1, self.shadows.bind_group(), &[]);
        self.mesh.draw(device, &mut pass, &self.shading, clip_from_world);
        drop(pass);
        queue.submit([encoder.finish()]);
        Ok(())
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (device, queue) = shared::device()?;
    let mut renderer = Renderer::new(&device)?;
    let picture = shared::picture(&device);
    for _ in 0..FRAMES {
        renderer.frame(&device, &queue, &shared::camera(), &picture)?;
    }
    shared::save(&device, &queue, &picture[0], &shared::path_argument("after.png"))
}
