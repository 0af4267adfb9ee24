// What all passes share; put in front of each of them.
//
// Scene coordinates are of the size 1. View coordinates have the eye at zero and look along -z. Depth is reversed:
// a point at distance w from the eye plane has depth near / w, 1 at the near plane and 0 at infinity. Where lines of
// sight are parallel all points have the w of the pivot, and depth grows evenly towards the eye.

struct Frame {
    view_from_scene: mat4x4<f32>,
    clip_from_scene: mat4x4<f32>,
    // Rectangle of the whole picture that is drawn now: ndc of the tile = ndc of the picture * xy + zw.
    tile: vec4<f32>,
    background_top: vec4<f32>,
    background_bottom: vec4<f32>,
    front: vec4<f32>,
    back: vec4<f32>,
    eye: vec3<f32>, // in scene coordinates
    near: f32,
    size: vec2<f32>, // of the whole picture in pixels
    pixel: f32, // length of a pixel at distance 1
    scale: f32, // pixels per point
    smooth_shading: u32,
    encode: u32, // the target does not turn light into sRGB
    parallel: f32, // depth per length where lines of sight are parallel, else 0
    surface: u32, // how the surface shows its quality, see surface.wgsl
    tint: u32, // how the words of corners are read, see tint.wgsl
    reach: f32, // of ambient occlusion, in scene coordinates
    window: vec2<f32>, // of the numbers of corners, see tint.wgsl
    // What is cut away: dot(clip.xyz, p) > clip.w in scene coordinates.
    clip: vec4<f32>,
    cut: vec4<f32>, // colour of the line along the cut
    // The plane of the grid: its height, the distance of its lines and how far it reaches, in scene coordinates; whether z
    // points up, else y.
    ground: vec4<f32>,
    // Scene coordinates x and z, or y where z points up, of the world's axes; and of a point where thick lines cross.
    ground_lines: vec4<f32>,
    grid_line: vec4<f32>,
    scale_colors: array<vec4<f32>, 32>,
}

// How the lines and points of one mesh look.
struct Layer {
    line: vec4<f32>, // colour of edges between two faces, not premultiplied
    strong_line: vec4<f32>, // colour of the other edges
    point: vec4<f32>,
    ring: vec4<f32>, // colour around points
    line_width: f32, // in pixels
    strong_width: f32,
    point_size: f32,
    spacing: f32, // mean length of edges in scene coordinates, 0 if there are none
    strong_from: u32, // edges from this on are strong
    lonely_count: u32, // vertices before this one have no edges
    opacity: f32,
    faintest: f32, // opacity of lines that crowd
    gone_at: f32, // points between lines below which they are not drawn
    dots: vec2<f32>, // points that points are large from which on they begin to be seen, and are fully
}

@group(0) @binding(0) var<uniform> frame: Frame;

// Unpacks a unit vector from the square onto which the octahedron around the unit ball was unfolded.
fn unpack_normal(word: u32) -> vec3<f32> {
    let square = unpack2x16snorm(word);
    let z = 1.0 - abs(square.x) - abs(square.y);
    let below = max(-z, 0.0);
    let xy = square + select(vec2(below), vec2(-below), square >= vec2(0.0));
    return normalize(vec3(xy, z));
}

// What to write into the target for a colour in linear light: sRGB (IEC 61966-2-1) where the target does not encode.
fn output(color: vec4<f32>) -> vec4<f32> {
    if frame.encode == 0u {
        return color;
    }
    let c = clamp(color.rgb, vec3(0.0), vec3(1.0));
    let curve = 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055;
    return vec4(select(curve, 12.92 * c, c <= vec3(0.0031308)), color.a);
}

// How far a point lies on the side that is cut away; up to 0 it is seen.
fn beyond_cut(p: vec3<f32>) -> f32 {
    return dot(frame.clip.xyz, p) - frame.clip.w;
}

// From the whole picture to the tile that is drawn now.
fn to_tile(clip: vec4<f32>) -> vec4<f32> {
    return vec4(clip.xy * frame.tile.xy + clip.w * frame.tile.zw, clip.zw);
}

// The depth of a point in clip coordinates that is drawn as if nearer by so many pixels' worth of depth.
fn depth_nearer(p: vec4<f32>, pixels: f32) -> f32 {
    if frame.parallel > 0.0 {
        return min(p.z / p.w + pixels * frame.pixel * p.w * frame.parallel, 1.0);
    }
    return min(frame.near / (p.w * max(1.0 - pixels * frame.pixel, 0.5)), 1.0);
}
