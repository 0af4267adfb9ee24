//! What changes from picture to picture: uniforms, and which lines and points are drawn.

use std::ops::Range;

use glam::{DMat4, DVec3, DVec4, Mat4, Vec2, Vec3, Vec4};

use super::Size;
use super::palette::{linear, opaque, palette};
use super::upload::{PartBuffers, Uploaded};
use crate::annotate::scale::SAMPLES;
use crate::annotate::{Reading, Tint};
use crate::camera::{Camera, Up};
use crate::scene::{Plane, Style, Surface};

/// Part of a picture, in pixels from its upper left corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tile {
    pub picture: Size,
    pub left: u32,
    pub top: u32,
    pub width: u32,
    pub height: u32,
}

impl Tile {
    pub(super) fn whole(picture: Size) -> Self {
        Self { picture, left: 0, top: 0, width: picture.width, height: picture.height }
    }

    /// With so many pixels around it as the picture has.
    pub(super) fn with_margin(self, margin: u32) -> Self {
        let (left, top) = (self.left.saturating_sub(margin), self.top.saturating_sub(margin));
        let right = (self.left + self.width + margin).min(self.picture.width);
        let bottom = (self.top + self.height + margin).min(self.picture.height);
        Self { left, top, width: right - left, height: bottom - top, ..self }
    }

    /// Scale and shift from coordinates in the picture (−1 to 1, y up) to coordinates in the tile.
    fn transform(self) -> Vec4 {
        let picture = Vec2::new(self.picture.width.max(1) as f32, self.picture.height.max(1) as f32);
        let own = Vec2::new(self.width.max(1) as f32, self.height.max(1) as f32);
        let scale = picture / own;
        let left = 2.0 * self.left as f32 / picture.x - 1.0;
        let top = 1.0 - 2.0 * self.top as f32 / picture.y;
        Vec4::new(scale.x, scale.y, -1.0 - left * scale.x, 1.0 - top * scale.y)
    }
}

/// `Frame` of `shaders/frame.wgsl`.
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct Frame {
    view_from_scene: Mat4,
    clip_from_scene: Mat4,
    tile: Vec4,
    background_top: [f32; 4],
    background_bottom: [f32; 4],
    front: [f32; 4],
    back: [f32; 4],
    eye: Vec3,
    near: f32,
    size: Vec2,
    pixel: f32,
    scale: f32,
    smooth_shading: u32,
    encode: u32,
    parallel: f32,
    surface: u32,
    tint: u32,
    reach: f32,
    window: [f32; 2],
    clip: Vec4,
    cut: [f32; 4],
    ground: Vec4,
    ground_lines: Vec4,
    grid_line: [f32; 4],
    scale_colors: [[f32; 4]; SAMPLES],
}

/// `Layer` of `shaders/frame.wgsl`.
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct Layer {
    line: [f32; 4],
    strong_line: [f32; 4],
    point: [f32; 4],
    ring: [f32; 4],
    line_width: f32,
    strong_width: f32,
    point_size: f32,
    spacing: f32,
    strong_from: u32,
    lonely_count: u32,
    opacity: f32,
    faintest: f32,
    gone_at: f32,
    padding: f32,
    dots: [f32; 2],
}

/// How many layers there are: the mesh, the control mesh, what of the control mesh lies behind faces, and arrows.
pub(super) const LAYERS: usize = 4;
const MESH: usize = 0;
const CONTROL: usize = 1;
const HIDDEN_CONTROL: usize = 2;
pub(super) const ARROWS: usize = 3;

/// Edges of the boundary are this many times as wide as others.
const STRONG: f32 = 2.2;
/// Opacity of what shows through the surface.
const HIDDEN: f32 = 0.22;
/// How far ambient occlusion reaches, measured by the radius of the mesh.
const REACH: f64 = 0.6;
/// Points that arrows and their heads are wide and long.
const ARROW_WIDTH: f32 = 1.4;
const ARROW_HEAD: f32 = 8.0;
/// Opacity of crowded lines where there is nothing but lines.
const FAINTEST: f32 = 0.15;
/// Points between lines below which they are not drawn.
const GONE_AT: f32 = 2.5;
/// The same of the control mesh, which lies on what it is shown for: crowded, it would hide the surface.
const CONTROL_GONE_AT: f32 = 7.0;
/// Points that vertices are large from which on they begin to be seen, and are fully.
const DOTS: [f32; 2] = [0.7, 2.5];
const CONTROL_DOTS: [f32; 2] = [2.5, 5.0];

/// With `encode` the shaders turn light into sRGB, because the target does not.
pub(super) fn frame(
    scene: &Uploaded,
    camera: &Camera,
    style: &Style,
    tint: Option<&Tint>,
    tile: Tile,
    encode: bool,
) -> Frame {
    let palette = palette(style.theme);
    // Scene coordinates are turned and shifted in double precision, so that a far-away origin costs nothing.
    let eye = (camera.eye() - scene.origin) / scene.unit;
    let to_view = DMat4::from_quat(camera.world_from_view.conjugate());
    let view_from_scene = to_view * DMat4::from_translation(-eye);
    let near = camera.near() / scene.unit;
    let bounds = scene.bounds(&Style { control: true, ..*style });
    let mut clip_from_view = camera.clip_from_view_within(tile.picture.aspect(), bounds);
    // From world units to those of the scene.
    if camera.orthographic {
        clip_from_view.w_axis /= scene.unit;
    } else {
        clip_from_view.w_axis.z = near;
    }
    // Whose lines of sight are parallel is infinitely far away.
    let seen_from = if camera.orthographic { camera.world_from_view * DVec3::new(0.0, 0.0, 1e6) } else { eye };
    let ground = ground(scene, style.up);
    let behind = |color| style.backdrop.map_or(color, |[r, g, b]| [r, g, b, 0xff]);
    Frame {
        view_from_scene: view_from_scene.as_mat4(),
        clip_from_scene: (clip_from_view * view_from_scene).as_mat4(),
        tile: tile.transform(),
        background_top: linear(behind(palette.background_top)),
        background_bottom: linear(behind(palette.background_bottom)),
        front: linear(palette.front),
        back: linear(palette.back),
        eye: seen_from.as_vec3(),
        near: near as f32,
        size: Vec2::new(tile.picture.width.max(1) as f32, tile.picture.height.max(1) as f32),
        pixel: pixel(camera, tile.picture) as f32,
        scale: tile.picture.scale,
        smooth_shading: u32::from(style.smooth),
        encode: u32::from(encode),
        parallel: (camera.depth_per_length(bounds) * scene.unit) as f32,
        surface: match style.surface {
            Surface::Lights => 0,
            Surface::ReflectionLines => 1,
            Surface::Isophotes => 2,
        },
        tint: match tint {
            Some(tint) => tint.reading as u32,
            None => Reading::Colors as u32,
        },
        clip: clip(scene, camera, style),
        cut: linear(palette.cut),
        ground: ground.0,
        ground_lines: ground.1,
        grid_line: linear(palette.grid),
        window: tint.map_or([0.0, 1.0], Tint::window),
        reach: (scene.bounds(&Style { control: false, ..*style }).radius * REACH / scene.unit) as f32,
        scale_colors: tint.map_or([[0.0; 4]; SAMPLES], |tint| tint.samples().map(opaque)),
    }
}

/// What is cut away, in scene coordinates.
fn clip(scene: &Uploaded, camera: &Camera, style: &Style) -> Vec4 {
    match style.cut.plane(scene.bounds(&Style { control: false, ..*style }), camera) {
        Some(Plane { normal, place }) => normal.extend((place - normal.dot(scene.origin)) / scene.unit).as_vec4(),
        None => Vec4::new(0.0, 0.0, 0.0, 1.0),
    }
}

/// The grid: its height, the distance of its lines and its reach; and where its lines are. Distances of lines are 1, 2 or
/// 5 times a power of ten in world units, some ten of them to the radius of what is seen.
fn ground(scene: &Uploaded, up: Up) -> (Vec4, Vec4) {
    let bounds = scene.bounds(&Style { control: false, ..Style::default() });
    let radius = if bounds.radius > 0.0 { bounds.radius } else { scene.unit };
    let wanted = radius / 10.0;
    let power = 10f64.powf(wanted.log10().floor());
    let apart = [1.0, 2.0, 5.0, 10.0].map(|n| n * power).into_iter().find(|a| *a >= wanted).unwrap_or(power);
    // Thick lines are where the coordinate is a multiple of ten times the distance.
    let from = (scene.origin / (10.0 * apart)).round() * (10.0 * apart);
    let scene_place = |x: f64, origin: f64| (x - origin) / scene.unit;
    let origin = scene.origin;
    // A hair below the mesh, so that a flat one is not in it.
    let (upright, across) = match up {
        Up::Y => (1, 2),
        Up::Z => (2, 1),
    };
    let height = scene_place(scene.lowest[upright] - radius * 1e-3, origin[upright]);
    let z_up = f64::from(u8::from(up == Up::Z));
    let grid = DVec4::new(height, apart / scene.unit, 4.0 * radius / scene.unit, z_up);
    let lines = DVec4::new(
        scene_place(0.0, origin.x),
        scene_place(0.0, origin[across]),
        scene_place(from.x, origin.x),
        scene_place(from[across], origin[across]),
    );
    (grid.as_vec4(), lines.as_vec4())
}

/// `arrow` is the length in scene units of arrows of length 1.
pub(super) fn layers(scene: &Uploaded, style: &Style, arrow: f32, scale: f32) -> [Layer; LAYERS] {
    let palette = palette(style.theme);
    let spacing = |part: &Option<PartBuffers>| part.as_ref().map_or(0.0, |p| p.mean_edge);
    let mesh = Layer {
        line: linear(if style.faces { palette.line } else { palette.bare_line }),
        strong_line: linear(palette.strong_line),
        point: linear(palette.point),
        ring: linear(palette.ring),
        line_width: style.edge_width * scale,
        strong_width: style.edge_width * STRONG * scale,
        point_size: style.vertex_size * scale,
        spacing: spacing(&scene.mesh),
        strong_from: scene.mesh.as_ref().map_or(0, |p| p.inner_edge_count),
        lonely_count: scene.mesh.as_ref().map_or(0, |p| p.lonely_count),
        opacity: 1.0,
        faintest: if style.faces { 0.0 } else { FAINTEST },
        gone_at: GONE_AT,
        padding: 0.0,
        dots: DOTS,
    };
    let color = linear(palette.control);
    let control = Layer {
        line: color,
        strong_line: color,
        point: color,
        ring: linear(palette.ring),
        strong_width: style.edge_width * scale,
        spacing: spacing(&scene.control),
        strong_from: scene.control.as_ref().map_or(0, |p| p.inner_edge_count),
        lonely_count: scene.control.as_ref().map_or(0, |p| p.lonely_count),
        gone_at: CONTROL_GONE_AT,
        dots: CONTROL_DOTS,
        ..mesh
    };
    let arrows = Layer {
        line: linear(palette.arrow),
        line_width: ARROW_WIDTH * scale,
        point_size: ARROW_HEAD * scale,
        spacing: arrow,
        ..mesh
    };
    [mesh, control, Layer { opacity: HIDDEN, ..control }, arrows]
}

/// Which of the two meshes.
#[derive(Debug, Clone, Copy)]
pub(super) enum Which {
    Mesh,
    Control,
}

impl Which {
    pub(super) fn of(self, scene: &Uploaded) -> Option<&PartBuffers> {
        match self {
            Self::Mesh => scene.mesh.as_ref(),
            Self::Control => scene.control.as_ref(),
        }
    }
}

/// Lines and points of one mesh in one look.
pub(super) struct LayerDraw {
    pub part: Which,
    pub layer: usize,
    pub hidden: bool,
    pub edges: Range<u32>,
    pub vertices: Range<u32>,
}

/// Lines and points in the order in which they are drawn.
pub(super) fn layer_draws(scene: &Uploaded, camera: &Camera, style: &Style, picture: Size) -> Vec<LayerDraw> {
    let mut draws = Vec::new();
    if let Some(mesh) = &scene.mesh {
        draws.push(LayerDraw {
            part: Which::Mesh,
            layer: MESH,
            hidden: false,
            edges: match (style.edges, style.faces) {
                (true, true) => first_edge(scene, mesh, camera, style, picture)..mesh.edge_count,
                (true, false) => 0..mesh.edge_count,
                (false, _) => 0..0,
            },
            vertices: 0..if style.vertices { mesh.vertex_count } else { mesh.lonely_count },
        });
    }
    if style.control
        && let Some(control) = &scene.control
    {
        for (layer, hidden) in [(HIDDEN_CONTROL, true), (CONTROL, false)] {
            let (edges, vertices) = (0..control.edge_count, 0..control.vertex_count);
            draws.push(LayerDraw { part: Which::Control, layer, hidden, edges, vertices });
        }
    }
    draws
}

/// Edges before this one would all come out too short to be drawn: spares the GPU millions of them.
fn first_edge(scene: &Uploaded, part: &PartBuffers, camera: &Camera, style: &Style, picture: Size) -> u32 {
    let bounds = scene.bounds(&Style { control: true, ..*style });
    let nearest = match camera.orthographic {
        true => camera.distance,
        false => (camera.eye().distance(bounds.center) - bounds.radius).max(camera.near()),
    } / scene.unit;
    let longest = f64::from(part.longest_inner_edge) / (nearest * pixel(camera, picture) * f64::from(picture.scale));
    if longest < f64::from(GONE_AT) { part.inner_edge_count } else { 0 }
}

/// Length of a pixel at distance 1.
fn pixel(camera: &Camera, picture: Size) -> f64 {
    2.0 * (camera.field_of_view / 2.0).tan() / f64::from(picture.height.max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_map_their_own_corners_to_the_corners_of_the_target() {
        let tile = Tile { picture: Size::new(400, 200), left: 100, top: 50, width: 200, height: 50 };
        let t = tile.transform();
        let at = |x: f32, y: f32| {
            let (x, y) = (2.0 * x / 400.0 - 1.0, 1.0 - 2.0 * y / 200.0);
            (x * t.x + t.z, y * t.y + t.w)
        };
        assert_eq!(at(100.0, 50.0), (-1.0, 1.0));
        assert_eq!(at(300.0, 100.0), (1.0, -1.0));
        assert_eq!(Tile::whole(tile.picture).transform(), Vec4::new(1.0, 1.0, 0.0, 0.0));
    }
}
