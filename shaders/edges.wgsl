// Edges: each a rectangle in the plane of the picture, as wide as asked for in pixels, with soft sides and round ends.
//
// The ends a, b are projected after the part nearer than the near plane was cut off: for a.w < near,
//   a := mix(a, b, (near - a.w) / (b.w - a.w))
// and likewise after the part beyond the cut was cut off.
// The opacity of a pixel is that part of it which the line covers, about
//   clamp(width / 2 + 1/2 - d, 0, 1)          d its distance from the segment in pixels
// Lines are drawn as if nearer by k pixels' worth of depth, w := w (1 - k * pixel) with k more than the width, so that
// they win against the faces they bound at any zoom. (To push the faces back instead lets back faces win at outlines.)
//
// On a dense mesh lines would cover everything. Lines are about
//   s = |b - a| / (pixel * w) * max(|n.v|, 1/4)
// pixels apart (n the surface normal, v the direction to the eye: lines crowd where the surface is seen edge on), and
// become thinner and fade as s falls.

@group(0) @binding(1) var<uniform> layer: Layer;
@group(1) @binding(0) var<storage, read> corners: array<u32>; // 5 words each: position, normal, normal of a face
@group(1) @binding(1) var<storage, read> edges: array<vec2<u32>>;

const PULL = 0.5; // points
const FULL_AT = 16.0; // points between lines

struct Varying {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(linear) along: f32, // pixels from the first end
    @location(1) @interpolate(linear) across: f32, // pixels from the line
    @location(2) @interpolate(flat, either) length: f32, // pixels
    @location(3) @interpolate(flat, either) width: f32, // pixels
    @location(4) @interpolate(flat, either) color: vec4<f32>,
}

fn corner_position(i: u32) -> vec3<f32> {
    return bitcast<vec3<f32>>(vec3(corners[i * 5u], corners[i * 5u + 1u], corners[i * 5u + 2u]));
}

// Pixels between lines around an edge between two faces.
fn spacing(ends: vec2<u32>, a: vec3<f32>, b: vec3<f32>, w: f32) -> f32 {
    let n = unpack_normal(corners[ends.x * 5u + 3u]) + unpack_normal(corners[ends.y * 5u + 3u]);
    let v = frame.eye - 0.5 * (a + b);
    let facing = abs(dot(n, v)) / max(length(n) * length(v), 1e-20);
    return distance(a, b) / (frame.pixel * w) * max(facing, 0.25);
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varying {
    var out: Varying;
    out.position = vec4(2.0, 2.0, 0.5, 1.0); // outside: not drawn
    let edge = index / 6u;
    let ends = edges[edge];
    var a = corner_position(ends.x);
    var b = corner_position(ends.y);
    let over = vec2(beyond_cut(a), beyond_cut(b));
    if over.x > 0.0 && over.y > 0.0 {
        return out;
    }
    if over.x > 0.0 {
        a = mix(a, b, over.x / (over.x - over.y));
    } else if over.y > 0.0 {
        b = mix(b, a, over.y / (over.y - over.x));
    }
    var p = frame.clip_from_scene * vec4(a, 1.0);
    var q = frame.clip_from_scene * vec4(b, 1.0);
    let near = frame.near * 1.0001;
    if p.w < near && q.w < near {
        return out;
    }
    if p.w < near {
        p = mix(p, q, (near - p.w) / (q.w - p.w));
    } else if q.w < near {
        q = mix(q, p, (near - q.w) / (p.w - q.w));
    }

    let strong = edge >= layer.strong_from;
    var width = layer.strong_width;
    var color = layer.strong_line;
    if !strong {
        let apart = spacing(ends, a, b, 0.5 * (p.w + q.w)) / frame.scale;
        let room = smoothstep(layer.gone_at, FULL_AT, apart);
        let opacity = max(sqrt(room), layer.faintest);
        if opacity <= 0.0 {
            return out;
        }
        width = layer.line_width * mix(0.6, 1.0, room);
        color = layer.line;
        color.a *= opacity;
    }
    // A line thinner than a pixel is one of a pixel, fainter.
    color.a *= layer.opacity * min(width, 1.0);
    width = max(width, 1.0);

    let start = p.xy / p.w * frame.size * 0.5;
    let end = q.xy / q.w * frame.size * 0.5;
    let span = distance(start, end);
    let direction = select(vec2(1.0, 0.0), (end - start) / span, span > 1e-6);
    // Two triangles: corners 0 1 2, 2 1 3; bit 0 is the end, bit 1 the side.
    var order = array<u32, 6>(0u, 1u, 2u, 2u, 1u, 3u);
    let which = order[index % 6u];
    let at_end = (which & 1u) == 1u;
    let side = select(-1.0, 1.0, (which & 2u) == 2u);
    let reach = width * 0.5 + 1.0;
    let along = select(-reach, span + reach, at_end);
    let at = start + direction * along + vec2(-direction.y, direction.x) * side * reach;
    let depth = depth_nearer(select(p, q, at_end), 1.5 * width + PULL * frame.scale);

    out.position = to_tile(vec4(at / (frame.size * 0.5), depth, 1.0));
    out.along = along;
    out.across = side * reach;
    out.length = span;
    out.width = width;
    out.color = color;
    return out;
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    let beyond = max(max(-in.along, in.along - in.length), 0.0);
    let d = length(vec2(beyond, in.across));
    let cover = clamp(in.width * 0.5 + 0.5 - d, 0.0, 1.0);
    return output(vec4(in.color.rgb, in.color.a * cover));
}
