// Faces: two-sided, in the light of a sky, a key lamp and a fill lamp that move with the eye.
//
//   color = albedo * (ambient + key * max(n.l, 0) + fill * max(n.m, 0)) + gloss * (n.h)^p + rim * (1 - n.v)^q
//   ambient = mix(ground, sky, (n.up + 1) / 2)                                    hemispheric light
//   h = normalize(l + v)                                                          Blinn's half vector
//
// n is the normal on the side that is seen, v points to the eye; all in view coordinates and linear colours. Flat
// shading takes the normal of the face from the first corner of the triangle, smooth shading interpolates those of the
// vertices. The back of a face has an albedo of its own. Where vertices or faces have colours (tint.wgsl) these are the
// albedo; backs are darker then. Patterns that show the quality of the surface (surface.wgsl) darken the albedo.
//
// Where the surface is cut, each pixel keeps as much of it as lies on this side: with d the distance beyond the cut and
// |d'| what it changes from pixel to pixel, of 4 samples round(4 clamp(1/2 - d / |d'|, 0, 1)). The pixels next to the cut
// get a line.

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
    @location(4) number: f32,
    @location(5) @interpolate(flat, either) face_number: f32,
    @location(6) beyond: f32, // the cut
}

const BACK = 0.55; // brightness of the backs of coloured faces

const CUT_WIDTH = 1.6; // points

fn corner(position: vec3<f32>, normal: u32, face_normal: u32) -> Varying {
    let turn = mat3x3(frame.view_from_scene[0].xyz, frame.view_from_scene[1].xyz, frame.view_from_scene[2].xyz);
    var out: Varying;
    out.position = to_tile(frame.clip_from_scene * vec4(position, 1.0));
    out.view_position = (frame.view_from_scene * vec4(position, 1.0)).xyz;
    out.normal = turn * unpack_normal(normal);
    out.face_normal = turn * unpack_normal(face_normal);
    out.color = vec4(0.0);
    out.beyond = beyond_cut(position);
    return out;
}

@vertex
fn vertex(
    @location(0) position: vec3<f32>,
    @location(1) normal: u32,
    @location(2) face_normal: u32,
) -> Varying {
    return corner(position, normal, face_normal);
}

@vertex
fn vertex_with_tint(
    @location(0) position: vec3<f32>,
    @location(1) normal: u32,
    @location(2) face_normal: u32,
    @location(3) word: u32,
) -> Varying {
    var out = corner(position, normal, face_normal);
    if frame.tint == TINT_COLORS || frame.tint == TINT_VERTEX_CLASSES {
        out.color = vertex_color(word);
    } else {
        out.number = bitcast<f32>(word);
        out.face_number = out.number;
    }
    return out;
}

fn shade(in: Varying, front: bool) -> vec3<f32> {
    let v = select(normalize(-in.view_position), vec3(0.0, 0.0, 1.0), frame.parallel > 0.0);
    let outward = select(in.face_normal, in.normal, frame.smooth_shading != 0u);
    var n = normalize(select(-outward, outward, front));
    // Interpolated normals may point away from the eye near the outline: bend them back to just seen.
    n = normalize(n - min(dot(n, v), 0.0) * v);

    var color = in.color;
    if frame.tint == TINT_NUMBERS {
        color = number_color(in.number);
    } else if frame.tint == TINT_FACE_CLASSES {
        color = class_color(in.face_number);
    }
    let plain = select(frame.back.rgb, frame.front.rgb, front);
    var albedo = mix(plain, color.rgb * select(BACK, 1.0, front), color.a);
    albedo *= pattern(n, v);
    let light = mix(GROUND, SKY, dot(n, UP) * 0.5 + 0.5)
        + KEY * max(dot(n, KEY_DIRECTION), 0.0)
        + FILL * max(dot(n, FILL_DIRECTION), 0.0);
    let h = normalize(KEY_DIRECTION + v);
    let gloss = GLOSS * pow(max(dot(n, h), 0.0), GLOSS_POWER);
    let rim = RIM * pow(1.0 - clamp(dot(n, v), 0.0, 1.0), RIM_POWER);
    return albedo * light + gloss + rim * SKY;
}

@fragment
fn fragment(in: Varying, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return output(vec4(shade(in, front), 1.0));
}

struct Cut {
    @location(0) color: vec4<f32>,
    @builtin(sample_mask) samples: u32,
}

@fragment
fn fragment_with_cut(in: Varying, @builtin(front_facing) front: bool) -> Cut {
    let pixels = in.beyond / max(fwidth(in.beyond), 1e-20);
    let light = shade(in, front);
    let seen = u32(round(4.0 * clamp(0.5 - pixels, 0.0, 1.0)));
    if seen == 0u {
        discard;
    }
    let line = clamp(CUT_WIDTH * frame.scale + 0.5 + pixels, 0.0, 1.0) * frame.cut.a;
    return Cut(output(vec4(mix(light, frame.cut.rgb, line), 1.0)), (1u << seen) - 1u);
}
