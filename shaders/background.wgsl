// Background: one triangle over the whole picture, coloured by height.
//
//   color(y) = mix(bottom, top, (y + 1) / 2)      y from -1 to 1 over the whole picture

struct Varying {
    @builtin(position) position: vec4<f32>,
    @location(0) height: f32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varying {
    // (-1, -1), (3, -1), (-1, 3): covers the square from -1 to 1
    let p = vec2(f32((index & 1u) * 4u), f32((index & 2u) * 2u)) - 1.0;
    return Varying(vec4(p, 0.0, 1.0), (p.y - frame.tile.w) / frame.tile.y);
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    return output(mix(frame.background_bottom, frame.background_top, in.height * 0.5 + 0.5));
}
