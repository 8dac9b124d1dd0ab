//! A device without storage and compute, with the limits of WebGL 2: sizes come from bounds, shadows are there, and what
//! needs more says so.

mod common;

use std::path::Path;

use common::casters::Casters;
use common::rig::{Rig, camera_above, ground_and, ground_points, slab, sun_above};
use common::{Gpu, open};
use glam::DVec3;
use naga::back::glsl;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use scumble::{
    Aabb, CLEAR_WGSL, COPY_WGSL, Error, FILTER_OVERRIDE, Filter, FragmentDemand, Keep, Options, Settings, Shadows,
    filter_constant, shadow_wgsl,
};

/// Pixels a side of the picture: the 8 m of ground below `camera_above`.
const SIDE: u32 = 64;

fn settings() -> Settings {
    Settings { cap: 512, ..Settings::default() }
}

const SHADE: &str = "
    @vertex fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
        return vec4f(vec2f(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0, 0.0, 1.0);
    }
    @fragment fn shade(@builtin(position) at: vec4f) -> @location(0) vec4f {
        let plane = (at.xy / 64.0 - 0.5) * 8.0;
        let visibility = shadow_visibility(0u, vec3f(plane.x, 0.0, plane.y), vec3f(0.0, 1.0, 0.0), at.xy);
        return vec4f(visibility, 0.0, 0.0, 1.0);
    }";

/// The red of a picture that fragments shade, of 255.
fn picture(gpu: &Gpu, shadows: &Shadows) -> Vec<u8> {
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl([&shadow_wgsl(0), SHADE].join("\n").into()),
    });
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &[Some(shadows.bind_group_layout())],
        immediate_size: 0,
    });
    let format = wgpu::TextureFormat::Rgba8Unorm;
    let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("cover"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("shade"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(format.into())],
        }),
        multiview_mask: None,
        cache: None,
    });
    let size = wgpu::Extent3d { width: SIDE, height: SIDE, depth_or_array_layers: 1 };
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let target = texture.create_view(&wgpu::TextureViewDescriptor::default());
    let bytes = gpu.buffer(&vec![0u8; (SIDE * SIDE * 4) as usize], wgpu::BufferUsages::COPY_SRC);
    let mut encoder = gpu.encoder();
    {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: None,
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations::default(),
            })],
            depth_stencil_attachment: None,
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, shadows.bind_group(), &[]);
        pass.draw(0..3, 0..1);
    }
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &bytes,
            layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(SIDE * 4), rows_per_image: None },
        },
        size,
    );
    gpu.finish(encoder);
    let pixels: Vec<[u8; 4]> = gpu.read(&bytes);
    pixels.into_iter().map(|[red, ..]| red).collect()
}

#[test]
fn shadows_without_storage_and_compute_are_those_of_any_device() {
    let gpu = open(wgpu::Limits::downlevel_webgl2_defaults());
    let vertices = ground_and(slab(2.0, 0.3));
    let bounds = Aabb::from_points(vertices.iter().map(|v| v.as_dvec3()));
    for filter in [Filter::Hard, Filter::Pcf { radius_world: 0.3 }, Filter::Pcss] {
        for keep in [Keep::Nothing, Keep::StaticLayers] {
            let options = Options { filter, keep, ..Options::default() };
            let mut shadows = Shadows::with_options(&gpu.device, settings(), options.clone()).expect("nothing lacks");
            let casters = Casters::new(&gpu, &shadows, &vertices);
            let plan = shadows.plan(&camera_above(DVec3::ZERO), &bounds, &[sun_above(0.1)]).expect("it can be planned");
            shadows.upload(&gpu.queue, &plan);
            let mut encoder = gpu.encoder();
            casters.draw_static(&gpu, &mut encoder, &mut shadows, &plan);
            if keep == Keep::StaticLayers {
                drop(shadows.begin(&mut encoder, &plan.views()[0]));
            }
            gpu.finish(encoder);
            let found = picture(&gpu, &shadows);

            if keep == Keep::Nothing {
                let mut rig = Rig::new(settings(), options, &vertices);
                rig.draw(&[sun_above(0.1)]);
                for (pixel, expected) in found.iter().zip(rig.visibility(&ground_points(SIDE))) {
                    assert!((f32::from(*pixel) - 255.0 * expected).abs() <= 1.0, "{filter:?}: {pixel} {expected}");
                }
            }
            assert!(found.contains(&0) && found.contains(&255), "{filter:?} {keep:?}");
        }
    }
}

#[test]
fn what_needs_storage_or_compute_is_refused_in_words() {
    let gpu = open(wgpu::Limits::downlevel_webgl2_defaults());
    let mut shadows = Shadows::new(&gpu.device, settings()).expect("nothing lacks");
    let casters = Casters::new(&gpu, &shadows, &ground_and(slab(2.0, 0.0)));
    let mut encoder = gpu.encoder();
    let camera = camera_above(DVec3::ZERO);
    let prepass = casters.draw_prepass(&gpu, &mut encoder, &camera, DVec3::ZERO, [SIDE; 2]);
    let refused = shadows.measure(&gpu.queue, &mut encoder, &prepass, &camera).unwrap_err();
    assert!(matches!(refused, Error::NoCompute { buffers: 0, textures: 0 }));
    assert!(refused.to_string().contains("sizes come from bounds"), "{refused}");
    gpu.finish(encoder);

    let refused = FragmentDemand::new(&gpu.device, &shadows).expect_err("there is no storage");
    assert!(matches!(refused, Error::NoFragmentStorage));
    let vsm = Options { filter: Filter::Vsm { radius_world: 0.3 }, ..Options::default() };
    let refused = Shadows::with_options(&gpu.device, settings(), vsm).expect_err("there is no compute");
    assert!(matches!(refused, Error::NoMoments { found: 0 }));
}

/// A shader for WebGL 2, of one filter.
fn glsl(source: &str, entry_point: &str, shader_stage: naga::ShaderStage, filter: Option<&Filter>) -> String {
    let module = naga::front::wgsl::parse_str(source).expect("it is WGSL");
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::all());
    let info = validator.validate(&module).expect("it is valid");
    let constants = filter.map(|filter| (FILTER_OVERRIDE.to_owned(), filter_constant(filter))).into_iter().collect();
    let (module, info) = naga::back::pipeline_constants::process_overrides(&module, &info, None, &constants)
        .expect("the constant is known");
    let version = glsl::Version::Embedded { version: 300, is_webgl: true };
    let options = glsl::Options { version, ..Default::default() };
    let pipeline = glsl::PipelineOptions { shader_stage, entry_point: entry_point.into(), multiview: None };
    let mut text = String::new();
    let checks = naga::proc::BoundsCheckPolicies::default();
    glsl::Writer::new(&mut text, &module, &info, &options, &pipeline, checks)
        .and_then(|mut writer| writer.write())
        .unwrap_or_else(|error| panic!("{entry_point} {filter:?}: {error}"));
    text
}

#[test]
fn shaders_of_shadows_have_a_translation_for_webgl() {
    let shading = [&shadow_wgsl(0), SHADE].join("\n");
    for filter in [Filter::Hard, Filter::Pcf { radius_world: 1.0 }, Filter::Pcss] {
        let text = glsl(&shading, "shade", naga::ShaderStage::Fragment, Some(&filter));
        assert!(text.contains("sampler2DArrayShadow"), "maps are compared with");
    }
    glsl(CLEAR_WGSL, "clear_vertex", naga::ShaderStage::Vertex, None);
    glsl(COPY_WGSL, "copy_vertex", naga::ShaderStage::Vertex, None);
    glsl(COPY_WGSL, "copy_depth", naga::ShaderStage::Fragment, None);
}

#[test]
fn all_that_shadows_bind_fits_the_least_uniform_buffers() {
    let most = wgpu::Limits::downlevel_webgl2_defaults().max_uniform_buffer_binding_size;
    assert_eq!(most, 16 << 10);
    let sizes = [size_of::<scumble::uniforms::LightsUniform>(), size_of::<scumble::uniforms::TapsUniform>()];
    assert!(sizes.iter().all(|&size| size as u64 <= most), "{sizes:?}");
}

/// Text of all sources of a crate beside this one.
fn sources(name: &str) -> String {
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name).join("src")];
    let mut text = String::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("the sources are there") {
            let path = entry.expect("the sources can be listed").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                text += &std::fs::read_to_string(&path).expect("sources are text");
            }
        }
    }
    text
}

#[test]
fn neither_crate_asks_for_a_clock_a_file_a_thread_or_a_socket_which_a_browser_lacks() {
    for name in ["scumble", "scumble-core"] {
        let text = sources(name);
        assert!(text.contains("pub struct Settings") || text.contains("pub struct Shadows"));
        for lacking in ["time", "fs", "thread", "net", "process", "env"] {
            assert!(!text.contains(&format!("std::{lacking}")), "{name} uses std::{lacking}");
        }
    }
}
