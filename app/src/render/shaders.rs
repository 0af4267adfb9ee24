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

/// All of them by name.
pub const ALL: [(&str, &str); 6] = [
    ("background", BACKGROUND),
    ("faces", FACES),
    ("grid", GRID),
    ("arrows", ARROWS),
    ("edges", EDGES),
    ("vertices", VERTICES),
];
