//! A box on a ground under a soft sun, without a window: `cargo run -p scumble --example minimal -- shadow.png`.
//!
//! Shows a frame: plan, upload, the maps, shading. The size of the map comes from the light's softness and the bounds
//! alone. `integrate.rs` adds the demand that the GPU measures.

mod shared;

use scumble::{Aabb, Filter, Light, Options, Settings, Shadows, shadow_wgsl};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (device, queue) = shared::device()?;
    let camera = shared::camera();
    let vertices = shared::vertices();
    let mesh = shared::Mesh::new(&device, &vertices);

    // The drop-in, and pipelines that use it.
    let sun = Light::Directional { direction: shared::SUN, half_angle: 0.03 };
    let bounds = Aabb::from_points(vertices.iter().map(|[position, _]| position.as_dvec3()));
    let options = Options { filter: Filter::Pcf { radius_world: 0.12 }, ..Options::default() };
    let mut shadows = Shadows::with_options(&device, Settings { cap: 1024, ..Settings::default() }, options)?;
    let source = [&shadow_wgsl(1), include_str!("minimal.wgsl")].concat();
    let caster = mesh.pipeline(&device, &source, None, shadows.unclipped_depth());
    let shading = mesh.pipeline(&device, &source, Some(shadows.bind_group_layout()), false);

    // One frame: plan, upload, draw the maps, shade.
    let plan = shadows.plan(&camera, &bounds, &[sun])?;
    shadows.upload(&queue, &plan);
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    for view in plan.views() {
        println!("map of {:?} texels, ratio {:.2}", view.size_texels, view.size.c_effective);
        mesh.draw(&device, &mut shadows.begin(&mut encoder, view), &caster, view.clip_from_world);
    }
    let [color, depth] = shared::picture(&device);
    let mut pass = shared::begin(&mut encoder, Some(&color), &depth);
    pass.set_bind_group(1, shadows.bind_group(), &[]);
    mesh.draw(&device, &mut pass, &shading, camera.clip_from_world().as_mat4());
    drop(pass);
    queue.submit([encoder.finish()]);
    shared::save(&device, &queue, &color, &shared::path_argument("shadow.png"))
}
