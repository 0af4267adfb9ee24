//! The shaders of each pass, as WGSL text. What they share stands in front of each.

/// Background.
pub const BACKGROUND: &str =
    concat!(include_str!("../../../shaders/frame.wgsl"), include_str!("../../../shaders/background.wgsl"));
/// Faces.
pub const FACES: &str = concat!(
    include_str!("../../../shaders/frame.wgsl"),
    include_str!("../../../shaders/tint.wgsl"),
    include_str!("../../../shaders/surface.wgsl"),
    include_str!("../../../shaders/faces.wgsl")
);
/// The grid on the ground.
pub const GRID: &str = concat!(include_str!("../../../shaders/frame.wgsl"), include_str!("../../../shaders/grid.wgsl"));
/// Edges.
pub const EDGES: &str =
    concat!(include_str!("../../../shaders/frame.wgsl"), include_str!("../../../shaders/edges.wgsl"));
/// Vertices.
pub const VERTICES: &str =
    concat!(include_str!("../../../shaders/frame.wgsl"), include_str!("../../../shaders/vertices.wgsl"));

/// Arrows.
pub const ARROWS: &str =
    concat!(include_str!("../../../shaders/frame.wgsl"), include_str!("../../../shaders/arrows.wgsl"));

/// What is in front of the passes that read depths, of which there are several at a pixel or one.
const SEVERAL_DEPTHS: &str = "@group(1) @binding(0) var depths: texture_depth_multisampled_2d;\n";
const ONE_DEPTH: &str = "@group(1) @binding(0) var depths: texture_depth_2d;\n";

/// Ambient occlusion, for pictures with so many samples a pixel.
#[must_use]
pub fn occlusion(samples: u32) -> String {
    reading_depths(samples, include_str!("../../../shaders/occlusion.wgsl"))
}

/// What ambient occlusion does to the picture.
#[must_use]
pub fn shadow(samples: u32) -> String {
    reading_depths(samples, include_str!("../../../shaders/shadow.wgsl"))
}

fn reading_depths(samples: u32, shader: &str) -> String {
    let depths = if samples > 1 { SEVERAL_DEPTHS } else { ONE_DEPTH };
    format!("{}{depths}{shader}", include_str!("../../../shaders/frame.wgsl"))
}

/// All of them by name.
#[must_use]
pub fn all() -> Vec<(&'static str, String)> {
    let plain = [
        ("background", BACKGROUND),
        ("faces", FACES),
        ("grid", GRID),
        ("arrows", ARROWS),
        ("edges", EDGES),
        ("vertices", VERTICES),
    ];
    let plain = plain.map(|(name, text)| (name, text.to_owned()));
    let deep = [1, 4].map(|n| [("occlusion", occlusion(n)), ("shadow", shadow(n))]);
    plain.into_iter().chain(deep.into_iter().flatten()).collect()
}
