//! Every shader of the viewer is valid, as its pipeline puts its parts together.

use naga::valid::{Capabilities, ValidationFlags, Validator};

const CAMERA: &str = include_str!("../shader/camera.wgsl");
const READ: &str = include_str!("../shader/gbuffer_read.wgsl");
const MASK: &str = include_str!("../shader/mask.wgsl");
const LIGHTING: &str = include_str!("../shader/lighting.wgsl");

fn check(parts: &[&str]) {
    let source = parts.join("\n");
    let module =
        naga::front::wgsl::parse_str(&source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(&source)));
    Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .unwrap_or_else(|error| panic!("{}", error.emit_to_string(&source)));
}

#[test]
fn every_shader_is_valid() {
    check(&[CAMERA, MASK, include_str!("../shader/gbuffer.wgsl")]);
    check(&[READ, &scumble::shadow_wgsl(1), include_str!("../shader/evaluation.wgsl")]);
    check(&[CAMERA, READ, LIGHTING, include_str!("../shader/ambient.wgsl")]);
    check(&[CAMERA, READ, LIGHTING, include_str!("../shader/shading.wgsl")]);
    check(&[MASK, include_str!("../shader/caster.wgsl")]);
}
