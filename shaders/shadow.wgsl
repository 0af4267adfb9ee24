// The picture times its ambient occlusion, the mean over the four by four pixels around each that are about as deep:
//
//   A = sum w_i A_i / sum w_i      w_i = 1 where |z_i - z| is less than half the reach, else 0

@group(1) @binding(1) var occlusion: texture_2d<f32>;

fn distance_at(at: vec2<i32>) -> f32 {
    let last = vec2<i32>(textureDimensions(depths)) - 1;
    let depth = textureLoad(depths, clamp(at, vec2(0), last), 0);
    return select(frame.near / max(depth, 1e-12), -depth / frame.parallel, frame.parallel > 0.0);
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(vec2(f32((index & 1u) * 4u), f32((index & 2u) * 2u)) - 1.0, 0.0, 1.0);
}

@fragment
fn fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = vec2<i32>(position.xy);
    let last = vec2<i32>(textureDimensions(occlusion)) - 1;
    let here = distance_at(at);
    var sum = vec2(0.0);
    for (var i = 0; i < 16; i++) {
        let other = clamp(at + vec2(i & 3, i >> 2u) - 2, vec2(0), last);
        if abs(distance_at(other) - here) < 0.5 * frame.reach {
            sum += vec2(textureLoad(occlusion, other, 0).x, 1.0);
        }
    }
    let open = select(1.0, sum.x / max(sum.y, 1.0), sum.y > 0.0);
    return vec4(vec3(open), 1.0);
}
