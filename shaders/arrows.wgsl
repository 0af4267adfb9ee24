// Arrows: each a shaft and a head in the plane of the picture, as wide as asked for in pixels.
//
// An arrow goes from its begin p to q = p + length * direction; both are projected after the part nearer than the near
// plane or beyond the cut was cut off. With d the direction from p to q in the picture and h = min(head, |q - p| / 2):
//   shaft   p .. q - h d         half as wide as asked for on either side
//   head    the triangle q, q - h d +- 0.45 h d', d' across d
// Arrows shorter than a few pixels are not drawn: they would be dots.

@group(0) @binding(1) var<uniform> layer: Layer;
@group(1) @binding(0) var<storage, read> arrows: array<f32>; // 6 words each: begin, direction

const SHORTEST = 2.5; // points

struct Varying {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(linear) across: f32, // pixels from the middle line
    @location(1) @interpolate(linear) reach: f32, // of the arrow there, in pixels
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) arrow: u32) -> Varying {
    var out: Varying;
    out.position = vec4(2.0, 2.0, 0.5, 1.0); // outside: not drawn
    let i = arrow * 6u;
    var a = vec3(arrows[i], arrows[i + 1u], arrows[i + 2u]);
    var b = a + layer.spacing * vec3(arrows[i + 3u], arrows[i + 4u], arrows[i + 5u]);
    if beyond_cut(a) > 1e-6 {
        return out;
    }
    var p = frame.clip_from_scene * vec4(a, 1.0);
    var q = frame.clip_from_scene * vec4(b, 1.0);
    if frame.parallel == 0.0 && (p.w < frame.near * 1.0001 || q.w < frame.near * 1.0001) {
        return out;
    }
    let start = p.xy / p.w * frame.size * 0.5;
    let end = q.xy / q.w * frame.size * 0.5;
    let span = distance(start, end);
    if span < SHORTEST * frame.scale {
        return out;
    }
    let along = (end - start) / span;
    let side = vec2(-along.y, along.x);
    let head = min(layer.point_size, span * 0.5);
    let half_width = layer.line_width * 0.5;
    // 0 .. 5 the shaft, 6 .. 8 the head.
    var at = end;
    var part = 1.0;
    if index < 6u {
        var order = array<u32, 6>(0u, 1u, 2u, 2u, 1u, 3u);
        let which = order[index];
        let reach = half_width + 1.0;
        let sign = select(-1.0, 1.0, (which & 2u) == 2u);
        part = select(0.0, (span - head) / span, (which & 1u) == 1u);
        at = start + along * span * part + side * sign * reach;
        out.across = sign * reach;
        out.reach = half_width;
    } else {
        let corner = index - 6u;
        if corner > 0u {
            part = (span - head) / span;
            at = end - along * head + side * select(-0.45, 0.45, corner == 1u) * head;
        }
        out.across = 0.0;
        out.reach = 1e3;
    }
    let depth = mix(depth_nearer(p, 2.0), depth_nearer(q, 2.0), part);
    out.position = to_tile(vec4(at / (frame.size * 0.5), depth, 1.0));
    return out;
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    let cover = clamp(in.reach + 0.5 - abs(in.across), 0.0, 1.0);
    return output(vec4(layer.line.rgb, layer.line.a * cover));
}
