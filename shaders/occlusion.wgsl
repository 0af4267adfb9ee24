// Ambient occlusion: how much of the sky above each pixel what is near it hides, as the depths of the picture tell.
//
// With p the point of a pixel in view coordinates, n its normal and q_i the points of pixels around it within the reach
// r, v_i = q_i - p:
//
//   A = max(0, 1 - k / N sum max(n.v_i / |v_i| - b, 0) max(1 - |v_i|^2 / r^2, 0))
//
// so that what stands steeply above the surface and is near hides most (after L. Bavoil, M. Sainz, "Multi-layer
// dual-resolution screen-space ambient occlusion", 2009). The pixels lie on a spiral that is turned differently at each
// pixel of a square of four by four, over which the next pass takes the mean. The normal is that of the pixel and those
// of its neighbours that are nearer in depth. 1 where nothing is seen.

const SAMPLES_AROUND = 20u;
const STRENGTH = 5.0; // k
const BIAS = 0.06; // b
const TURNS = 7.0; // of the spiral
const FARTHEST = 200.0; // pixels

// The place of a pixel in view coordinates; in pixels from the tile's upper left corner.
fn place(at: vec2<i32>, depth: f32) -> vec3<f32> {
    let tile = vec2<f32>(textureDimensions(depths));
    let here = ((vec2<f32>(at) + 0.5) / tile * 2.0 - 1.0) * vec2(1.0, -1.0);
    let ndc = (here - frame.tile.zw) / frame.tile.xy;
    if frame.parallel > 0.0 {
        let w = frame.clip_from_scene[3][3];
        return vec3(ndc * frame.size * 0.5 * frame.pixel * w, depth / frame.parallel);
    }
    let w = frame.near / max(depth, 1e-12);
    return vec3(ndc * frame.size * 0.5 * frame.pixel * w, -w);
}

fn depth_at(at: vec2<i32>) -> f32 {
    let last = vec2<i32>(textureDimensions(depths)) - 1;
    return textureLoad(depths, clamp(at, vec2(0), last), 0);
}

// The step to the neighbour on the side where depth changes less.
fn slope(at: vec2<i32>, p: vec3<f32>, step: vec2<i32>) -> vec3<f32> {
    let before = p - place(at - step, depth_at(at - step));
    let after = place(at + step, depth_at(at + step)) - p;
    return select(after, before, abs(before.z) < abs(after.z));
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(vec2(f32((index & 1u) * 4u), f32((index & 2u) * 2u)) - 1.0, 0.0, 1.0);
}

@fragment
fn fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = vec2<i32>(position.xy);
    let depth = depth_at(at);
    if depth <= 0.0 {
        return vec4(1.0);
    }
    let p = place(at, depth);
    // y runs down the picture in pixels and up in view coordinates.
    let n = normalize(cross(slope(at, p, vec2(1, 0)), -slope(at, p, vec2(0, 1))));
    let w = select(-p.z, frame.clip_from_scene[3][3], frame.parallel > 0.0);
    let reach = frame.reach;
    let pixels = min(reach / (frame.pixel * w), FARTHEST);
    if pixels < 2.0 {
        return vec4(1.0);
    }
    let cross_wise = at.x ^ at.y;
    let order = ((cross_wise & 1) << 3u) | ((at.y & 1) << 2u) | (cross_wise & 2) | ((at.y >> 1u) & 1); // Bayer's
    let turn = f32(order) / 16.0;
    var sum = 0.0;
    for (var i = 0u; i < SAMPLES_AROUND; i++) {
        let t = (f32(i) + 0.5) / f32(SAMPLES_AROUND);
        let angle = 6.2831853 * (t * TURNS + turn);
        let other = at + vec2<i32>(round(vec2(cos(angle), sin(angle)) * t * pixels));
        let d = depth_at(other);
        if d <= 0.0 {
            continue;
        }
        let v = place(other, d) - p;
        let far = length(v);
        let steep = dot(v, n) / max(far, 1e-6 * reach);
        sum += max(steep - BIAS, 0.0) * max(1.0 - far * far / (reach * reach), 0.0);
    }
    return vec4(max(0.0, 1.0 - sum * STRENGTH / f32(SAMPLES_AROUND)));
}
