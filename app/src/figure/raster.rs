//! Drawings in pixels, where a picture needs lines and text without a GPU.

use glam::DVec2;
use image::{Rgba, RgbaImage};
use vello_cpu::color::{AlphaColor, Srgb};
use vello_cpu::kurbo::{Affine, BezPath, Cap, Circle, Join, Shape as _, Stroke};
use vello_cpu::{Pixmap, RenderContext, Resources};

use super::letters::{Step, outline};
use super::page::{At, Drawing, Layer};
use super::{Dash, Line};

/// Pixels along a side of what is drawn at once.
const TILE: u32 = 2048;

/// How much bolder letters are than on paper, over their height: pixels make them pale.
const BOLD: f64 = 0.035;

/// The drawing on white, with so many pixels per point.
#[must_use]
pub fn image(drawing: &Drawing, scale: f64) -> RgbaImage {
    let pixels = |x: i32| (f64::from(x) / 100.0 * scale).ceil().max(1.0) as u32;
    let mut image = RgbaImage::from_pixel(pixels(drawing.size.x), pixels(drawing.size.y), Rgba([0xff; 4]));
    over(&mut image, drawing, scale);
    image
}

/// Draws over a picture, from its upper left corner.
pub(super) fn over(image: &mut RgbaImage, drawing: &Drawing, scale: f64) {
    if drawing.layers.is_empty() {
        return;
    }
    let (width, height) = image.dimensions();
    for top in (0..height).step_by(TILE as usize) {
        for left in (0..width).step_by(TILE as usize) {
            let size = [TILE.min(width - left), TILE.min(height - top)].map(|side| side as u16);
            let corner = DVec2::new(left.into(), top.into());
            let drawn = tile(drawing, scale, corner, size);
            let rows = drawn.data_as_u8_slice().chunks_exact(usize::from(size[0]) * 4);
            for (y, row) in (top..).zip(rows) {
                for (x, from) in (left..).zip(row.chunks_exact(4)) {
                    if let (&[r, g, b, a], Some(pixel)) = (from, image.get_pixel_mut_checked(x, y))
                        && a > 0
                    {
                        pixel.0 = blended([r, g, b, a], pixel.0);
                    }
                }
            }
        }
    }
}

/// What lies in a part of the picture.
fn tile(drawing: &Drawing, scale: f64, corner: DVec2, [width, height]: [u16; 2]) -> Pixmap {
    let mut context = RenderContext::new(width, height);
    // Hundredths of a point to pixels.
    context.set_transform(Affine::translate((-corner.x, -corner.y)) * Affine::scale(scale / 100.0));
    for layer in &drawing.layers {
        draw(&mut context, layer);
    }
    let mut pixels = Pixmap::new(width, height);
    context.render(&mut pixels, &mut Resources::new());
    pixels
}

fn draw(context: &mut RenderContext, layer: &Layer) {
    match layer {
        Layer::Faces(areas) => {
            context.set_stroke(round(30.0));
            for (corners, color) in areas {
                context.set_paint(opaque(*color));
                let area = path(corners, true);
                context.fill_path(&area);
                context.stroke_path(&area);
            }
        }
        Layer::Lines { line, paths, .. } => {
            context.set_paint(opaque(line.color));
            context.set_stroke(stroke(line));
            for line in paths {
                context.stroke_path(&path(&line.points, line.closed));
            }
        }
        Layer::Dots { diameter, color, places, .. } => {
            context.set_paint(opaque(*color));
            for at in places {
                let disc = Circle::new((f64::from(at.x), f64::from(at.y)), f64::from(*diameter) / 2.0);
                context.fill_path(&disc.to_path(1.0));
            }
        }
        Layer::Text { size, color, halo: (paper, width), words, .. } => {
            let shapes: Vec<BezPath> = words
                .iter()
                .flat_map(|line| &line.glyphs)
                .map(|(glyph, at)| letter(&outline(*glyph, *size), *at))
                .collect();
            context.set_paint(opaque(*paper));
            context.set_stroke(round(f64::from(*width)));
            shapes.iter().for_each(|shape| context.stroke_path(shape));
            context.set_paint(opaque(*color));
            context.set_stroke(round(BOLD * f64::from(*size)));
            for shape in &shapes {
                context.fill_path(shape);
                context.stroke_path(shape);
            }
        }
    }
}

fn stroke(line: &Line) -> Stroke {
    match line.dash {
        Dash::Solid => round(line.width * 100.0),
        dash => Stroke::new(line.width * 100.0)
            .with_join(Join::Round)
            .with_caps(Cap::Butt)
            .with_dashes(0.0, dash.lengths(line.width).map(f64::from)),
    }
}

fn round(width: f64) -> Stroke {
    Stroke::new(width).with_join(Join::Round).with_caps(Cap::Round)
}

fn path(points: &[At], closed: bool) -> BezPath {
    let mut path = BezPath::new();
    for (i, p) in points.iter().enumerate() {
        let p = (f64::from(p.x), f64::from(p.y));
        if i == 0 { path.move_to(p) } else { path.line_to(p) }
    }
    if closed {
        path.close_path();
    }
    path
}

fn letter(steps: &[Step], at: At) -> BezPath {
    let place = |p: At| (f64::from(p.x + at.x), f64::from(p.y + at.y));
    let mut path = BezPath::new();
    for step in steps {
        match *step {
            Step::Move(p) => path.move_to(place(p)),
            Step::Line(p) => path.line_to(place(p)),
            Step::Quad(c, p) => path.quad_to(place(c), place(p)),
            Step::Close => path.close_path(),
        }
    }
    path
}

fn opaque([r, g, b]: [u8; 3]) -> AlphaColor<Srgb> {
    AlphaColor::from_rgba8(r, g, b, 255)
}

/// A colour, multiplied by its opacity, over another, which is not.
fn blended(over: [u8; 4], below: [u8; 4]) -> [u8; 4] {
    let (a, b) = (f32::from(over[3]) / 255.0, f32::from(below[3]) / 255.0);
    let opacity = a + b * (1.0 - a);
    let mix = |i: usize| ((f32::from(over[i]) + f32::from(below[i]) * b * (1.0 - a)) / opacity).round() as u8;
    [mix(0), mix(1), mix(2), (opacity * 255.0).round() as u8]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dot_is_drawn_where_it_stands_across_tiles() {
        let at = |x: i32, y: i32| At { x, y };
        let dots =
            Layer::Dots { name: "vertices", diameter: 1000, color: [255, 0, 0], places: vec![at(204_800, 1000)] };
        let (layers, missing) = (vec![dots], Vec::new());
        let drawing = Drawing { size: at(300_000, 2000), layers, is_exact: true, crowded_out: 0, missing };
        let image = image(&drawing, 1.0);
        assert_eq!(image.dimensions(), (3000, 20));
        let red = |x: u32, y: u32| image.get_pixel(x, y).0 == [255, 0, 0, 255];
        assert!(red(2048, 10) && red(2045, 10) && red(2051, 10) && !red(2041, 10) && !red(2055, 10));
        let count = image.pixels().filter(|p| p.0 == [255, 0, 0, 255]).count();
        assert!((45..80).contains(&count), "{count}");
    }

    #[test]
    fn over_a_picture_what_is_not_drawn_on_stays() {
        assert_eq!(blended([0, 0, 0, 255], [9, 9, 9, 255]), [0, 0, 0, 255]);
        assert_eq!(blended([50, 0, 0, 128], [0, 0, 0, 0]), [100, 0, 0, 128]);
        assert_eq!(blended([128, 0, 0, 128], [0, 255, 0, 255]), [128, 127, 0, 255]);
    }
}
