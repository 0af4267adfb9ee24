//! The gallery: every program that ships with vv as a picture with a title and a line; also what an empty window offers.

use std::collections::HashMap;
use std::sync::mpsc::{self, Receiver, Sender};

use eframe::egui::text::{LayoutJob, TextWrapping};
use eframe::egui::{
    self, Color32, ColorImage, Context, CornerRadius, Frame, Id, Key, Margin, Modal, Modifiers, Rect, Response, Role,
    ScrollArea, Sense, Stroke, StrokeKind, TextEdit, TextStyle, TextureHandle, TextureOptions, Ui, WidgetInfo, pos2,
    vec2,
};

use super::widgets::tooltip;
use crate::command::Command;
use crate::document::{MeshSource, file_name};
use crate::gallery::{EXHIBITS, Exhibit, Group, line};
use crate::session::{Dialog, Purpose, Session};

/// Points that a tile is wide, at least.
const TILE: f32 = 160.0;
const GAP: f32 = 12.0;
/// Room for title and line.
const CAPTION: f32 = 66.0;

/// The panel's own state: what is known of the pictures.
pub struct Gallery {
    pictures: HashMap<&'static str, Picture>,
    decoded: (Sender<Decoded>, Receiver<Decoded>),
}

type Decoded = (&'static str, Option<ColorImage>);

enum Picture {
    /// On its way from another thread.
    Expected,
    There(TextureHandle),
    /// It cannot be read.
    Missing,
}

impl Default for Gallery {
    fn default() -> Self {
        Self { pictures: HashMap::new(), decoded: mpsc::channel() }
    }
}

impl Gallery {
    /// Shows it, if it is open.
    pub fn show(&mut self, ctx: &Context, session: &mut Session, commands: &mut Vec<Command>) {
        let Some(Dialog::Gallery { query, selected, keep_mesh }) = &session.dialog else { return };
        let (mut query, mut selected, mut keep_mesh) = (query.clone(), *selected, *keep_mesh);
        self.take_pictures(ctx);
        let room = ctx.content_rect().size();
        let size = vec2((room.x - 48.0).min(1180.0), room.y - 48.0);
        let frame = Frame::window(&ctx.global_style()).inner_margin(Margin::same(16));
        let margin = frame.total_margin().sum();
        let (mut chosen, mut closed) = (Vec::new(), false);
        let response = Modal::new(Id::unique("gallery")).frame(frame).show(ctx, |ui| {
            ui.set_width(size.x - margin.x);
            ui.set_height(size.y - margin.y);
            let keys = Keys::take(ui);
            ui.horizontal(|ui| {
                ui.heading("Gallery");
                ui.add_space(8.0);
                let field = TextEdit::singleline(&mut query)
                    .hint_text(super::widgets::hint("find a program"))
                    .desired_width(200.0);
                let field = ui.add(field).accessible_name("Find a program");
                if ui.memory(|m| m.focused().is_none()) {
                    field.request_focus();
                }
                if field.changed() {
                    selected = 0;
                }
                if let Some(name) = own_mesh(session).filter(|_| ui.available_width() > 200.0) {
                    let text = format!("keep {name}");
                    let keep = super::widgets::check_box(ui, &mut keep_mesh, &text);
                    keep.on_hover_text("show the programs on the mesh that is open, not on one that suits them");
                }
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    if ui.button("×").on_hover_text("close, Esc").accessible_name("Close").clicked() {
                        closed = true;
                    }
                });
            });
            ui.add_space(6.0);
            begin(ui, session, &mut chosen);
            ui.add_space(6.0);
            let columns = (((ui.available_width() + GAP) / (TILE + GAP)) as usize).max(1);
            let rows = rows(&query, columns);
            selected = keys.moved(&rows, selected);
            let wanted = rows.iter().flat_map(|(_, row)| row).any(|&i| i == selected);
            if !wanted {
                selected = rows.first().and_then(|(_, row)| row.first().copied()).unwrap_or(0);
            }
            if rows.is_empty() {
                ui.weak("neither name nor description of any program says that");
            }
            ScrollArea::vertical().auto_shrink(egui::Vec2b::FALSE).show(ui, |ui| {
                let width = (ui.available_width() - GAP * (columns - 1) as f32 - 8.0) / columns as f32;
                for (title, row) in &rows {
                    if let Some(title) = title {
                        super::widgets::heading(ui, title);
                        ui.add_space(2.0);
                    }
                    ui.horizontal(|ui| {
                        ui.spacing_mut().item_spacing.x = GAP;
                        for &i in row {
                            let Some(exhibit) = EXHIBITS.get(i) else { continue };
                            let response = self.tile(ui, exhibit, width, i == selected);
                            if i == selected && keys.any() {
                                response.scroll_to_me(None);
                            }
                            if response.clicked() || i == selected && keys.enter && wanted {
                                chosen.push(Command::Exhibit { program: exhibit.program, keep_mesh });
                            }
                        }
                    });
                    ui.add_space(GAP - 5.0);
                }
            });
        });
        let closes = response.should_close() || closed || !chosen.is_empty();
        session.dialog = (!closes).then_some(Dialog::Gallery { query, selected, keep_mesh });
        commands.extend(chosen);
    }

    fn tile(&mut self, ui: &mut Ui, exhibit: &'static Exhibit, width: f32, selected: bool) -> Response {
        let size = vec2(width, width.round() + CAPTION);
        let (rect, response) = ui.allocate_exact_size(size, Sense::click());
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, selected, exhibit.title));
        if !ui.is_rect_visible(rect) {
            return response;
        }
        let visuals = ui.visuals().clone();
        let radius = CornerRadius::same(7);
        let fill = if response.hovered() { visuals.widgets.hovered.weak_bg_fill } else { visuals.faint_bg_color };
        let stroke = if selected || response.has_focus() {
            Stroke::new(2.0, visuals.hyperlink_color)
        } else {
            visuals.widgets.noninteractive.bg_stroke
        };
        ui.painter().rect(rect, radius, fill, stroke, StrokeKind::Inside);
        let inner = rect.shrink(3.0);
        let picture = Rect::from_min_size(inner.min, vec2(inner.width(), inner.width()));
        self.paint_picture(ui, exhibit, picture);
        let headline = exhibit.headline();
        let line = line(&headline);
        // Some begin with who and when, the others now with a small letter.
        let (first, rest) = line.split_at(line.chars().next().map_or(0, char::len_utf8));
        let line = format!("{}{rest}", first.to_uppercase());
        let (body, small) = (TextStyle::Body.resolve(ui.style()), TextStyle::Small.resolve(ui.style()));
        let text_width = (inner.width() - 14.0).max(20.0);
        let at = pos2(inner.left() + 7.0, picture.bottom() + 6.0);
        let mut title = LayoutJob::simple_singleline(exhibit.title.to_owned(), body, visuals.strong_text_color());
        title.wrap = TextWrapping::truncate_at_width(text_width);
        let title = ui.painter().layout_job(title);
        let below = at + vec2(0.0, title.size().y + 1.0);
        ui.painter().galley(at, title, visuals.strong_text_color());
        let mut job = LayoutJob::simple(line, small, visuals.weak_text_color(), text_width);
        job.wrap.max_rows = 3;
        let galley = ui.painter().layout_job(job);
        ui.painter().galley(below, galley, visuals.weak_text_color());
        response.on_hover_ui(|ui| {
            ui.label(exhibit.headline());
            ui.weak(match exhibit.mesh() {
                MeshSource::Empty => format!("{}, on a mesh of its own", exhibit.program),
                mesh => format!("{}, on {}", exhibit.program, mesh.name()),
            });
        })
    }

    fn paint_picture(&mut self, ui: &Ui, exhibit: &'static Exhibit, rect: Rect) {
        let radius = CornerRadius { nw: 5, ne: 5, sw: 0, se: 0 };
        let state = self.pictures.entry(exhibit.program).or_insert_with(|| {
            let (sender, ctx) = (self.decoded.0.clone(), ui.ctx().clone());
            rayon::spawn(move || {
                let _ = sender.send((exhibit.program, decode(exhibit.picture)));
                ctx.request_repaint();
            });
            Picture::Expected
        });
        match state {
            Picture::There(texture) => {
                egui::Image::new((texture.id(), rect.size())).corner_radius(radius).paint_at(ui, rect);
            }
            Picture::Expected => drop(ui.painter().rect_filled(rect, radius, ui.visuals().extreme_bg_color)),
            Picture::Missing => {
                let color = tint(exhibit.group, ui.visuals().dark_mode);
                ui.painter().rect_filled(rect, radius, color);
                let font = egui::FontId::proportional(20.0);
                let text = ui.visuals().strong_text_color().gamma_multiply(0.75);
                let mut job = LayoutJob::simple(exhibit.title.to_owned(), font, text, rect.width() - 24.0);
                job.halign = egui::Align::Center;
                let galley = ui.painter().layout_job(job);
                let at = pos2(rect.center().x, rect.center().y - galley.size().y / 2.0);
                ui.painter().galley(at, galley, text);
            }
        }
    }

    fn take_pictures(&mut self, ctx: &Context) {
        while let Ok((name, image)) = self.decoded.1.try_recv() {
            let picture = image.map_or(Picture::Missing, |image| {
                Picture::There(ctx.load_texture(name, image, TextureOptions::LINEAR))
            });
            self.pictures.insert(name, picture);
        }
    }
}

/// A mesh that was opened from a file, which nobody wants to lose on the way.
fn own_mesh(session: &Session) -> Option<String> {
    match &session.document.mesh {
        MeshSource::File(path) => Some(file_name(path)),
        MeshSource::Empty | MeshSource::BuiltIn(_) | MeshSource::Result(_) => None,
    }
}

/// What one begins with who has work of his own.
fn begin(ui: &mut Ui, session: &Session, chosen: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        let own = [Command::Choose(Purpose::OpenMesh), Command::Choose(Purpose::OpenProgram), Command::NewProgram];
        for command in own {
            if ui.button(command.describe().label).on_hover_ui(|ui| tooltip(ui, &command)).clicked() {
                chosen.push(command);
            }
        }
        let recent = session.recent();
        if !recent.is_empty() {
            ui.add_space(4.0);
            ui.weak("recent:");
        }
        for path in recent.iter().take(5) {
            let link = ui.link(file_name(path)).on_hover_text(path.display().to_string());
            if link.clicked() {
                chosen.push(Command::Open(path.clone()));
            }
        }
    });
}

fn decode(png: &[u8]) -> Option<ColorImage> {
    let image = image::load_from_memory_with_format(png, image::ImageFormat::Png).ok()?.into_rgba8();
    let size = [image.width() as usize, image.height() as usize];
    Some(ColorImage::from_rgba_unmultiplied(size, &image.into_raw()))
}

/// A quiet colour for programs without picture.
fn tint(group: Group, dark: bool) -> Color32 {
    let rgb: u32 = match (group, dark) {
        (Group::Subdivision, true) => 0x2c_3a_52,
        (Group::Subdivision, false) => 0xd5_e2_f5,
        (Group::Beyond, true) => 0x2b_41_40,
        (Group::Beyond, false) => 0xd3_ec_e8,
        (Group::Fractals, true) => 0x44_36_50,
        (Group::Fractals, false) => 0xe9_dc_f3,
        (Group::Growth, true) => 0x39_43_2c,
        (Group::Growth, false) => 0xe0_ec_d2,
        (Group::Paper, true) => 0x4a_40_2e,
        (Group::Paper, false) => 0xf3_e9_d3,
    };
    let [_, r, g, b] = rgb.to_be_bytes();
    Color32::from_rgb(r, g, b)
}

/// A row of tiles, by their places in [`EXHIBITS`]; the first of a group with the group's title.
type Row = (Option<&'static str>, Vec<usize>);

/// The exhibits that fit what was typed.
fn rows(query: &str, columns: usize) -> Vec<Row> {
    let mut rows = Vec::new();
    for group in Group::ALL {
        let fits = |exhibit: &Exhibit| {
            let text = format!("{} {} {} {}", exhibit.title, exhibit.program, group.title(), exhibit.headline());
            let text = text.to_lowercase();
            exhibit.group == group && query.split_whitespace().all(|word| text.contains(&word.to_lowercase()))
        };
        let found: Vec<usize> = EXHIBITS.iter().enumerate().filter(|(_, e)| fits(e)).map(|(i, _)| i).collect();
        for (n, row) in found.chunks(columns).enumerate() {
            rows.push(((n == 0).then_some(group.title()), row.to_vec()));
        }
    }
    rows
}

/// The keys that walk the tiles, taken before the text field sees them.
struct Keys {
    across: isize,
    down: isize,
    enter: bool,
}

impl Keys {
    fn take(ui: &Ui) -> Self {
        // A button that has the focus is meant by Enter.
        let typing = ui.ctx().egui_wants_keyboard_input() || ui.memory(|m| m.focused().is_none());
        ui.input_mut(|i| {
            let mut pressed = |key| i.count_and_consume_key(Modifiers::NONE, key) as isize;
            let across = pressed(Key::ArrowRight) - pressed(Key::ArrowLeft);
            let down =
                pressed(Key::ArrowDown) - pressed(Key::ArrowUp) + 3 * (pressed(Key::PageDown) - pressed(Key::PageUp));
            Self { across, down, enter: typing && pressed(Key::Enter) > 0 }
        })
    }

    fn any(&self) -> bool {
        self.across != 0 || self.down != 0
    }

    /// Across goes on in the next row; down stays in the column as far as the row reaches.
    fn moved(&self, rows: &[Row], selected: usize) -> usize {
        let all: Vec<usize> = rows.iter().flat_map(|(_, row)| row.iter().copied()).collect();
        let Some(place) = all.iter().position(|&i| i == selected) else { return selected };
        let mut now = all[(place as isize + self.across).clamp(0, all.len() as isize - 1) as usize];
        if self.down != 0 {
            let at = |i: usize| {
                let column = |row: &[usize]| row.iter().position(|&j| j == i);
                rows.iter().enumerate().find_map(|(r, (_, row))| Some((r, column(row)?)))
            };
            if let Some((row, column)) = at(now) {
                let row = (row as isize + self.down).clamp(0, rows.len() as isize - 1) as usize;
                now = rows[row].1.get(column).or(rows[row].1.last()).copied().unwrap_or(now);
            }
        }
        now
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn moves(across: isize, down: isize, from: usize, to: usize) {
        let rows = [(Some("a"), vec![0, 1, 2]), (None, vec![3]), (Some("b"), vec![5, 6, 7])];
        assert_eq!(Keys { across, down, enter: false }.moved(&rows, from), to);
    }

    #[test]
    fn arrows_walk_the_tiles() {
        moves(1, 0, 2, 3);
        moves(-1, 0, 5, 3);
        moves(1, 0, 7, 7);
        moves(0, 1, 2, 3); // as far as the row reaches
        moves(0, 1, 3, 5);
        moves(0, -1, 1, 1);
    }

    #[test]
    fn pictures_have_nothing_behind_them_in_light_and_dark() {
        for exhibit in EXHIBITS {
            let picture = decode(exhibit.picture).unwrap();
            assert_eq!(picture.pixels[0], Color32::TRANSPARENT, "{}", exhibit.program);
        }
    }

    #[track_caller]
    fn finds(query: &str, first: &str) {
        let rows = rows(query, 4);
        assert_eq!(EXHIBITS[rows[0].1[0]].program, first, "{query}");
    }

    #[test]
    fn programs_are_found_by_name_title_group_and_what_they_say() {
        finds("butter", "butterfly.vv");
        finds("snowflake", "koch.vv");
        finds("growth", "tissue.vv");
        finds("Turing", "reaction-diffusion.vv");
        assert!(rows("no such program", 4).is_empty());
        assert_eq!(rows("", 4).iter().map(|(_, row)| row.len()).sum::<usize>(), EXHIBITS.len());
    }
}
