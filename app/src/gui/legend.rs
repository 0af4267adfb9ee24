//! What the colours mean: a bar with its numbers, or the kinds with their counts.

use eframe::egui::{
    Color32, CornerRadius, FontId, Frame, Label, Margin, Pos2, Rect, RichText, Sense, Stroke, Ui, UiBuilder, pos2, vec2,
};

use super::widgets::grouped;
use crate::annotate::cell::Colors;
use crate::annotate::field::{Class, Kind};
use crate::annotate::scale::{self, short};
use crate::annotate::{Legend, Tint};
use crate::scene::Pointer;
use crate::session::Session;
use crate::worker::Frame as Shown;

const WIDTH: f32 = 148.0;
const BAR: f32 = 168.0;
const ROW: f32 = 17.0;
/// The part of a picture that it covers at most, lest it lie over the mesh; in smaller ones it is a strip.
const MOST: f32 = 0.08;
/// Height of the histogram over a strip.
const COUNTS: f32 = 16.0;

/// How much of a picture's width it takes, with what it leaves free at the right.
pub fn width(rect: Rect, colors: Option<&Colors>) -> f32 {
    match colors.map(height) {
        Some(height) if is_strip(rect, height) => strip_width(rect) + 26.0,
        Some(_) => WIDTH + 34.0,
        None => 0.0,
    }
}

fn height(colors: &Colors) -> f32 {
    let inside = match colors {
        Ok(tint) => match &tint.field.kind {
            Kind::Classes(classes) => classes.iter().filter(|c| c.count > 0).count() as f32 * ROW,
            Kind::Colors => 0.0,
            _ => BAR + 14.0,
        },
        Err(_) => 2.0 * ROW,
    };
    inside + 2.0 * ROW + 36.0
}

/// Whether something so high would cover too much.
fn is_strip(rect: Rect, height: f32) -> bool {
    let part = (WIDTH + 24.0) * height / rect.area().max(1.0);
    part > MOST || rect.height() < height + 40.0
}

fn strip_width(rect: Rect) -> f32 {
    (rect.width() - 44.0).min(230.0)
}

/// Shows it in the lower right corner, in a small picture as a strip; with the value under the pointer, if it is over the
/// mesh. Returns where it is.
pub fn show(
    ui: &mut Ui,
    rect: Rect,
    session: &Session,
    frame: &Shown,
    colors: Option<&Colors>,
    at: Option<Pointer>,
) -> Option<Rect> {
    let colors = colors?;
    let title = session.document.annotations.color_by.title();
    let height = height(colors);
    let under = at.and_then(|pointer| under(&pointer, frame, colors.as_ref().ok()?));
    if is_strip(rect, height) {
        return compact(ui, rect, &title, colors, under.as_ref());
    }
    let place =
        Rect::from_min_size(rect.right_bottom() - vec2(WIDTH + 34.0, height + 10.0), vec2(WIDTH + 24.0, height));
    let shown = ui.scope_builder(UiBuilder::new().max_rect(place), |ui| {
        Frame::NONE
            .fill(ui.visuals().window_fill.gamma_multiply(0.9))
            .stroke(ui.visuals().window_stroke)
            .corner_radius(CornerRadius::same(7))
            .inner_margin(Margin::symmetric(12, 9))
            .show(ui, |ui| {
                ui.set_width(WIDTH);
                ui.spacing_mut().item_spacing.y = 4.0;
                line(ui, RichText::new(title).strong());
                match colors {
                    Ok(tint) => explain(ui, tint, under.as_ref()),
                    Err(why) => _ = ui.add(Label::new(RichText::new(why).small()).selectable(false)),
                }
            });
    });
    Some(shown.response.rect)
}

/// How much of a picture's height it takes as a strip; nothing otherwise.
pub fn strip_height(ui: &Ui, rect: Rect, colors: Option<&Colors>) -> f32 {
    let Some(colors) = colors.filter(|colors| is_strip(rect, height(colors)) && has_room(rect)) else { return 0.0 };
    compact_height(colors, &rows(ui, strip_width(rect), colors)) + 10.0
}

/// Whether there is room for a strip.
fn has_room(rect: Rect) -> bool {
    strip_width(rect) >= 90.0 && rect.height() >= 150.0
}

/// The kinds that occur, in as many rows as they need in a strip.
fn rows<'c>(ui: &Ui, width: f32, colors: &'c Colors) -> Vec<Vec<&'c Class>> {
    let font = FontId::proportional(11.0);
    let ink = ui.visuals().text_color();
    let long = |text: &str| ui.painter().layout_no_wrap(text.to_owned(), font.clone(), ink).size().x;
    let mut rows: Vec<Vec<&Class>> = Vec::new();
    if let Some(Kind::Classes(classes)) = colors.as_ref().ok().map(|tint| &tint.field.kind) {
        let mut left = 0.0;
        for class in classes.iter().filter(|class| class.count > 0) {
            let wide = 24.0 + long(&class.name);
            if rows.is_empty() || left < wide {
                rows.push(Vec::new());
                left = width;
            }
            left -= wide;
            if let Some(row) = rows.last_mut() {
                row.push(class);
            }
        }
    }
    rows
}

fn compact_height(colors: &Colors, rows: &[Vec<&Class>]) -> f32 {
    let below = match colors.as_ref().map(|tint| &tint.field.kind) {
        Err(_) => 2.0 * 15.0,
        Ok(Kind::Classes(_)) => rows.len() as f32 * 15.0,
        Ok(Kind::Colors) => 0.0,
        Ok(_) => 25.0 + COUNTS,
    };
    17.0 + below + 10.0
}

/// A strip above the lower edge: what the colours are, and a bar or the kinds, in a line each.
fn compact(ui: &mut Ui, rect: Rect, title: &str, colors: &Colors, under: Option<&Under>) -> Option<Rect> {
    if !has_room(rect) {
        return None;
    }
    let width = strip_width(rect);
    let font = FontId::proportional(11.0);
    let kind = colors.as_ref().ok().map(|tint| &tint.field.kind);
    let rows = rows(ui, width, colors);
    let size = vec2(width + 16.0, compact_height(colors, &rows));
    let place = Rect::from_min_size(rect.right_bottom() - size - vec2(10.0, 10.0), size);
    let paper = ui.visuals().window_fill.gamma_multiply(0.9);
    let edge = ui.visuals().window_stroke;
    ui.painter().rect(place, CornerRadius::same(6), paper, edge, eframe::egui::StrokeKind::Inside);
    ui.scope_builder(UiBuilder::new().max_rect(place.shrink2(vec2(8.0, 5.0))), |ui| {
        ui.spacing_mut().item_spacing = vec2(10.0, 1.0);
        ui.spacing_mut().interact_size.y = 14.0;
        let value = under.map(|under| format!("{}: {}", under.name, under.text.as_deref().unwrap_or("none")));
        line(ui, RichText::new(value.as_deref().unwrap_or(title)).font(font.clone()).strong());
        match (colors, kind) {
            (Err(why), _) => _ = ui.add(Label::new(RichText::new(why).font(font.clone())).selectable(false)),
            (Ok(tint), Some(kind @ (Kind::Sequential { .. } | Kind::Diverging))) => {
                strip(ui, kind, &tint.legend, under, &font);
            }
            _ => {
                for row in rows {
                    ui.horizontal(|ui| {
                        ui.spacing_mut().item_spacing.x = 4.0;
                        for class in row {
                            let (swatch, _) = ui.allocate_exact_size(vec2(10.0, 10.0), Sense::hover());
                            ui.painter().rect_filled(swatch, 2.0, color32(class.color));
                            line(ui, RichText::new(&class.name).font(font.clone()));
                            ui.add_space(2.0);
                        }
                    });
                }
            }
        }
    });
    Some(place)
}

/// The bar lying down, with the numbers at its ends below it.
fn strip(ui: &mut Ui, kind: &Kind, legend: &Legend, under: Option<&Under>, font: &FontId) {
    const STEPS: usize = 64;
    let (all, _) = ui.allocate_exact_size(vec2(ui.available_width(), COUNTS + 9.0), Sense::hover());
    let (counts, bar) = all.split_top_bottom_at_y(all.top() + COUNTS);
    let (painter, ink) = (ui.painter(), ui.visuals().text_color());
    let fill = ui.visuals().weak_text_color().gamma_multiply(0.6);
    let wide = counts.width() / legend.histogram.len().max(1) as f32;
    for (i, part) in parts(legend) {
        let least = pos2(counts.left() + i as f32 * wide, counts.bottom() - 2.0);
        let height = (part * (COUNTS - 3.0)).max(1.0);
        let size = vec2((wide - 0.5).max(0.5), height);
        painter.rect_filled(Rect::from_min_size(least - vec2(0.0, height), size), 0.0, fill);
    }
    let step = bar.width() / STEPS as f32;
    for i in 0..STEPS {
        let min = pos2(bar.left() + i as f32 * step, bar.top());
        let color = scale::color(kind, (i as f64 + 0.5) / STEPS as f64);
        painter.rect_filled(Rect::from_min_size(min, vec2(step + 0.5, bar.height())), 0.0, color32(color));
    }
    painter.rect_stroke(bar, 0.0, ui.visuals().window_stroke, eframe::egui::StrokeKind::Outside);
    let [low, high] = legend.range;
    if let Some(under) = under.filter(|under| under.number.is_finite()) {
        let x = bar.left() + bar.width() * ((under.number - low) / (high - low)).clamp(0.0, 1.0) as f32;
        painter.vline(x, bar.y_range().expand(2.0), Stroke::new(3.0, ui.visuals().window_fill));
        painter.vline(x, bar.y_range().expand(2.0), Stroke::new(1.5, ink));
    }
    ui.horizontal(|ui| {
        line(ui, RichText::new(short(low)).font(font.clone()));
        ui.with_layout(eframe::egui::Layout::right_to_left(eframe::egui::Align::Center), |ui| {
            line(ui, RichText::new(short(high)).font(font.clone()));
        });
    });
}

fn line(ui: &mut Ui, text: RichText) {
    ui.add(Label::new(text).selectable(false).truncate());
}

/// What lies under the pointer.
struct Under {
    name: String,
    text: Option<String>,
    number: f64,
}

fn under(pointer: &Pointer, frame: &Shown, tint: &Tint) -> Option<Under> {
    let picked = frame.scene.pick(pointer)?;
    let (name, index) = if tint.field.at_faces {
        let face = picked.face?;
        (format!("face {}", face + 1), face)
    } else {
        let vertex = picked.vertex?.what;
        (vertex.to_string(), vertex.index())
    };
    let number = tint.field.numbers.get(index).copied().unwrap_or(f64::NAN);
    Some(Under { name, text: tint.field.text(index), number })
}

fn explain(ui: &mut Ui, tint: &Tint, under: Option<&Under>) {
    match &tint.field.kind {
        Kind::Classes(classes) => kinds(ui, classes, under),
        Kind::Colors => {}
        kind => bar(ui, kind, &tint.legend, under),
    }
    let value = match under {
        Some(Under { name, text: Some(text), .. }) => format!("{name}: {text}"),
        Some(Under { name, text: None, .. }) => format!("{name}: none"),
        None => match (&tint.field.note, tint.legend.without) {
            (Some(note), _) => note.clone(),
            (None, 0) => "point at the mesh for a value".to_owned(),
            (None, n) => format!("{} without", grouped(n)),
        },
    };
    line(ui, RichText::new(value).small());
}

fn kinds(ui: &mut Ui, classes: &[Class], under: Option<&Under>) {
    for (i, class) in classes.iter().enumerate().filter(|(_, class)| class.count > 0) {
        let is_under = under.is_some_and(|under| under.number == i as f64);
        let (rect, _) = ui.allocate_exact_size(vec2(WIDTH, ROW - 4.0), Sense::hover());
        let swatch = Rect::from_min_size(rect.min, vec2(14.0, 13.0));
        let text = ui.visuals().text_color();
        ui.painter().rect_filled(swatch, 2.0, color32(class.color));
        if is_under {
            ui.painter().rect_stroke(
                swatch.expand(1.5),
                3.0,
                Stroke::new(1.5, text),
                eframe::egui::StrokeKind::Outside,
            );
        }
        let mut row = ui.new_child(UiBuilder::new().max_rect(rect.with_min_x(rect.left() + 22.0)));
        row.spacing_mut().interact_size.y = rect.height(); // else the text stands below its colour
        row.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 0.0;
            line(ui, RichText::new(&class.name).small());
            ui.with_layout(eframe::egui::Layout::right_to_left(eframe::egui::Align::Center), |ui| {
                line(ui, RichText::new(grouped(class.count)).small().weak());
            });
        });
    }
}

/// The bar with its histogram at the left and its numbers at the right.
fn bar(ui: &mut Ui, kind: &Kind, legend: &Legend, under: Option<&Under>) {
    const BAR_WIDTH: f32 = 16.0;
    const COUNTS: f32 = 56.0;
    let (rect, _) = ui.allocate_exact_size(vec2(WIDTH, BAR + 10.0), Sense::hover());
    let rect = rect.shrink2(vec2(0.0, 5.0));
    let bar = Rect::from_min_size(rect.min + vec2(COUNTS + 4.0, 0.0), vec2(BAR_WIDTH, BAR));
    let painter = ui.painter();
    const STEPS: usize = 84;
    let height = bar.height() / STEPS as f32;
    for i in 0..STEPS {
        let t = (i as f64 + 0.5) / STEPS as f64;
        let top = bar.bottom() - (i + 1) as f32 * height;
        let step = Rect::from_min_size(pos2(bar.left(), top), vec2(bar.width(), height + 0.5));
        painter.rect_filled(step, 0.0, color32(scale::color(kind, t)));
    }
    painter.rect_stroke(bar, 0.0, ui.visuals().window_stroke, eframe::egui::StrokeKind::Outside);
    let fill = ui.visuals().weak_text_color().gamma_multiply(0.6);
    let height = bar.height() / legend.histogram.len().max(1) as f32;
    for (i, part) in parts(legend) {
        let length = part * COUNTS;
        let bottom = bar.bottom() - i as f32 * height;
        let size = vec2(length.max(1.0), (height - 0.5).max(0.5));
        painter.rect_filled(Rect::from_min_size(pos2(bar.left() - 4.0 - length, bottom - height), size), 0.0, fill);
    }
    let [low, high] = legend.range;
    let font = FontId::proportional(11.0);
    let text = ui.visuals().text_color();
    for i in 0..=4 {
        let t = f64::from(i) / 4.0;
        let at = pos2(bar.right() + 3.0, bar.bottom() - bar.height() * t as f32);
        painter.line_segment([at - vec2(3.0, 0.0), at + vec2(3.0, 0.0)], Stroke::new(1.0, text));
        let number = low + (high - low) * t;
        // What lies beyond the ends has their colours.
        let sign = match (i, legend.extremes) {
            (0, Some([least, _])) if least < low => "≤ ",
            (4, Some([_, most])) if most > high => "≥ ",
            _ => "",
        };
        let number = if number.abs() < (high - low).abs() * 1e-9 { 0.0 } else { number };
        let label = format!("{sign}{}", short(number));
        painter.text(at + vec2(6.0, 0.0), eframe::egui::Align2::LEFT_CENTER, label, font.clone(), text);
    }
    if let Some(under) = under.filter(|under| under.number.is_finite()) {
        let t = ((under.number - low) / (high - low)).clamp(0.0, 1.0) as f32;
        let at = pos2(bar.left(), bar.bottom() - bar.height() * t);
        let line: [Pos2; 2] = [at - vec2(4.0, 0.0), at + vec2(BAR_WIDTH + 4.0, 0.0)];
        painter.line_segment(line, Stroke::new(3.0, ui.visuals().window_fill));
        painter.line_segment(line, Stroke::new(1.5, text));
    }
}

/// The classes of the histogram that are not empty, each with its length, 1 for the fullest. The square root keeps the few
/// visible beside the many.
fn parts(legend: &Legend) -> impl Iterator<Item = (usize, f32)> {
    let most = f64::from(legend.histogram.iter().copied().max().unwrap_or(0).max(1));
    let filled = legend.histogram.iter().enumerate().filter(|(_, n)| **n > 0);
    filled.map(move |(i, &n)| (i, (f64::from(n) / most).sqrt() as f32))
}

fn color32([r, g, b]: [u8; 3]) -> Color32 {
    Color32::from_rgb(r, g, b)
}
