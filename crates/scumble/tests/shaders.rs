//! Every shader is valid in every permutation; structs and constants are the same on both sides.

use bytemuck::Zeroable;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use scumble::{
    BLOCKER_TAPS, CASCADES_MAX, FILTER_OVERRIDE, LIGHT_MAPS_MAX, LIGHTS_MAX, MAPS_MAX, PCF_TAPS, classify_wgsl,
    filter_constant, fragments_wgsl, measure_wgsl, shadow_wgsl, vsm_box_wgsl, vsm_reduce_wgsl,
};
use scumble_core::Filter;

fn parse(source: &str) -> naga::Module {
    naga::front::wgsl::parse_str(source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)))
}

fn validate(source: &str) -> (naga::Module, naga::valid::ModuleInfo) {
    let module = parse(source);
    let info = Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(&module)
        .unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)));
    (module, info)
}

/// A fragment shader that uses the one public function, as a renderer would.
fn with_use(group: u32) -> String {
    format!(
        "{}
        @fragment fn shade(@builtin(position) at: vec4f) -> @location(0) vec4f {{
            return vec4f(shadow_visibility(0u, at.xyz, vec3f(0.0, 1.0, 0.0), at.xy));
        }}",
        shadow_wgsl(group)
    )
}

fn filters() -> [(&'static str, f64); 5] {
    [
        ("none", filter_constant(&Filter::Hard)),
        ("pcf", filter_constant(&Filter::Pcf { radius_world: 1.0 })),
        ("pcss", filter_constant(&Filter::Pcss)),
        ("vsm", filter_constant(&Filter::Vsm { radius_world: 1.0 })),
        ("as uploaded", 4.0),
    ]
}

#[test]
fn every_shader_is_valid_with_every_filter() {
    let measured = [with_use(0), fragments_wgsl(1)].join("\n");
    for source in [
        with_use(0),
        with_use(3),
        measured,
        measure_wgsl(),
        scumble::CLEAR_WGSL.to_owned(),
        scumble::COPY_WGSL.to_owned(),
        classify_wgsl(),
    ] {
        let (module, info) = validate(&source);
        for (name, value) in filters() {
            let constants = if module.overrides.is_empty() {
                naga::back::PipelineConstants::default()
            } else {
                [(FILTER_OVERRIDE.to_owned(), value)].into_iter().collect()
            };
            let (fixed, _) = naga::back::pipeline_constants::process_overrides(&module, &info, None, &constants)
                .unwrap_or_else(|error| panic!("{name}: {error}"));
            Validator::new(ValidationFlags::all(), Capabilities::all())
                .validate_resolved_overrides(&fixed)
                .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(&source)));
        }
    }
}

#[test]
fn the_passes_of_moments_are_valid_along_both_axes() {
    validate(&vsm_reduce_wgsl());
    let (module, info) = validate(&vsm_box_wgsl());
    for axis in [0.0, 1.0] {
        let constants = [("box_axis".to_owned(), axis)].into_iter().collect();
        let (fixed, _) = naga::back::pipeline_constants::process_overrides(&module, &info, None, &constants)
            .unwrap_or_else(|error| panic!("{axis}: {error}"));
        Validator::new(ValidationFlags::all(), Capabilities::all())
            .validate_resolved_overrides(&fixed)
            .unwrap_or_else(|error| panic!("{axis}: {error}"));
    }
}

#[test]
fn a_wrong_shader_is_found_by_the_same_check() {
    let wrong = with_use(0).replace("shadow_visibility(0u, at.xyz", "shadow_visibility(0u, at");
    assert!(std::panic::catch_unwind(|| validate(&wrong)).is_err());
}

#[test]
fn the_bindings_move_to_the_callers_group() {
    let (module, _) = validate(&with_use(2));
    let groups: Vec<u32> = module
        .global_variables
        .iter()
        .filter_map(|(_, variable)| variable.binding.as_ref().map(|binding| binding.group))
        .collect();
    assert_eq!(groups, [2; 7]);
}

#[test]
fn all_names_carry_the_prefix() {
    let module = parse(&[shadow_wgsl(0), fragments_wgsl(1)].join("\n"));
    let functions = module.functions.iter().filter_map(|(_, f)| f.name.clone());
    let types = module.types.iter().filter_map(|(_, t)| t.name.clone());
    let constants = module.constants.iter().filter_map(|(_, c)| c.name.clone());
    let variables = module.global_variables.iter().filter_map(|(_, v)| v.name.clone());
    for name in functions.chain(types).chain(constants).chain(variables) {
        assert!(name.to_lowercase().starts_with("shadow"), "{name}");
    }
}

/// Offset and size of each member of a WGSL struct, then of the struct itself.
fn layout(module: &naga::Module, name: &str) -> (Vec<(String, u32)>, u32) {
    let members = module.types.iter().find_map(|(_, ty)| match &ty.inner {
        naga::TypeInner::Struct { members, span } if ty.name.as_deref() == Some(name) => Some((members, span)),
        _ => None,
    });
    let (members, span) = members.unwrap_or_else(|| panic!("no struct {name}"));
    let offsets = members.iter().map(|member| (member.name.clone().unwrap_or_default(), member.offset)).collect();
    (offsets, *span)
}

macro_rules! assert_same_layout {
    ($module:expr, $wgsl:literal, $rust:ty, [$($field:ident),* $(,)?]) => {{
        let (offsets, size) = layout(&$module, $wgsl);
        let rust = vec![$((stringify!($field).to_owned(), std::mem::offset_of!($rust, $field) as u32)),*];
        assert_eq!(offsets, rust, "{}", $wgsl);
        assert_eq!(size as usize, size_of::<$rust>(), "size of {}", $wgsl);
    }};
}

#[test]
fn structs_have_the_same_offsets_in_rust_and_wgsl() {
    use scumble::uniforms::{
        LightReceivers, LightUniform, LightsUniform, MapDemand, MapUniform, MeasureUniform, Measured, MomentsUniform,
        TapsUniform,
    };
    let passes = parse(&vsm_reduce_wgsl());
    assert_same_layout!(passes, "Moments", MomentsUniform, [viewport, origin, block, radius, near_over_far, padding]);
    let fragments = parse(&[shadow_wgsl(0), fragments_wgsl(1)].join("\n"));
    assert_same_layout!(
        fragments,
        "ShadowFragments",
        scumble::FragmentsStorage,
        [radius_per_footprint, radius_floor_world, minima]
    );
    let module = parse(&measure_wgsl());
    assert_same_layout!(
        module,
        "ShadowMap",
        MapUniform,
        [
            clip_from_world,
            light_from_world,
            viewport_texels,
            texel_from_plane,
            depth_near,
            depth_far,
            is_spot,
            layer,
            light_size,
            radius_world,
            radius_min_world,
            texel_world,
            bias_constant_texels,
            bias_slope_texels,
            bias_rounding_world,
            slope_max,
            has_map,
            filter_kind,
            deviation_min_texels,
            bleeding_cut,
            moment_block,
            first_bin,
            is_sphere,
            inner,
            origin_texels,
        ]
    );
    assert_same_layout!(
        module,
        "ShadowLight",
        LightUniform,
        [slice_ends, map_count, across_x, first_map, across_y, net_map, position, is_point]
    );
    assert_same_layout!(module, "ShadowLights", LightsUniform, [maps, lights, view_depth, block_px]);
    assert_same_layout!(module, "MapDemand", MapDemand, [minimum_bits, shadowed, counts]);
    assert_same_layout!(module, "LightReceivers", LightReceivers, [minima]);
    assert_same_layout!(module, "Measured", Measured, [blocks, maps, receivers]);
    assert_same_layout!(module, "ShadowTaps", TapsUniform, [pcf, blocker]);
    assert_same_layout!(
        module,
        "Measure",
        MeasureUniform,
        [
            eye,
            depth_numerator,
            ray_corner,
            depth_offset,
            ray_x,
            stride,
            ray_y,
            radius_per_footprint,
            forward,
            radius_floor_world,
            pixel_at_unit_distance,
        ]
    );
}

/// Value of a WGSL constant of type u32 or f32.
fn constant(module: &naga::Module, name: &str) -> f64 {
    let (_, constant) = module
        .constants
        .iter()
        .find(|(_, constant)| constant.name.as_deref() == Some(name))
        .unwrap_or_else(|| panic!("no constant {name}"));
    match module.global_expressions[constant.init] {
        naga::Expression::Literal(naga::Literal::U32(value)) => f64::from(value),
        naga::Expression::Literal(naga::Literal::F32(value)) => f64::from(value),
        ref other => panic!("{name} is {other:?}"),
    }
}

#[test]
fn constants_are_the_same_in_rust_and_wgsl() {
    let module = parse(&measure_wgsl());
    assert_eq!(constant(&module, "SHADOW_LIGHTS_MAX"), f64::from(LIGHTS_MAX));
    assert_eq!(constant(&module, "SHADOW_CASCADES_MAX"), f64::from(CASCADES_MAX));
    assert_eq!(constant(&module, "SHADOW_LIGHT_MAPS_MAX"), f64::from(LIGHT_MAPS_MAX));
    assert_eq!(constant(&module, "SHADOW_MAPS_MAX"), f64::from(MAPS_MAX));
    assert_eq!(constant(&module, "SHADOW_PCF_TAPS"), f64::from(PCF_TAPS));
    assert_eq!(constant(&module, "SHADOW_BLOCKER_TAPS"), f64::from(BLOCKER_TAPS));
    assert_eq!(constant(&module, "MEASURE_NOTHING"), f64::from(f32::INFINITY.to_bits()));
    assert_eq!(constant(&module, "SHADOW_NO_MAP"), f64::from(scumble::uniforms::NO_MAP));
    assert_eq!(constant(&module, "MEASURE_BANDS"), f64::from(scumble_core::Seen::BANDS));
    assert_eq!(constant(&module, "MEASURE_BINS"), f64::from(scumble_core::RadiusHistogram::BINS));
    let share = scumble::scumble_core::filter::SEARCH_SHARE as f32;
    assert_eq!(constant(&module, "SHADOW_SEARCH_SHARE"), f64::from(share));
    assert_eq!(scumble::MEASURE_NOTHING, f32::INFINITY.to_bits());
    let classify = parse(&classify_wgsl());
    let kinds = constant(&classify, "CLASSIFY_KINDS");
    assert_eq!(constant(&classify, "CLASSIFY_COUNTS"), kinds * f64::from(MAPS_MAX));
    assert_eq!(std::mem::size_of_val(&scumble::uniforms::Measured::zeroed().blocks[0]) as f64, 4.0 * kinds);
    assert_eq!(std::mem::offset_of!(scumble::uniforms::Measured, blocks), 0, "the counts are the buffer's beginning");
    let kinds = ["HARD", "PCF", "PCSS", "VSM", "UPLOADED"].map(|name| format!("SHADOW_FILTER_{name}"));
    for (name, (_, value)) in kinds.into_iter().zip(filters()) {
        assert_eq!(constant(&module, &name), value, "{name}");
    }
}
