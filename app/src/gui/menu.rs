//! The menu bar.

use eframe::egui::text::LayoutJob;
use eframe::egui::{
    Align, Color32, Key, Layout, MenuBar, Response, ScrollArea, Stroke, TextFormat, TextStyle, TextWrapMode, Ui,
};

use super::widgets::{TICK, menu_item};
use super::{menu_keys, views};
use crate::command::{Command, MENUS, Menu, outer};
use crate::document::MeshSource;
use crate::gallery::{EXHIBITS, Exhibit, Group};
use crate::library;
use crate::session::Session;

/// Letters that open a menu with Alt: those of its title at these places.
const LETTERS: [(&str, usize, Key); 11] = [
    ("File", 0, Key::F),
    ("Examples", 1, Key::X),
    ("Meshes", 0, Key::M),
    ("Edit", 0, Key::E),
    ("Run", 0, Key::R),
    ("View", 0, Key::V),
    ("Subdivide", 0, Key::S),
    ("Camera", 0, Key::C),
    ("Inspect", 0, Key::I),
    ("Show", 2, Key::O),
    ("Help", 0, Key::H),
];

/// Shows it.
pub fn show(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    menu_keys::open(ui, &LETTERS.map(|(.., key)| key));
    let mut buttons = Vec::new();
    MenuBar::new().ui(ui, |ui| {
        for menu in MENUS.iter().filter(|menu| outer(menu.title).is_none()) {
            let title = title(ui, menu.title);
            buttons.push(of_bar(ui, title, |ui| whole(ui, session, commands, menu)));
            if menu.title == "File" {
                let name = self::title(ui, "Examples");
                buttons.push(of_bar(ui, name, |ui| examples(ui, session, commands)));
                let name = self::title(ui, "Meshes");
                buttons.push(of_bar(ui, name, |ui| meshes(ui, session, commands)));
            }
        }
    });
    menu_keys::remember(ui, &buttons);
}

/// A menu that hangs from the bar.
fn of_bar(ui: &mut Ui, title: LayoutJob, show: impl FnOnce(&mut Ui)) -> Response {
    let bar = ui.max_rect().bottom();
    ui.menu_button(title, |ui| scrolled(ui, bar, show)).response
}

/// The entries of a menu, which are scrolled if they have no room below `top`.
pub fn scrolled(ui: &mut Ui, top: f32, show: impl FnOnce(&mut Ui)) {
    let around = ui.style().spacing.menu_margin.sum().y + 12.0;
    let room = (ui.ctx().content_rect().bottom() - top - around).max(100.0);
    // Nothing else says that there is more; and the keys of the entries are not covered.
    let scroll = &mut ui.spacing_mut().scroll;
    (scroll.dormant_handle_opacity, scroll.floating_allocated_width) = (0.5, 10.0);
    ui.style_mut().wrap_mode = Some(TextWrapMode::Extend);
    ScrollArea::vertical().max_height(room).min_scrolled_height(room).show(ui, show);
}

fn whole(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>, menu: &Menu) {
    ui.set_min_width(210.0);
    entries(ui, session, commands, menu);
    if MENUS.iter().any(|inner| outer(inner.title) == Some(menu.title)) {
        ui.separator();
    }
    let ticks = has_ticks(session, menu);
    for more in MENUS.iter().filter(|inner| outer(inner.title) == Some(menu.title)) {
        inner(ui, more.title, ticks, |ui| entries(ui, session, commands, more));
    }
    if menu.title == "Camera" {
        inner(ui, "Saved viewpoints", ticks, |ui| views::show(ui, session, commands));
    }
}

/// A title, its letter underlined while Alt is held.
fn title(ui: &Ui, text: &str) -> LayoutJob {
    let font = TextStyle::Button.resolve(ui.style());
    let plain = TextFormat::simple(font, Color32::PLACEHOLDER);
    let letter = LETTERS.iter().find(|(title, ..)| *title == text).map(|(_, at, _)| *at);
    let mut job = LayoutJob::default();
    match letter.filter(|_| ui.input(|i| i.modifiers.alt)) {
        Some(at) => {
            let line = Stroke::new(1.0, ui.visuals().text_color());
            job.append(&text[..at], 0.0, plain.clone());
            job.append(&text[at..=at], 0.0, TextFormat { underline: line, ..plain.clone() });
            job.append(&text[at + 1..], 0.0, plain);
        }
        None => job.append(text, 0.0, plain),
    }
    job
}

/// A menu in a menu, in line with the entries of one with `ticks`.
fn inner(ui: &mut Ui, title: &str, ticks: bool, show: impl FnOnce(&mut Ui)) {
    let mut text = LayoutJob::default();
    let format = TextFormat::simple(TextStyle::Button.resolve(ui.style()), Color32::PLACEHOLDER);
    text.append(title, if ticks { TICK } else { 0.0 }, format);
    let button = ui.menu_button(text, |ui| scrolled(ui, 0.0, show));
    menu_keys::entry(ui, &button.response);
}

/// Whether some entry of a menu may have a tick before it.
fn has_ticks(session: &Session, menu: &Menu) -> bool {
    menu.groups.iter().copied().flatten().any(|command| command.is_on(session).is_some())
}

fn entries(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>, menu: &Menu) {
    let ticks = has_ticks(session, menu);
    for (i, group) in menu.groups.iter().enumerate() {
        if i > 0 {
            ui.separator();
        }
        for command in *group {
            menu_item(ui, session, commands, command.clone(), ticks);
        }
        if i == 0 && menu.title == "File" && !session.recent().is_empty() {
            inner(ui, "Open recent", ticks, |ui| recent(ui, session, commands));
        }
    }
}

fn recent(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    ui.set_min_width(240.0);
    for path in session.recent() {
        let response = ui.button(crate::document::file_name(path));
        menu_keys::entry(ui, &response);
        if response.on_hover_text(path.display().to_string()).clicked() {
            commands.push(Command::Open(path.clone()));
            ui.close();
        }
    }
    ui.separator();
    menu_item(ui, session, commands, Command::ForgetRecent, false);
}

fn examples(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    menu_item(ui, session, commands, Command::Gallery, false);
    ui.separator();
    // Side by side, so that all have room in a small window.
    let columns: [&[Group]; 3] =
        [&[Group::Subdivision], &[Group::Beyond, Group::Fractals], &[Group::Growth, Group::Paper]];
    ui.horizontal_top(|ui| {
        for groups in columns {
            ui.vertical(|ui| {
                ui.set_width(186.0);
                ui.spacing_mut().item_spacing.y = 3.0;
                for group in groups {
                    ui.weak(group.title());
                    let filled = Layout::top_down_justified(Align::Min);
                    ui.with_layout(filled, |ui| {
                        for exhibit in EXHIBITS.iter().filter(|e| e.group == *group) {
                            example(ui, session, commands, exhibit);
                        }
                    });
                    ui.add_space(6.0);
                }
            });
        }
    });
}

fn example(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>, exhibit: &Exhibit) {
    let open = session.document.program.path.is_none() && session.document.program.name == exhibit.program;
    let response = ui.selectable_label(open, exhibit.program);
    menu_keys::entry(ui, &response);
    if response.on_hover_text(exhibit.headline()).clicked() {
        commands.push(Command::OpenExample(exhibit.program));
        ui.close();
    }
}

fn meshes(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    ui.set_min_width(180.0);
    for mesh in library::MESHES {
        let source = MeshSource::BuiltIn(mesh.name.to_owned());
        let response = ui.selectable_label(session.document.mesh == source, mesh.name);
        menu_keys::entry(ui, &response);
        if response.clicked() {
            commands.push(Command::UseMesh(source));
            ui.close();
        }
    }
    ui.separator();
    let none = session.document.mesh == MeshSource::Empty;
    let response = ui.selectable_label(none, "No mesh").on_hover_text("for programs that build their own");
    menu_keys::entry(ui, &response);
    if response.clicked() {
        commands.push(Command::UseMesh(MeshSource::Empty));
        ui.close();
    }
}
