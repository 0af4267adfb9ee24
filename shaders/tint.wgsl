// Colours of numbers: a word for each corner, looked up in a scale of 32 colours.
//
//   number x    mix of the two colours next to 31 clamp((x - shift) factor, 0, 1)       window = (shift, factor)
//   class i     colour i of the scale
//   colour      red, green, blue as bytes, sRGB (IEC 61966-2-1)
//
// Numbers are interpolated over a triangle and then looked up, so that the bands of the scale are true everywhere;
// classes of vertices, between which nothing lies, are interpolated as light. Numbers far below zero stand for none.

const TINT_COLORS = 1u;
const TINT_NUMBERS = 2u;
const TINT_VERTEX_CLASSES = 3u;
const TINT_FACE_CLASSES = 4u;

const SAMPLES = 32u;
const NO_NUMBER = vec4(0.25, 0.25, 0.25, 1.0);

fn is_none(x: f32) -> bool {
    return x < -1e30;
}

fn number_color(x: f32) -> vec4<f32> {
    if is_none(x) {
        return NO_NUMBER;
    }
    let at = clamp((x - frame.window.x) * frame.window.y, 0.0, 1.0) * f32(SAMPLES - 1u);
    let i = min(u32(at), SAMPLES - 2u);
    return mix(frame.scale_colors[i], frame.scale_colors[i + 1u], at - f32(i));
}

fn class_color(x: f32) -> vec4<f32> {
    if is_none(x) {
        return NO_NUMBER;
    }
    return frame.scale_colors[min(u32(round(x)), SAMPLES - 1u)];
}

fn vertex_color(word: u32) -> vec4<f32> {
    if frame.tint == TINT_VERTEX_CLASSES {
        return class_color(bitcast<f32>(word));
    }
    let color = unpack4x8unorm(word).rgb;
    let curve = pow((color + 0.055) / 1.055, vec3(2.4));
    return vec4(select(curve, color / 12.92, color <= vec3(0.04045)), 1.0);
}
