//! The command palette: every command, example and mesh, found by a few letters.

use eframe::egui::text::LayoutJob;
use eframe::egui::{
    self, Align, Align2, Context, Frame, Id, Key, Margin, Modal, Modifiers, Rect, ScrollArea, Sense, TextEdit,
    TextFormat, TextStyle, Ui, WidgetInfo, vec2,
};

use crate::command::{Command, MENUS, Match, find, find_also};
use crate::document::MeshSource;
use crate::gallery::EXHIBITS;
use crate::library;
use crate::session::{Dialog, Session};

const ROW: f32 = 28.0;
const WIDTH: f32 = 600.0;

struct Entry {
    group: &'static str,
    label: String,
    tooltip: String,
    command: Command,
}

/// Shows it.
pub fn show(ctx: &Context, session: &mut Session, commands: &mut Vec<Command>) {
    let Some(Dialog::Palette { query, selected }) = &session.dialog else { return };
    let (mut query, mut selected) = (query.clone(), *selected);
    let id = Id::unique("palette");
    let area = Modal::default_area(id).anchor(Align2::CENTER_TOP, vec2(0.0, 70.0));
    let frame = Frame::window(&ctx.global_style()).inner_margin(Margin::same(8));
    let mut chosen = None;
    let response = Modal::new(id).area(area).frame(frame).show(ctx, |ui| {
        ui.set_width(WIDTH.min(ui.ctx().content_rect().width() - 40.0));
        let keys = Keys::take(ui);
        let field = TextEdit::singleline(&mut query)
            .hint_text(super::widgets::hint("find a command, an example or a mesh"))
            .font(TextStyle::Heading)
            .margin(Margin::symmetric(10, 8))
            .desired_width(f32::INFINITY);
        let field = ui.add(field);
        field.request_focus();
        if field.changed() {
            selected = 0;
        }
        field.accessible_name("Find a command");
        let found = found(session, &query);
        selected = keys.moved(selected, found.len());
        ui.add_space(2.0);
        if found.is_empty() {
            ui.add_space(6.0);
            ui.weak("no command is called so");
            ui.add_space(6.0);
        }
        let height = (ui.ctx().content_rect().height() - 200.0).clamp(3.0 * ROW, 12.0 * ROW);
        ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            for (i, (matched, entry)) in found.iter().enumerate() {
                let (response, enabled) = row(ui, session, entry, matched, i == selected);
                if i == selected && keys.any() {
                    response.scroll_to_me(None);
                }
                if enabled && (response.clicked() || i == selected && keys.enter) {
                    chosen = Some(entry.command.clone());
                }
            }
        });
    });
    let closes = response.should_close() || chosen.is_some();
    session.dialog = (!closes).then_some(Dialog::Palette { query, selected });
    commands.extend(chosen);
}

/// The keys that walk the list, taken before the text field sees them.
struct Keys {
    by: isize,
    ends: bool,
    enter: bool,
}

impl Keys {
    fn take(ui: &Ui) -> Self {
        ui.input_mut(|i| {
            let mut pressed = |key| i.count_and_consume_key(Modifiers::NONE, key) as isize;
            let by =
                pressed(Key::ArrowDown) - pressed(Key::ArrowUp) + 10 * (pressed(Key::PageDown) - pressed(Key::PageUp));
            Self { by, ends: by.abs() >= 10, enter: pressed(Key::Enter) > 0 }
        })
    }

    fn any(&self) -> bool {
        self.by != 0
    }

    /// Arrows go round, pages stop at the ends.
    fn moved(&self, selected: usize, count: usize) -> usize {
        if count == 0 {
            return 0;
        }
        let wanted = selected as isize + self.by;
        let last = count as isize - 1;
        (if self.ends { wanted.clamp(0, last) } else { wanted.rem_euclid(last + 1) }) as usize
    }
}

/// What fits, best first; of equals, and while nothing is typed, in the order of the menus.
fn found(session: &Session, query: &str) -> Vec<(Match, Entry)> {
    let fits = |mut entry: Entry| {
        // Who remembers the menu finds what stands in it.
        let also = format!("{} {}", entry.command.also(), entry.group.to_lowercase());
        let (called, known) = (find(query, &entry.label), find_also(query, &entry.label, &also));
        // Letters scattered over a name are meant less than another word for it.
        if known.as_ref().map(|m| m.score) > called.as_ref().map(|m| m.score) {
            let typed = query.to_lowercase();
            let typed: Vec<&str> = typed.split_whitespace().collect();
            let meant = also.split_whitespace().filter(|word| typed.iter().any(|typed| word.starts_with(typed)));
            let meant = meant.filter(|word| *word != entry.group.to_lowercase()).collect::<Vec<_>>().join(", ");
            if !meant.is_empty() {
                entry.tooltip = format!("{meant}: {}", entry.tooltip);
            }
            return Some((known?, entry));
        }
        Some((called?, entry))
    };
    let mut found: Vec<_> = entries(session).into_iter().filter_map(fits).collect();
    if !query.trim().is_empty() {
        found.sort_by_key(|(matched, _)| std::cmp::Reverse(matched.score));
    }
    found
}

fn entries(session: &Session) -> Vec<Entry> {
    let mut entries = Vec::new();
    for menu in MENUS {
        for command in menu.groups.iter().copied().flatten().filter(|c| **c != Command::Palette) {
            let description = command.describe();
            let (label, tooltip) = (description.label.to_owned(), description.tooltip.to_owned());
            entries.push(Entry { group: menu.title, label, tooltip, command: command.clone() });
        }
    }
    if let Some(program) = session.program() {
        for rule in program.rules.iter().filter_map(|&r| program.function(r)) {
            entries.push(Entry {
                group: "Rule",
                label: format!("Step with {}", rule.name),
                tooltip: "choose the rule that a step applies".to_owned(),
                command: Command::ChooseRule(rule.name.clone()),
            });
        }
    }
    for path in session.recent() {
        entries.push(Entry {
            group: "Recent",
            label: crate::document::file_name(path),
            tooltip: path.display().to_string(),
            command: Command::Open(path.clone()),
        });
    }
    for exhibit in EXHIBITS {
        entries.push(Entry {
            group: "Example",
            label: exhibit.program.to_owned(),
            tooltip: exhibit.headline(),
            command: Command::OpenExample(exhibit.program),
        });
    }
    for mesh in library::MESHES {
        entries.push(Entry {
            group: "Mesh",
            label: mesh.name.to_owned(),
            tooltip: "use this mesh".to_owned(),
            command: Command::UseMesh(MeshSource::BuiltIn(mesh.name.to_owned())),
        });
    }
    entries
}

/// Points for the name of a menu.
const GROUP: f32 = 60.0;

fn row(ui: &mut Ui, session: &Session, entry: &Entry, matched: &Match, selected: bool) -> (egui::Response, bool) {
    let enabled = entry.command.is_enabled(session);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click());
    response.widget_info(|| WidgetInfo::selected(egui::Role::Button, enabled, selected, &entry.label));
    if !ui.is_rect_visible(rect) {
        return (response, enabled); // to lay out all texts takes longer than a picture may
    }
    let visuals = ui.visuals().clone();
    let (mut text, mut weak) = (visuals.text_color(), visuals.weak_text_color());
    if selected {
        ui.painter().rect_filled(rect, visuals.menu_corner_radius, visuals.selection.bg_fill);
        (text, weak) = (visuals.selection.stroke.color, visuals.selection.stroke.color);
    } else if response.hovered() {
        ui.painter().rect_filled(rect, visuals.menu_corner_radius, visuals.widgets.hovered.weak_bg_fill);
    }
    if !enabled {
        text = weak;
    }
    let body = TextStyle::Body.resolve(ui.style());
    let small = TextStyle::Small.resolve(ui.style());
    let mut job = LayoutJob::default();
    let marked = if selected { text } else { visuals.hyperlink_color };
    for (i, letter) in entry.label.chars().enumerate() {
        let color = if enabled && matched.at.contains(&i) { marked } else { text };
        let underline =
            if enabled && matched.at.contains(&i) { egui::Stroke::new(1.0, color) } else { egui::Stroke::NONE };
        let format = TextFormat { font_id: body.clone(), color, underline, ..Default::default() };
        job.append(letter.encode_utf8(&mut [0; 4]), 0.0, format);
    }
    let galley = ui.painter().layout_job(job);
    let width = galley.size().x;
    let inner = rect.shrink2(vec2(10.0, 0.0));
    ui.painter().galley(Align2::LEFT_CENTER.align_size_within_rect(galley.size(), inner).min, galley, text);
    let keys = entry.command.describe().shortcuts.first().map(|s| super::widgets::keys(ui, s)).unwrap_or_default();
    let right = ui.painter().text(inner.right_center(), Align2::RIGHT_CENTER, &keys, small.clone(), weak);
    // Menu and explanation stand in columns, unless a long name needs the room.
    let from = inner.left() + (width + 18.0).max(0.36 * inner.width());
    let words = |from: f32, to: f32, text: &str| {
        let room = Rect::from_min_max(egui::pos2(from, rect.top()), egui::pos2(to, rect.bottom()));
        let mut job = LayoutJob::simple_singleline(text.to_owned(), small.clone(), weak);
        job.wrap = egui::text::TextWrapping::truncate_at_width(room.width().max(10.0));
        job.halign = Align::LEFT;
        let galley = ui.painter().layout_job(job);
        ui.painter().galley(Align2::LEFT_CENTER.align_size_within_rect(galley.size(), room).min, galley, weak);
    };
    words(from, right.left() - 12.0, entry.group);
    if width < 0.45 * inner.width() {
        words(from + GROUP, right.left() - 12.0, &entry.tooltip);
    }
    (response, enabled)
}
