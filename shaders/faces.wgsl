// Faces: two-sided, in the light of a sky, a key lamp and a fill lamp that move with the eye.
//
//   color = albedo * (ambient + key * max(n.l, 0) + fill * max(n.m, 0)) + gloss * (n.h)^p + rim * (1 - n.v)^q
//   ambient = mix(ground, sky, (n.up + 1) / 2)                                    hemispheric light
//   h = normalize(l + v)                                                          Blinn's half vector
//
// n is the normal on the side that is seen, v points to the eye; all in view coordinates and linear colours. Flat
// shading takes the normal of the face from the first corner of the triangle, smooth shading interpolates those of the
// vertices. The back of a face has an albedo of its own.

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
}

@vertex
fn vertex(
    @location(0) position: vec3<f32>,
    @location(1) normal: u32,
    @location(2) face_normal: u32,
) -> Varying {
    let turn = mat3x3(frame.view_from_scene[0].xyz, frame.view_from_scene[1].xyz, frame.view_from_scene[2].xyz);
    var out: Varying;
    out.position = to_tile(frame.clip_from_scene * vec4(position, 1.0));
    out.view_position = (frame.view_from_scene * vec4(position, 1.0)).xyz;
    out.normal = turn * unpack_normal(normal);
    out.face_normal = turn * unpack_normal(face_normal);
    return out;
}

@fragment
fn fragment(in: Varying, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let v = normalize(-in.view_position);
    let outward = select(in.face_normal, in.normal, frame.smooth_shading != 0u);
    var n = normalize(select(-outward, outward, front));
    // Interpolated normals may point away from the eye near the outline: bend them back to just seen.
    n = normalize(n - min(dot(n, v), 0.0) * v);

    let albedo = select(frame.back.rgb, frame.front.rgb, front);
    let light = mix(GROUND, SKY, dot(n, UP) * 0.5 + 0.5)
        + KEY * max(dot(n, KEY_DIRECTION), 0.0)
        + FILL * max(dot(n, FILL_DIRECTION), 0.0);
    let h = normalize(KEY_DIRECTION + v);
    let gloss = GLOSS * pow(max(dot(n, h), 0.0), GLOSS_POWER);
    let rim = RIM * pow(1.0 - clamp(dot(n, v), 0.0, 1.0), RIM_POWER);
    return output(vec4(albedo * light + gloss + rim * SKY, 1.0));
}
