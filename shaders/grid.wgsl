// The grid on the ground: lines in a plane of equal height, every tenth thick, and the world's axes in
// it: x and z, or y where z points up.
//
// A pixel is covered by lines of one direction about as much as
//   clamp(width / 2 + 1/2 - d / |d'|, 0, 1)      d the distance from the nearest one, |d'| its change from pixel to pixel
// and lines fade where |d'| comes near their distance, and with the distance from the middle of the grid.
// The depths of parallel lines of sight end at the mesh; what of the grid lies beyond keeps the last one.

struct Varying {
    @builtin(position) position: vec4<f32>,
    @location(0) place: vec2<f32>, // x and z, or y, in scene coordinates
    @location(1) depth: f32, // where lines of sight are parallel
}

struct Fragment {
    @location(0) color: vec4<f32>,
    @builtin(frag_depth) depth: f32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varying {
    // Two triangles: corners 0 1 2, 2 1 3 of a square.
    var order = array<u32, 6>(0u, 1u, 2u, 2u, 1u, 3u);
    let which = order[index % 6u];
    let place = (vec2(f32(which & 1u), f32(which >> 1u)) * 2.0 - 1.0) * frame.ground.z;
    let z_up = frame.ground.w > 0.0;
    let at = select(vec3(place.x, frame.ground.x, place.y), vec3(place, frame.ground.x), z_up);
    var clip = to_tile(frame.clip_from_scene * vec4(at, 1.0));
    let depth = clip.z;
    if frame.parallel > 0.0 {
        clip.z = 0.5;
    }
    return Varying(clip, place, depth);
}

// How much lines `apart` cover, counted from `from`; `change` is that of the place from pixel to pixel.
fn lines(place: vec2<f32>, change: vec2<f32>, lines_from: vec2<f32>, apart: f32, width: f32) -> f32 {
    let at = (place - lines_from) / apart;
    let d = abs(at - round(at)) * apart / max(change, vec2(1e-20));
    let cover = clamp(vec2(width * 0.5 + 0.5) - d, vec2(0.0), vec2(1.0));
    let room = 1.0 - smoothstep(vec2(0.08), vec2(0.35), change / apart);
    return max(cover.x * room.x, cover.y * room.y);
}

@fragment
fn fragment(in: Varying) -> Fragment {
    let change = fwidth(in.place);
    let fine = lines(in.place, change, frame.ground_lines.zw, frame.ground.y, frame.scale);
    let coarse = lines(in.place, change, frame.ground_lines.zw, frame.ground.y * 10.0, 1.3 * frame.scale);
    let from_axes = abs(in.place - frame.ground_lines.xy) / max(change, vec2(1e-20));
    let axes = clamp(vec2(frame.scale + 0.5) - from_axes, vec2(0.0), vec2(1.0)); // z runs where x is 0
    let fade = 1.0 - smoothstep(0.35, 1.0, length(in.place) / frame.ground.z);
    var color = vec4(frame.grid_line.rgb, frame.grid_line.a * max(fine * 0.45, coarse));
    color = mix(color, vec4(0.77, 0.16, 0.12, 1.0), axes.y);
    let second = select(vec3(0.10, 0.32, 0.80), vec3(0.05, 0.40, 0.12), frame.ground.w > 0.0);
    color = mix(color, vec4(second, 1.0), axes.x);
    let depth = select(in.position.z, clamp(in.depth, 0.0, 1.0), frame.parallel > 0.0);
    return Fragment(output(vec4(color.rgb, color.a * fade)), depth);
}
