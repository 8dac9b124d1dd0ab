//! A little forward renderer with a shadow map of a fixed size. `integrate.rs` is the same renderer with the drop-in: their
//! difference is the tutorial, `diff -u crates/scumble/examples/integrate_before.rs crates/scumble/examples/integrate.rs`.
//!
//! `cargo run -p scumble --example integrate_before -- before.png`

mod shared;

use glam::Mat4;
use scumble::Camera;
use shared::Mesh;

const FRAMES: u32 = 4;
const MAP_SIDE: u32 = 2048;

struct Renderer {
    mesh: Mesh,
    depth_only: wgpu::RenderPipeline,
    shading: wgpu::RenderPipeline,
    map: wgpu::Texture,
    shadow_group: wgpu::BindGroup,
    light_from_world: Mat4,
}

impl Renderer {
    fn new(device: &wgpu::Device) -> Result<Self, Box<dyn std::error::Error>> {
        let mesh = Mesh::new(device, &shared::vertices());
        let source = include_str!("integrate_before.wgsl");
        let depth_only = mesh.pipeline(device, source, None, false);
        let map = shared::texture(device, [MAP_SIDE; 2], wgpu::TextureFormat::Depth32Float);
        let light_from_world = shared::sun_matrix();
        let (shadow_layout, shadow_group) = shared::shadow_group(device, &map, light_from_world);
        let shading = mesh.pipeline(device, source, Some(&shadow_layout), false);
        Ok(Self { mesh, depth_only, shading, map, shadow_group, light_from_world })
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

        let mut pass = shared::begin(&mut encoder, None, &self.map);
        self.mesh.draw(device, &mut pass, &self.depth_only, self.light_from_world);
        drop(pass);

        let mut pass = shared::begin(&mut encoder, None, depth);
        self.mesh.draw(device, &mut pass, &self.depth_only, clip_from_world);
        drop(pass);

        let mut pass = shared::begin(&mut encoder, Some(color), depth);
        pass.set_bind_group(1, &self.shadow_group, &[]);
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
    shared::save(&device, &queue, &picture[0], &shared::path_argument("before.png"))
}
