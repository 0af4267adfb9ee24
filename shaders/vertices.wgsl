// Vertices: each a disc in the plane of the picture, as large as asked for in pixels, with a ring around it.
//
// The opacity of a pixel is that part of it which the disc covers, about
//   clamp(size / 2 + 1/2 - d, 0, 1)           d its distance from the centre in pixels
// Discs are drawn as if nearer by their radius' worth of depth, so that the surface around a vertex does not cut them.
// Those beyond the cut are not drawn. On a dense mesh they shrink to 2/5 of the mean distance between vertices as it is seen, as with edges, and fade.

@group(0) @binding(1) var<uniform> layer: Layer;
@group(1) @binding(0) var<storage, read> corners: array<u32>; // 5 words each: position, normal, normal of a face

const RING = 1.0; // points
const ROOM = 0.4;

struct Varying {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(linear) offset: vec2<f32>, // pixels from the centre
    @location(1) @interpolate(flat, either) radius: f32, // pixels
    @location(2) @interpolate(flat, either) opacity: f32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varying {
    var out: Varying;
    out.position = vec4(2.0, 2.0, 0.5, 1.0); // outside: not drawn
    let i = index / 6u;
    let position = bitcast<vec3<f32>>(vec3(corners[i * 5u], corners[i * 5u + 1u], corners[i * 5u + 2u]));
    let p = frame.clip_from_scene * vec4(position, 1.0);
    if p.w < frame.near || beyond_cut(position) > 1e-6 {
        return out;
    }
    var size = layer.point_size;
    if layer.spacing > 0.0 && i >= layer.lonely_count {
        let n = unpack_normal(corners[i * 5u + 3u]);
        let facing = abs(dot(n, normalize(frame.eye - position)));
        size = min(size, ROOM * layer.spacing * max(facing, 0.35) / (frame.pixel * p.w));
    }
    let opacity = smoothstep(layer.dots.x, layer.dots.y, size / frame.scale) * layer.opacity;
    if opacity <= 0.0 {
        return out;
    }
    size = max(size, 1.0);
    // Two triangles: corners 0 1 2, 2 1 3 of a square.
    var order = array<u32, 6>(0u, 1u, 2u, 2u, 1u, 3u);
    let which = order[index % 6u];
    let corner = vec2(f32(which & 1u), f32(which >> 1u)) * 2.0 - 1.0;
    let offset = corner * (size * 0.5 + 1.0);
    let depth = depth_nearer(p, size * 0.5 + 1.0);
    out.position = to_tile(vec4(p.xy / p.w + offset / (frame.size * 0.5), depth, 1.0));
    out.offset = offset;
    out.radius = size * 0.5;
    out.opacity = opacity;
    return out;
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    let d = length(in.offset);
    let cover = clamp(in.radius + 0.5 - d, 0.0, 1.0);
    // Small discs have no ring.
    let ring = min(RING * frame.scale, in.radius * 0.4) * smoothstep(1.5, 2.5, in.radius / frame.scale);
    let inside = clamp(in.radius - ring + 0.5 - d, 0.0, 1.0);
    let color = mix(layer.ring, layer.point, select(1.0, inside, ring > 0.0));
    return output(vec4(color.rgb, color.a * cover * in.opacity));
}
