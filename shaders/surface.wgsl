// Patterns that show the quality of a surface: dark stripes that the eye follows. Where they break, the normal jumps;
// where they bend sharply, the curvature does.
//
//   reflection lines   r = 2 (n.v) n - v, the direction from which the eye gets its light; it comes from lamps in rings
//                      around the x axis:  s = asin(r.x) * 14 / pi  counts them
//   isophotes          points of equal light:  s = acos(n.l) * 16 / pi,  l the direction of the key lamp
//
// (M. Kass, A. Witkin; E. Kaufmann, R. Klass, "Smoothing surfaces using reflection lines", 1988; T. Poeschl, "Detecting
// surface irregularities using isophotes", 1984.) A stripe is dark for half of each unit of s; its sides are as soft as s
// changes from pixel to pixel, and where stripes crowd they fade into grey.

const REFLECTION_LINES = 1u;
const ISOPHOTES = 2u;
const STRIPE = 0.16; // what is left of the light in a stripe
const PI = 3.14159265;
const LAMP = vec3(-0.58, 0.52, 0.627);

// 1 in a stripe, 0 beside it.
fn stripe(s: f32, width: f32) -> f32 {
    let phase = abs(fract(s) - 0.5) * 2.0; // 0 in the middle of a stripe, 1 between two
    let soft = clamp(width * 2.0, 1e-4, 1.0);
    let sharp = 1.0 - smoothstep(0.5 - 0.5 * soft, 0.5 + 0.5 * soft, phase);
    return mix(sharp, 0.5, smoothstep(0.35, 0.9, width));
}

// What the albedo is multiplied with.
fn pattern(n: vec3<f32>, v: vec3<f32>) -> f32 {
    let r = 2.0 * dot(n, v) * n - v;
    let lamps = asin(clamp(r.x, -1.0, 1.0)) * 14.0 / PI;
    let slope = fwidth(lamps);
    let light = acos(clamp(dot(n, LAMP), -1.0, 1.0)) * 16.0 / PI;
    let light_slope = fwidth(light);
    if frame.surface == REFLECTION_LINES {
        return mix(1.0, STRIPE, stripe(lamps, slope));
    }
    if frame.surface == ISOPHOTES {
        return mix(1.0, STRIPE, stripe(light, light_slope));
    }
    return 1.0;
}
