//! The dialog in which everything is set as the user likes it.

use eframe::egui::{
    Align, ComboBox, Context, DragValue, Frame, Grid, Id, Key, Layout, Margin, Modal, RichText, Slider, SliderClamping,
    Ui, vec2,
};

use super::widgets::{check_box, first_choice};
use crate::camera::Up;
use crate::command::{Command, Panel, Reload, ThemeChoice, ViewAction};
use crate::navigation::{Preset, Turning};
use crate::preferences::{Preferences, Start, Unit};
use crate::session::{Dialog, Session};

/// Points of width from which on the parts stand side by side.
const BESIDE: f32 = 1000.0;

/// Shows it.
pub fn show(ctx: &Context, session: &Session, commands: &mut Vec<Command>) {
    if session.dialog != Some(Dialog::Preferences) {
        return;
    }
    let frame = Frame::window(&ctx.global_style()).inner_margin(Margin::same(18));
    let response = Modal::new(Id::unique("preferences")).frame(frame).show(ctx, |ui| {
        let room = ui.ctx().content_rect().size();
        // Side by side all is seen at once, also in a low window.
        let beside = room.x >= BESIDE;
        ui.set_width(if beside { BESIDE - 100.0 } else { 540.0_f32.min(room.x - 60.0) });
        ui.heading("Preferences");
        ui.add_space(8.0);
        let mut preferences = session.preferences;
        let height = (room.y - 170.0).max(120.0);
        let area = eframe::egui::ScrollArea::vertical().auto_shrink([false, true]).max_height(height);
        let area = area.content_margin(super::theme::beside_bar());
        area.show(ui, |ui| {
            if beside {
                ui.columns(2, |columns| {
                    window(&mut columns[0], session, &mut preferences, commands);
                    columns[0].add_space(8.0);
                    program(&mut columns[0], session, &mut preferences, commands);
                    navigation(&mut columns[1], session, commands);
                    columns[1].add_space(8.0);
                    generations(&mut columns[1], session, &mut preferences, commands);
                });
                return;
            }
            window(ui, session, &mut preferences, commands);
            ui.add_space(8.0);
            program(ui, session, &mut preferences, commands);
            ui.add_space(8.0);
            navigation(ui, session, commands);
            ui.add_space(8.0);
            generations(ui, session, &mut preferences, commands);
        });
        ui.add_space(12.0);
        ui.horizontal(|ui| {
            if ui.add(first_choice(ui, "Done")).clicked() {
                commands.push(Command::CloseDialog);
            }
            let reset = ui.button("Reset to defaults").on_hover_text("everything here as it was at first");
            if reset.clicked() {
                preferences = Preferences { picture: preferences.picture, ..Preferences::default() };
                commands.push(Command::SetTheme(ThemeChoice::default()));
                commands.push(Command::SetReload(Reload::default()));
                commands.push(Command::SetSpeed(crate::session::SPEED));
                commands.push(Command::View(ViewAction::SetPreset(Preset::Vv)));
                commands.push(Command::View(ViewAction::SetTurning(Turning::Arcball)));
                commands.push(Command::View(ViewAction::SetUp(Up::Y)));
                if !session.navigation.glide {
                    commands.push(Command::View(ViewAction::Gliding));
                }
                for panel in PANELS.map(|(panel, _)| panel) {
                    if !session.panels.is_open(panel) {
                        commands.push(Command::Toggle(panel));
                    }
                }
            }
        });
        if preferences != session.preferences {
            commands.push(Command::SetPreferences(preferences));
        }
    });
    let enter = ctx.input(|i| i.key_pressed(Key::Enter)) && ctx.memory(|m| m.focused().is_none());
    if response.should_close() || enter {
        commands.push(Command::CloseDialog);
    }
}

const PANELS: [(Panel, &str); 4] = [
    (Panel::Program, "Program"),
    (Panel::Messages, "Messages"),
    (Panel::Inspector, "Inspector"),
    (Panel::Timeline, "Time line"),
];

fn section(ui: &mut Ui, title: &str, rows: impl FnOnce(&mut Ui)) {
    super::widgets::bold(ui, title);
    ui.add_space(2.0);
    Grid::new(title).num_columns(2).min_col_width(150.0).spacing([16.0, 7.0]).show(ui, rows);
}

/// A row: what it is called, and a field for it.
fn row(ui: &mut Ui, name: &str, tip: &str, field: impl FnOnce(&mut Ui) -> eframe::egui::Response) {
    let label = ui.label(name);
    field(ui).labelled_by(label.id).on_hover_text(tip);
    ui.end_row();
}

/// A list to choose one of.
fn list<T: Copy + PartialEq>(
    ui: &mut Ui,
    name: &str,
    now: T,
    all: &[(T, &str)],
    mut choose: impl FnMut(T),
) -> eframe::egui::Response {
    let text = all.iter().find(|(value, _)| *value == now).map_or("", |(_, text)| *text);
    let list = ComboBox::from_id_salt(name).selected_text(text).width(200.0).show_ui(ui, |ui| {
        for (value, text) in all {
            if ui.selectable_label(*value == now, *text).clicked() {
                choose(*value);
            }
        }
    });
    list.response
}

fn window(ui: &mut Ui, session: &Session, preferences: &mut Preferences, commands: &mut Vec<Command>) {
    section(ui, "Window", |ui| {
        row(ui, "At start", "what opens where no file is given", |ui| {
            let all = [
                (Start::Gallery, "the gallery"),
                (Start::Surface, "a surface"),
                (Start::LastSession, "what was open last"),
            ];
            list(ui, "start", preferences.start, &all, |start| preferences.start = start)
        });
        row(ui, "Theme", "light or dark", |ui| {
            let all =
                [(ThemeChoice::System, "as the system"), (ThemeChoice::Light, "light"), (ThemeChoice::Dark, "dark")];
            list(ui, "theme", session.theme, &all, |theme| commands.push(Command::SetTheme(theme)))
        });
        row(ui, "A length of 1 is", "the unit of measures; nothing is converted", |ui| {
            let all = Unit::ALL.map(|unit| (unit, if unit == Unit::None { "no unit" } else { unit.suffix().trim() }));
            list(ui, "unit", preferences.unit, &all, |unit| preferences.unit = unit)
        });
        row(ui, "Size of everything", "also Ctrl and +, −, 0", |ui| {
            let field = DragValue::new(&mut preferences.scale).range(Preferences::SCALES).speed(0.01);
            let percent = |x: f64, _| format!("{:.0} %", x * 100.0);
            let parse = |text: &str| Some(text.trim().trim_end_matches('%').trim().parse::<f64>().ok()? / 100.0);
            ui.add(field.update_while_editing(false).custom_formatter(percent).custom_parser(parse))
        });
        // In rows of the table, two and two: wrapped in one cell they would stand apart from the other rows.
        for (i, row) in PANELS.chunks(2).enumerate() {
            ui.label(if i == 0 { "Panels" } else { "" });
            ui.horizontal(|ui| {
                for &(panel, name) in row {
                    let size = vec2(96.0, ui.spacing().interact_size.y);
                    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
                        ui.set_min_width(size.x);
                        let mut on = session.panels.is_open(panel);
                        let command = Command::Toggle(panel);
                        if check_box(ui, &mut on, name).on_hover_text(command.describe().tooltip).changed() {
                            commands.push(command);
                        }
                    });
                }
            });
            ui.end_row();
        }
    });
}

fn program(ui: &mut Ui, session: &Session, preferences: &mut Preferences, commands: &mut Vec<Command>) {
    section(ui, "Program", |ui| {
        row(ui, "A changed text is run", "when a changed program is compiled and run", |ui| {
            let all =
                [(Reload::Typed, "as typed"), (Reload::Saved, "when it is saved"), (Reload::ByHand, "when asked for")];
            list(ui, "reload", session.reload, &all, |reload| commands.push(Command::SetReload(reload)))
        });
        row(ui, "Size of letters", "in points", |ui| {
            ui.add(DragValue::new(&mut preferences.font_size).range(Preferences::FONT_SIZES).speed(0.1).suffix(" pt"))
        });
        row(ui, "Tab makes", "spaces that Tab and a new block are indented by", |ui| {
            let spaces = if preferences.tab_width == 1 { " space" } else { " spaces" };
            ui.add(DragValue::new(&mut preferences.tab_width).range(Preferences::TAB_WIDTHS).speed(0.05).suffix(spaces))
        });
    });
    let font = eframe::egui::FontId::monospace(preferences.font_size);
    ui.label(RichText::new("forall p in S { p$pos *= 0.5; }").font(font).weak());
}

fn navigation(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let now = session.navigation;
    let mut set = |action| commands.push(Command::View(action));
    section(ui, "Navigation", |ui| {
        row(ui, "Mouse", "whose habits the hands have", |ui| {
            let all = [(Preset::Vv, "as in vv"), (Preset::Blender, "as in Blender"), (Preset::Maya, "as in Maya")];
            list(ui, "preset", now.preset, &all, |preset| set(ViewAction::SetPreset(preset)))
        });
        row(ui, "Turning", "how a drag turns the mesh", |ui| {
            let all =
                [(Turning::Arcball, "arcball: follows the pointer"), (Turning::Turntable, "turntable: stays upright")];
            list(ui, "turning", now.turning, &all, |turning| set(ViewAction::SetTurning(turning)))
        });
        row(ui, "Up", "the axis that points up", |ui| {
            list(ui, "up", now.up, &[(Up::Y, "y"), (Up::Z, "z")], |up| set(ViewAction::SetUp(up)))
        });
        row(ui, "Viewpoints", "how a new viewpoint is gone to", |ui| {
            let all = [(true, "are glided to"), (false, "are there at once")];
            list(ui, "glide", now.glide, &all, |glide| {
                if glide != now.glide {
                    set(ViewAction::Gliding);
                }
            })
        });
    });
}

fn generations(ui: &mut Ui, session: &Session, preferences: &mut Preferences, commands: &mut Vec<Command>) {
    section(ui, "Generations", |ui| {
        row(ui, "Memory to keep them in", "past this they are computed again when they are gone back to", |ui| {
            let slider = Slider::new(&mut preferences.memory, Preferences::MEMORIES);
            ui.add(slider.logarithmic(true).clamping(SliderClamping::Always).suffix(" MiB").smart_aim(true))
        });
        row(ui, "Speed of playing", "generations a second, at most", |ui| {
            let mut speed = session.speed;
            let response = ui.add(DragValue::new(&mut speed).range(0.1..=60.0).speed(0.1).suffix(" / s"));
            if response.changed() {
                commands.push(Command::SetSpeed(speed));
            }
            response
        });
    });
}
