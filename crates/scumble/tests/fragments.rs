//! The demand from a renderer's own fragment shaders is that of the prepass, and the picture is the same.

mod common;

use common::casters::cuboid;
use common::rig::{Rig, camera_above, fixed, ground_and, slab, sun_above};
use glam::{DVec3, Vec3};
use scumble::{Camera, Error, Filter, FragmentDemand, Light, Settings, Statistic, fragments_wgsl, shadow_wgsl};
use wgpu::util::DeviceExt;

/// Pixels across and down.
const SIDE: u32 = 192;

/// Draws world positions; colour is the difference of the two functions.
const SHADER: &str = "
    struct Frame { clip_from_world: mat4x4f, eye: vec3f, pixel_at_unit_distance: f32, forward: vec3f }
    @group(2) @binding(0) var<uniform> frame: Frame;
    struct Fragment { @builtin(position) clip: vec4f, @location(0) position: vec3f }
    @vertex fn place(@location(0) position: vec3f) -> Fragment {
        return Fragment(frame.clip_from_world * vec4f(position, 1.0), position);
    }
    @fragment fn shade(fragment: Fragment) -> @location(0) vec4f {
        let normal = normalize(cross(dpdy(fragment.position), dpdx(fragment.position)));
        let pixel = dot(fragment.position - frame.eye, frame.forward) * frame.pixel_at_unit_distance;
        let measured =
            shadow_visibility_measured(0u, fragment.position, normal, fragment.clip.xy, pixel);
        let plain = shadow_visibility(0u, fragment.position, normal, fragment.clip.xy);
        return vec4f(abs(measured - plain), measured, 0.0, 1.0);
    }";

#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Frame {
    clip_from_world: [[f32; 4]; 4],
    eye: [f32; 3],
    pixel_at_unit_distance: f32,
    forward: [f32; 3],
    padding: f32,
}

/// A forward renderer of one light: maps, then one pass that shades and measures. Returns the picture.
fn shade(rig: &mut Rig, demand: &mut FragmentDemand, light: Light, vertices: &[Vec3]) -> Vec<[f32; 4]> {
    rig.draw(&[light]);
    let (gpu, camera) = (rig.gpu, rig.camera);
    let uniform = Frame {
        clip_from_world: camera.clip_from_world().as_mat4().to_cols_array_2d(),
        eye: camera.eye.as_vec3().to_array(),
        pixel_at_unit_distance: (camera.height_at_unit_distance() / f64::from(SIDE)) as f32,
        forward: camera.forward().as_vec3().to_array(),
        padding: 0.0,
    };
    let uniform = gpu.buffer(&[uniform], wgpu::BufferUsages::UNIFORM);
    let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: None,
        entries: &[wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        }],
    });
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &layout,
        entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() }],
    });
    let source = [shadow_wgsl(0), fragments_wgsl(1), SHADER.to_owned()].join("\n");
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    let groups = [rig.shadows.bind_group_layout(), demand.bind_group_layout(), &layout].map(Some);
    let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: Some(&gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &groups,
            immediate_size: 0,
        })),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("place"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: 12,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Float32x3],
            })],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(rig.shadows.depth_stencil_state()),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("shade"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(wgpu::TextureFormat::Rgba32Float.into())],
        }),
        multiview_mask: None,
        cache: None,
    });
    let positions: Vec<[f32; 3]> = vertices.iter().map(|vertex| vertex.to_array()).collect();
    let positions = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::cast_slice(&positions),
        usage: wgpu::BufferUsages::VERTEX,
    });
    let target = |format| {
        gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width: SIDE, height: SIDE, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        })
    };
    let (color, depth) = (target(wgpu::TextureFormat::Rgba32Float), target(rig.shadows.format()));
    let mut encoder = gpu.encoder();
    demand.begin(&mut encoder);
    {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: None,
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &color.create_view(&wgpu::TextureViewDescriptor::default()),
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth.create_view(&wgpu::TextureViewDescriptor::default()),
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, rig.shadows.bind_group(), &[]);
        pass.set_bind_group(1, demand.bind_group(), &[]);
        pass.set_bind_group(2, &group, &[]);
        pass.set_vertex_buffer(0, positions.slice(..));
        pass.draw(0..vertices.len() as u32, 0..1);
    }
    assert!(demand.end(&mut encoder, &rig.shadows), "the ring has room");
    // Rows of 192 times 16 bytes are whole multiples of 256.
    let picture = gpu.buffer(&vec![[0.0_f32; 4]; (SIDE * SIDE) as usize], wgpu::BufferUsages::COPY_SRC);
    encoder.copy_texture_to_buffer(
        color.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &picture,
            layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(SIDE * 16), rows_per_image: None },
        },
        color.size(),
    );
    gpu.finish(encoder);
    gpu.read(&picture)
}

/// What fragments and prepass measure under the first map, and the picture.
fn both(settings: Settings, light: Light, vertices: &[Vec3], camera: Camera) -> ([Option<f64>; 2], Vec<[f32; 4]>) {
    let mut rig = Rig::new(settings, fixed(Filter::Pcss, 512), vertices);
    rig.camera = camera;
    let plan = rig.draw_and_measure(&[light], SIDE);
    let by_prepass = rig.shadows.measured_radius_world(&plan.views()[0]).expect("there is a result");
    rig.shadows.reset().expect("the settings are allowed");
    let mut demand = FragmentDemand::new(&rig.gpu.device, &rig.shadows).expect("a minimum can be measured");
    let picture = shade(&mut rig, &mut demand, light, vertices);
    assert_eq!(rig.shadows.measured_radius_world(&plan.views()[0]), None, "nothing was read yet");
    assert!(demand.read(&mut rig.shadows) && !demand.read(&mut rig.shadows), "one result has come back");
    ([rig.shadows.measured_radius_world(&plan.views()[0]).expect("there is a result"), by_prepass], picture)
}

#[test]
fn fragments_ask_for_what_the_prepass_asks_for_and_shade_alike() {
    let lamp = Light::Spot {
        position: DVec3::new(0.0, 6.0, 0.0),
        direction: DVec3::NEG_Y,
        cone_half_angle: 0.6,
        radius_world: 0.2,
    };
    let above = Camera { eye: DVec3::new(0.0, 9.0, 9.0), ..camera_above(DVec3::ZERO) };
    let mut casters = cuboid(Vec3::new(-2.5, 0.9, -2.5), Vec3::new(-1.0, 1.0, -1.0));
    casters.extend(slab(2.0, -0.3));
    for light in [sun_above(0.2), lamp] {
        for footprint_kappa in [0.0, 1.0] {
            let settings = Settings { cap: 512, footprint_kappa, ..Settings::default() };
            let ([fragments, prepass], picture) = both(settings, light, &ground_and(casters.clone()), above);
            let (fragments, prepass) = (fragments.expect("a penumbra"), prepass.expect("a penumbra"));
            assert!((fragments / prepass - 1.0).abs() < 0.01, "{light:?} {footprint_kappa}: {fragments} {prepass}");
            assert!(picture.iter().all(|pixel| pixel[0] == 0.0), "measuring does not change the picture");
            assert!(picture.iter().any(|pixel| pixel[1] > 0.2 && pixel[1] < 0.8), "there is a penumbra");
        }
    }
}

#[test]
fn fragments_without_a_penumbra_ask_for_nothing() {
    let settings = Settings { cap: 512, ..Settings::default() };
    let (found, _) = both(settings, sun_above(0.2), &ground_and(Vec::new()), camera_above(DVec3::ZERO));
    assert_eq!(found, [None, None]);
}

#[test]
fn a_quantile_is_refused_with_what_is_allowed() {
    let settings = Settings { statistic: Statistic::Quantile(0.01), cap: 64, ..Settings::default() };
    let rig = Rig::new(settings, fixed(Filter::Pcss, 64), &ground_and(Vec::new()));
    let refused = FragmentDemand::new(&rig.gpu.device, &rig.shadows).unwrap_err();
    assert!(matches!(refused, Error::FragmentStatistic(_)) && refused.to_string().contains("only Statistic::Minimum"));
}
