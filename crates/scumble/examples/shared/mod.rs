//! What any renderer has, so that the examples show what is theirs: a device without a window, a box on a ground, pipelines,
//! a picture in a file.

#![allow(dead_code, reason = "each example uses a part")]

use std::error::Error;

use glam::{DVec3, Mat4, Vec3};
use scumble::Camera;
use wgpu::util::DeviceExt;

const WIDTH: u32 = 640;
const HEIGHT: u32 = 360;

/// The first argument, else a name.
pub fn path_argument(name: &str) -> String {
    std::env::args().nth(1).unwrap_or_else(|| name.to_owned())
}

/// Any adapter's device; with depth clamping where there is such.
pub fn device() -> Result<(wgpu::Device, wgpu::Queue), Box<dyn Error>> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))?;
    let descriptor = wgpu::DeviceDescriptor {
        required_features: adapter.features() & wgpu::Features::DEPTH_CLIP_CONTROL,
        ..Default::default()
    };
    Ok(pollster::block_on(adapter.request_device(&descriptor))?)
}

/// Looks down on the box.
pub fn camera() -> Camera {
    Camera {
        eye: DVec3::new(3.0, 3.5, 6.0),
        target: DVec3::new(0.3, 0.4, 0.0),
        up: DVec3::Y,
        vertical_fov: 0.6,
        aspect: f64::from(WIDTH) / f64::from(HEIGHT),
        near: 0.1,
        far: 50.0,
    }
}

/// The way of the sun's light, as the shaders know it.
pub const SUN: DVec3 = DVec3::new(0.5, -1.0, -0.4);

/// Positions and normals of a box of 1 m on a ground of 20 m.
pub fn vertices() -> Vec<[Vec3; 2]> {
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

/// Triangles on the device, and the layout of the matrix that they are drawn with, group 0.
pub struct Mesh {
    buffer: wgpu::Buffer,
    count: u32,
    matrices: wgpu::BindGroupLayout,
}

impl Mesh {
    /// Uploads triangles.
    pub fn new(device: &wgpu::Device, vertices: &[[Vec3; 2]]) -> Self {
        let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents: bytemuck::cast_slice(vertices),
            usage: wgpu::BufferUsages::VERTEX,
        });
        let entry = wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::VERTEX,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        let descriptor = wgpu::BindGroupLayoutDescriptor { label: None, entries: &[entry] };
        Self { buffer, count: vertices.len() as u32, matrices: device.create_bind_group_layout(&descriptor) }
    }

    /// Draws everything under a matrix.
    pub fn draw(
        &self,
        device: &wgpu::Device,
        pass: &mut wgpu::RenderPass<'_>,
        pipeline: &wgpu::RenderPipeline,
        clip_from_world: Mat4,
    ) {
        let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents: bytemuck::bytes_of(&clip_from_world),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let entry = wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() };
        let descriptor = wgpu::BindGroupDescriptor { label: None, layout: &self.matrices, entries: &[entry] };
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &device.create_bind_group(&descriptor), &[]);
        pass.set_vertex_buffer(0, self.buffer.slice(..));
        pass.draw(0..self.count, 0..1);
    }

    /// A pipeline of `vertex` and, with a layout of group 1, `shade`; without one it writes depth alone.
    pub fn pipeline(
        &self,
        device: &wgpu::Device,
        source: &str,
        shading: Option<&wgpu::BindGroupLayout>,
        unclipped_depth: bool,
    ) -> wgpu::RenderPipeline {
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(source.into()),
        });
        let groups: Vec<_> = [Some(&self.matrices), shading].into_iter().filter(Option::is_some).collect();
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &groups,
            immediate_size: 0,
        });
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
                compilation_options: Default::default(),
                buffers: &[Some(buffer)],
            },
            primitive: wgpu::PrimitiveState { unclipped_depth, ..Default::default() },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: wgpu::TextureFormat::Depth32Float,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Less),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: shading.map(|_| wgpu::FragmentState {
                module: &module,
                entry_point: Some("shade"),
                compilation_options: Default::default(),
                targets: &color,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

/// A texture that is drawn to, read by shaders and copied from.
pub fn texture(device: &wgpu::Device, [width, height]: [u32; 2], format: wgpu::TextureFormat) -> wgpu::Texture {
    use wgpu::TextureUsages as Usage;
    device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: Usage::RENDER_ATTACHMENT | Usage::COPY_SRC | Usage::TEXTURE_BINDING,
        view_formats: &[],
    })
}

/// Colour and depth of the picture.
pub fn picture(device: &wgpu::Device) -> [wgpu::Texture; 2] {
    [wgpu::TextureFormat::Rgba8UnormSrgb, wgpu::TextureFormat::Depth32Float]
        .map(|format| texture(device, [WIDTH, HEIGHT], format))
}

/// A pass that clears depth, and colour where there is some.
pub fn begin<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    color: Option<&wgpu::Texture>,
    depth: &wgpu::Texture,
) -> wgpu::RenderPass<'e> {
    let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
    let (color, depth) = (color.map(view), view(depth));
    let sky = wgpu::Color { r: 0.3, g: 0.4, b: 0.6, a: 1.0 };
    let colors: Vec<_> = color
        .iter()
        .map(|view| {
            Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(sky), store: wgpu::StoreOp::Store },
            })
        })
        .collect();
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: None,
        color_attachments: &colors,
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &depth,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store }),
            stencil_ops: None,
        }),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    })
}

/// The sun's view of the whole ground.
pub fn sun_matrix() -> Mat4 {
    let towards_box = glam::dcamera::rh::view::look_to_mat4(-20.0 * SUN.normalize(), SUN.normalize(), DVec3::Y);
    (glam::dcamera::rh::proj::directx::orthographic(-14.0, 14.0, -14.0, 14.0, 0.1, 40.0) * towards_box).as_mat4()
}

/// A light's matrix, its map and a comparison sampler as the shader's group 1.
pub fn shadow_group(
    device: &wgpu::Device,
    map: &wgpu::Texture,
    light_from_world: Mat4,
) -> (wgpu::BindGroupLayout, wgpu::BindGroup) {
    let entry =
        |binding, ty| wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::FRAGMENT, ty, count: None };
    let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: None,
        entries: &[
            entry(
                0,
                wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
            ),
            entry(
                1,
                wgpu::BindingType::Texture {
                    sample_type: wgpu::TextureSampleType::Depth,
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
            ),
            entry(2, wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison)),
        ],
    });
    let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::bytes_of(&light_from_world),
        usage: wgpu::BufferUsages::UNIFORM,
    });
    let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
        compare: Some(wgpu::CompareFunction::LessEqual),
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    });
    let view = map.create_view(&wgpu::TextureViewDescriptor::default());
    let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &layout,
        entries: &[
            entry(0, buffer.as_entire_binding()),
            entry(1, wgpu::BindingResource::TextureView(&view)),
            entry(2, wgpu::BindingResource::Sampler(&sampler)),
        ],
    });
    (layout, group)
}

/// Copies, waits and writes the picture. A row of 640 pixels needs no padding to 256 bytes.
pub fn save(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    picture: &wgpu::Texture,
    path: &str,
) -> Result<(), Box<dyn Error>> {
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(WIDTH * HEIGHT * 4),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(WIDTH * 4), rows_per_image: None };
    let copy = wgpu::TexelCopyBufferInfo { buffer: &buffer, layout };
    encoder.copy_texture_to_buffer(picture.as_image_copy(), copy, picture.size());
    queue.submit([encoder.finish()]);
    buffer.map_async(wgpu::MapMode::Read, .., |_| ());
    device.poll(wgpu::PollType::wait_indefinitely())?;
    image::save_buffer(path, &buffer.get_mapped_range(..)?, WIDTH, HEIGHT, image::ColorType::Rgba8)?;
    println!("wrote {path}");
    Ok(())
}
