//! A box on a ground under a soft sun, without a window: `cargo run -p scumble --example minimal -- shadow.png`.
//!
//! Shows a frame: plan, upload, the maps, shading. The size of the map comes from the light's softness and the bounds
//! alone.

use glam::{DVec3, Mat4, Vec3};
use scumble::{Aabb, Camera, Filter, Light, Options, Settings, Shadows, shadow_wgsl};
use wgpu::util::DeviceExt;

const WIDTH: u32 = 640;
const HEIGHT: u32 = 360;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "shadow.png".to_owned());
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))?;
    let descriptor = wgpu::DeviceDescriptor {
        required_features: adapter.features() & wgpu::Features::DEPTH_CLIP_CONTROL,
        ..Default::default()
    };
    let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))?;

    // The scene: a camera, a light, bounds.
    let camera = Camera {
        eye: DVec3::new(3.0, 3.5, 6.0),
        target: DVec3::new(0.3, 0.4, 0.0),
        up: DVec3::Y,
        vertical_fov: 0.6,
        aspect: f64::from(WIDTH) / f64::from(HEIGHT),
        near: 0.1,
        far: 50.0,
    };
    let sun = Light::Directional { direction: DVec3::new(0.5, -1.0, -0.4), half_angle: 0.03 };
    let vertices = scene();
    let bounds = Aabb::from_points(vertices.iter().map(|[position, _]| position.as_dvec3()));

    // The drop-in, and pipelines that use it.
    let options = Options { filter: Filter::Pcf { radius_world: 0.12 }, ..Options::default() };
    let mut shadows = Shadows::with_options(&device, Settings { cap: 1024, ..Settings::default() }, options)?;
    let mesh = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::cast_slice(&vertices),
        usage: wgpu::BufferUsages::VERTEX,
    });
    let matrices = matrix_layout(&device);
    let caster = pipeline(&device, &matrices, &shadows, false);
    let shading = pipeline(&device, &matrices, &shadows, true);

    // One frame: plan, upload, draw the maps, shade.
    let plan = shadows.plan(&camera, &bounds, &[sun])?;
    shadows.upload(&queue, &plan);
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    for view in plan.views() {
        println!("map of {:?} texels, ratio {:.2}", view.size_texels, view.size.c_effective);
        let matrix = matrix(&device, &matrices, view.clip_from_world);
        let mut pass = shadows.begin(&mut encoder, view);
        pass.set_pipeline(&caster);
        pass.set_bind_group(0, &matrix, &[]);
        pass.set_vertex_buffer(0, mesh.slice(..));
        pass.draw(0..vertices.len() as u32, 0..1);
    }
    let picture = target(&device, wgpu::TextureFormat::Rgba8UnormSrgb);
    let depth = target(&device, wgpu::TextureFormat::Depth32Float);
    {
        let matrix = matrix(&device, &matrices, camera.clip_from_world().as_mat4());
        let mut pass = begin_shading(&mut encoder, &picture, &depth);
        pass.set_pipeline(&shading);
        pass.set_bind_group(0, &matrix, &[]);
        pass.set_bind_group(1, shadows.bind_group(), &[]);
        pass.set_vertex_buffer(0, mesh.slice(..));
        pass.draw(0..vertices.len() as u32, 0..1);
    }
    let pixels = read(&device, &queue, encoder, &picture)?;
    image::save_buffer(&path, &pixels, WIDTH, HEIGHT, image::ColorType::Rgba8)?;
    println!("wrote {path}");
    Ok(())
}

/// Positions and normals of a box of 1 m on a ground of 20 m.
fn scene() -> Vec<[Vec3; 2]> {
    let side = |normal: Vec3, center: Vec3, half: f32| {
        let u = normal.any_orthonormal_vector() * half;
        let v = normal.cross(u);
        let corners = [center - u - v, center + u - v, center + u + v, center - u + v];
        [0, 1, 2, 0, 2, 3].map(|i| [corners[i], normal])
    };
    let middle = Vec3::new(0.0, 0.5, 0.0);
    let faces = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
    let cube = faces.into_iter().flat_map(|normal| side(normal, middle + 0.5 * normal, 0.5));
    side(Vec3::Y, Vec3::ZERO, 10.0).into_iter().chain(cube).collect()
}

fn matrix_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let uniform = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let entry =
        wgpu::BindGroupLayoutEntry { binding: 0, visibility: wgpu::ShaderStages::VERTEX, ty: uniform, count: None };
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries: &[entry] })
}

fn matrix(device: &wgpu::Device, layout: &wgpu::BindGroupLayout, matrix: Mat4) -> wgpu::BindGroup {
    let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::bytes_of(&matrix),
        usage: wgpu::BufferUsages::UNIFORM,
    });
    let entry = wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() };
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &[entry] })
}

/// The pipeline that draws casters into a map, or the one that shades.
fn pipeline(
    device: &wgpu::Device,
    matrices: &wgpu::BindGroupLayout,
    shadows: &Shadows,
    shades: bool,
) -> wgpu::RenderPipeline {
    let source = [&shadow_wgsl(1), include_str!("minimal.wgsl")].concat();
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    let groups = [Some(matrices), Some(shadows.bind_group_layout())];
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: if shades { &groups } else { &groups[..1] },
        immediate_size: 0,
    });
    let compilation_options = wgpu::PipelineCompilationOptions::default();
    let attributes = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3];
    let buffer = wgpu::VertexBufferLayout {
        array_stride: size_of::<[Vec3; 2]>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &attributes,
    };
    let color = [Some(wgpu::ColorTargetState::from(wgpu::TextureFormat::Rgba8UnormSrgb))];
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: compilation_options.clone(),
            buffers: &[Some(buffer)],
        },
        primitive: wgpu::PrimitiveState { unclipped_depth: !shades && shadows.unclipped_depth(), ..Default::default() },
        depth_stencil: Some(shadows.depth_stencil_state()),
        multisample: wgpu::MultisampleState::default(),
        fragment: shades.then_some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("shade"),
            compilation_options,
            targets: &color,
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn target(device: &wgpu::Device, format: wgpu::TextureFormat) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: WIDTH, height: HEIGHT, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

fn begin_shading<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    picture: &wgpu::Texture,
    depth: &wgpu::Texture,
) -> wgpu::RenderPass<'e> {
    let [picture, depth] = [picture, depth].map(|texture| texture.create_view(&wgpu::TextureViewDescriptor::default()));
    let sky = wgpu::Color { r: 0.3, g: 0.4, b: 0.6, a: 1.0 };
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: None,
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &picture,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(sky), store: wgpu::StoreOp::Store },
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &depth,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Discard }),
            stencil_ops: None,
        }),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    })
}

/// Submits, waits and returns the picture's bytes. A row of 640 pixels needs no padding to 256 bytes.
fn read(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    mut encoder: wgpu::CommandEncoder,
    picture: &wgpu::Texture,
) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(WIDTH * HEIGHT * 4),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(WIDTH * 4), rows_per_image: None };
    encoder.copy_texture_to_buffer(
        picture.as_image_copy(),
        wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
        picture.size(),
    );
    queue.submit([encoder.finish()]);
    buffer.map_async(wgpu::MapMode::Read, .., |_| ());
    device.poll(wgpu::PollType::wait_indefinitely())?;
    Ok(buffer.get_mapped_range(..)?.to_vec())
}
