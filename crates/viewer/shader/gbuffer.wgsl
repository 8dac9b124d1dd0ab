// The receivers of a frame: one position and one geometric normal per pixel, and what the shading needs.
//
// The geometric normal is the cross product of the position's screen derivatives, turned towards the eye, so that open
// surfaces and doubled faces have the normal of the side that is seen. Derivatives are taken of the position relative
// to the eye, where f32 has more digits than in the world. Prepend camera.wgsl and mask.wgsl.

struct Vertex {
    @location(0) position_world: vec3f,
    @location(1) normal_world: vec3f,
    @location(2) linear_color: vec3f,
}

struct Surface {
    @builtin(position) clip: vec4f,
    @location(0) eye_to_surface: vec3f,
    @location(1) normal_world: vec3f,
    @location(2) linear_color: vec3f,
}

struct Receiver {
    @location(0) position: vec4f,          // world position; w = 1 where there is a surface
    @location(1) normal: vec4f,            // geometric normal, towards the eye
    @location(2) shading_normal: vec4f,    // interpolated normal, on the same side
    @location(3) color: vec4f,             // linear reflectance
}

fn surface_of(in: Vertex) -> Surface {
    var out: Surface;
    out.clip = camera.clip_from_world * vec4f(in.position_world, 1.0);
    out.eye_to_surface = in.position_world - camera.eye_world.xyz;
    out.normal_world = in.normal_world;
    out.linear_color = in.linear_color;
    return out;
}

fn receiver_of(in: Surface) -> Receiver {
    let across = cross(dpdx(in.eye_to_surface), dpdy(in.eye_to_surface));
    let interpolated = in.normal_world * inverseSqrt(max(dot(in.normal_world, in.normal_world), 1e-20));
    var normal = interpolated;
    let length_squared = dot(across, across);
    if length_squared > 1e-30 {
        normal = across * inverseSqrt(length_squared);
    }
    normal = select(normal, -normal, dot(normal, in.eye_to_surface) > 0.0);
    var out: Receiver;
    out.position = vec4f(camera.eye_world.xyz + in.eye_to_surface, 1.0);
    out.normal = vec4f(normal, 0.0);
    out.shading_normal = vec4f(select(interpolated, -interpolated, dot(interpolated, normal) < 0.0), 0.0);
    out.color = vec4f(in.linear_color, 1.0);
    return out;
}

@vertex
fn vertex(in: Vertex) -> Surface {
    return surface_of(in);
}

@fragment
fn fragment(in: Surface) -> Receiver {
    return receiver_of(in);
}

struct MaskedSurface {
    @builtin(position) clip: vec4f,
    @location(0) eye_to_surface: vec3f,
    @location(1) normal_world: vec3f,
    @location(2) linear_color: vec3f,
    @location(3) uv: vec2f,
}

@vertex
fn vertex_masked(in: Vertex, @location(3) uv: vec2f) -> MaskedSurface {
    let whole = surface_of(in);
    return MaskedSurface(whole.clip, whole.eye_to_surface, whole.normal_world, whole.linear_color, uv);
}

@fragment
fn fragment_masked(in: MaskedSurface) -> Receiver {
    let receiver = receiver_of(Surface(in.clip, in.eye_to_surface, in.normal_world, in.linear_color));
    if !is_there(in.uv) {
        discard;
    }
    return receiver;
}
