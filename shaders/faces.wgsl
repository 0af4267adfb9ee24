// Faces: two-sided, in the light of a sky, a key lamp and a fill lamp that move with the eye.
//
//   color = albedo * (ambient + key * max(n.l, 0) + fill * max(n.m, 0)) + gloss * (n.h)^p + rim * (1 - n.v)^q
//   ambient = mix(ground, sky, (n.up + 1) / 2)                                    hemispheric light
//   h = normalize(l + v)                                                          Blinn's half vector
//
// n is the normal on the side that is seen, v points to the eye; all in view coordinates and linear colours. Flat
// shading takes the normal of the face from the first corner of the triangle, smooth shading interpolates those of the
// vertices. The back of a face has an albedo of its own. Where vertices have colours these are the albedo, interpolated
// as light; backs are darker then.

const UP = vec3(0.0, 0.98, 0.2);
const SKY = vec3(0.40, 0.43, 0.48);
const GROUND = vec3(0.19, 0.18, 0.18);
const KEY_DIRECTION = vec3(-0.58, 0.52, 0.627);
const KEY = vec3(0.88, 0.85, 0.80);
const FILL_DIRECTION = vec3(0.78, -0.05, 0.62);
const FILL = vec3(0.10, 0.12, 0.15);
const GLOSS = 0.11;
const GLOSS_POWER = 28.0;
const RIM = 0.10;
const RIM_POWER = 4.0;

struct Varying {
    @builtin(position) position: vec4<f32>,
    @location(0) view_position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) @interpolate(flat, either) face_normal: vec3<f32>,
    @location(3) color: vec4<f32>, // linear; opacity 0 without colour
}

const BACK = 0.55; // brightness of the backs of coloured faces

fn corner(position: vec3<f32>, normal: u32, face_normal: u32, color: vec4<f32>) -> Varying {
    let turn = mat3x3(frame.view_from_scene[0].xyz, frame.view_from_scene[1].xyz, frame.view_from_scene[2].xyz);
    var out: Varying;
    out.position = to_tile(frame.clip_from_scene * vec4(position, 1.0));
    out.view_position = (frame.view_from_scene * vec4(position, 1.0)).xyz;
    out.normal = turn * unpack_normal(normal);
    out.face_normal = turn * unpack_normal(face_normal);
    out.color = color;
    return out;
}

@vertex
fn vertex(
    @location(0) position: vec3<f32>,
    @location(1) normal: u32,
    @location(2) face_normal: u32,
) -> Varying {
    return corner(position, normal, face_normal, vec4(0.0));
}

// Colours come as sRGB (IEC 61966-2-1).
@vertex
fn vertex_with_color(
    @location(0) position: vec3<f32>,
    @location(1) normal: u32,
    @location(2) face_normal: u32,
    @location(3) color: vec4<f32>,
) -> Varying {
    let curve = pow((color.rgb + 0.055) / 1.055, vec3(2.4));
    let light = select(curve, color.rgb / 12.92, color.rgb <= vec3(0.04045));
    return corner(position, normal, face_normal, vec4(light, 1.0));
}

@fragment
fn fragment(in: Varying, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let v = select(normalize(-in.view_position), vec3(0.0, 0.0, 1.0), frame.parallel > 0.0);
    let outward = select(in.face_normal, in.normal, frame.smooth_shading != 0u);
    var n = normalize(select(-outward, outward, front));
    // Interpolated normals may point away from the eye near the outline: bend them back to just seen.
    n = normalize(n - min(dot(n, v), 0.0) * v);

    let plain = select(frame.back.rgb, frame.front.rgb, front);
    let albedo = mix(plain, in.color.rgb * select(BACK, 1.0, front), in.color.a);
    let light = mix(GROUND, SKY, dot(n, UP) * 0.5 + 0.5)
        + KEY * max(dot(n, KEY_DIRECTION), 0.0)
        + FILL * max(dot(n, FILL_DIRECTION), 0.0);
    let h = normalize(KEY_DIRECTION + v);
    let gloss = GLOSS * pow(max(dot(n, h), 0.0), GLOSS_POWER);
    let rim = RIM * pow(1.0 - clamp(dot(n, v), 0.0, 1.0), RIM_POWER);
    return output(vec4(albedo * light + gloss + rim * SKY, 1.0));
}
