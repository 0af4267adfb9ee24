//! All keys, and what the mouse does.

use eframe::egui::{
    Color32, Context, Frame, Id, Key, Margin, Modal, RichText, ScrollArea, TextEdit, TextStyle, Ui, vec2,
};

use super::clicks;
use crate::command::{Command, MENUS, find, find_also, of_hands};
use crate::navigation::Preset;
use crate::session::{Dialog, Session};

/// Keys that mean more than one command.
const MORE: &[(&str, &str)] = &[("0 … 9", "go to this generation")];

/// Shows it.
pub fn show(ctx: &Context, session: &mut Session, commands: &mut Vec<Command>) {
    let preset = session.navigation.preset;
    let Some(Dialog::CheatSheet { query }) = &mut session.dialog else { return };
    let frame = Frame::window(&ctx.global_style()).inner_margin(Margin::same(18));
    let response = Modal::new(Id::unique("keys")).frame(frame).show(ctx, |ui| {
        let room = ui.ctx().content_rect().size();
        ui.set_width(760.0_f32.min(room.x - 60.0));
        ui.horizontal(|ui| {
            ui.heading("Keys");
            ui.add_space(12.0);
            let field =
                ui.add(TextEdit::singleline(query).hint_text(super::widgets::hint("find")).desired_width(220.0));
            field.request_focus();
            field.accessible_name("Find a key");
        });
        ui.add_space(10.0);
        let sections = sections(ui, preset, query);
        let height = (room.y - 170.0).clamp(120.0, 640.0);
        ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
            if sections.is_empty() {
                ui.weak("no key does that");
            }
            let columns = if room.x > 720.0 { 2 } else { 1 };
            let split = fair_split(&sections, columns);
            ui.columns(columns, |columns| {
                for (i, section) in sections.iter().enumerate() {
                    let column = usize::from(columns.len() > 1 && i >= split);
                    show_section(&mut columns[column], section);
                }
            });
        });
    });
    if response.should_close() || ctx.input(|i| i.key_pressed(Key::Enter)) {
        commands.push(Command::CloseDialog);
    }
}

struct Section {
    title: &'static str,
    rows: Vec<Row>,
}

/// Keys, what they do, and other words for that.
type Row = (String, String, &'static str);

fn sections(ui: &Ui, preset: Preset, query: &str) -> Vec<Section> {
    let mut sections: Vec<Section> = MENUS
        .iter()
        .map(|menu| {
            let commands = menu.groups.iter().copied().flatten();
            let rows = commands.filter_map(|command| {
                let description = command.describe();
                let keys: Vec<String> = description.shortcuts.iter().map(|s| super::widgets::keys(ui, s)).collect();
                let label = description.label.trim_end_matches('…').to_owned();
                (!keys.is_empty()).then(|| (keys.join("  or  "), label, command.also()))
            });
            Section { title: menu.title, rows: rows.collect() }
        })
        .collect();
    let fixed = |rows: &[(&str, &str)]| -> Vec<Row> {
        rows.iter().map(|&(keys, what)| (keys.to_owned(), what.to_owned(), "")).collect()
    };
    if let Some(help) = sections.iter_mut().find(|s| s.title == "Help") {
        help.rows.extend(fixed(super::menu_keys::KEYS));
    }
    if let Some(run) = sections.iter_mut().find(|s| s.title == "Run") {
        run.rows.extend(fixed(if preset == Preset::Blender { &[] } else { MORE }));
    }
    let of_hands = of_hands(preset).iter().map(|(keys, command)| {
        let label = command.describe().label.trim_end_matches('…');
        (ui.ctx().format_shortcut(keys), label.to_owned(), command.also())
    });
    sections.push(Section { title: "Digits and keypad", rows: of_hands.collect() });
    let hands = preset.explained().into_iter().map(|(how, what)| (how, what.to_owned(), ""));
    sections.push(Section { title: "In the picture", rows: hands.chain(fixed(clicks::HANDS)).collect() });
    for section in &mut sections {
        section.rows.retain(|(keys, label, also)| {
            find(query, &format!("{label} {keys}")).is_some() || find_also(query, label, also).is_some()
        });
    }
    sections.retain(|section| !section.rows.is_empty());
    sections
}

/// How many sections stand in the first column, so that the columns are about as long.
fn fair_split(sections: &[Section], columns: usize) -> usize {
    let length = |s: &Section| s.rows.len() + 2;
    let total: usize = sections.iter().map(length).sum();
    let mut so_far = 0;
    sections
        .iter()
        .take_while(|s| {
            let half = so_far + length(s) / 2 < total.div_ceil(columns);
            so_far += length(s);
            half
        })
        .count()
}

fn show_section(ui: &mut Ui, section: &Section) {
    super::widgets::bold(ui, section.title);
    ui.add_space(2.0);
    let font = TextStyle::Body.resolve(ui.style());
    let width = ui.available_width();
    for (keys, label, _) in &section.rows {
        let long = |text: &String| ui.painter().layout_no_wrap(text.clone(), font.clone(), Color32::WHITE).size().x;
        let (name, wanted) = (long(label), long(keys) + 12.0);
        let room = width - name - wanted - 28.0;
        if room < 8.0 {
            ui.label(label); // the keys get a line of their own
        }
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 0.0;
            if room < 8.0 {
                ui.add_space((width - wanted - 28.0).max(0.0));
            } else {
                ui.label(label);
                ui.add_space(room);
            }
            let frame = Frame::NONE.fill(ui.visuals().faint_bg_color).corner_radius(4);
            frame.inner_margin(Margin::symmetric(6, 1)).show(ui, |ui| {
                ui.label(RichText::new(keys).color(ui.visuals().weak_text_color()));
            });
        });
    }
    ui.allocate_space(vec2(1.0, 10.0));
}
