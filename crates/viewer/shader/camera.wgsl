// The camera as every pass of the viewer sees it; the twin of `CameraUniform` in gbuffer.rs.

struct Camera {
    clip_from_world: mat4x4f,
    world_from_clip: mat4x4f,
    eye_world: vec4f,
}

@group(0) @binding(0) var<uniform> camera: Camera;
